// Records from text: PEER .AT2 files and columns of text, read as `seismass.read_record` reads them. What cannot be read
// without a guess is refused with its reason.
const GRAVITY = 9.80665; // m/s2, standard
const UNITS = { g: GRAVITY, "m/s2": 1, "cm/s2": 0.01 };

function readRecord(text, name, stated = {}) {
  const lines = text.split(/\r\n|\r|\n/);
  const refuse = (what, must, got) => {
    throw new Error(`${what} of ${name} must be ${must}; got ${got}`);
  };
  const NUMBER = /^[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d+)?$/;
  const FIELD = /[+-]?\d*\.\d+(?:[EeDd][+-]\d\d)?/y;
  const valueOf = (token) => Number(token.replace(/[Dd]/, "E"));

  // Fields of fixed width that touch, such as "-.24E-03-.23E-03"; null where it is no run of those.
  function touching(token) {
    const fields = [];
    FIELD.lastIndex = 0;
    while (FIELD.lastIndex < token.length) {
      const at = FIELD.lastIndex;
      const match = FIELD.exec(token);
      if (match === null || (at > 0 && !"+-".includes(token[at]) && !/[EeDd]/.test(fields.at(-1)))) return null;
      fields.push(match[0]);
    }
    return fields;
  }
  function tokensOf(line, number) {
    return line.trim().split(/[\s,;]+/).filter(Boolean).flatMap((token) => {
      if (NUMBER.test(token)) return [token];
      const fields = touching(token);
      if (fields === null || fields.length === 0) refuse(`line ${number}`, "numbers", `"${token.slice(0, 40)}"`);
      return fields;
    });
  }
  function unitOf(header) {
    const found = new Set();
    if (/\b(?:cm|centimet\w+)[ \t]*\/[ \t]*s(?:ec)?|\bgals?\b/i.test(header)) found.add("cm/s2");
    if (/(?:^|[^a-z])m[ \t]*\/[ \t]*s(?:ec)?/i.test(header)) found.add("m/s2");
    if (/\bunits?[ \t]*(?:of\b|[:=])[ \t]*[([]?[ \t]*g(?:'s|ravity)?(?!\w)|[([][ \t]*g(?:'s)?[ \t]*[)\]]|\bacc[a-z.]*[ \t]+in[ \t]+g(?:'s)?(?!\w)/i.test(header)) found.add("g");
    if (found.size > 1) refuse("unit", "one", [...found].join(" and "));
    return [...found][0];
  }
  function finished(values, dt, unit, title) {
    if (!(dt >= 1e-5 && dt <= 1)) refuse("step", "between 0.00001 and 1 s", `${dt} s`);
    if (values.some((value) => !Number.isFinite(value))) refuse("numbers", "finite", "another");
    if (values.every((value) => value === 0)) refuse("acceleration", "other than zero somewhere", "zero throughout");
    return { name, title, dt, unit, values, samples: Float64Array.from(values, (value) => value * UNITS[unit]) };
  }
  function refuseOther(header) {
    const other = /(?<![a-z])(?<!wave[ -])(velocity|velocities|displacements?)(?![a-z])/i.exec(header);
    if (other !== null && !/acc(?:el|\b)/i.test(header)) refuse("quantity", "acceleration", other[1].toLowerCase());
  }

  // Four header lines, of which one has NPTS and DT, then any number of values in a line.
  function at2(index, points, step, stepUnit) {
    const header = lines.slice(0, index).join("\n");
    refuseOther(header);
    const unit = unitOf(header) || "g";
    const perSecond = /^(?:ms|msec)/i.test(stepUnit || "") ? 1000 : 1;
    const tokens = lines.slice(index + 1).flatMap((line, i) => tokensOf(line, index + 2 + i));
    if (tokens.length < points) refuse("points", `${points}, as its header says`, `${tokens.length}: the file is cut off`);
    const values = tokens.map(valueOf);
    if (values.slice(points).some((value) => value !== 0)) refuse("points", `${points}, as its header says`, tokens.length);
    if (points === 0) refuse("points", "at least 1", 0);
    return finished(values.slice(0, points), step / perSecond, unit, (lines[1] || "").trim());
  }
  // Formats that `seismass.read_record` reads and this page does not, by words of their first lines.
  const top = lines.slice(0, 14).join("\n");
  const kind = [
    ["CSMIP, volume 1 to 3", /(?:un)?corrected accelerogram data|processed data, chan|CSMIP/i],
    ["COSMOS", /COSMOS|Format v\d+\.\d+/i],
    ["K-NET or KiK-net", /^Origin Time\b[\s\S]*^Scale Factor|^Station Code/m],
    ["SMC", /^\s*[12]?\s*(?:UN)?CORRECTED ACCELEROGRAM/],
    ["ESM (Engineering Strong-Motion)", /^EVENT_NAME\s*:/m],
    ["GeoNet", /GeoNet|^Accelerogram\b/m],
  ].find(([, words]) => words.test(top));

  for (const [index, line] of lines.slice(0, 10).entries()) {
    const found =
      /NPTS\s*[=:]?\s*(\d{1,9})[.,;\s]*DT\s*[=:]?\s*([\d.]+(?:E[+-]?\d+)?)\s*([A-Z/][^\s,;]*)?/i.exec(line) ||
      /^\s*(\d{1,9})[,\s]+([\d.]+(?:E[+-]?\d+)?)[,\s]+()NPTS\s*,?\s*DT/i.exec(line);
    if (found !== null && NUMBER.test(found[2])) return at2(index, Number(found[1]), Number(found[2]), found[3]);
  }

  if (kind !== undefined) {
    throw new Error(
      `${name} seems to be a file of ${kind[0]}; this page reads PEER .AT2 and one or two columns of numbers. ` +
        "\u201cseismass records FILE\u201d reads it, and seismass.read_record in Python.",
    );
  }
  // One column of accelerations, or time and acceleration; header lines and comments are not numbers.
  const rows = [];
  const header = [];
  lines.forEach((line, i) => {
    if (line.trim() === "") return;
    const words = line.trim().split(/[\s,;]+/).filter(Boolean);
    const isText = /^\s*(?:#|%|\/\/|!)/.test(line) || (rows.length === 0 && !words.every((word) => NUMBER.test(word)));
    if (isText) header.push(line.trim());
    else rows.push(tokensOf(line, i + 1));
  });
  const headed = header.join("\n");
  if (rows.length < 2) refuse("content", "lines of one or two numbers", rows.length === 0 ? "no numbers" : "one line");
  refuseOther(headed);
  const columns = rows.at(-1).length;
  if (columns > 2 || rows.some((row) => row.length !== columns)) {
    refuse("content", "lines of one or of two numbers", `lines of ${[...new Set(rows.map((row) => row.length))].join(" and ")}`);
  }
  const unit = unitOf(headed) || stated.unit; // what the file says goes before what is stated
  if (unit === undefined) refuse("unit", "given (g, m/s2, cm/s2), the file states none", "none");
  const step = /\b(?:dt|delta[ \t]*t|time[ \t]*step)\b[^=:\n]{0,30}[=:][ \t]*([\d.]+(?:E[+-]?\d+)?)/i.exec(headed);
  let dt = step === null ? stated.dt : Number(step[1]);
  if (columns === 2) {
    const times = rows.map((row) => valueOf(row[0]));
    const span = times.at(-1) - times[0];
    const even = span / (times.length - 1);
    if (!(even > 0)) refuse("times", "increasing", `${times[0]} s first, ${times.at(-1)} s last`);
    const off = times.findIndex((time, i) => Math.abs(time - times[0] - even * i) > 0.05 * even + 1e-9 * span);
    if (off >= 0) refuse("times", `uniform, here ${even.toPrecision(6)} s apart`, `${times[off]} s in row ${off + 1}`);
    // The shortest step that gives every time back to its last digit: 0.01, not 0.010000000000000002.
    const digit = Math.min(...rows.slice(1).map((row) => 10 ** -(row[0].split(/[EeDd]/)[0].split(".")[1] || "").length));
    for (let digits = 1; digits < 17; digits++) {
      dt = Number(even.toPrecision(digits));
      if (times.every((time, i) => Math.abs(time - times[0] - dt * i) <= 0.5 * digit + 1e-12 * span)) break;
    }
  }
  if (dt === undefined) refuse("step", "given, the file has no times and states none", "none");
  return finished(rows.map((row) => valueOf(row.at(-1))), dt, unit, header[0] || "");
}
