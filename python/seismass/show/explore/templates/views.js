// What is shown of a solved case: words, figures and tables.
const MINUS = "\u2212";
const fixed = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", MINUS);
// As Python's format .4g has it.
function general(value, digits) {
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : "\u2013";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const power = Number(exponent);
  if (power >= -4 && power < digits) return String(Number(value.toPrecision(digits))).replace("-", MINUS);
  const sign = power < 0 ? "-" : "+";
  return `${Number(mantissa)}e${sign}${String(Math.abs(power)).padStart(2, "0")}`.replaceAll("-", MINUS);
}
const per100 = (share) => `${fixed(100 * share, 0)} %`;
// A value at a share between those that were solved, which have equal distances from 0 to 1.
function valueAt(share, values) {
  const at = share * (values.length - 1);
  const low = Math.min(Math.floor(at), values.length - 2);
  return values[low] + (values[low + 1] - values[low]) * (at - low);
}
const largest = (list) => list.reduce((most, value) => Math.max(most, value), 0);
const place = (list) => list.reduce((best, value, i) => (value > list[best] ? i : best), 0);
const listed = (words) => (words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words.at(-1)}`);
const KIND_WORDS = {
  stuck: "no goods slide under any motion of the suite, so that all of them act as mass",
  root: "one share gives the drift of the building whose goods slide",
  multiple: "several shares give the drift of the building whose goods slide, the largest counts",
  zero: "no share drifts less than the building whose goods slide, so that none needs to be attached",
  one: "even with all goods attached the model drifts less than the building whose goods slide",
};

// Peak drifts over the storey heights.
const ratiosOf = (run, { height }) => Array.from(run.peakDrift, (drift, i) => drift / height[i]);
const weightOf = (scene) => GRAVITY * scene.floorMass.reduce((sum, mass) => sum + mass, 0);

// The run in words, for the live region.
function runWords({ state, real, code, full }, name) {
  const storey = place(ratiosOf(real, state));
  const [end, collapsed] = real.end;
  const drift = (run) => (run.end[1] > 0 ? `storey ${run.end[1]} collapses` : `${fixed(1000 * run.peakDrift[storey], 1)} mm`);
  const yielding = new Set();
  for (let i = 0; i < real.events.length; i += 4) if (real.events[i + 1] === 0) yielding.add(real.events[i + 2]);
  const parts = [
    `Under ${name} at intensity ${general(state.intensity, 4)}: ` +
      (collapsed > 0
        ? `storey ${collapsed} collapses at ${fixed(end, 2)} s, where the run ends.`
        : `largest drift ${drift(real)} (${fixed((100 * real.peakDrift[storey]) / state.height[storey], 2)} % of the height) in storey ${storey + 1}.`),
    yielding.size ? `Storeys that yield: ${listed([...yielding].sort().map(String))}.` : "No storey yields.",
  ];
  if (real.blocks.length) {
    const slid = real.blocks.filter((_, j) => real.peakSlip[j] > 0);
    const most = place(real.peakSlip);
    parts.push(
      slid.length
        ? `Goods slide on ${slid.length === 1 ? "floor" : "floors"} ${listed(slid.map((block) => String(block.floor)))}, at most ${fixed(1000 * real.peakSlip[most], 1)} mm.`
        : "No goods slide.",
      `With ${fixed(100 * state.counted, 0)} % of the goods attached, as the code's model has, ${drift(code)}; with all attached ${drift(full)}.`,
    );
  }
  return parts.join(" ");
}

// The rule of `seismass.effective_mass.rule`, with the constants that the page carries; S_a of the suite in g.
function ruleBy(scene, acceleration, constants) {
  const { massRatio, muS, muK, strength, overstrength, secondSlope, floorMass } = scene;
  const goods = massRatio.reduce((sum, ratio) => sum + ratio, 0);
  const friction = massRatio.reduce((sum, ratio, i) => sum + (ratio * (muS[i] + muK[i])) / 2, 0) / goods;
  const yieldCoefficient = strength[0] / (1 + goods / floorMass.reduce((sum, mass) => sum + mass, 0));
  const reduction = Math.max(1, acceleration / yieldCoefficient);
  const coefficient = acceleration / reduction ** constants.power;
  const ordinary = overstrength.every((one) => one >= constants.leastOverstrength) && secondSlope.every((one) => one > 0 && one <= constants.largestSecondSlope);
  const less = !(ordinary || !Number.isFinite(yieldCoefficient)) || massRatio.some((ratio, i) => ratio > constants.largestLoad * floorMass[i] * (1 + 1e-12));
  const offset = less ? constants.smallOffset : constants.offset;
  const share = (mu) => Math.min(1, Math.max(0, (constants.slope * mu) / coefficient - offset));
  const words =
    `${constants.slope} mu/C1 \u2212 ${fixed(offset, 2)} = ${fixed(share(friction), 3)}; C1 = S_a/R_y^(2/3) = ${fixed(coefficient, 3)}, ` +
    `S_a = ${fixed(acceleration, 3)} g, R_y = ${fixed(reduction, 2)}`;
  const kinetic = massRatio.reduce((sum, ratio, i) => sum + ratio * muK[i], 0) / goods;
  return { coefficient, share, estimate: share(friction), overKinetic: friction / kinetic, words };
}

function fractionWords(found, rule) {
  return {
    short: `Over the built-in motions ${per100(found.value)} of the goods act as mass, 90 % interval ${per100(found.low)} to ${per100(found.high)}.`,
    long:
      `Effective fraction ${fixed(found.value, 3)} (90 % interval over the built-in motions ${fixed(found.low, 2)} to ${fixed(found.high, 2)}). ` +
      `${KIND_WORDS[found.kind].replace(/^./, (letter) => letter.toUpperCase())}. By hand: ${rule.words}.`,
  };
}

// What must be known beside the number, as `EffectiveMass.remarks` has it.
function fractionRemarks(found) {
  const remarks = [];
  if (found.kind === "multiple") {
    remarks.push(`${found.roots.length} shares give the same drift (${Array.from(found.roots, (root) => fixed(root, 3)).join(", ")}).`);
  }
  if (found.kind === "one") {
    remarks.push(`With sliding goods the building drifts ${general(100 * (found.realMean / found.modelMean - 1), 2)} % more than the model with all goods attached.`);
  }
  found.realByStorey.forEach((real, i) => {
    const ratio = real / found.modelByStorey[i];
    if (!(ratio > 1.05)) return;
    const envelope = real / Math.max(found.modelByStorey[i], found.bareByStorey[i]);
    remarks.push(
      `Storey ${i + 1} drifts ${fixed(ratio, 2)} times the model at ${fixed(found.value, 2)}; with a second analysis without goods ${fixed(envelope, 2)} times the larger of the two.`,
    );
  });
  return remarks;
}

function fillTable(table, caption, heads, rows) {
  const make = (name, words, attributes = {}) => Object.assign(document.createElement(name), { textContent: words, ...attributes });
  const row = (cells, name) => {
    const made = document.createElement("tr");
    made.append(...cells.map((words, i) => (name === "td" && i ? make("td", words) : make("th", words, { scope: name === "td" ? "row" : "col" }))));
    return made;
  };
  const [head, body] = [document.createElement("thead"), document.createElement("tbody")];
  head.append(row(heads, "th"));
  body.append(...rows.map((cells) => row(cells, "td")));
  table.replaceChildren(make("caption", caption), head, body);
}

// Three digits, of what is larger none behind the point.
function millimetres(value) {
  const [size, mm] = [Math.abs(1000 * value), 1000 * value];
  return fixed(mm, size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2);
}
function runTables(root, { state, scene, real, code, full }) {
  const weight = weightOf(scene);
  const mm = millimetres;
  const hasGoods = real.blocks.length > 0;
  const storeyRows = Array.from(real.peakDrift, (drift, i) => [
    String(i + 1), mm(drift), fixed((100 * drift) / state.height[i], 2), fixed(real.peakDriftTime[i], 2), mm(real.residualDrift[i]),
    general(real.peakShear[i] / weight, 3), fixed(real.peakAcceleration[i] / GRAVITY, 2),
    ...(hasGoods ? [mm(code.peakDrift[i]), mm(full.peakDrift[i])] : []),
  ]);
  fillTable(
    root.querySelector("table.storeys"), "This motion: goods slide, and peak drifts of the models",
    ["storey", "peak drift mm", "of height %", "at s", "residual mm", "peak shear / W", "floor acceleration g",
      ...(hasGoods ? ["code\u2019s model mm", "all attached mm"] : [])],
    storeyRows,
  );
  const goodsRows = real.blocks.map((block, j) => [
    String(block.floor), general(block.ratio, 3), `${general(block.muS, 3)}${block.muS === block.muK ? "" : `/${general(block.muK, 3)}`}`,
    mm(real.peakSlip[j]), fixed(real.peakSlipTime[j], 2), mm(real.residualSlip[j]), mm(real.slipPath[j]),
  ]);
  root.querySelector("table.goods").hidden = !hasGoods;
  fillTable(
    root.querySelector("table.goods"), "This motion: the goods",
    ["floor", "of floor mass", "mu", "peak slip mm", "at s", "residual mm", "slip path mm"], goodsRows,
  );
  const counts = EVENT_NAMES.map((name, i) => [real.counts[i], name]).filter(([count]) => count > 0);
  root.querySelector(".events").textContent = `Events where goods slide: ${counts.map(([count, name]) => `${count} ${name}`).join(", ") || "none"}.`;
}

function fractionTables(root, found, names) {
  const mm = millimetres;
  const tables = [root.querySelector("table.suite"), root.querySelector("table.motions")];
  for (const table of tables) table.hidden = found === null;
  if (found === null) return;
  fillTable(
    tables[0], "Mean peak drift over the built-in motions by storey (mm), and that of sliding goods over those of the models",
    ["storey", "goods slide", "model at the fraction", "none attached", "all attached", "slide / model", "slide / none", "slide / all", "slide / larger of model and none"],
    Array.from(found.realByStorey, (real, i) => {
      const [model, bare, full] = [found.modelByStorey[i], found.bareByStorey[i], found.fullByStorey[i]];
      return [String(i + 1), mm(real), mm(model), mm(bare), mm(full), ...[model, bare, full, Math.max(model, bare)].map((one) => fixed(real / one, 2))];
    }),
  );
  fillTable(
    tables[1], "Each motion of the suite on its own: single motions have other shares, several or none",
    ["motion", "goods slide", "largest drift % of height", "first share", "last share"],
    names.map((name, i) => [
      name, found.slides[i] ? "yes" : "no", fixed(100 * found.realDrift[i], 2),
      ...[found.firstRoot[i], found.lastRoot[i]].map((root) => (Number.isNaN(root) ? "\u2013" : fixed(root, 2))),
    ]),
  );
}

// ---- figures --------------------------------------------------------------------------------------------------------
// Zero, and the largest round number on either side.
function evenTicks(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  const round = [5, 2, 1].find((one) => one * power <= most) * power;
  const words = String(Number(round.toPrecision(1)));
  return [[-round, `${MINUS}${words}`], [0, "0"], [round, words]];
}
// Returns what puts the dots where a row of the histories is, over the loops that stay as they are.
function drawLoops(canvas, colours, { state, scene, real, beside }) {
  const besides = colours[{ code: "code", share: "code", full: "attached", none: "bare" }[state.beside]];
  const chart = chartOf(canvas, colours);
  if (chart.width === 0) return () => {};
  const n = scene.storeys;
  const weight = weightOf(scene);
  const columns = n === 4 && chart.width < 480 ? 2 : n;
  const lines = Math.ceil(n / columns);
  const other = beside === null ? null : beside.run;
  const spread = (list, by) => (list.length ? list.reduce((most, value) => Math.max(most, Math.abs(value)), 0) * by : 0);
  const drift = Math.max(spread(real.drift, 1000), other ? spread(other.drift, 1000) : 0, 1e-6) * 1.05;
  const force = Math.max(spread(real.force, 1 / weight), other ? spread(other.force, 1 / weight) : 0, 1e-6) * 1.05;
  const entries = [{ words: "goods slide", colour: colours.slide }];
  if (other) entries.push({ words: beside.words, colour: besides, thick: 1.2, dash: [4, 2] });
  const keyEnd = chart.key(entries, 46, 14, chart.width);
  const [left, gap, foot] = [56, 16, 38];
  const wide = (chart.width - left - 8 - gap * (columns - 1)) / columns;
  const high = (chart.height - keyEnd - foot - (lines - 1) * 40) / lines;
  const panels = [];
  for (let i = 0; i < n; i++) {
    const [column, line] = [i % columns, Math.floor(i / columns)];
    const box = { left: left + column * (wide + gap), top: keyEnd + 12 + line * (high + 28) };
    Object.assign(box, { right: box.left + wide, bottom: box.top + high - 12 });
    const last = i + columns >= n;
    const panel = chart.panel(box, [-drift, drift], [-force, force], {
      title: `storey ${i + 1}`, xTitle: last ? "drift (mm)" : "", yTitle: column ? "" : "shear / W",
      xTicks: last ? evenTicks(drift) : [], yTicks: column ? [] : evenTicks(force),
    });
    for (const [run, colour, options] of [[other, besides, { width: 1, dash: [4, 2] }], [real, colours.slide, { width: 1.2 }]]) {
      if (!run) continue;
      const rows = Math.min(run.rows, run.drift.length / n);
      panel.line(Array.from({ length: rows }, (_, row) => [1000 * run.drift[row * n + i], run.force[row * n + i] / weight]), { colour, ...options });
    }
    panels.push(panel);
  }
  const peaks = Array.from(real.peakShear, (shear, i) => `storey ${i + 1} up to ${general(shear / weight, 3)} of the weight at drifts up to ${fixed(1000 * real.peakDrift[i], 1)} mm`);
  canvas.setAttribute("aria-label", `Storey shear against drift: ${peaks.join(", ")}.`);
  const loops = document.createElement("canvas");
  [loops.width, loops.height] = [canvas.width, canvas.height];
  loops.getContext("2d").drawImage(canvas, 0, 0);
  return (at) => {
    const row = Math.min(Math.round(at), real.rows - 1);
    chart.context.clearRect(0, 0, chart.width, chart.height);
    chart.context.drawImage(loops, 0, 0, chart.width, chart.height);
    panels.forEach((panel, i) => panel.dot(1000 * real.drift[row * n + i], real.force[row * n + i] / weight, colours.yield));
  };
}

function drawProfile(canvas, colours, { state, scene, real, code, full }) {
  const chart = chartOf(canvas, colours);
  if (chart.width === 0) return;
  const n = scene.storeys;
  const percent = (run) => ratiosOf(run, state).map((ratio) => 100 * ratio);
  const lines = [{ words: "goods slide", run: real, colour: colours.slide, dash: [], thick: 3 }];
  if (real.blocks.length) {
    lines.push(
      { words: `${fixed(100 * state.counted, 0)} % attached (code)`, run: code, colour: colours.code, dash: [6, 3], thick: 2 },
      { words: "all attached", run: full, colour: colours.attached, dash: [2, 3], thick: 2 },
    );
  }
  const keyEnd = chart.key(lines, 46, 14, chart.width);
  const most = Math.max(...lines.map(({ run }) => largest(percent(run))), 1e-6) * 1.08;
  const box = { left: 46, top: keyEnd + 6, right: chart.width - 14, bottom: chart.height - 40 };
  const panel = chart.panel(box, [0, most], [0, n], {
    xTitle: "peak drift (% of the storey height)", yTitle: "floor",
    yTicks: Array.from({ length: n + 1 }, (_, i) => [i, i ? String(i) : "ground"]).map(([i, words]) => [i, i ? words : "0"]),
  });
  for (const { run, colour, dash, thick } of lines.toReversed()) {
    const points = percent(run).map((drift, i) => [[drift, i], [drift, i + 1]]).flat();
    panel.line(points, { colour, width: thick, dash });
    percent(run).forEach((drift, i) => panel.dot(drift, i + 0.5, colour, 3));
  }
  const words = lines.map(({ words: name, run }) => `${name}: ${percent(run).map((drift) => fixed(drift, 2)).join(", ")}`);
  canvas.setAttribute("aria-label", `Peak drift in per cent of the height, from storey 1. ${words.join("; ")}.`);
}

function drawCurve(canvas, colours, found, state) {
  const chart = chartOf(canvas, colours);
  if (chart.width === 0) return;
  const box = { left: 52, top: 12, right: chart.width - 14, bottom: chart.height - 40 };
  if (found === null || !found.shares) {
    chart.panel(box, [0, 1], [0.5, 1.5], { xTitle: "share of the goods attached as mass", yTitle: "slide / model" });
    canvas.setAttribute("aria-label", "Drift with sliding goods over that of the model, against the share attached: not solved yet.");
    return;
  }
  const ratios = Array.from(found.model, (model) => found.realMean / model);
  const [low, high] = [Array.from(found.ratioLow), Array.from(found.ratioHigh)];
  const all = [...ratios, ...low, ...high, 1].filter(Number.isFinite);
  const [least, most] = [Math.min(...all), Math.max(...all)];
  const margin = 0.06 * (most - least) || 0.1;
  const keyEnd = chart.key([
    { words: "mean over the suite", colour: colours.slide },
    { words: "90 % of resamples", colour: colours.slide, fill: 0.25 },
    { words: "effective fraction", colour: colours.ink, thick: 3 },
    { words: "code", colour: colours.code, dash: [4, 3] },
  ], 52, 14, chart.width);
  box.top = keyEnd + 4;
  const panel = chart.panel(box, [0, 1], [least - margin, most + margin], { xTitle: "share of the goods attached as mass", yTitle: "slide / model" });
  const points = (values) => Array.from(found.shares, (share, i) => [share, values[i]]);
  panel.area(points(low), points(high), colours.slide, 0.22);
  panel.line([[0, 1], [1, 1]], { colour: colours.ink, width: 1 });
  panel.line([[state.counted, least - margin], [state.counted, most + margin]], { colour: colours.code, width: 1.5, dash: [4, 3] });
  panel.line([[found.value, least - margin], [found.value, most + margin]], { colour: colours.ink, width: 2 });
  panel.line(points(ratios), { colour: colours.slide, width: 2 });
  panel.dot(found.value, found.realMean / found.modelMean, colours.ink);
  const at = (share) => fixed(valueAt(share, ratios), 2);
  canvas.setAttribute("aria-label", `Drift with sliding goods over that of the model is ${at(0)} with nothing attached, ${at(state.counted)} with the share of the code and ${at(1)} with all; it is 1 at the effective fraction ${fixed(found.value, 3)}.`);
}

function drawRule(canvas, colours, found, bins, rule, state) {
  const chart = chartOf(canvas, colours);
  if (chart.width === 0) return;
  const keyEnd = chart.key([
    { words: "the rule for this case", colour: colours.ink },
    { words: "other buildings, median, 16 to 84 %", colour: colours.soft, fill: 0.35 },
    { words: "this case", colour: colours.slide, thick: 3 },
    { words: "code", colour: colours.code, dash: [4, 3] },
  ], 46, 14, chart.width);
  const most = 2;
  const box = { left: 46, top: keyEnd + 6, right: chart.width - 16, bottom: chart.height - 40 };
  const panel = chart.panel(box, [0, most], [0, 1.04], { xTitle: "eta = mu_k / base shear coefficient", yTitle: "effective fraction", yTicks: [0, 0.25, 0.5, 0.75, 1].map((one) => [one, String(one)]) });
  for (const { from, to, low, median, high } of bins) {
    if (from >= most) continue;
    const end = Math.min(to === null ? most : to, most);
    panel.area([[from, low], [end, low]], [[from, Math.max(high, low + 0.006)], [end, Math.max(high, low + 0.006)]], colours.soft, 0.28);
    panel.line([[from, median], [end, median]], { colour: colours.soft, width: 2 });
  }
  const known = found !== null && !found.error;
  if (known) {
    const curve = Array.from({ length: 101 }, (_, i) => (i / 100) * most).map((eta) => [eta, rule.share(eta * found.coefficient * rule.overKinetic)]);
    panel.line(curve, { colour: colours.ink, width: 1.6 });
  }
  panel.line([[0, state.counted], [most, state.counted]], { colour: colours.code, width: 1.3, dash: [4, 3] });
  if (!known) {
    canvas.setAttribute("aria-label", "Effective fraction against eta: there are no goods, or they are being solved.");
    return;
  }
  const eta = Math.min(found.eta, most);
  if (found.shares) {
    panel.line([[eta, found.low], [eta, found.high]], { colour: colours.slide, width: 3 });
    panel.dot(eta, found.value, colours.slide, 5);
  } else {
    panel.line([[eta, 0], [eta, 1.04]], { colour: colours.slide, width: 1.2, dash: [2, 3] });
  }
  if (found.eta > most) chart.text(`eta = ${general(found.eta, 3)} \u2192`, box.right - 4, panel.y(0.9), { size: 11, align: "right", colour: colours.slide });
  const where = found.shares ? `effective fraction ${fixed(found.value, 2)}, interval ${fixed(found.low, 2)} to ${fixed(found.high, 2)}` : "effective fraction not solved yet";
  canvas.setAttribute("aria-label", `This case has eta ${fixed(found.eta, 2)}: ${where}; the rule by hand gives ${fixed(rule.estimate, 2)}, the code's share ${fixed(state.counted, 2)}.`);
}
