"use strict";
(() => {
  const root = document.currentScript.parentElement;
  root.classList.add("live");
  const one = (selector) => root.querySelector(selector);
  const all = (selector) => Array.from(root.querySelectorAll(selector));
  const given = JSON.parse(one("script.given").textContent);
  const player = one("figure.animation");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const stillness = matchMedia("(prefers-reduced-motion: reduce)");
  const PAUSE = 150; // ms without a change before the effective fraction is sought, and the address and the words follow
  const TYPED = 700; // ms without a key stroke after which a typed number counts; Enter and leaving the field count at once
  const BEFORE_PEAK = 3; // s
  const FILM = 8; // s
  const PUSHED = "your push";
  const STEP = 1000; // ms between two cases that Back and Undo return to
  const SHARES = 21;
  const LARGEST_DRAWN = 2; // goods over floor mass of the largest block that is drawn; heavier ones are drawn relative to the heaviest

  let kernel = null;
  let module = null;
  let worker = null;
  let records = new Map(); // by the name in the address: name, dt, unit, values, samples, factor
  let state = defaultCase();
  let solved = null; // what is shown of the motion
  let found = null; // what is known of the effective fraction
  let number = 0; // of the case that is shown
  let sought = ""; // the numbers of the case that `found` is of, or that the worker seeks
  let goods = new Set(); // floors that carry goods, as the slider of the goods has them
  let kinetic = []; // mu_k/mu_s of each floor, which stays while mu_s is moved
  let story = null; // the step that is told
  let ofFile = ""; // the numbers of the case of a building file
  let race = null; // models of the codes beside the building
  const past = []; // addresses of the cases before, for Undo
  let stepped = -Infinity; // when the last of them was kept
  let inKernel = ""; // the motion that the kernel holds
  let inSuite = ""; // and the factors of its suite, for the spectrum of the design

  // ---- what the page carries --------------------------------------------------------------------------------------
  const bytesOf = (text) => Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  async function unpacked(text) {
    const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }
  async function start() {
    const [code, texts] = await Promise.all([unpacked(one("script.wasm").textContent), unpacked(given.records)]);
    const files = JSON.parse(new TextDecoder().decode(texts));
    for (const { name, text, factor } of files) records.set(name, { ...readRecord(text, name), name, factor });
    module = await WebAssembly.compile(code);
    kernel = openKernel(await WebAssembly.instantiate(module, {}));
    open(location.hash);
    requestAnimationFrame(() => requestAnimationFrame(() => performance.mark("first picture")));
    if (!stillness.matches) requestAnimationFrame(() => player.play());
    window.addEventListener("hashchange", () => {
      if (location.hash.slice(1) !== addressOf(state)) open(location.hash);
    });
    root.dataset.ready = "";
  }
  const suite = () => given.suite.map((name) => records.get(name));
  const scaledBy = ({ samples }, scale) => samples.map((sample) => sample * scale);
  // By how much a record is scaled at intensity 1: by its own factor, or that of the site of a building file.
  const factorOf = (key) => (state.factors !== null && given.suite.includes(key) ? state.factors[given.suite.indexOf(key)] : records.get(key).factor);
  const suiteAt = (intensity) => suite().map((record, i) => ({ dt: record.dt, samples: scaledBy(record, factorOf(given.suite[i]) * intensity) }));
  const nameOf = (key) => key.replace(/^file:/, "");
  const recordInUse = () => records.get(state.record);

  const says = messagesOf(root);
  function complain(words) {
    const place = one(".problem");
    place.hidden = words === "";
    place.textContent = words;
  }

  // ---- the case and its fields ------------------------------------------------------------------------------------
  function open(address) {
    const { state: opened, remarks } = caseOf(address);
    state = opened;
    if (state.factors !== null && state.factors.length !== given.suite.length) {
      remarks.push(`factors of the motions in the address must be ${given.suite.length}; got ${state.factors.length}`);
      state.factors = null;
    }
    ofFile = state.file === null ? "" : caseNumbers(state);
    inSuite = inKernel = "";
    if (!records.has(state.record)) {
      remarks.push(`The record ${state.record} of this link is not part of the page: drop its file here. ${given.suite[0]} stands in for it.`);
      state.record = given.suite[0];
    }
    complain(remarks.map((remark) => remark.replace(/\.?$/, ".")).join(" "));
    goods = new Set(state.massRatio.flatMap((ratio, i) => (ratio > 0 ? [i] : [])));
    kinetic = state.muS.map((mu, i) => (mu > 0 ? state.muK[i] / mu : 1));
    one("#x-beside").value = state.beside;
    changed();
  }
  const loaded = () => Array.from(goods).filter((i) => i < state.storeys).sort((a, b) => a - b);
  // The value of a slider: of a list that of all loaded floors, null where they differ.
  function shownOf(key) {
    if (!LISTS.includes(key)) return state[key];
    const values = new Set(floorsOf(key).map((i) => state[key][i]));
    return values.size === 1 ? [...values][0] : null;
  }
  const storeysOf = () => Array.from({ length: state.storeys }, (_, i) => i);
  const floorsOf = (key) => (BY_FLOOR.includes(key) ? (loaded().length ? loaded() : [0]) : storeysOf());
  const isEdited = (field) => document.activeElement === field;
  function fill() {
    for (const row of all(".row")) {
      const { key } = row.dataset;
      const value = shownOf(key);
      const [range, field] = row.querySelectorAll("input");
      if (value !== null) range.value = String(value);
      range.setAttribute("aria-valuetext", value === null ? "differs from floor to floor" : String(value));
      if (!isEdited(field)) field.value = value === null ? "" : String(value);
      field.placeholder = value === null ? "differs" : "";
      if (!isEdited(field)) field.removeAttribute("aria-invalid");
      row.toggleAttribute("data-off", key === "R" && state.by !== "design");
    }
    for (const radio of all('.choice input[type="radio"]')) radio.checked = String(state[radio.name]) === radio.value;
    for (const row of all(".floors tbody tr")) row.hidden = Number(row.dataset.floor) >= state.storeys;
    for (const option of one("#x-counter").options) option.hidden = Number(option.value) > state.storeys;
    one("#x-counter").value = String(state.counter);
    const strength = solved === null ? state.strength : solved.scene.strength;
    for (const field of all(".floors input")) {
      const [key, floor] = [field.dataset.list, Number(field.closest("tr").dataset.floor)];
      if (isEdited(field)) continue;
      const isGiven = key !== "strength" || state.by === "hand";
      field.readOnly = !isGiven;
      const value = key === "strength" ? strength[floor] : state[key][floor];
      field.type = Number.isFinite(value) || value === undefined ? "number" : "text";
      field.value = value === undefined ? "" : isGiven ? String(value) : general(value, 4);
      field.removeAttribute("aria-invalid");
    }
    const select = one("#x-record");
    for (const name of records.keys()) {
      if (Array.from(select.options).every((option) => option.value !== name)) select.add(new Option(nameOf(name), name));
    }
    select.value = state.record;
    const code = Array.from(one("#x-code").options).find((option) => option.value !== "" && Math.abs(shareOf(option) - state.counted) < 1e-6);
    one("#x-code").value = code === undefined ? "" : code.value;
    one(".unchecked").hidden = code === undefined || !code.textContent.includes(given.mark);
    const record = recordInUse();
    const factor = factorOf(state.record);
    const scale = factor * state.intensity;
    const pga = (largest(record.samples.map(Math.abs)) * scale) / GRAVITY;
    one(".motion").textContent =
      `${record.samples.length} samples at ${record.dt} s, PGA ${fixed(pga, 3)} g` +
      (factor === 1 ? "." : `: scaled by ${general(factor, 4)} to the target${state.intensity === 1 ? "" : `, times ${general(state.intensity, 4)}`}.`);
  }

  // A number that a field gives; what is out of its range is said beside it and not taken.
  function taken(field, key, floors) {
    const [low, high, , words] = LIMITS[key];
    const value = field.value.trim() === "" ? NaN : Number(field.value);
    const most = key === "muK" ? Math.min(...floors.map((i) => state.muS[i])) : high;
    let problem = "";
    if (!(value >= low && value <= high)) problem = `${words} must be from ${low} to ${high}; got ${field.value || "nothing"}`;
    else if (value > most && field.type !== "range") problem = `${words} must be at most static friction, ${most}; got ${field.value}`;
    field.removeAttribute("aria-invalid");
    if (problem) field.setAttribute("aria-invalid", "true");
    says(field, problem);
    return problem ? null : value;
  }
  // The share of the goods that are present which a code counts, of those at most all.
  const shareOf = (option) => Math.min(1, Number(option.value) / state.present);
  const rounded = (value) => Number(value.toPrecision(6));
  function setValue(key, value, floors) {
    if (!LISTS.includes(key)) state[key] = value;
    else for (const i of floors) state[key][i] = value;
    for (const i of floors) {
      if (key === "muS") state.muK[i] = rounded(value * kinetic[i]);
      if (key === "muK") {
        state.muK[i] = Math.min(value, state.muS[i]);
        kinetic[i] = state.muS[i] > 0 ? state.muK[i] / state.muS[i] : 1;
      }
    }
    changed();
  }
  const choose = (key, value) => setValue(key, value, floorsOf(key));
  // Goods of one floor: without any it stands with the others, and the last of them stay on the list.
  function chooseMass(value, floor) {
    if (value > 0) goods.add(floor);
    else if (loaded().length > 1) goods.delete(floor);
    setValue("massRatio", value, [floor]);
  }
  // A typed number counts when it is complete: on Enter, when the field is left, or after a pause.
  function takeTyped(field, take) {
    let typing = 0;
    const now = () => {
      clearTimeout(typing);
      typing = 0;
      take();
    };
    field.addEventListener("input", () => {
      clearTimeout(typing);
      typing = setTimeout(now, TYPED);
    });
    field.addEventListener("change", now);
    field.addEventListener("blur", () => {
      if (typing) now();
      says(field, "");
      fill();
    });
  }
  for (const row of all(".row")) {
    const [range, field] = row.querySelectorAll("input");
    const take = (input) => {
      const value = taken(input, row.dataset.key, floorsOf(row.dataset.key));
      if (value === null) return;
      if (input === range) says(field, "");
      choose(row.dataset.key, value);
    };
    range.addEventListener("input", () => take(range));
    takeTyped(field, () => take(field));
  }
  for (const field of all(".floors input")) {
    takeTyped(field, () => {
      const [key, floor] = [field.dataset.list, Number(field.closest("tr").dataset.floor)];
      const value = taken(field, key, [floor]);
      if (value === null) return;
      if (key === "massRatio") chooseMass(value, floor);
      else setValue(key, value, [floor]);
    });
  }
  for (const radio of all('.choice input[type="radio"]')) {
    radio.addEventListener("change", () => {
      if (radio.name === "storeys") state.storeys = Number(radio.value);
      else {
        // By hand one starts from what was.
        if (radio.value === "hand" && solved !== null) solved.scene.strength.forEach((value, i) => (state.strength[i] = Number.isFinite(value) ? Number(value.toPrecision(4)) : state.strength[i]));
        state.by = radio.value;
      }
      changed();
    });
  }
  one("#x-record").addEventListener("change", (event) => {
    state.record = event.target.value;
    says(one("#x-file"), "");
    one(".unstated").hidden = true;
    changed();
  });
  one("#x-code").addEventListener("change", (event) => {
    if (event.target.value !== "") choose("counted", shareOf(event.target.selectedOptions[0]));
  });
  one("#x-beside").addEventListener("change", (event) => {
    state.beside = event.target.value;
    changed();
  });
  one("#x-counter").addEventListener("change", (event) => {
    state.counter = Number(event.target.value);
    changed();
  });
  one("form.controls").addEventListener("submit", (event) => event.preventDefault());

  // ---- records that are given ---------------------------------------------------------------------------------------
  let pending = null; // a file whose unit or step has to be said
  function takeRecord(text, name, stated) {
    const file = one("#x-file");
    try {
      const record = readRecord(text, name, stated);
      pending = null;
      one(".unstated").hidden = true;
      says(file, "");
      const key = `file:${name}`;
      records.set(key, { ...record, factor: 1 });
      inKernel = "";
      state.record = key;
      changed();
    } catch (error) {
      pending = { text, name };
      one(".unstated").hidden = !/^(?:unit|step) of/.test(error.message);
      says(file, error.message);
      file.value = "";
    }
  }
  // What is stated belongs to one file: it is asked for again with another.
  const readFile = async (file) => {
    const text = await file.text();
    one("#x-unit").value = "";
    one("#x-dt").value = "";
    takeRecord(text, file.name, {});
  };
  one("#x-file").addEventListener("change", (event) => event.target.files.length && readFile(event.target.files[0]));
  for (const field of [one("#x-unit"), one("#x-dt")]) {
    field.addEventListener("change", () => {
      if (pending === null) return;
      takeRecord(pending.text, pending.name, { unit: one("#x-unit").value || undefined, dt: Number(one("#x-dt").value) || undefined });
    });
  }
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    root.classList.add("dropping");
  });
  document.addEventListener("dragleave", (event) => event.relatedTarget === null && root.classList.remove("dropping"));
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    root.classList.remove("dropping");
    if (event.dataTransfer.files.length) readFile(event.dataTransfer.files[0]);
  });

  // ---- solving ------------------------------------------------------------------------------------------------------
  function solve() {
    const record = recordInUse();
    const scale = factorOf(state.record) * state.intensity;
    const wanted = `${state.record} ${scale}`;
    if (inKernel !== wanted) {
      kernel.setMotion(record.dt, scaledBy(record, scale));
      inKernel = wanted;
    }
    const suiteFactors = String(state.factors);
    if (inSuite !== suiteFactors) {
      kernel.setSuite(suiteAt(1), new Float64Array(0));
      inSuite = suiteFactors;
    }
    const elastic = state.by === "design" ? kernel.design(sceneOf(state, []), state.counted) : storeysOf();
    const scene = sceneOf(state, strengthsOf(state, elastic));
    // An oscillator has the base shear S_a of the suite.
    const oscillator = sceneOf({ ...defaultCase(), storeys: 1, period: state.period, massRatio: [0] }, []);
    const acceleration = state.intensity * kernel.design(oscillator, 0)[0];
    const rule = ruleBy(scene, acceleration, given.rule);
    const every = Math.max(1, Math.round(record.samples.length / 8000));
    const blocks = scene.massRatio.flatMap((ratio, i) => (ratio > 0 ? [{ floor: i + 1, ratio, muS: scene.muS[i], muK: scene.muK[i] }] : []));
    const run = (share) => {
      const done = kernel.run(scene, share, every);
      let rows = done.drift.length / scene.storeys;
      // Behind a collapse there is nothing.
      while (rows > 1 && Number.isNaN(done.drift[rows * scene.storeys - 1])) rows -= 1;
      const own = share === null ? blocks : [];
      const upTo = (list, columns) => list.subarray(0, rows * columns);
      const histories = { drift: upTo(done.drift, scene.storeys), slip: upTo(done.slip, own.length), force: upTo(done.force, scene.storeys) };
      return { ...done, ...histories, rows, blocks: own };
    };
    const real = run(null);
    const [code, full] = blocks.length ? [run(state.counted), run(1)] : [real, real];
    const share = isFound() ? found.value : rule.estimate;
    const beside = {
      none: () => null,
      code: () => ({ run: code, share: state.counted, words: "model of the code" }),
      share: () => ({ run: run(share), share, words: isFound() ? "model with the share found" : "model with the share by hand" }),
      full: () => ({ run: full, share: 1, words: "all goods attached" }),
    }[blocks.length ? state.beside : "none"]();
    const counter = state.counter > 0 ? Math.min(state.counter, state.storeys) - 1 : place(ratiosOf(real, state));
    return { state: structuredClone(state), scene, record, scale, every, real, code, full, beside, rule, counter, run };
  }
  const isFound = () => found !== null && found.shares !== undefined;

  const seconds = (record, every) => every * record.dt;
  function animated({ state, scene, record, scale, every, real, code, full, beside, counter }, kept) {
    const step = seconds(record, every);
    const rows = Math.max(real.rows, beside === null ? 0 : beside.run.rows);
    const [low, high] = [new Float32Array(rows), new Float32Array(rows)];
    for (let row = 0; row < rows; row++) {
      let [least, most] = [Infinity, -Infinity];
      for (let i = row * every; i <= Math.min((row + 1) * every, record.samples.length - 1); i++) {
        const value = (record.samples[i] * scale) / GRAVITY;
        [least, most] = [Math.min(least, value), Math.max(most, value)];
      }
      [low[row], high[row]] = [least, most];
    }
    const spread = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    const shown = (run, label, what, attached) => {
      const events = { row: [], kind: [], number: [] };
      for (let i = 0; i < run.events.length; i += 4) {
        events.row.push(Math.min(Math.ceil(run.events[i] / step - 1e-9), rows - 1));
        events.kind.push(run.events[i + 1]);
        events.number.push(run.events[i + 2]);
      }
      return {
        label, what, attached, rows: run.rows, collapsed: run.end[1] || null, end: run.end[0], events,
        drift: { peak: spread(run.drift), values: run.drift }, slip: { peak: spread(run.slip), values: run.slip },
      };
    };
    const runs = [shown(real, real.blocks.length ? "goods slide" : "no goods", state.record, null)];
    if (beside) runs.push(shown(beside.run, beside.words, `${fixed(100 * beside.share, 0)} % of the goods attached`, beside.share));
    // Displacements are enlarged as far as nothing leaves the picture.
    const n = scene.storeys;
    let farthest = spread(real.slip);
    for (const run of [real, ...(beside ? [beside.run] : [])]) {
      for (let row = 0; row < run.rows; row++) {
        let moved = 0;
        for (let i = 0; i < n; i++) farthest = Math.max(farthest, Math.abs((moved += run.drift[row * n + i])));
      }
    }
    const room = 0.15 * scene.height.reduce((sum, one) => sum + one, 0);
    const factor = kept || given.enlargements.filter((one) => one * farthest <= room).at(-1) || 1;
    const mass = Math.max(...real.blocks.map((block) => block.ratio), LARGEST_DRAWN);
    const moved = record.moved && Float32Array.from({ length: rows }, (_, row) => (record.moved[Math.min(row * every, record.moved.length - 1)] * state.intensity) * pushScale(player));
    return {
      step, rows, known: true, factor, marks: true, storey: counter, heights: scene.height, kinds: EVENT_NAMES,
      ground: { peak: spread(high) > spread(low) ? spread(high) : spread(low), low, high, moved },
      blocks: real.blocks.map((block) => ({ floor: block.floor, size: Math.sqrt(block.ratio / mass) })),
      runs, alt: runWords({ state, real, code, full }, nameOf(state.record)),
    };
  }

  // ---- what is shown --------------------------------------------------------------------------------------------------
  function colours() {
    const style = getComputedStyle(root);
    return Object.fromEntries(["paper", "ink", "soft", "line", "slide", "code", "attached", "bare", "yield"].map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }
  let time = 0;
  let putDots = () => {};
  // Figures that are out of sight are drawn after a pause.
  const inSight = new Set();
  const sight = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) inSight[isIntersecting ? "add" : "delete"](target);
    redraw(false);
  });
  for (const canvas of [...all(".chart"), one(".race")]) sight.observe(canvas);
  const isDrawn = (name, even) => even || inSight.has(one(name));
  function drawRun(even) {
    const palette = colours();
    if (isDrawn(".loops", even)) {
      putDots = drawLoops(one(".loops"), palette, solved);
      putDots(time / seconds(solved.record, solved.every));
    }
    if (isDrawn(".profile", even)) drawProfile(one(".profile"), palette, solved);
  }
  function drawFraction(even) {
    const palette = colours();
    if (isDrawn(".curve", even)) drawCurve(one(".curve"), palette, found, state);
    if (isDrawn(".rule", even)) drawRule(one(".rule"), palette, found, given.bins, solved.rule, state);
  }
  function sayFraction() {
    const place = one(".fraction");
    const done = isFound();
    place.classList.toggle("stale", !done);
    const list = one(".remarks");
    list.replaceChildren();
    if (solved.real.blocks.length === 0) place.textContent = "There are no goods on the floors, and so no share of them.";
    else if (found === null) place.textContent = "Being solved over the built-in suite\u2026";
    else if (found.error) place.textContent = `It could not be solved: ${found.error}`;
    else if (!done) {
      const part = found.left === undefined ? "" : ` ${Math.round(100 * (1 - found.left / SHARES))} % done.`;
      place.textContent = `By hand: ${solved.rule.words}. Being solved over the built-in suite\u2026${part}`;
    } else {
      place.textContent = fractionWords(found, solved.rule).long;
      list.append(...fractionRemarks(found).map((words) => Object.assign(document.createElement("li"), { textContent: words })));
    }
    fractionTables(root, done ? found : null, given.suite);
    sayHeadline();
    sayStory();
    const remark = one(".of-file");
    remark.hidden = state.file === null;
    if (state.file !== null) remark.textContent = fileWords(state.file, done ? found : null, caseNumbers(state) === ofFile, given.differences);
  }
  function sayStory() {
    const [says, asks] = [one(".story"), one(".asks")];
    says.hidden = asks.hidden = story === null;
    one(".next").textContent = story === null ? "Tell the first" : story === STORIES.at(-1) ? "Tell the first again" : "Tell the next";
    for (const [i, button] of all(".stories button").entries()) button.setAttribute("aria-pressed", String(STORIES[i] === story));
    if (story === null) return;
    const facts = isFound() ? factsOf(found, solved.state) : null;
    const isGone = solved.real.blocks.length === 0;
    says.textContent = isGone ? "There are no goods." : facts === null ? "Being solved\u2026" : TOLD[story.tells](facts);
    asks.textContent = `${story.asks}${facts === null || isGone ? "" : ` ${questionWords(story, facts)}`}`;
  }
  function sayHeadline() {
    showHeadline(one(".headline"), { found, real: solved.real, rule: solved.rule, state: solved.state, codes: given.codes, motions: given.suite.length });
  }
  // Said once the reader pauses, so that a screen reader is not flooded.
  function say() {
    // The headline shows the fraction already.
    const fraction = isFound() ? ` ${fractionWords(found, solved.rule).short}` : "";
    const words = runWords(solved, nameOf(state.record));
    if (one(".answer").textContent === words + fraction) return;
    one(".answer").replaceChildren(words, Object.assign(document.createElement("span"), { className: "heard", textContent: fraction }));
  }

  let timer = 0;
  let isRefused = false; // the case before, by the kernel
  let waiting = false;
  function changed() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      show();
    });
  }
  function show() {
    try {
      solved = solve();
    } catch (error) {
      complain(error.message);
      if (error instanceof WebAssembly.RuntimeError) restart();
      isRefused = solved !== null;
      // An address of which nothing can be shown leaves the first case.
      if (!isRefused) {
        state = defaultCase();
        changed();
      }
      return;
    }
    if (isRefused) complain("");
    isRefused = false;
    const drift = largest(ratiosOf(solved.real, state));
    one(".belief").hidden = solved.real.end[1] > 0 || !(drift > 0.05);
    one(".belief").textContent = `A drift of ${fixed(100 * drift, 0)} % of the storey height is beyond what buildings survive: the run goes on as if it stood.`;
    number += 1;
    // The effective fraction is of the suite: another record, another model beside leave it as it is.
    const numbers = caseNumbers(state);
    if (numbers !== sought || !isFound()) {
      if (worker !== null) worker.postMessage({ number });
      const isBeside = found !== null && state.beside === "share";
      found = null;
      if (isBeside) solved = solve();
    }
    sought = numbers;
    fill();
    showSentence();
    showHandles(loaded().filter((i) => state.massRatio[i] > 0), state.storeys);
    player.show(animated(solved), startAt());
    drawRun(false);
    runTables(root, solved);
    drawFraction(false);
    sayFraction();
    clearTimeout(timer);
    timer = setTimeout(settle, PAUSE);
    root.dataset.shown = String(number);
  }
  // The kernel stopped on a defect: what it holds may be half of something.
  function restart() {
    kernel = openKernel(new WebAssembly.Instance(module, {}));
    inKernel = inSuite = "";
  }
  // The page and each story start some seconds before the largest drift of the storey that is counted; without motion, at it.
  let isToldAnew = true;
  function startAt() {
    if (!isToldAnew) return undefined;
    isToldAnew = false;
    return solved.real.peakDriftTime[solved.counter] - (stillness.matches ? 0 : BEFORE_PEAK);
  }
  function settle() {
    drawRun(true);
    drawFraction(true);
    say();
    followAddress();
    solveRace();
    if (solved.real.blocks.length && !isFound()) seek();
    else root.dataset.found = String(number);
  }
  function seek() {
    if (worker === null) {
      const source = `"use strict";${openKernel}\n${effectiveWorker}\neffectiveWorker();`;
      worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
      worker.onmessage = ({ data }) => arrived(data);
      worker.postMessage({ module });
    }
    worker.postMessage({ number, scene: solved.scene, motions: suiteAt(state.intensity), resamples: given.resamples.flat() });
  }
  function arrived({ number: of, begun, left, found: answer, error }) {
    if (of !== number) return;
    if (error !== undefined) found = { error };
    if (begun !== undefined) found = begun;
    if (left !== undefined) found = { ...found, left };
    if (answer !== undefined) found = answer;
    if (answer !== undefined && state.beside === "share") {
      solved = solve();
      player.show(animated(solved));
      drawRun(true);
    }
    if (error === undefined && (begun !== undefined || answer !== undefined)) drawFraction(true);
    sayFraction();
    if (answer !== undefined) say();
    if (answer !== undefined || error !== undefined) root.dataset.found = String(number);
  }

  player.addEventListener("time", (event) => {
    time = event.detail;
    if (inSight.has(one(".race"))) showRace();
    if (solved !== null && inSight.has(one(".loops"))) putDots(time / seconds(solved.record, solved.every));
  });
  function redraw(even = true) {
    placeTicks(one(".ticks"));
    if (solved === null) return;
    drawRun(even);
    drawFraction(even);
    showRace();
  }
  dark.addEventListener("change", () => redraw());
  window.addEventListener("beforeprint", () => {
    for (const folded of all(".rest details")) folded.open = true;
    redraw();
  });
  window.addEventListener("afterprint", () => redraw());
  new ResizeObserver(() => redraw()).observe(one(".rest"));

  // ---- the building is the control ----------------------------------------------------------------------------------
  const stage = one(".stage");
  one(".picture").prepend(one(".buildings"));
  one(".short").append(one(".play"), one(".time"), one(".clock"));
  stage.addEventListener("keydown", (event) => event.target.closest(".player") && player.keys(event));
  const ranges = (key) => {
    const { min, max, step } = one(`.row[data-key="${key}"] input`);
    return { min: key === "massRatio" ? 0 : Number(min), max: Number(max), step: Number(step) };
  };
  const showHandles = openHandles(one(".handles"), player, {
    ranges,
    valueOf: (key, floor) => state[key][floor],
    // The grip moves the friction of all goods, where it is the same for all.
    choose: (key, value, floor) => (key === "massRatio" ? chooseMass(value, floor) : setValue(key, value, shownOf(key) === null ? [floor] : floorsOf(key))),
    pushed: ({ dt, samples, moved }, isOver) => {
      records.set(PUSHED, { name: PUSHED, title: "", dt, unit: "m/s2", values: samples, samples, moved, factor: 1 });
      state.record = PUSHED;
      inKernel = "";
      if (isOver) {
        changed();
        return;
      }
      solved = solve();
      player.show(animated(solved, enlargement), samples.length * dt);
    },
  });
  // While it is pushed, displacements are enlarged as they were before.
  let enlargement = 0;
  one(".handle.ground").addEventListener("focus", () => (enlargement = solved === null ? 0 : animated(solved).factor));
  one(".buildings").addEventListener("click", (event) => {
    const { ys } = player.places;
    const y = event.clientY - event.currentTarget.getBoundingClientRect().top;
    const storey = ys.findIndex((level, i) => i > 0 && y < ys[i - 1] && y >= level);
    if (storey < 1) return;
    state.counter = state.counter === storey ? 0 : storey;
    changed();
  });

  // ---- the race of the codes ------------------------------------------------------------------------------------------
  function solveRace() {
    race = null;
    const { real, run, scene, counter, record, every } = solved;
    one(".race").hidden = real.blocks.length === 0;
    if (real.blocks.length > 0) {
      const byShare = new Map();
      for (const [name, fraction] of [["none", 0], ...given.codes, ["all", Infinity]]) {
        const share = Math.min(1, fraction / state.present);
        byShare.set(share, byShare.has(share) ? `${byShare.get(share)}, ${name}` : name);
      }
      const entrants = Array.from(byShare, ([share, name]) => ({ share, name, run: run(share) })).toSorted((a, b) => a.share - b.share);
      race = raceOf({ real, entrants, heights: scene.height, masses: scene.massRatio, step: seconds(record, every), counter });
    }
    one(".winner").textContent = race === null ? "There are no goods." : raceWords(race, nameOf(state.record));
    one(".race").setAttribute("aria-label", one(".winner").textContent);
    showRace();
  }
  function showRace() {
    if (race === null || one(".race").clientWidth === 0) return;
    const chart = chartOf(one(".race"), colours());
    drawRace(chart.context, chart, race, time, colours());
  }
  const card = (at) => ({
    title: `${one(".share").textContent} of the goods act as mass${isFound() ? "" : ", by the rule by hand"}`, winner: one(".winner").textContent, race, time: at, colours: colours(),
    sentence: Array.from(one(".sentence").childNodes, (node) => (node.localName === "small" || node.hidden ? "" : node.textContent)).join("").trim(),
  });
  const canvasOfCard = () => Object.assign(document.createElement("canvas"), { width: 1200, height: 675 });
  function give(blob, name) {
    const link = Object.assign(document.createElement("a"), { download: name, href: URL.createObjectURL(blob) });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }
  one(".save").addEventListener("click", () => {
    if (race === null) return;
    const canvas = canvasOfCard();
    drawCard(canvas, card(time));
    canvas.toBlob((blob) => give(blob, "seismass.png"));
    one(".done").textContent = "The picture is at the time that is shown.";
  });
  one(".film").addEventListener("click", async () => {
    if (race === null) return;
    const canvas = canvasOfCard();
    const begin = Math.max(0, race.own.run.peakDriftTime[race.counter] - 0.6 * FILM);
    const still = { ...card(begin) };
    one(".film").disabled = true;
    one(".done").textContent = `It takes ${FILM} s, as it is filmed while it runs\u2026`;
    try {
      const blob = await filmOf(canvas, FILM, (at) => drawCard(canvas, { ...still, time: begin + at }));
      give(blob, `seismass.${blob.type.endsWith("mp4") ? "mp4" : "webm"}`);
      one(".done").textContent = `The film: ${fixed(blob.size / 1e6, 1)} MB.`;
    } catch (error) {
      one(".done").textContent = `There is no film: ${error.message}.`;
    }
    one(".film").disabled = false;
  });

  // ---- out of the page --------------------------------------------------------------------------------------------------
  one(".download").addEventListener("click", () => {
    const { scene, record, scale } = solved;
    const note = `made with the live page of seismass ${given.version}`;
    const text = sceneFile(scene, { stiffness: kernel.stiffness(scene), record, scale, note });
    give(new Blob([text], { type: "application/toml" }), "scene.toml");
    one(".done").textContent = "Solve it with: seismass run scene.toml";
  });
  one(".link").addEventListener("click", async () => {
    followAddress();
    try {
      await navigator.clipboard.writeText(location.href);
      one(".done").textContent = "The link is in the clipboard.";
    } catch {
      one(".done").textContent = "The address of this page is the link.";
    }
  });
  // A case that stays for a while is a step: Back and Undo return to the one before.
  function followAddress() {
    const address = addressOf(state);
    const before = location.hash.slice(1);
    if (before === address) return;
    const isStep = performance.now() - stepped > STEP;
    if (before !== "" && isStep) {
      past.push(before);
      history.pushState(null, "", `#${address}`);
    } else {
      history.replaceState(null, "", `#${address}`);
    }
    stepped = performance.now();
    one(".undo").disabled = past.length === 0;
  }
  one(".undo").addEventListener("click", undo);
  document.addEventListener("keydown", (event) => {
    const isText = event.target.matches('input[type="number"], input[type="text"]');
    if (event.key.toLowerCase() !== "z" || !(event.ctrlKey || event.metaKey) || event.shiftKey || isText) return;
    event.preventDefault();
    followAddress();
    undo();
  });
  function undo() {
    const now = addressOf(state);
    let before = past.pop();
    while (before === now) before = past.pop(); // Back has been there
    one(".undo").disabled = past.length === 0;
    if (before === undefined) return;
    history.replaceState(null, "", `#${before}`);
    open(before);
  }
  one(".reset").addEventListener("click", () => {
    one(".done").textContent = "";
    story = null;
    open("");
  });
  const sliderOf = (key) => one(`.row[data-key="${key}"] input`);
  const showNumbers = openSentence(one(".sentence"), { shownOf, choose, sliderOf });
  function showSentence() {
    showNumbers();
    for (const part of all(".sentence [data-by]")) part.hidden = part.dataset.by !== state.by;
    one(".storeys-said").textContent = state.storeys === 1 ? "one storey" : `${state.storeys} storeys`;
    one(".sentence .record").textContent = nameOf(state.record);
  }
  one(".stories").replaceChildren(...STORIES.map((step, i) => {
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: `${i + 1} ${step.name}` });
    button.addEventListener("click", () => tell(step));
    return button;
  }));
  function tell(step) {
    stepped = -Infinity;
    story = step;
    isToldAnew = true;
    open(step.address);
  }
  one(".next").addEventListener("click", () => tell(STORIES[(STORIES.indexOf(story) + 1) % STORIES.length]));

  start().catch((error) => {
    complain(`The kernel could not be started: ${error.message}. The page needs a newer browser: Chromium 120, Firefox 117, Safari 17.2 or later.`);
    one(".answer").textContent = "The kernel could not be started.";
  });
})();
