// What the worker does: it seeks effective fractions, and leaves one unfinished where another case arrives. The page makes
// it of the text of this function and of openKernel.
function effectiveWorker() {
  const SHARES_AT_ONCE = 4;
  let kernel = null;
  let wanted = null;

  function step(number, scene) {
    if (wanted !== number) return;
    try {
      const left = kernel.solveEffective(SHARES_AT_ONCE);
      if (left > 0) {
        postMessage({ number, left });
        setTimeout(step, 0, number, scene);
      } else {
        postMessage({ number, found: kernel.answerEffective() });
      }
    } catch (error) {
      postMessage({ number, error: error.message });
    }
  }
  onmessage = ({ data }) => {
    if (data.module !== undefined) {
      kernel = openKernel(new WebAssembly.Instance(data.module, {}));
      return;
    }
    wanted = data.number;
    if (data.scene === undefined) return;
    try {
      kernel.setSuite(data.motions, data.resamples);
      postMessage({ number: data.number, begun: kernel.beginEffective(data.scene) });
      setTimeout(step, 0, data.number, data.scene);
    } catch (error) {
      postMessage({ number: data.number, error: error.message });
    }
  };
}
