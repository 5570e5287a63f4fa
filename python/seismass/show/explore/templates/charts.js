// Drawing on canvases: axes with round numbers, lines, marks and words, in the colours of the page.
function chartOf(canvas, colours) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.lineJoin = "round";

  function text(words, x, y, { size = 12, colour = colours.ink, align = "left", weight = "", fit = 0, turn = false } = {}) {
    context.save();
    context.fillStyle = colour;
    context.textAlign = align;
    context.font = `${weight} ${size}px system-ui, "DejaVu Sans", sans-serif`.trim();
    context.translate(x, y);
    if (turn) context.rotate(-Math.PI / 2);
    context.fillText(words, 0, 0, fit || undefined);
    context.restore();
  }
  const measure = (words, size = 12) => {
    context.font = `${size}px system-ui, "DejaVu Sans", sans-serif`;
    return context.measureText(words).width;
  };

  // Round numbers from low to high, some `count` of them.
  function ticks([low, high], count) {
    const rough = (high - low) / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find((one) => one * power >= rough * 0.999) * power;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const found = [];
    for (let i = Math.ceil(low / step - 1e-9); i <= high / step + 1e-9; i++) {
      found.push([i * step, (i * step).toFixed(digits).replace(/^-(?=[0.]*$)/, "").replace("-", "\u2212")]);
    }
    return found;
  }

  // A panel with axes; values are drawn inside it.
  function panel(box, xs, ys, { xTitle = "", yTitle = "", xCount = 5, yCount = 4, xTicks, yTicks, title = "" } = {}) {
    const { left, top, right, bottom } = box;
    const x = (value) => left + ((value - xs[0]) / (xs[1] - xs[0])) * (right - left);
    const y = (value) => bottom - ((value - ys[0]) / (ys[1] - ys[0])) * (bottom - top);
    context.lineWidth = 1;
    context.strokeStyle = colours.line;
    for (const [value, words] of yTicks || ticks(ys, yCount)) {
      stroke([[left, y(value)], [right, y(value)]]);
      text(words, left - 5, y(value) + 4, { size: 11, colour: colours.soft, align: "right" });
    }
    for (const [value, words] of xTicks || ticks(xs, xCount)) {
      stroke([[x(value), bottom], [x(value), bottom + 4]]);
      text(words, x(value), bottom + 16, { size: 11, colour: colours.soft, align: "center" });
    }
    stroke([[left, bottom], [right, bottom]]);
    if (xTitle) text(xTitle, (left + right) / 2, bottom + 32, { align: "center", fit: right - left + 30 });
    if (yTitle) text(yTitle, 13, (top + bottom) / 2, { align: "center", turn: true, fit: bottom - top + 30 });
    if (title) text(title, left + 4, top - 6, { size: 12, fit: right - left });
    const clipped = (draw) => {
      context.save();
      context.beginPath();
      context.rect(left - 1, top - 1, right - left + 2, bottom - top + 2);
      context.clip();
      draw();
      context.restore();
    };
    return {
      x, y, clipped,
      line: (points, options) => clipped(() => stroke(points.map(([a, b]) => [x(a), y(b)]), options)),
      area: (low, high, colour, opacity) => clipped(() => {
        context.globalAlpha = opacity;
        context.fillStyle = colour;
        context.beginPath();
        for (const [a, b] of [...low, ...high.toReversed()]) context.lineTo(x(a), y(b));
        context.fill();
      }),
      dot: (a, b, colour, size = 4, hollow = false) => {
        context.beginPath();
        context.arc(x(a), y(b), size, 0, 2 * Math.PI);
        context.fillStyle = hollow ? colours.paper : colour;
        context.fill();
        context.strokeStyle = colour;
        context.lineWidth = 1.5;
        context.stroke();
      },
    };
  }
  function stroke(points, { colour, width: thick = 1, dash = [] } = {}) {
    if (colour) context.strokeStyle = colour;
    context.lineWidth = thick;
    context.setLineDash(dash);
    context.beginPath();
    for (const [a, b] of points) context.lineTo(a, b);
    context.stroke();
    context.setLineDash([]);
  }
  // Lines with their names, from left to right, in as many rows as they need; returns where the next row would stand.
  function key(entries, left, top, right) {
    let [x, y] = [left, top];
    for (const { words, colour, dash = [], thick = 2, fill = 0 } of entries) {
      const needed = 28 + measure(words, 11) + 14;
      if (x + needed > right && x > left) [x, y] = [left, y + 16];
      if (fill) {
        context.globalAlpha = fill;
        context.fillStyle = colour;
        context.fillRect(x, y - 9, 22, 10);
        context.globalAlpha = 1;
      } else {
        stroke([[x, y - 4], [x + 22, y - 4]], { colour, width: thick, dash });
      }
      text(words, x + 27, y, { size: 11, colour: colours.soft });
      x += needed;
    }
    return y + 16;
  }
  return { context, width, height, text, panel, stroke, key };
}
