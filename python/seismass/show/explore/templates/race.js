// Models with the shares of codes around the building whose goods slide, at one time of their runs: `entrants` have a name, a
// share and a run, `real` is a run; drifts are those of storey `counter`. Drawn on the page, in a picture and in a film alike.
function raceOf({ real, entrants, heights, masses, step, counter }) {
  const n = heights.length;
  const largestOf = (run) => {
    const largest = new Float32Array(run.rows);
    for (let row = 0; row < run.rows; row++) largest[row] = Math.max(row ? largest[row - 1] : 0, Math.abs(run.drift[row * n + counter]));
    return largest;
  };
  const all = [{ name: "goods slide", share: null, run: real }, ...entrants].map((one) => ({ ...one, largest: largestOf(one.run) }));
  const [own, ...others] = all;
  // What collapses has no drift to compare.
  const distance = ({ run }) => (real.end[1] > 0 || run.end[1] > 0 ? Infinity : Math.abs(run.peakDrift[counter] - real.peakDrift[counter]));
  const nearest = others.reduce((best, one) => (distance(one) < distance(best) ? one : best));
  let farthest = 1e-9;
  for (const { run } of all) {
    for (let row = 0; row < run.rows; row++) {
      let at = 0;
      for (let i = 0; i < n; i++) farthest = Math.max(farthest, Math.abs((at += run.drift[row * n + i])));
    }
  }
  const most = Math.max(...all.map(({ run }) => run.peakDrift[counter]), 1e-9);
  return { own, others, nearest: distance(nearest) < Infinity ? nearest : null, heights, masses, step, counter, farthest, most };
}

function drawRace(context, { left = 0, top = 0, width, height }, race, time, colours) {
  const { own, others, nearest, heights, masses, step, farthest, most } = race;
  const n = heights.length;
  const total = heights.reduce((sum, one) => sum + one, 0);
  const rowOf = (run) => Math.min(Math.max(Math.round(time / step), 0), run.rows - 1);
  const words = (text, x, y, { size = 12, colour = colours.ink, weight = "", fit } = {}) => {
    context.font = `${weight} ${size}px system-ui, "DejaVu Sans", sans-serif`.trim();
    context.fillStyle = colour;
    context.textAlign = "center";
    context.fillText(text, x, y, fit);
  };
  function frame({ name, share, run, largest }, box) {
    const colour = share === null ? colours.slide : share === 0 ? colours.bare : share === 1 ? colours.attached : colours.code;
    const row = rowOf(run);
    const isNearest = nearest !== null && share === nearest.share;
    const [head, foot, side] = [34, 20, 14];
    const middle = box.left + (box.width - side) / 2;
    context.lineWidth = isNearest ? 3 : 1;
    context.strokeStyle = isNearest ? colours.ink : colours.line;
    context.strokeRect(box.left + 2, box.top + 2, box.width - 4, box.height - 4);
    const centre = box.left + box.width / 2;
    words(share === null ? "goods slide" : `${Math.round(100 * share)} %`, centre, box.top + 17, { size: 13, weight: "600", colour, fit: box.width - 10 });
    words(share === null ? "as they are" : name, centre, box.top + 31, { size: 11, colour: colours.soft, fit: box.width - 10 });
    const scale = (box.height - head - foot - 12) / (total + (masses[n - 1] > 0 ? 0.5 * heights[n - 1] : 0.15 * heights[n - 1]));
    const half = Math.min(0.3 * (box.width - side), 0.5 * total * scale);
    const enlarged = Math.min((0.5 * (box.width - side) - half - 8) / farthest, 40 * scale);
    let [x, y] = [middle, box.top + box.height - foot - 6];
    const base = y;
    let block = 0;
    for (let i = 0; i < n; i++) {
      const [nextX, nextY] = [x + enlarged * run.drift[row * n + i], y - heights[i] * scale];
      context.strokeStyle = colour;
      context.lineWidth = 2;
      for (const way of [-0.9, 0.9]) {
        context.beginPath();
        context.moveTo(x + way * half, y);
        context.bezierCurveTo(x + way * half, (y + nextY) / 2, nextX + way * half, (y + nextY) / 2, nextX + way * half, nextY);
        context.stroke();
      }
      [x, y] = [nextX, nextY];
      context.fillStyle = colours.soft;
      context.fillRect(x - half, y, 2 * half, 3);
      if (masses[i] === 0) continue;
      const size = Math.sqrt(masses[i] / Math.max(...masses));
      const [wide, high] = [half * size, Math.min(0.45 * heights[Math.min(i + 1, n - 1)] * scale, half) * size];
      const slid = share === null ? enlarged * run.slip[row * run.blocks.length + block] : 0;
      block += 1;
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 1.2;
      context.setLineDash(share === null ? [] : [3, 2]);
      context.strokeRect(x - wide / 2 + slid, y - high, wide, high);
      context.setLineDash([]);
      const filled = share === null ? 1 : share;
      context.globalAlpha = share === null ? 0.55 : 1;
      context.fillRect(x - wide / 2 + slid, y - filled * high, wide, filled * high);
      context.globalAlpha = 1;
    }
    // The bar of its drift so far, with that of the building as a line across.
    const bar = box.left + box.width - side - 2;
    const room = base - box.top - head;
    const at = (value) => base - (value / most) * room;
    context.fillStyle = colours.line;
    context.fillRect(bar, base - room, 8, room);
    context.fillStyle = colour;
    context.fillRect(bar, at(largest[row]), 8, base - at(largest[row]));
    const reference = own.largest[rowOf(own.run)];
    context.fillStyle = colours.ink;
    context.fillRect(bar - 3, at(reference) - 1, 14, 2);
    const apart = reference > 0 ? Math.round(100 * (largest[row] / reference - 1)) : 0;
    const percent = ((100 * largest[row]) / heights[race.counter]).toFixed(2);
    const isDown = run.end[1] > 0 && row === run.rows - 1;
    words(isDown ? `storey ${run.end[1]} collapses` : share === null ? `${percent} % of ${heights[race.counter]} m` : `${apart < 0 ? "\u2212" : apart > 0 ? "+" : ""}${Math.abs(apart)} %`, centre, box.top + box.height - 8, { size: 12, fit: box.width - 10 });
  }
  if (width < 600) {
    frame(own, { left, top, width, height: 0.55 * height });
    const each = width / others.length;
    others.forEach((one, i) => frame(one, { left: left + i * each, top: top + 0.56 * height, width: each, height: 0.44 * height }));
    return;
  }
  const each = width / (others.length + 1.8);
  let x = left;
  const half = Math.floor(others.length / 2);
  for (const one of [...others.slice(0, half), own, ...others.slice(half)]) {
    const wide = one === own ? 1.8 * each : each;
    const box = one === own ? { left: x, top, width: wide, height } : { left: x, top: top + 0.14 * height, width: wide, height: 0.86 * height };
    frame(one, box);
    x += wide;
  }
}

// A picture with the answer, the case and the race, as it is saved and filmed.
function drawCard(canvas, { title, sentence, winner, race, time, colours }) {
  const context = canvas.getContext("2d");
  const { width, height } = canvas;
  context.fillStyle = colours.paper;
  context.fillRect(0, 0, width, height);
  context.textAlign = "left";
  let y = 38;
  for (const [words, size, colour] of [[title, 26, colours.ink], [sentence, 15, colours.soft], [winner, 15, colours.ink]]) {
    context.font = `${size > 20 ? "600 " : ""}${size}px system-ui, "DejaVu Sans", sans-serif`;
    context.fillStyle = colour;
    let line = "";
    for (const word of words.split(/\s+/)) {
      if (context.measureText(`${line} ${word}`).width > width - 40 && line) {
        context.fillText(line, 20, y);
        [line, y] = [word, y + 1.3 * size];
      } else line = line ? `${line} ${word}` : word;
    }
    context.fillText(line, 20, y);
    y += 26;
  }
  drawRace(context, { left: 16, top: y - 10, width: width - 32, height: height - y - 22 }, race, time, colours);
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.textAlign = "right";
  context.fillStyle = colours.soft;
  context.fillText(`${time.toFixed(1)} s, seismass`, width - 20, height - 8);
}

// Seconds of a canvas as a film: WebM, or MP4 where a browser makes no other.
function filmOf(canvas, seconds, draw) {
  const type = typeof MediaRecorder === "undefined" ? undefined : ["video/webm;codecs=vp9", "video/webm", "video/mp4"].find((one) => MediaRecorder.isTypeSupported(one));
  if (type === undefined) return Promise.reject(new Error("this browser makes no films"));
  draw(0);
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 3e6 });
  const parts = [];
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  return new Promise((done, failed) => {
    recorder.addEventListener("stop", () => done(new Blob(parts, { type: type.split(";")[0] })));
    recorder.addEventListener("error", ({ error }) => failed(error));
    recorder.start();
    const begin = performance.now();
    const frame = (now) => {
      const at = Math.max(0, (now - begin) / 1000);
      draw(Math.min(at, seconds));
      if (at < seconds) requestAnimationFrame(frame);
      else recorder.stop();
    };
    requestAnimationFrame(frame);
  });
}
