// Solves what standard input asks for with the kernel of the live page, in Node: node solve.js KERNEL TEMPLATES < asked.json.
// `asked` has runs (scene, share, every, motion), effective fractions (scene, motions, resamples, and where
// sentences are to be made of them the state of the page), designs, records, addresses and answers of building files; each gives its results in the same order, runs as the SHA-256 of their numbers.
"use strict";
const { createHash } = require("node:crypto");
const { readFileSync } = require("node:fs");
const { join } = require("node:path");
const vm = require("node:vm");

const [, , file, templates] = process.argv;
const read = (name) => readFileSync(join(templates, name), "utf8");
const names = ["factsOf", "TOLD", "fileWords", "openKernel", "readRecord", "caseOf", "addressOf", "sceneOf", "sceneFile", "defaultCase"];
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
  effective: (asked.effective || []).map(({ scene, suite, resamples, told }) =>
    attempted(() => {
      kernel.setSuite(suite.map((i) => motions[i]), resamples);
      kernel.beginEffective(numbers(scene));
      while (kernel.solveEffective(30) > 0);
      const found = kernel.answerEffective();
      const say = (facts) => Object.fromEntries(Object.entries(page.TOLD).map(([name, words]) => [name, words(facts)]));
      return told === undefined ? found : { ...found, told: say(page.factsOf(found, told)) };
    }),
  ),
  records: (asked.records || []).map(({ text, stated }) =>
    attempted(() => {
      const { dt, unit, samples } = page.readRecord(text, "file", stated || {});
      return { dt, unit, samples: createHash("sha256").update(Buffer.from(samples.buffer)).digest("hex") };
    }),
  ),
  files: (asked.files || []).map((file) => page.fileWords(...file)),
  addresses: (asked.addresses || []).map((address) => {
    const { state, remarks } = page.caseOf(address);
    return { state, remarks, again: page.addressOf(state) };
  }),
};
process.stdout.write(JSON.stringify(answers, finite));
