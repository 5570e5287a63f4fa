// The answer first: one bar from nothing to all of the goods, and the case as a sentence whose numbers can be dragged.
// Codes as [name with its mark, share of the goods that are present], of those that are there at most all, and the share that
// the case counts where it is none of them.
function ticksOf(codes, { present, counted }) {
  const shares = codes.map(([name, fraction]) => [name, Math.min(1, fraction / present)]);
  const isNamed = shares.some(([, share]) => Math.abs(share - counted) < 1e-6);
  return (isNamed ? shares : [...shares, ["this model", counted]]).toSorted((a, b) => a[1] - b[1]);
}
// Ticks stand in rows in which none meets another.
function placeTicks(place) {
  const ends = [];
  for (const tick of place.children) {
    const left = tick.offsetLeft - (tick.classList.contains("late") ? tick.offsetWidth : 0);
    let row = ends.findIndex((end) => left > end + 4);
    if (row < 0) row = ends.length;
    ends[row] = left + tick.offsetWidth;
    tick.style.paddingTop = `${1.25 * row}em`;
  }
  place.style.height = `${1.25 * Math.max(ends.length, 1) + 0.2}em`;
}

// Tells what is known of the answer, in the bar and beside it. `codes` are [name with its mark, fraction].
function showHeadline(place, { found, real, rule, state, codes, motions }) {
  const known = found !== null && found.shares !== undefined;
  const none = real.blocks.length === 0;
  const one = (selector) => place.querySelector(selector);
  const failed = found !== null && found.error !== undefined;
  const words = none ? "no goods" : known ? per100(found.value) : failed ? "not solved" : `\u2248 ${per100(rule.estimate)}`;
  one(".share").textContent = words;
  place.classList.toggle("stale", !none && !known);
  const [means, over] = none ? ["There is nothing on the floors.", ""]
    : failed ? ["There is no share of the goods.", ""]
    : known ? [`of the goods${state.present === 1 ? "" : " present"} act as mass (90 % interval ${per100(found.low)} to ${per100(found.high)})`, `, over the ${motions} built-in synthetic motions at intensity ${general(state.intensity, 4)}`]
    : ["of the goods act as mass by the rule by hand", ": being solved over the built-in motions"];
  one(".means").replaceChildren(means, Object.assign(document.createElement("span"), { textContent: over }));
  const bar = one(".share-bar");
  for (const [selector, from, to] of [[".filled", 0, known ? found.value : none || failed ? 0 : rule.estimate], [".interval", known ? found.low : 0, known ? found.high : 0]]) {
    Object.assign(one(selector).style, { left: `${100 * from}%`, width: `${100 * (to - from)}%` });
  }
  one(".interval").hidden = !known;
  const ticks = ticksOf(codes, state);
  one(".ticks").replaceChildren(...ticks.map(([name, share]) => {
    const tick = Object.assign(document.createElement("span"), { textContent: `${name} ${per100(share)}` });
    tick.style.left = `${100 * share}%`;
    tick.classList.toggle("late", share > 0.6);
    tick.classList.toggle("chosen", Math.abs(share - state.counted) < 1e-6);
    return tick;
  }));
  placeTicks(one(".ticks"));
  const said = known ? `Effective fraction ${per100(found.value)}, interval ${per100(found.low)} to ${per100(found.high)}` : "Effective fraction not known yet";
  bar.setAttribute("aria-label", `${said}; codes: ${ticks.map(([name, share]) => `${name} ${per100(share)}`).join(", ")}.`);
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
