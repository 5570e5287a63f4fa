// The compiled kernel behind functions that take and give numbers; no page, so that a worker and Node have it too.
function openKernel(instance) {
  const calls = instance.exports;
  const RUN = [
    "end", "peakDrift", "peakDriftTime", "peakSlip", "peakSlipTime", "peakAcceleration", "peakAccelerationTime",
    "peakShear", "peakShearTime", "residualDrift", "residualSlip", "slipPath", "counts", "events",
    "drift", "slip", "force",
  ];
  const ANSWER = [
    "answer", "roots", "shares", "model", "ratioLow", "ratioHigh", "realByStorey", "modelByStorey", "bareByStorey",
    "fullByStorey", "slides", "realDrift", "firstRoot", "lastRoot",
  ];

  function give(numbers) {
    // The memory may move when room is made in it.
    const place = calls.seismass_input(numbers.length);
    new Float64Array(calls.memory.buffer, place, numbers.length).set(numbers);
  }
  const output = () =>
    new Float64Array(calls.memory.buffer, calls.seismass_output(), calls.seismass_output_length()).slice();
  function checked(failed) {
    if (failed === 0) return;
    const words = new Uint8Array(calls.memory.buffer, calls.seismass_message(), calls.seismass_message_length());
    throw new Error(new TextDecoder().decode(words.slice()));
  }
  function named(names) {
    const numbers = output();
    let place = 1 + numbers[0];
    return Object.fromEntries(
      names.map((name, i) => {
        const list = numbers.subarray(place, place + numbers[1 + i]);
        place += numbers[1 + i];
        return [name, list];
      }),
    );
  }
  // Mean peak base shear of the fully attached model over the full weight, and friction over it.
  const shearOf = ([coefficient, eta]) => ({ coefficient, eta });
  const listed = (scene) => [
    scene.storeys, scene.period, scene.damping, scene.pDelta, ...scene.strength, ...scene.massRatio, ...scene.muS, ...scene.muK,
    ...scene.floorMass, ...scene.stiffness, ...scene.height, ...scene.overstrength, ...scene.secondSlope, ...scene.thirdSlope,
  ];

  return {
    // Samples in m/s2 at a step in s.
    setMotion(dt, samples) {
      const numbers = new Float64Array(1 + samples.length);
      numbers[0] = dt;
      numbers.set(samples, 1);
      give(numbers);
      checked(calls.seismass_motion());
    },
    // Motions as {dt, samples}; counts of each motion in each resample, resample by resample.
    setSuite(motions, resamples) {
      calls.seismass_suite_clear();
      for (const { dt, samples } of motions) {
        give([dt, ...samples]);
        checked(calls.seismass_suite_motion());
      }
      give(resamples);
      calls.seismass_resamples();
    },
    // Goods slide where the share attached is null. Lists of histories are row by row.
    run(scene, share, every) {
      give(listed(scene));
      checked(calls.seismass_run(share === null ? -1 : share, every));
      return named(RUN);
    },
    // V_e/W of each storey, of a response spectrum analysis with a share of the goods counted, for the mean spectrum of the
    // suite; strengths of the scene do not count.
    design(scene, counted) {
      give(listed({ ...scene, strength: scene.massRatio.map(() => 1) }));
      checked(calls.seismass_design(counted));
      return Array.from(output());
    },
    // N/m, where the mean floor mass is 1 kg.
    stiffness(scene) {
      give(listed(scene));
      checked(calls.seismass_stiffness());
      return Array.from(output());
    },
    beginEffective(scene) {
      give(listed(scene));
      checked(calls.seismass_effective_begin());
      return shearOf(output());
    },
    // Solves some shares; returns how many are left.
    solveEffective(shares) {
      checked(calls.seismass_effective_solve(shares));
      return output()[0];
    },
    answerEffective() {
      checked(calls.seismass_effective_answer());
      const { answer, ...lists } = named(ANSWER);
      const [kind, value, low, high, real, model, ...shear] = answer;
      const KINDS = ["stuck", "root", "multiple", "zero", "one"];
      return { kind: KINDS[kind], value, low, high, realMean: real, modelMean: model, ...shearOf(shear), ...lists };
    },
  };
}
