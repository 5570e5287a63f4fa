// Handles on the drawing of the building: the height of a block is the mass of its goods, the grip beside it their friction,
// the ground is pushed. Each is a slider for keys and for screen readers too. `ranges` gives smallest, largest and step of a
// quantity, `valueOf` its value on a floor, `choose` takes another one.
function openHandles(place, player, { ranges, valueOf, choose, pushed }) {
  const PIXELS = { massRatio: 150, muS: 200 }; // for the whole range
  const made = (name, words, attributes = {}) => {
    const handle = Object.assign(document.createElement("b"), { className: `handle ${name}`, tabIndex: 0 });
    handle.setAttribute("role", "slider");
    handle.setAttribute("aria-label", words);
    for (const [key, value] of Object.entries(attributes)) handle.setAttribute(key, value);
    place.append(handle);
    return handle;
  };
  function slide(handle, key, floor, upwards) {
    const take = (value) => {
      const { min, max, step } = ranges(key);
      const rounded = Math.round(value / step) * step;
      choose(key, Number(Math.min(Math.max(rounded, min), max).toPrecision(6)), floor());
    };
    let from = null; // where the pointer went down, and the value there
    handle.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      handle.focus({ preventScroll: true });
      handle.setPointerCapture(event.pointerId);
      from = { x: event.clientX, y: event.clientY, value: valueOf(key, floor()) };
    });
    handle.addEventListener("pointermove", (event) => {
      if (from === null) return;
      const { min, max } = ranges(key);
      const moved = upwards ? from.y - event.clientY : event.clientX - from.x;
      take(from.value + (moved / PIXELS[key]) * (max - min));
    });
    for (const name of ["pointerup", "pointercancel"]) handle.addEventListener(name, () => (from = null));
    handle.addEventListener("keydown", (event) => {
      const { min, max, step } = ranges(key);
      const value = valueOf(key, floor());
      const wanted = {
        ArrowUp: value + step, ArrowRight: value + step, ArrowDown: value - step, ArrowLeft: value - step,
        PageUp: value + 10 * step, PageDown: value - 10 * step, Home: min, End: max,
      }[event.key];
      if (wanted === undefined) return;
      event.preventDefault();
      take(wanted);
    });
  }
  const masses = Array.from({ length: MOST_STOREYS }, (_, i) => made("mass", `Mass of the goods on floor ${i + 1}, over the floor mass`, { "aria-orientation": "vertical" }));
  masses.forEach((handle, i) => slide(handle, "massRatio", () => i, true));
  const grip = made("grip", "Friction of the goods");
  let lowest = 0;
  slide(grip, "muS", () => lowest, false);
  const ground = made("ground", "The ground, cm to the side", { "aria-valuemin": "-30", "aria-valuemax": "30", "aria-valuenow": "0" });
  ground.append(Object.assign(document.createElement("span"), { textContent: "\u2194 push" }));
  openPush(ground, player, pushed);

  // Where the picture has them now.
  function put() {
    const { places } = player;
    if (places === undefined) return;
    const { xs, ys, half, middle, left, width, loaded, blocks } = { loaded: [], ...places, ...place.state };
    masses.forEach((handle, i) => {
      handle.hidden = i + 1 >= xs.length;
      if (handle.hidden) return;
      const block = blocks[loaded.indexOf(i)] || { x: xs[i + 1], y: ys[i + 1] + 12, wide: 0.5 * half, high: 0 };
      const [wide, high] = [Math.max(block.wide, 24), Math.max(block.high + 6, 24)];
      handle.classList.toggle("empty", !loaded.includes(i));
      Object.assign(handle.style, { width: `${wide}px`, height: `${high}px`, transform: `translate(${block.x - wide / 2}px, ${block.y - high}px)` });
    });
    lowest = loaded.length ? loaded[0] : 0;
    grip.hidden = loaded.length === 0;
    // Beside the place of the block, as the block may slide.
    if (!grip.hidden) grip.style.transform = `translate(calc(${xs[lowest + 1] - (blocks[0] || { wide: half }).wide / 2 - 3}px - 100%), ${ys[lowest + 1] - 25}px)`;
    ground.style.transform = `translate(calc(${middle - left - width / 2 + left + 0.96 * width}px - 100%), ${ys[0] + 4}px)`;
  }
  player.addEventListener("time", put);
  // The values that they have, and which floors carry goods.
  return (loaded, storeys) => {
    place.state = { loaded };
    for (const [handle, key, floor] of [...masses.slice(0, storeys).map((one, i) => [one, "massRatio", i]), [grip, "muS", loaded[0] || 0]]) {
      const { min, max } = ranges(key);
      const value = valueOf(key, floor);
      for (const [name, text] of [["valuemin", min], ["valuemax", max], ["valuenow", value]]) handle.setAttribute(`aria-${name}`, text);
      const words = key === "muS" ? `\u03bc ${general(value, 3)}` : value > 0 ? `${general(value, 3)}\u00d7` : "+";
      handle.replaceChildren(Object.assign(document.createElement("span"), { textContent: words }));
    }
    put();
  };
}

// The ground as it is pushed by hand: it follows the pointer as a damped oscillator does, so that accelerations are finite, and
// is the record of the run from its begin. It ends some seconds after it was let go, or where it is long.
const PUSH = { step: 0.01, farthest: 0.3, rate: 2 * Math.PI * 1.5, rest: 4, longest: 30 }; // s, m, rad/s, s, s
// Pixels of a metre of the ground, so that it stays in the picture of a building.
const pushScale = ({ places }) => (0.14 * places.width) / PUSH.farthest;
function openPush(handle, player, pushed) {
  let [target, at, speed, rest, last] = [0, 0, 0, 0, null];
  let [samples, moved] = [[], []];
  let from = null;
  function frame(now) {
    const passed = Math.min((now - last) / 1000, 0.1);
    const steps = Math.floor(passed / PUSH.step);
    last += 1000 * steps * PUSH.step;
    if (now - last > 100) last = now;
    for (let i = 0; i < steps; i++) {
      const acceleration = PUSH.rate ** 2 * (target - at) - 2 * PUSH.rate * speed;
      speed += acceleration * PUSH.step;
      at += speed * PUSH.step;
      samples.push(acceleration);
      moved.push(at);
    }
    rest = from === null ? rest + steps * PUSH.step : 0;
    const isOver = rest > PUSH.rest || samples.length * PUSH.step > PUSH.longest;
    if (samples.length > 1) pushed({ dt: PUSH.step, samples: Float64Array.from(samples), moved: Float64Array.from(moved) }, isOver);
    handle.setAttribute("aria-valuenow", String(Math.round(100 * at)));
    if (isOver) last = from = null;
    else requestAnimationFrame(frame);
  }
  function begin() {
    rest = 0;
    if (last !== null) return;
    [target, at, speed, samples, moved, last] = [0, 0, 0, [], [], performance.now()];
    player.play(false);
    requestAnimationFrame(frame);
  }
  const aim = (metres) => (target = Math.min(Math.max(metres, -PUSH.farthest), PUSH.farthest));
  handle.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    handle.focus({ preventScroll: true });
    handle.setPointerCapture(event.pointerId);
    begin();
    from = event.clientX - target * pushScale(player);
  });
  handle.addEventListener("pointermove", (event) => from !== null && aim((event.clientX - from) / pushScale(player)));
  for (const name of ["pointerup", "pointercancel"]) handle.addEventListener(name, () => (from = null));
  handle.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (way === undefined) return;
    event.preventDefault();
    begin();
    aim(target + 0.05 * way);
  });
}
