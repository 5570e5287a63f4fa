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
};
const LISTS = ["strength", "massRatio", "muS", "muK"];
// Kinds of events, in the order of the kernel.
const EVENT_NAMES = ["yield", "unload", "reload", "close", "open", "slip", "stick", "reverse", "touch", "lift", "land", "wear"];
const STRENGTHS = ["design", "hand", "elastic"];
const BESIDE = ["code", "full", "none"];

// Goods as heavy as the floors on floors 1 and 2, a bare roof, strengths by design: where lambda is not at an end.
function defaultCase() {
  return {
    storeys: 3, period: 0.47, damping: 0.05, overstrength: 2, secondSlope: 0.05, height: 3.5,
    by: "design", R: 4, strength: [0.34, 0.27, 0.13, 0.1],
    massRatio: [1, 1, 0, 0], muS: [0.2, 0.2, 0.2, 0.2], muK: [0.2, 0.2, 0.2, 0.2],
    record: "synthetic-1", intensity: 1, counted: 0.25, beside: "code",
  };
}

function addressOf(state) {
  const parts = ["v=1", `by=${state.by}`, `m=${encodeURIComponent(state.record)}`, `d=${state.beside}`];
  for (const [key, [, , letters]] of Object.entries(LIMITS)) {
    const value = LISTS.includes(key) ? state[key].slice(0, state.storeys).join(",") : state[key];
    parts.push(`${letters}=${value}`);
  }
  return parts.join("&");
}

// What an address says over the default case; what it says wrong is left out and returned as remarks.
function caseOf(address) {
  const state = defaultCase();
  const remarks = [];
  const parts = address.replace(/^#/, "").split("&").filter(Boolean).map((part) => part.split("="));
  const said = new Map(parts.map(([key, ...value]) => [key, value.join("=")]));
  for (const [key, [low, high, letters, words]] of Object.entries(LIMITS)) {
    if (!said.has(letters)) continue;
    const written = said.get(letters).split(",");
    const isList = LISTS.includes(key);
    const numbers = written.map((text) => (text.trim() === "" ? NaN : Number(text)));
    const fits = numbers.every((number) => number >= low && number <= high);
    const counts = isList ? numbers.length <= MOST_STOREYS : numbers.length === 1;
    if (!fits || !counts || (key === "storeys" && !Number.isInteger(numbers[0]))) {
      remarks.push(`${words} in the address must be from ${low} to ${high}; got ${written.join(",").slice(0, 40)}`);
    } else if (isList) {
      // One number of friction stands for all floors.
      const isForAll = numbers.length === 1 && (key === "muS" || key === "muK");
      if (isForAll) state[key].fill(numbers[0]);
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
  return {
    storeys: state.storeys, period: state.period, damping: state.damping, overstrength: state.overstrength,
    secondSlope: state.secondSlope, thirdSlope: 0, strength,
    massRatio: first(state.massRatio), muS: first(state.muS), muK: first(state.muK),
  };
}

// A scene file for `seismass run`, to the last bit of what the page solves.
function sceneFile(scene, { height, record, scale, note }) {
  const list = (values) => `[${Array.from(values, String).join(", ")}]`;
  const lines = [
    `name = ${JSON.stringify(`${scene.storeys} ${scene.storeys === 1 ? "storey" : "storeys"}, T = ${scene.period} s`)}`,
    `note = ${JSON.stringify(note)}`,
    "",
    "[building]",
    `storeys = ${scene.storeys}`,
    `period = ${scene.period} # s, without the goods`,
    `damping = ${scene.damping}`,
    `overstrength = ${scene.overstrength}`,
    `second_slope = ${scene.secondSlope}`,
    `third_slope = ${scene.thirdSlope}`,
    `heights = ${height} # m`,
  ];
  if (scene.strength.every(Number.isFinite)) lines.push(`yield_shear_over_weight = ${list(scene.strength)}`);
  scene.massRatio.forEach((ratio, i) => {
    if (ratio === 0) return;
    lines.push("", "[[blocks]]", `floor = ${i + 1}`, `mass_ratio = ${ratio}`, `mu_s = ${scene.muS[i]}`, `mu_k = ${scene.muK[i]}`);
  });
  lines.push("", "[motion]", `# ${record.name.replace(/[\x00-\x1f\x7f]/g, " ")}`, `dt = ${record.dt}`);
  lines.push(`unit = "${record.unit}"`, `scale = ${scale}`, "acceleration = [");
  for (let i = 0; i < record.values.length; i += 8) lines.push(`  ${Array.from(record.values.slice(i, i + 8), String).join(", ")},`);
  return `${[...lines, "]"].join("\n")}\n`;
}
