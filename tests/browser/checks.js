// Returns what is wrong with the page as it stands: an expression, evaluated in the page.
(() => {
  const problems = [];
  const dark = matchMedia("screen and (prefers-color-scheme: dark)").matches;
  const name = (element) => {
    const text = (element.textContent || "").trim().slice(0, 30);
    return `<${element.localName}${element.id ? "#" + element.id : ""} "${text}">`;
  };

  // ---- the document -----------------------------------------------------------------------------------------------
  if (document.documentElement.lang !== "en") problems.push("the language is not stated");
  if (document.title === "") problems.push("there is no title");
  if (document.querySelectorAll("h1").length !== 1) problems.push("there is not one h1");
  let level = 1;
  for (const heading of document.querySelectorAll("h1, h2, h3, h4, h5, h6")) {
    const own = Number(heading.localName[1]);
    if (own > level + 1) problems.push(`${name(heading)} skips a level`);
    level = own;
  }
  const ids = Array.from(document.querySelectorAll("[id]"), (element) => element.id);
  for (const id of new Set(ids.filter((one, i) => ids.indexOf(one) !== i))) problems.push(`#${id} is not unique`);
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    if (document.getElementById(decodeURIComponent(link.hash.slice(1))) === null) problems.push(`${name(link)} leads nowhere`);
  }

  // ---- nothing is wider than the page -----------------------------------------------------------------------------
  const view = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > view) {
    problems.push(`the page is ${document.documentElement.scrollWidth} px wide in a window of ${view} px`);
    for (const element of document.body.querySelectorAll("*")) {
      const box = element.getBoundingClientRect();
      if (box.right > view + 1 && !element.closest(".scroll")) problems.push(`${name(element)} ends at ${box.right} px`);
    }
  }

  // ---- figures are seen, and said ---------------------------------------------------------------------------------
  for (const picture of document.querySelectorAll("svg, canvas, img")) {
    if (picture.getAttribute("aria-hidden") === "true") continue;
    // Of a figure with a drawing for phones one is shown, and is looked at.
    const drawings = Array.from(picture.closest("figure")?.querySelectorAll(":scope > .on-wide, :scope > .on-narrow") ?? []);
    if (drawings.length && drawings.filter((one) => one.getClientRects().length > 0).length !== 1) problems.push(`${name(picture)} is not shown once`);
    if (drawings.length && picture.getClientRects().length === 0) continue;
    const box = picture.getBoundingClientRect();
    const style = getComputedStyle(picture);
    if (box.width < 40 || box.height < 20 || style.visibility !== "visible") problems.push(`${name(picture)} is not seen`);
    const said = picture.getAttribute("aria-label") || picture.getAttribute("alt") || picture.querySelector("title")?.textContent;
    if (!(said || "").trim()) problems.push(`${name(picture)} has no alternative text`);
    if (picture.localName !== "img" && picture.getAttribute("role") !== "img") problems.push(`${name(picture)} has no role`);
    const scroll = picture.closest(".scroll");
    if (picture.localName === "svg" && scroll === null && box.right > view) problems.push(`${name(picture)} is cut`);
  }
  for (const field of document.querySelectorAll("input, select, button")) {
    const said = field.getAttribute("aria-label") || field.labels?.[0]?.textContent || field.textContent;
    if (!(said || "").trim()) problems.push(`${name(field)} has no label`);
  }

  // ---- contrast: WCAG 2.2, 1.4.3 ----------------------------------------------------------------------------------
  const probe = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgba = (text) => {
    probe.clearRect(0, 0, 1, 1);
    probe.fillStyle = "#000";
    probe.fillStyle = text;
    probe.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = probe.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = ([r, g, b, a], below) => [r, g, b].map((value, i) => a * value + (1 - a) * below[i]);
  const luminance = (colour) => {
    const [r, g, b] = colour.map((value) => {
      const part = value / 255;
      return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = (one, other) => {
    const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  const paper = getComputedStyle(document.body).backgroundColor;
  const behind = (element) => {
    const layers = [];
    for (let e = element; e !== null; e = e.parentElement) layers.push(rgba(getComputedStyle(e).backgroundColor));
    return layers.reverse().reduce((below, layer) => over(layer, below), [255, 255, 255]);
  };
  // What the style sheet does in dark mode to a figure that is made for white: invert(0.902) hue-rotate(180deg).
  const inverted = (colour) => {
    const [r, g, b] = colour.map((value) => 0.902 * 255 - 0.804 * value);
    const rows = [[-0.574, 1.43, 0.144], [0.426, 0.43, 0.144], [0.426, 1.43, -0.856]];
    return rows.map(([x, y, z]) => Math.min(255, Math.max(0, x * r + y * g + z * b)));
  };
  let texts = 0;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    if (walker.currentNode.data.trim() === "" || element.closest("script, style, noscript, title, option")) continue;
    const box = element.getBoundingClientRect();
    if (box.width === 0 || box.height === 0 || box.right < 0 || getComputedStyle(element).visibility !== "visible") continue;
    const style = getComputedStyle(element);
    const svg = element.closest("svg");
    let [ground, ink] = [behind(element), rgba(svg === null ? style.color : style.fill)];
    if (svg !== null && svg.classList.contains("inverts")) {
      [ground, ink] = [[255, 255, 255], [...over(ink, [255, 255, 255]), 1]];
      if (dark) [ground, ink] = [inverted(ground), [...inverted(ink.slice(0, 3)), 1]];
    }
    for (let e = element; e !== null; e = e.parentElement) ink[3] *= Number(getComputedStyle(e).opacity);
    const size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    const ratio = contrast(over(ink, ground), ground);
    texts += 1;
    if (ratio < (large ? 3 : 4.5)) problems.push(`${name(element)} has a contrast of ${ratio.toFixed(2)}`);
  }
  // What an animation draws: words in ink, in the colours of the buildings and in that of events, on its paper.
  for (const animation of document.querySelectorAll(".animation")) {
    const colour = (variable) => over(rgba(getComputedStyle(animation).getPropertyValue(variable)), over(rgba(paper), [255, 255, 255]));
    for (const variable of ["--ink", "--soft", "--slide", "--code", "--attached", "--bare", "--yield"]) {
      const ratio = contrast(colour(variable), colour("--paper"));
      texts += 1;
      if (ratio < 4.5) problems.push(`${variable} of an animation has a contrast of ${ratio.toFixed(2)}`);
    }
  }
  return { problems, texts };
})()
