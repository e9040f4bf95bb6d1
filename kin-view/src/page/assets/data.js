// The data of the page: columns of numbers over time, and where tracks stand at a time.

const svgElement = (name, className, parent) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  if (className) element.setAttribute("class", className);
  if (parent) parent.appendChild(element);
  return element;
};

// A column: base64 of variable-length integers. 0 is a gap; else the second difference, zigzag, plus one; a gap starts anew.
const column = ({ o: offset, s: step, d: text }, n) => {
  const bytes = atob(text), values = new Float64Array(n);
  let at = 0, last = 0, slope = 0, known = 0;
  for (let k = 0; k < n; k++) {
    let code = 0, factor = 1, byte;
    do {
      byte = bytes.charCodeAt(at++);
      code += (byte & 127) * factor;
      factor *= 128;
    } while (byte & 128);
    if (code === 0) {
      values[k] = NaN;
      last = slope = known = 0;
      continue;
    }
    code -= 1;
    const change = code % 2 ? -(code + 1) / 2 : code / 2;
    slope = known > 1 ? slope + change : known === 1 ? change : 0;
    last = known ? last + slope : change;
    known += 1;
    values[k] = offset + step * last;
  }
  return values;
};

// Between two frames everything goes straight; beside a gap there is nothing.
const between = (values, index) => {
  const k = Math.floor(index), share = index - k;
  return share === 0 ? values[k] : values[k] + share * (values[k + 1] - values[k]);
};

// Between two frames that are far apart there is no way that could be drawn: the nearer one is shown.
const shownAt = (data, index) => (data.leaps && data.leaps[Math.floor(index)] > 0.5 ? Math.round(index) : index);

// Position and rotation (row by row) of a track at a frame, whole or between two.
const frameOf = (track, index) => {
  const at = track.columns.map((values) => between(values, index));
  if (track.kind === "planar") {
    const sin = Math.sin(at[2]), cos = Math.cos(at[2]);
    return { r: [at[0], at[1], 0], a: [cos, -sin, 0, sin, cos, 0, 0, 0, 1] };
  }
  if (track.kind === "spatial") {
    const norm = Math.hypot(at[3], at[4], at[5], at[6]), [e0, x, y, z] = at.slice(3).map((e) => e / norm);
    const d = 2 * e0 * e0 - 1;
    return {
      r: at.slice(0, 3),
      a: [d + 2 * x * x, 2 * (x * y - e0 * z), 2 * (x * z + e0 * y), 2 * (x * y + e0 * z), d + 2 * y * y, 2 * (y * z - e0 * x),
        2 * (x * z - e0 * y), 2 * (y * z + e0 * x), d + 2 * z * z],
    };
  }
  return { r: track.kind === "point" ? at : [0, 0, 0], a: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
};

const pointOf = ({ r, a }, [x, y, z]) => [
  r[0] + a[0] * x + a[1] * y + a[2] * z, r[1] + a[3] * x + a[4] * y + a[5] * z, r[2] + a[6] * x + a[7] * y + a[8] * z,
];

// The data as it stands in the page, columns unpacked.
const load = () => {
  const data = JSON.parse(document.getElementById("data").textContent), n = data.frames;
  data.times = column(data.times, n);
  if (data.leaps) data.leaps = column(data.leaps, n);
  for (const track of data.tracks) track.columns = track.columns.map((packed) => column(packed, n));
  for (const push of data.pushes) push.columns = push.columns.map((packed) => column(packed, n));
  for (const chart of data.charts) for (const series of chart.series) series.values = column(series.values, n);
  for (const trace of data.traces) {
    trace.path = Array.from({ length: n }, (_, k) => pointOf(frameOf(data.tracks[trace.track], k), trace.local));
  }
  return data;
};

// A number as people write it: as many digits as tell it from its neighbours.
const text = (x, digits = 4) => {
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  return (size !== 0 && (size < 1e-3 || size >= 1e6) ? x.toExponential(digits - 1) : String(+x.toPrecision(digits))).replace("-", "−");
};
