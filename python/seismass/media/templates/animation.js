"use strict";
(() => {
  const root = document.currentScript.parentElement;
  const one = (name) => root.querySelector("." + name);
  const [play, slider, clock, speed, factor] = ["play", "time", "clock", "speed", "factor"].map(one);
  const [buildings, plots] = [one("buildings"), one("plots")];
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const FLASH = 0.35; // seconds on the screen

  // ---- data -------------------------------------------------------------------------------------------------------
  let [data, ground, runs] = [null, null, []];
  let [storeys, levels, blockCount, BEGIN, STOP, END] = [0, 0, 0, 0, 0, 0]; // levels: of all racks together
  let racks = []; // with the index of their lowest level among all

  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
  // Values are little-endian, as every machine with a browser is. A page that solves while it is shown gives arrays.
  const numbers = (given, peak) => {
    if (typeof given !== "string") return given;
    return Float32Array.from(new Int16Array(bytes(given)), (value) => (value * peak) / 32767);
  };
  const whole = (given, Type) => (typeof given === "string" ? new Type(bytes(given)) : given);

  // Of each storey and block the events that change its state, and what the state is from there on.
  const STARTS = { yield: 1, slip: 1, reverse: 1, lift: 2, unload: 0, reload: 0, stick: 0, touch: 1, land: 1 };
  function opened(given) {
    const drift = numbers(given.drift.values, given.drift.peak);
    const slip = numbers(given.slip.values, given.slip.peak);
    const levelDrift = given.racks ? numbers(given.racks.values, given.racks.peak) : [];
    const base = given.base && numbers(given.base.values, given.base.peak);
    const blocks = given.slip.peak > 0 || slip.length ? slip.length / given.rows : 0;
    const event = { row: whole(given.events.row, Uint32Array), kind: whole(given.events.kind, Uint8Array) };
    event.number = whole(given.events.number, Uint16Array);
    const largest = new Float32Array(given.rows); // drift so far, of the storey that is compared
    for (let row = 0; row < given.rows; row++) {
      const here = storeys ? Math.abs(drift[row * storeys + data.storey]) : 0;
      largest[row] = row ? Math.max(largest[row - 1], here) : here;
    }
    const changes = new Map();
    event.row.forEach((row, i) => {
      const name = data.kinds[event.kind[i]];
      if (!(name in STARTS)) return;
      const ofStorey = name === "yield" || name === "unload" || name === "reload";
      const places = ofStorey || event.number[i] ? [event.number[i]] : Array.from({ length: blocks }, (_, j) => j + 1);
      for (const place of places) {
        const key = (ofStorey ? "s" : "b") + place;
        if (!changes.has(key)) changes.set(key, []);
        changes.get(key).push([row, STARTS[name]]);
      }
    });
    return { ...given, drift, slip, levelDrift, base, blocks, event, largest, changes };
  }
  function open(given) {
    data = given;
    ground = { low: numbers(data.ground.low, data.ground.peak), high: numbers(data.ground.high, data.ground.peak) };
    storeys = data.heights.length;
    levels = 0;
    racks = (data.racks || []).map((rack) => {
      levels += rack.levels;
      return { ...rack, first: levels - rack.levels };
    });
    END = (data.rows - 1) * data.step;
    [BEGIN, STOP] = data.played || [0, END];
    runs = data.runs.map(opened);
    blockCount = runs[0].blocks;
    slider.max = String(END);
    if (data.alt) buildings.setAttribute("aria-label", data.alt);
    // An enlargement that is chosen to fit is stated.
    const fits = Array.from(factor.options).find((option) => Number(option.value) === 0);
    if (fits) fits.textContent = `${data.factor} \u00d7, to fit`;
  }

  const lastUpTo = (list, row, of) => {
    let [low, high] = [0, list.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (of(list[middle]) <= row) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  };
  const stateOf = (run, key, row) => {
    const list = run.changes.get(key);
    if (list === undefined) return [0, Infinity];
    const i = lastUpTo(list, row, (entry) => entry[0]);
    return i < 0 ? [0, Infinity] : [list[i][1], (row - list[i][0]) * data.step];
  };
  const between = (values, columns, column, rows, at) => {
    const last = rows - 1;
    const row = Math.min(Math.floor(at), last);
    const next = Math.min(row + 1, last);
    const part = Math.min(at - row, 1);
    return (1 - part) * values[row * columns + column] + part * values[next * columns + column];
  };

  // ---- drawing ----------------------------------------------------------------------------------------------------
  let colours = {};
  const readColours = () => {
    const style = getComputedStyle(root);
    for (const name of ["paper", "ink", "soft", "line", "slide", "code", "attached", "bare", "yield", "slab"]) {
      colours[name] = style.getPropertyValue("--" + name).trim();
    }
  };
  // Of the run whose goods slide, and of models: with none, all, or the code's share of the goods attached.
  const roleOf = ({ attached }) => (attached === null ? "slide" : attached === 0 ? "bare" : attached === 1 ? "attached" : "code");
  const colourOf = (run) => colours[roleOf(run)];
  const font = (size, weight = "") => `${weight} ${size}px system-ui, "DejaVu Sans", sans-serif`.trim();

  function sized(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    return [context, width, height];
  }

  function text(context, words, x, y, { size = 12, weight = "", colour = colours.ink, align = "left", fit = 0 } = {}) {
    context.fillStyle = colour;
    context.font = font(size, weight);
    context.textAlign = align;
    if (fit) while (size > 8 && context.measureText(words).width > fit) context.font = font(--size, weight);
    context.fillText(words, x, y, fit || undefined);
  }

  const driftText = (value) =>
    data.known ? `${((100 * value) / data.heights[data.storey]).toFixed(2)} %` : `${(1000 * value).toFixed(1)} mm`;

  function drawBuilding(context, run, left, width, height, at, enlarged) {
    const bottom = 30;
    const onRoof = (one) => storeys && !one.rack && one.floor === storeys;
    const aloft = racks.some(onRoof) ? (0.8 * (height - 110)) / (storeys + 0.8) : 0; // of racks on the roof
    const top = 72 + (aloft || (data.blocks.some(onRoof) ? Math.min(46, (0.5 * (height - 150)) / storeys) : 0));
    const total = data.heights.reduce((sum, one) => sum + one, 0) || 1.2; // m of ground
    const scale = (height - top - bottom) / total;
    const moved = data.ground.moved ? between(data.ground.moved, 1, 0, data.rows, at) : 0; // px, where it is pushed by hand
    const middle = left + width / 2 + moved;
    const floor = height - bottom;
    const half = Math.min(width * 0.27, Math.max((storeys ? 0.42 : 1.5) * total * scale, 40));
    const row = Math.min(at, run.rows - 1);
    const colour = colourOf(run);
    const flash = (age) => (still.matches || age < 0 ? 0 : Math.max(0, 1 - age / (FLASH * Number(speed.value))));

    const line = (words, y, options = {}) => text(context, words, middle, y, { align: "center", fit: width - 8, ...options });
    line(run.label[0].toUpperCase() + run.label.slice(1), 15, { weight: "600", colour, size: 14 });
    line(run.what, 31, { colour: colours.soft });
    if (storeys) {
      const so = driftText(run.largest[Math.min(Math.floor(at), run.rows - 1)]);
      const words = width < 260 ? `largest drift ${so}` : `largest drift of storey ${data.storey + 1} so far ${so}`;
      line(words, 47, { colour: colours.soft });
    }
    if (run.collapsed !== null && at >= run.rows - 1) {
      const words = `storey ${run.collapsed} collapsed at ${run.end.toFixed(2)} s`;
      line(words, 63, { weight: "600", colour: colours.yield });
    }

    context.save();
    context.beginPath();
    context.rect(left, 66, width, height - 66);
    context.clip();
    context.lineCap = "round";
    const slab = Math.min(7, Math.max(2, (scale * total) / Math.max(storeys, 1) / 10));
    const soil = floor + 2 + (run.base ? slab : 0);
    context.strokeStyle = colours.soft;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(left + width * 0.06, soil);
    context.lineTo(left + width * 0.94, soil);
    if (run.base) for (const edge of [-half, half]) context.rect(middle + edge, soil, 0, 5); // the first place of the slab
    context.stroke();

    const xs = [middle + (run.base ? enlarged * scale * between(run.base, 1, 0, run.rows, row) : 0)];
    const ys = [floor];
    for (let s = 0; s < storeys; s++) {
      xs.push(xs[s] + enlarged * scale * between(run.drift, storeys, s, run.rows, row));
      ys.push(ys[s] - data.heights[s] * scale);
    }
    const thin = Math.min(4, Math.max(1.2, (scale * total) / Math.max(storeys, 1) / 22));
    for (let s = 0; s < storeys; s++) {
      const [state, age] = stateOf(run, "s" + (s + 1), row);
      const glow = state ? flash(age) : 0;
      const mid = (ys[s] + ys[s + 1]) / 2;
      for (const side of [-0.88, 0.88]) {
        const path = new Path2D();
        path.moveTo(xs[s] + side * half, ys[s]);
        path.bezierCurveTo(xs[s] + side * half, mid, xs[s + 1] + side * half, mid, xs[s + 1] + side * half, ys[s + 1]);
        if (glow > 0) {
          context.globalAlpha = 0.45 * glow;
          context.strokeStyle = colours.yield;
          context.lineWidth = thin + 14;
          context.stroke(path);
          context.globalAlpha = 1;
        }
        context.strokeStyle = state ? colours.yield : colour;
        context.lineWidth = state ? thin * 2 + 1 : thin;
        context.stroke(path);
      }
    }
    if (data.walls) {
      context.strokeStyle = colours.slab;
      context.lineWidth = 2 * thin + 2;
      context.beginPath();
      for (let s = 0; s <= storeys; s++) context.lineTo(xs[s] - 0.97 * half, ys[s]);
      context.stroke();
    }
    for (let s = run.base ? 0 : 1; s <= storeys; s++) {
      context.fillStyle = colours.slab;
      context.fillRect(xs[s] - half, ys[s], 2 * half, slab);
    }
    if (run === runs[0]) root.places = { left, width, middle, xs, ys, half, blocks: [] };
    drawGoods(context, run, { xs, ys, half, scale, row, enlarged, flash, colour, total, aloft, thin });
    context.restore();

    const shake = (ground.low[Math.round(at)] + ground.high[Math.round(at)]) / 2 / (data.ground.peak || 1);
    const [label, edge] = [width < 260 ? "ground" : "ground acceleration", left + width * 0.06];
    text(context, label, edge, floor + 20, { size: 11, colour: colours.soft });
    const room = middle - edge - context.measureText(label).width - 6;
    arrow(context, middle, floor + 16, shake * Math.min(width * 0.3, room));
  }

  // Blocks and racks of a floor stand side by side, blocks first; goods of a level on its beam.
  function drawGoods(context, run, place) {
    const { xs, ys, half, scale, total, aloft } = place;
    const onFloor = new Map();
    const stand = (one) => onFloor.set(one.floor, (onFloor.get(one.floor) || 0) + 1);
    data.blocks.filter((block) => !block.rack).forEach(stand);
    racks.forEach(stand);
    const taken = new Map();
    const slotOf = (one) => {
      const position = taken.get(one.floor) || 0;
      taken.set(one.floor, position + 1);
      const slot = (1.7 * half) / onFloor.get(one.floor);
      const storey = (storeys ? data.heights[Math.min(one.floor, storeys - 1)] : total) * scale;
      return [slot, storey, xs[one.floor] - 0.85 * half + slot * (position + 0.5), ys[one.floor]];
    };
    data.blocks.forEach((block, j) => {
      if (block.rack || (run.attached !== null && block.floor === 0)) return;
      const [slot, storey, home, base] = slotOf(block);
      const wide = Math.max(6, Math.min(0.62 * slot, 0.9 * half) * (0.4 + 0.6 * block.size));
      const high = Math.max(4, Math.min(0.5 * storey, 0.8 * wide, storeys ? 46 : 120) * (0.4 + 0.6 * block.size));
      drawBlock(context, run, place, block, j, { home, base, wide, high });
    });
    racks.forEach((rack, r) => {
      if (run.attached !== null && rack.floor === 0) return;
      const [slot, storey, home, base] = slotOf(rack);
      const high = aloft && rack.floor === storeys ? aloft : 0.84 * storey;
      drawRack(context, run, place, rack, r, { home, base, wide: Math.min(0.82 * slot, 0.9 * half), high });
    });
  }

  // In the model of a code racks are part of their floor: they do not sway by themselves.
  function drawRack(context, run, place, rack, r, { home, base, wide, high }) {
    const { scale, row, enlarged, flash, colour, thin } = place;
    const each = high / (rack.levels + 0.72);
    const [xs, ys] = [[home], [base]];
    for (let l = 0; l < rack.levels; l++) {
      const drift = run.attached === null ? between(run.levelDrift, levels, rack.first + l, run.rows, row) : 0;
      xs.push(xs[l] + enlarged * scale * drift);
      ys.push(ys[l] - each);
    }
    const fine = Math.min(2.2, Math.max(1, 0.6 * thin));
    for (let l = 0; l < rack.levels; l++) {
      const [state, age] = run.attached === null ? stateOf(run, "s" + (storeys + rack.first + l + 1), row) : [0, Infinity];
      const glow = state ? flash(age) : 0;
      for (const side of [-wide / 2, wide / 2]) {
        const path = new Path2D();
        path.moveTo(xs[l] + side, ys[l]);
        path.lineTo(xs[l + 1] + side, ys[l + 1]);
        if (glow > 0) {
          context.globalAlpha = 0.45 * glow;
          context.strokeStyle = colours.yield;
          context.lineWidth = fine + 10;
          context.stroke(path);
          context.globalAlpha = 1;
        }
        context.strokeStyle = state ? colours.yield : colour;
        context.lineWidth = state ? 2 * fine + 1 : fine;
        context.stroke(path);
      }
      context.fillStyle = colours.slab;
      context.fillRect(xs[l + 1] - wide / 2, ys[l + 1], wide, Math.max(1.5, 0.7 * fine + 1));
    }
    for (let l = 1; l <= rack.levels; l++) {
      const fixed = rack.fixed.filter((one) => one.level === l).map((one) => [one, -1]);
      const loose = data.blocks.map((block, j) => [block, j]).filter(([block]) => block.rack === r + 1 && block.level === l);
      const goods = [...loose, ...fixed];
      goods.forEach(([block, j], position) => {
        const slot = (0.96 * wide) / goods.length;
        const broad = Math.max(4, 0.62 * slot * (0.4 + 0.6 * block.size));
        const tall = Math.max(3, Math.min(0.66 * each, 0.9 * broad, 46) * (0.5 + 0.5 * block.size));
        const at = { home: xs[l] - 0.48 * wide + slot * (position + 0.5), base: ys[l], wide: broad, high: tall };
        drawBlock(context, run, place, block, j, at);
      });
    }
  }

  // A block at its place; fixed ones have no number (-1).
  function drawBlock(context, run, place, block, j, { home, base, wide, high }) {
    const { scale, row, enlarged, flash, colour, half } = place;
    if (run.attached !== null) {
      context.lineWidth = 1.2;
      context.strokeStyle = colour;
      context.setLineDash([4, 3]);
      context.strokeRect(home - wide / 2, base - high, wide, high);
      context.setLineDash([]);
      context.fillStyle = colour;
      context.fillRect(home - wide / 2, base - high * run.attached, wide, high * run.attached);
      return;
    }
    if (j < 0) {
      context.fillStyle = colours.slab;
      context.fillRect(home - wide / 2, base - high, wide, high);
      return;
    }
    const [state, age] = stateOf(run, "b" + (j + 1), row);
    const slip = between(run.slip, run.blocks, j, run.rows, row);
    const x = home + enlarged * scale * slip;
    const y = base - (state === 2 ? 4 : 0);
    root.places.blocks[j] = { x, y, wide, high };
    const glow = state ? flash(age) : 0;
    if (glow > 0) {
      context.globalAlpha = 0.45 * glow;
      context.fillStyle = colour;
      context.fillRect(x - wide / 2 - 6, y - high - 6, wide + 12, high + 6);
      context.globalAlpha = 1;
    }
    context.strokeStyle = colours.ink;
    context.lineWidth = 1.5;
    context.beginPath(); // where it stood at the start
    context.moveTo(home, base + 1);
    context.lineTo(home, base + 6);
    context.stroke();
    context.fillStyle = state ? colour : colours.paper;
    context.fillRect(x - wide / 2, y - high, wide, high);
    context.strokeStyle = colour;
    context.strokeRect(x - wide / 2, y - high, wide, high);
    context.beginPath(); // its own mark, above that of the floor
    context.strokeStyle = state ? colours.paper : colour;
    context.moveTo(x, y);
    context.lineTo(x, y - Math.min(6, high));
    context.stroke();
    (block.stops || []).forEach((clearance, side) => {
      const away = enlarged * scale * clearance;
      if (clearance === null || away > 2 * half) return;
      const rail = home + (side ? 1 : -1) * (wide / 2 + away + 1);
      context.strokeStyle = colours.ink;
      context.lineWidth = 2;
      context.beginPath();
      context.moveTo(rail, base);
      context.lineTo(rail, base - Math.min(10, Math.max(5, 0.6 * high)));
      context.stroke();
    });
    if (data.blocks.length > 1 && high >= 22) {
      text(context, String(j + 1), x, y - high / 2 + 3, { size: 11, align: "center", colour: state ? colours.paper : colours.ink });
    }
  }

  function arrow(context, x, y, length) {
    if (Math.abs(length) < 1) return;
    const head = Math.sign(length) * Math.min(6, Math.abs(length));
    context.strokeStyle = context.fillStyle = colours.soft;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + length - head, y);
    context.stroke();
    context.beginPath();
    context.moveTo(x + length, y);
    context.lineTo(x + length - head, y - 4);
    context.lineTo(x + length - head, y + 4);
    context.fill();
  }

  // ---- histories --------------------------------------------------------------------------------------------------
  const rangeOf = (curves) => {
    let [low, high] = [0, 0];
    for (const { values, columns, column, rows, scale } of curves) {
      for (let row = 0; row < rows; row++) {
        const value = scale * values[row * columns + column];
        [low, high] = [Math.min(low, value), Math.max(high, value)];
      }
    }
    return [low, high];
  };
  // Rows of the real building at which it begins to yield or its goods begin to slide, where they are to be marked.
  function marksOf(name, number) {
    const { row, kind, number: numbered } = runs[0].event;
    const isOne = (_, i) => data.kinds[kind[i]] === name && (number === undefined || numbered[i] === number);
    return data.marks ? Array.from(row).filter(isOne) : [];
  }
  const DASHES = [[], [6, 3], [2, 3], [9, 3, 2, 3], [1, 2]];
  // A history of both runs: solid where goods slide, dashed of the model.
  const curveOf = (run, i, values, columns, column, scale) => ({
    values, columns, column, rows: run.rows, scale,
    colour: colourOf(run), dash: i ? [5, 2] : [], label: run.attached === null ? "goods slide" : "model",
  });
  function panelsOf(mostCurves) {
    const wide = storeys ? (data.known ? 100 / data.heights[data.storey] : 1000) : 1;
    const peak = data.ground.peak;
    const panels = [{ title: "ground acceleration (g)", ends: [-peak, peak], digits: 2, range: ground, curves: [] }];
    if (storeys) {
      const unit = data.known ? "% of height" : "mm";
      const curves = runs.map((run, i) => curveOf(run, i, run.drift, storeys, data.storey, wide));
      const title = mostCurves > 3 ? `drift of storey ${data.storey + 1} (${unit})` : `drift ${data.storey + 1} (${unit.slice(0, 2).trim()})`;
      panels.push({ title, ends: rangeOf(curves), digits: data.known ? 2 : 1, curves, marks: marksOf("yield", data.storey + 1) });
    }
    const reach = (curve) => Math.max(...rangeOf([curve]).map(Math.abs));
    // Blocks and levels are shades of the colour of goods that slide: the others are those of models.
    const shade = (part, other) => `color-mix(in srgb, ${colours.slide} ${part}%, ${other})`;
    const hues = [colours.slide, shade(55, colours.paper), shade(45, colours.ink), shade(75, colours.ink), shade(35, colours.paper)];
    const mostOf = (all) => {
      const most = all.map((curve) => [reach(curve), curve]).sort(([a], [b]) => b - a).slice(0, mostCurves);
      const curves = all.filter((curve) => most.some(([, other]) => other === curve));
      curves.forEach((curve, i) => Object.assign(curve, { colour: hues[i], dash: DASHES[i] }));
      return curves;
    };
    if (runs[0].base) {
      const curves = runs.map((run, i) => curveOf(run, i, run.base, 1, 0, 1000));
      panels.push({ title: "slip of the base (mm)", ends: rangeOf(curves), digits: 1, curves });
    }
    if (levels) {
      const ofLevels = racks.flatMap((rack, r) => Array.from({ length: rack.levels }, (_, l) => ({
        values: runs[0].levelDrift, columns: levels, column: rack.first + l, rows: runs[0].rows, scale: 1000,
        label: `${r + 1}.${l + 1}`,
      })));
      const curves = mostOf(ofLevels);
      panels.push({ title: mostCurves > 3 ? "drift of racks (mm), rack.level" : "drift of racks (mm)", ends: rangeOf(curves), digits: 1, curves });
    }
    if (blockCount) {
      const real = runs[0];
      const all = data.blocks.map((_, j) => ({
        values: real.slip, columns: blockCount, column: j, rows: real.rows, scale: 1000, label: `${j + 1}`,
      }));
      const curves = mostOf(all);
      const title = all.length > mostCurves ? `slip (mm), ${mostCurves} blocks of ${all.length}` : "slip of blocks (mm)";
      panels.push({ title, ends: rangeOf(curves), digits: 1, curves, marks: marksOf("slip") });
    }
    return panels;
  }

  const MARGIN = { left: 50, right: 12, top: 4, bottom: 24, title: 20, gap: 12 };
  let backdrop = null; // the histories without cursor, and where their panels are

  function drawBackdrop(width, height) {
    const canvas = document.createElement("canvas");
    const ratio = window.devicePixelRatio || 1;
    [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    const panels = panelsOf(width < 500 ? 3 : 5);
    const [x0, x1] = [MARGIN.left, width - MARGIN.right];
    const each = (height - MARGIN.top - MARGIN.bottom) / panels.length;
    const xOf = (row) => x0 + ((x1 - x0) * row) / Math.max(data.rows - 1, 1);
    panels.forEach((panel, p) => {
      const [top, low] = [MARGIN.top + p * each + MARGIN.title, MARGIN.top + (p + 1) * each - MARGIN.gap];
      const [least, most] = panel.ends[0] < panel.ends[1] ? panel.ends : [-1, 1];
      const yOf = (value) => low - ((value - least) / (most - least)) * (low - top);
      Object.assign(panel, { top, low, yOf });
      context.strokeStyle = colours.line;
      context.lineWidth = 1;
      // An end close to zero has no label of its own.
      for (const value of [least, 0, most].filter((one) => one === 0 || Math.abs(yOf(one) - yOf(0)) > 12)) {
        context.beginPath();
        context.moveTo(x0, yOf(value));
        context.lineTo(x1, yOf(value));
        context.stroke();
        const words = value === 0 ? "0" : value.toFixed(panel.digits).replace(/^-(?=[0.]*$)/, "").replace("-", "\u2212");
        text(context, words, x0 - 6, yOf(value) + 4, { size: 11, colour: colours.soft, align: "right", fit: x0 - 8 });
      }
      let x = x1;
      for (const curve of panel.curves.length > 1 ? panel.curves.toReversed() : []) {
        context.font = font(11);
        x -= context.measureText(curve.label).width;
        text(context, curve.label, x, top - 7, { size: 11, colour: colours.soft });
        stroke(context, curve, 2, [[x - 26, top - 11], [x - 5, top - 11]]);
        x -= 36;
      }
      text(context, panel.title, x0 + 5, top - 7, { size: 12, fit: x - x0 - 5 });
      if (panel.range !== undefined) {
        context.strokeStyle = colours.ink;
        context.lineWidth = 1;
        context.beginPath();
        for (let row = 0; row < data.rows; row++) {
          context.lineTo(xOf(row), yOf(panel.range.high[row]));
          context.lineTo(xOf(row), yOf(panel.range.low[row]));
        }
        context.stroke();
      }
      for (const curve of panel.curves) {
        const points = Array.from({ length: curve.rows }, (_, row) => [
          xOf(row), yOf(curve.scale * curve.values[row * curve.columns + curve.column]),
        ]);
        stroke(context, curve, 1.5, points);
      }
    });
    for (const panel of panels) {
      context.strokeStyle = colours.yield;
      context.lineWidth = 1;
      context.beginPath();
      for (const row of panel.marks || []) {
        context.moveTo(xOf(row), panel.low + 1);
        context.lineTo(xOf(row), panel.low + 6);
      }
      context.stroke();
    }
    const seconds = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((one) => (x1 - x0) / (END / one) >= 44) || 1000;
    for (let t = 0; t <= END + 1e-9; t += seconds) {
      const last = t + seconds > END;
      text(context, last ? `${t} s` : String(t), xOf(t / data.step), height - 8, { size: 11, colour: colours.soft, align: "center" });
    }
    return { canvas, panels, x0, x1, width, height };
  }

  function stroke(context, curve, width, points) {
    context.strokeStyle = curve.colour;
    context.lineWidth = width;
    context.setLineDash(curve.dash);
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.stroke();
    context.setLineDash([]);
  }

  function drawPlots(at) {
    const [context, width, height] = sized(plots);
    if (backdrop === null || backdrop.width !== width || backdrop.height !== height) backdrop = drawBackdrop(width, height);
    const { canvas, panels, x0, x1 } = backdrop;
    context.drawImage(canvas, 0, 0, width, height);
    const x = x0 + ((x1 - x0) * at) / Math.max(data.rows - 1, 1);
    context.strokeStyle = colours.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x, panels[0].top - 2);
    context.lineTo(x, panels.at(-1).low + 4);
    context.stroke();
    for (const panel of panels) {
      for (const curve of panel.curves) {
        const value = curve.scale * between(curve.values, curve.columns, curve.column, curve.rows, at);
        context.fillStyle = curve.colour;
        context.beginPath();
        context.arc(x, panel.yOf(value), 3.5, 0, 2 * Math.PI);
        context.fill();
      }
    }
  }

  // ---- player -----------------------------------------------------------------------------------------------------
  let time = 0;
  let since = null; // the time of the last frame on the screen while it plays
  let isInSight = true; // the histories, which wait for a pause where they are not seen
  let later = 0;

  function draw() {
    if (data === null) return;
    const at = Math.min(time / data.step, data.rows - 1) || 0;
    const [context, width, height] = sized(buildings);
    if (width === 0) return;
    const each = width / runs.length;
    runs.forEach((run, i) => drawBuilding(context, run, i * each, each, height, at, Number(factor.value) || data.factor));
    clearTimeout(later);
    if (isInSight) drawPlots(at);
    else later = setTimeout(drawPlots, 200, at);
    slider.value = String(time);
    slider.setAttribute("aria-valuetext", `${time.toFixed(1)} of ${END.toFixed(1)} seconds`);
    clock.textContent = `${time.toFixed(2)} of ${END.toFixed(1)} s`;
    root.dispatchEvent(new CustomEvent("time", { detail: time }));
  }
  const redraw = () => {
    readColours();
    backdrop = null;
    draw();
  };
  function goTo(seconds) {
    time = Math.min(Math.max(seconds, 0), END);
    draw();
  }
  function frame(now) {
    if (since === null) return;
    const passed = Math.min(now - since, 250) / 1000;
    since = now;
    const before = time;
    goTo(time + passed * Number(speed.value));
    if (time >= END || (before < STOP && time >= STOP)) setPlaying(false);
    else requestAnimationFrame(frame);
  }
  function setPlaying(on) {
    if (on && time >= END) time = BEGIN;
    const was = since !== null;
    since = on ? performance.now() : null;
    play.textContent = on ? "Pause" : "Play";
    if (on && !was) requestAnimationFrame(frame);
  }
  function faster(by) {
    speed.selectedIndex = Math.min(Math.max(speed.selectedIndex + by, 0), speed.options.length - 1);
  }

  play.addEventListener("click", () => setPlaying(since === null));
  slider.addEventListener("input", () => goTo(Number(slider.value)));
  factor.addEventListener("change", draw);
  const drag = (event) => {
    if (event.buttons === 0 || backdrop === null) return;
    const x = event.clientX - plots.getBoundingClientRect().left;
    goTo(((x - backdrop.x0) / (backdrop.x1 - backdrop.x0)) * END);
  };
  plots.addEventListener("pointerdown", (event) => {
    plots.setPointerCapture(event.pointerId);
    root.focus({ preventScroll: true });
    drag(event);
  });
  plots.addEventListener("pointermove", drag);

  const alone = "autoplay" in root.dataset;
  const keys = (event) => {
    if (event.target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey || event.altKey) return;
    const by = event.shiftKey ? 1 : 0.1;
    const does = {
      " ": () => setPlaying(since === null),
      ArrowLeft: () => goTo(time - by), ArrowDown: () => goTo(time - by),
      ArrowRight: () => goTo(time + by), ArrowUp: () => goTo(time + by),
      Home: () => goTo(0), End: () => goTo(END),
      "+": () => faster(1), "-": () => faster(-1),
    }[event.key];
    const onPage = event.target === document.body && event.key.startsWith("Arrow") && !event.key.match(/Left|Right/);
    if (does === undefined || onPage || (event.key === " " && event.target === play)) return;
    event.preventDefault();
    does();
  };
  (alone ? document : root).addEventListener("keydown", keys);

  dark.addEventListener("change", redraw);
  // On paper stands the instant of the largest drift, unless another one was chosen.
  window.addEventListener("beforeprint", () => {
    isInSight = true;
    if (time === BEGIN && data !== null) time = runs[0].largest.indexOf(Math.max(...runs[0].largest)) * data.step;
    redraw();
    requestAnimationFrame(redraw);
  });
  window.addEventListener("afterprint", redraw);
  const resized = new ResizeObserver(() => {
    backdrop = null;
    draw();
  });
  resized.observe(root);
  resized.observe(buildings);
  new IntersectionObserver(([entry]) => {
    isInSight = entry.isIntersecting;
    if (isInSight) draw();
  }).observe(plots);
  const stored = JSON.parse(root.querySelector('script[type="application/json"]').textContent);
  if (stored !== null) {
    open(stored);
    time = BEGIN;
  }
  // For a page that solves while it is shown: other runs, at the time that is shown or another one; where things stand in
  // the picture of the first run (`places`); keys, where its parts stand outside the element.
  root.show = (given, at = time) => {
    open(given);
    time = Math.min(Math.max(at, 0), END);
    redraw();
  };
  root.play = (on = true) => setPlaying(on);
  root.keys = keys;
  redraw();
  if (alone && !still.matches) setPlaying(true);
})();
