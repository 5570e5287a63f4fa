// The answer first: one bar from nothing to all of the goods, and the case as a sentence whose numbers can be dragged.
const STORIES = [
  // Name, address, and what is to be seen.
  ["Pallets on steel", "n=2&T=0.4&a=1.2,0&s=0.25&k=0.2&R=4&m=synthetic-2", "Pallets slide in strong shaking: part of them acts as mass, far more than the code counts."],
  ["Library that never slides", "n=3&T=0.45&a=0.7,0.7,0&s=0.6&k=0.5&R=4&m=synthetic-1", "Shelves that are heavy and rough: none slides under any motion, and all of them act as mass."],
  ["Archive on carpet", "n=2&T=0.35&a=1.5,1.5&s=0.4&k=0.3&R=4&m=synthetic-3", "The goods slide, and the building still drifts as if all of them were attached."],
  ["The code is right", "n=3&T=0.47&a=1,1,0&s=0.15&k=0.11&R=4&m=synthetic-1", "Slippery goods under a short building: about a quarter of them acts as mass."],
  ["The code is unsafe", "n=1&T=0.25&a=1.5&s=0.6&k=0.6&R=4&m=synthetic-1", "A short building with heavy goods: it drifts twice as much as the model of the code."],
  ["A roof that drifts more", "n=4&T=0.57&a=2,2,2,0&s=0.15&k=0.15&R=4&m=synthetic-5", "With the share attached, the model drifts far less at the roof: a second analysis without goods is needed."],
];
const per100 = (share) => `${fixed(100 * share, 0)} %`;

// Tells what is known of the answer, in the bar and beside it. `codes` are [name with its mark, fraction].
function showHeadline(place, { found, real, state, codes, motions }) {
  const known = found !== null && found.shares !== undefined;
  const none = real.blocks.length === 0;
  const one = (selector) => place.querySelector(selector);
  const words = none ? "no goods" : known ? per100(found.value) : found !== null && found.error ? "not solved" : "\u2026";
  one(".share").textContent = words;
  place.classList.toggle("stale", !none && !known);
  one(".means").textContent = none ? "There is nothing on the floors." : known
    ? `of the goods act as mass (90 % interval ${per100(found.low)} to ${per100(found.high)}), over the ${motions} built-in synthetic motions at intensity ${general(state.intensity, 4)}.`
    : "of the goods act as mass: being solved over the built-in motions.";
  const bar = one(".share-bar");
  for (const [selector, from, to] of [[".filled", 0, known ? found.value : 0], [".interval", known ? found.low : 0, known ? found.high : 0]]) {
    Object.assign(one(selector).style, { left: `${100 * from}%`, width: `${100 * (to - from)}%` });
  }
  one(".interval").hidden = !known;
  const named = codes.some(([, fraction]) => fraction === state.counted);
  const ticks = named ? codes : [...codes, ["this model", state.counted]];
  const sorted = ticks.toSorted((a, b) => a[1] - b[1]);
  one(".ticks").replaceChildren(...sorted.map(([name, fraction], i) => {
    const tick = Object.assign(document.createElement("span"), { textContent: `${name} ${per100(fraction)}`, className: i % 2 ? "low" : "" });
    tick.style.left = `${100 * fraction}%`;
    tick.classList.toggle("late", fraction > 0.75);
    tick.classList.toggle("chosen", fraction === state.counted);
    return tick;
  }));
  const said = known ? `Effective fraction ${per100(found.value)}, interval ${per100(found.low)} to ${per100(found.high)}` : "Effective fraction not known yet";
  bar.setAttribute("aria-label", `${said}; codes: ${sorted.map(([name, fraction]) => `${name} ${per100(fraction)}`).join(", ")}.`);
}

// The numbers of the sentence: dragged to the side, or changed with the arrow keys. `shownOf` gives a value, null where it
// differs from floor to floor; `choose` takes another one.
function openSentence(place, { shownOf, choose, sliderOf }) {
  const numbers = Array.from(place.querySelectorAll("[data-drag]"));
  const stepped = (key, value) => {
    const { min, max, step } = sliderOf(key);
    const rounded = Math.round(value / step) * step;
    return Number(Math.min(Math.max(rounded, Number(min)), Number(max)).toPrecision(6));
  };
  for (const number of numbers) {
    const key = number.dataset.drag;
    let from = null; // where the pointer went down, and the value there
    number.addEventListener("pointerdown", (event) => {
      const value = shownOf(key);
      if (value === null) return;
      event.preventDefault();
      number.focus();
      number.setPointerCapture(event.pointerId);
      from = { x: event.clientX, value };
    });
    number.addEventListener("pointermove", (event) => {
      if (from === null) return;
      const { min, max } = sliderOf(key);
      choose(key, stepped(key, from.value + ((event.clientX - from.x) / 240) * (max - min)));
    });
    for (const name of ["pointerup", "pointercancel"]) number.addEventListener(name, () => (from = null));
    number.addEventListener("keydown", (event) => {
      const { min, max, step } = sliderOf(key);
      const value = shownOf(key);
      if (value === null) return;
      const wanted = {
        ArrowRight: value + Number(step), ArrowUp: value + Number(step), ArrowLeft: value - step, ArrowDown: value - step,
        Home: Number(min), End: Number(max),
      }[event.key];
      if (wanted === undefined) return;
      event.preventDefault();
      choose(key, stepped(key, wanted));
    });
  }
  return () => {
    for (const number of numbers) {
      const { min, max } = sliderOf(number.dataset.drag);
      const value = shownOf(number.dataset.drag);
      const words = value === null ? "various" : general(value, 4);
      number.textContent = words;
      for (const [name, text] of [["valuemin", min], ["valuemax", max], ["valuenow", value === null ? min : value], ["valuetext", words]]) {
        number.setAttribute(`aria-${name}`, text);
      }
    }
  };
}
