// Solves what standard input asks for with the kernel of the live page, in Node: node solve.js KERNEL TEMPLATES < asked.json.
// `asked` has runs (scene, share, every, motion), effective fractions (scene, motions, resamples), designs, records and
// addresses; each gives its results in the same order, runs as the SHA-256 of their numbers.
"use strict";
const { createHash } = require("node:crypto");
const { readFileSync } = require("node:fs");
const { join } = require("node:path");
const vm = require("node:vm");

const [, , file, templates] = process.argv;
const read = (name) => readFileSync(join(templates, name), "utf8");
const names = ["factsOf", "TOLD", "raceWords", "fileWords", "openKernel", "readRecord", "caseOf", "addressOf", "sceneOf", "sceneFile", "defaultCase"];
const source = `${["kernel.js", "record.js", "case.js", "views.js", "stories.js"].map(read).join("\n")}\n({ ${names.join(", ")} })`;
const page = vm.runInThisContext(source);
const kernel = page.openKernel(new WebAssembly.Instance(new WebAssembly.Module(readFileSync(file)), {}));
const asked = JSON.parse(readFileSync(0, "utf8"));
const motions = (asked.motions || []).map(({ dt, samples }) => ({ dt, samples: Float64Array.from(samples) }));
const finite = (_, value) => (typeof value === "number" && !Number.isFinite(value) ? String(value) : ArrayBuffer.isView(value) ? Array.from(value) : value);
const numbers = (scene) => ({ ...scene, strength: scene.strength.map(Number) });

function attempted(work) {
  try {
    return work();
  } catch (error) {
    return { error: error.message };
  }
}
const answers = {
  runs: (asked.runs || []).map(({ scene, share, every, motion }) =>
    attempted(() => {
      kernel.setMotion(motions[motion].dt, motions[motion].samples);
      const hash = createHash("sha256");
      const found = kernel.run(numbers(scene), share, every);
      for (const list of Object.values(found)) hash.update(Buffer.from(list.buffer, list.byteOffset, list.byteLength));
      return { hash: hash.digest("hex"), events: found.events.length / 4 };
    }),
  ),
  designs: (asked.designs || []).map(({ scene, counted, suite }) =>
    attempted(() => {
      kernel.setSuite(suite.map((i) => motions[i]), []);
      return kernel.design(scene, counted);
    }),
  ),
  effective: (asked.effective || []).map(({ scene, suite, resamples }) =>
    attempted(() => {
      kernel.setSuite(suite.map((i) => motions[i]), resamples);
      kernel.beginEffective(numbers(scene));
      while (kernel.solveEffective(30) > 0);
      return kernel.answerEffective();
    }),
  ),
  records: (asked.records || []).map(({ text, stated }) =>
    attempted(() => {
      const { dt, unit, samples } = page.readRecord(text, "file", stated || {});
      return { dt, unit, samples: createHash("sha256").update(Buffer.from(samples.buffer)).digest("hex") };
    }),
  ),
  told: (asked.told || []).map(({ found, state }) => {
    const facts = page.factsOf(found, state);
    return { facts, words: Object.fromEntries(Object.entries(page.TOLD).map(([name, told]) => [name, told(facts)])) };
  }),
  races: (asked.races || []).map(([race, motion]) => page.raceWords(race, motion)),
  files: (asked.files || []).map(([file, found, isSame]) => page.fileWords(file, found, isSame)),
  addresses: (asked.addresses || []).map((address) => {
    const { state, remarks } = page.caseOf(address);
    return { state, remarks, again: page.addressOf(state) };
  }),
};
process.stdout.write(JSON.stringify(answers, finite));
