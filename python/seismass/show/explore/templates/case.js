// A case of the page: what may be chosen, its form in the address, the scene that the kernel solves, and a scene file.
const MOST_STOREYS = 4;
const LIMITS = {
  // Key: [smallest, largest, letters in the address, words for messages]
  storeys: [1, MOST_STOREYS, "n", "storeys"],
  period: [0.05, 5, "T", "first period"],
  damping: [0, 0.5, "z", "damping ratio"],
  overstrength: [1, 10, "O", "overstrength"],
  secondSlope: [0, 1, "r2", "second slope"],
  height: [0.5, 20, "h", "storey height"],
  R: [1, 20, "R", "R"],
  strength: [0.001, 20, "V", "strength V_y/W"],
  massRatio: [0, 10, "a", "goods over floor mass"],
  muS: [0, 5, "s", "static friction"],
  muK: [0, 5, "k", "kinetic friction"],
  intensity: [0.001, 100, "x", "intensity"],
  counted: [0, 1, "c", "share of the code"],
  thirdSlope: [0, 1, "r3", "third slope"],
  floorMass: [0.01, 4, "M", "floor mass over the mean one"],
  stiffness: [0.001, 1000, "K", "storey stiffness over that of the first"],
  pDelta: [0, 1, "P", "P-Delta"],
  present: [0.01, 100, "o", "goods present over the design live load"],
  counter: [0, MOST_STOREYS, "y", "storey that is counted"],
};
const WHOLE = ["storeys", "pDelta", "counter"];
// Lists of one number per storey; of most of them one number stands for all storeys.
const BY_FLOOR = ["massRatio", "muS", "muK"];
const LISTS = [...BY_FLOOR, "strength", "height", "overstrength", "secondSlope", "thirdSlope", "floorMass", "stiffness"];
const FOR_ALL = LISTS.filter((key) => key !== "strength" && key !== "massRatio");
// Kinds of events, in the order of the kernel.
const EVENT_NAMES = ["yield", "unload", "reload", "close", "open", "slip", "stick", "reverse", "touch", "lift", "land", "wear"];
const STRENGTHS = ["design", "hand", "elastic"];
const BESIDE = ["code", "share", "full", "none"];

// Goods as heavy as the floors on floors 1 and 2, a bare roof, strengths by design: where lambda is not at an end. `factors`
// scale the suite in place of its own, `file` is what the page of a building file found: share, interval, number of motions,
// and by which keys the case differs from it.
function defaultCase() {
  const all = (value) => Array.from({ length: MOST_STOREYS }, () => value);
  return {
    storeys: 3, period: 0.47, damping: 0.05, overstrength: all(2), secondSlope: all(0.05), height: all(3.5),
    by: "design", R: 4, strength: [0.34, 0.27, 0.13, 0.1],
    massRatio: [1, 1, 0, 0], muS: all(0.2), muK: all(0.2), thirdSlope: all(0), floorMass: all(1), stiffness: all(1),
    record: "synthetic-1", intensity: 1, counted: 0.25, beside: "code", pDelta: 0, present: 1, counter: 0,
    factors: null, file: null,
  };
}

// The numbers of a case, by which two are the same building under the same suite.
function numbersOf(state, keys = Object.keys(LIMITS)) {
  const parts = [`by=${state.by}`];
  const usual = defaultCase();
  for (const key of keys) {
    const isList = LISTS.includes(key);
    const own = isList ? state[key].slice(0, state.storeys) : [state[key]];
    const isOne = FOR_ALL.includes(key) && own.every((value) => value === own[0]);
    // What few cases have is said where it is other than usual.
    const isRare = Object.keys(LIMITS).indexOf(key) > Object.keys(LIMITS).indexOf("counted");
    if (isRare && own.every((value) => value === [usual[key]].flat()[0])) continue;
    parts.push(`${LIMITS[key][2]}=${(isOne ? own.slice(0, 1) : own).join(",")}`);
  }
  if (state.factors !== null) parts.push(`g=${state.factors.join(",")}`);
  return parts.join("&");
}
const caseNumbers = (state) => numbersOf(state, Object.keys(LIMITS).filter((key) => key !== "counter"));

function addressOf(state) {
  const { file } = state;
  const tail = file === null ? "" : `&F=${[file.share, file.low, file.high, file.motions].join(",")}${file.differs.length ? `&W=${file.differs.join(",")}` : ""}`;
  return `v=1&m=${encodeURIComponent(state.record)}&d=${state.beside}&${numbersOf(state)}${tail}`;
}

// What an address says over the default case; what it says wrong is left out and returned as remarks.
function caseOf(address) {
  const state = defaultCase();
  const remarks = [];
  const parts = address.replace(/^#/, "").split("&").filter(Boolean).map((part) => part.split("="));
  const said = new Map(parts.map(([key, ...value]) => [key, value.join("=")]));
  const numbersAt = (letters) => said.get(letters).split(",").map((text) => (text.trim() === "" ? NaN : Number(text)));
  for (const [key, [low, high, letters, words]] of Object.entries(LIMITS)) {
    if (!said.has(letters)) continue;
    const numbers = numbersAt(letters);
    const isList = LISTS.includes(key);
    const fits = numbers.every((number) => number >= low && number <= high);
    const counts = isList ? numbers.length <= MOST_STOREYS : numbers.length === 1;
    if (!fits || !counts || (WHOLE.includes(key) && !Number.isInteger(numbers[0]))) {
      remarks.push(`${words} in the address must be from ${low} to ${high}; got ${said.get(letters).slice(0, 40)}`);
    } else if (isList) {
      if (numbers.length === 1 && FOR_ALL.includes(key)) state[key].fill(numbers[0]);
      else numbers.forEach((number, i) => (state[key][i] = number));
    } else {
      [state[key]] = numbers;
    }
  }
  if (STRENGTHS.includes(said.get("by"))) state.by = said.get("by");
  if (BESIDE.includes(said.get("d"))) state.beside = said.get("d");
  if (said.has("m")) {
    try {
      state.record = decodeURIComponent(said.get("m")).slice(0, 200);
    } catch {
      remarks.push(`the record in the address cannot be read: ${said.get("m").slice(0, 40)}`);
    }
  }
  if (said.has("g")) {
    const factors = numbersAt("g");
    if (factors.every((factor) => factor > 0 && factor <= 1000)) state.factors = factors;
    else remarks.push(`factors of the motions in the address must be above 0 and at most 1000; got ${said.get("g").slice(0, 40)}`);
  }
  if (said.has("F")) {
    const [share, low, high, motions] = numbersAt("F");
    const differs = (said.get("W") || "").split(",").filter((key) => /^[a-z]+$/.test(key));
    if ([share, low, high].every((one) => one >= 0 && one <= 2) && motions >= 1) state.file = { share, low, high, motions, differs };
    else remarks.push(`the answer of a building file in the address must be three shares and a number of motions; got ${said.get("F").slice(0, 40)}`);
  }
  state.counter = Math.min(state.counter, state.storeys);
  state.muK = state.muK.map((mu, i) => Math.min(mu, state.muS[i]));
  return { state, remarks };
}

// Strengths V_y/W of all storeys: designed with the elastic ones, V_e/W, by hand, or infinite.
function strengthsOf(state, elastic) {
  if (state.by === "elastic") return elastic.map(() => Infinity);
  return state.by === "design" ? elastic.map((each) => each / state.R) : state.strength.slice(0, state.storeys);
}

function sceneOf(state, strength) {
  const first = (list) => list.slice(0, state.storeys);
  const thirdSlope = first(state.thirdSlope).map((slope, i) => Math.min(slope, state.secondSlope[i]));
  return {
    storeys: state.storeys, period: state.period, damping: state.damping, pDelta: state.pDelta, strength,
    ...Object.fromEntries(LISTS.filter((key) => key !== "strength").map((key) => [key, first(state[key])])), thirdSlope,
  };
}

// A scene file for `seismass run`, to the last bit of what the page solves; stiffnesses (N/m) of floors that differ.
function sceneFile(scene, { stiffness, record, scale, note }) {
  const alike = (values) => values.every((value) => value === values[0]);
  const list = (values) => (alike(values) ? String(values[0]) : `[${Array.from(values, String).join(", ")}]`);
  const isUniform = [...scene.floorMass, ...scene.stiffness].every((value) => value === 1);
  const lines = [
    `name = ${JSON.stringify(`${scene.storeys} ${scene.storeys === 1 ? "storey" : "storeys"}, T = ${scene.period} s`)}`,
    `note = ${JSON.stringify(note)}`,
    "",
    "[building]",
    ...(isUniform ? [`storeys = ${scene.storeys}`, `period = ${scene.period} # s, without the goods`] : [`mass = [${scene.floorMass.join(", ")}] # kg, over the mean`, `stiffness = [${stiffness.join(", ")}]`]),
    `damping = ${scene.damping}`,
    `overstrength = ${list(scene.overstrength)}`,
    `second_slope = ${list(scene.secondSlope)}`,
    `third_slope = ${list(scene.thirdSlope)}`,
    `heights = ${list(scene.height)} # m`,
  ];
  if (scene.pDelta) lines.push(`gravity_load = [${scene.floorMass.map((mass) => GRAVITY * mass).join(", ")}] # N`);
  if (scene.strength.every(Number.isFinite)) lines.push(`yield_shear_over_weight = [${scene.strength.join(", ")}]`);
  scene.massRatio.forEach((ratio, i) => {
    if (ratio === 0) return;
    const mass = isUniform ? `mass_ratio = ${ratio}` : `mass = ${ratio}`;
    lines.push("", "[[blocks]]", `floor = ${i + 1}`, mass, `mu_s = ${scene.muS[i]}`, `mu_k = ${scene.muK[i]}`);
  });
  lines.push("", "[motion]", `# ${record.name.replace(/[\x00-\x1f\x7f]/g, " ")}`, `dt = ${record.dt}`);
  lines.push(`unit = "${record.unit}"`, `scale = ${scale}`, "acceleration = [");
  for (let i = 0; i < record.values.length; i += 8) lines.push(`  ${Array.from(record.values.slice(i, i + 8), String).join(", ")},`);
  return `${[...lines, "]"].join("\n")}\n`;
}
