// Charts over time: curves drawn once a size, a cursor that follows the slider and can be dragged.

const MARGIN = { left: 52, right: 10, top: 8, bottom: 20 };

// Round numbers from low to high, some five of them.
const ticks = (low, high, count = 4) => {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.max(0, Math.floor(high / step + 1e-9) - first + 1) }, (_, k) => (first + k) * step);
};

class Chart {
  constructor(parent, chart, times, goTo) {
    Object.assign(this, { chart, times, goTo });
    const figure = parent.appendChild(document.createElement("figure"));
    const caption = figure.appendChild(document.createElement("figcaption"));
    caption.appendChild(document.createElement("b")).textContent = chart.unit ? `${chart.title} [${chart.unit}]` : chart.title;
    this.values = chart.series.map((series) => {
      const span = caption.appendChild(document.createElement("span"));
      span.appendChild(document.createElement("i")).style.background = series.color;
      return span.appendChild(document.createElement("span"));
    });
    this.svg = svgElement("svg", "", figure);
    this.svg.setAttribute("role", "img");
    this.svg.setAttribute("aria-label", chart.title);
    this.range();
    let held = false;
    const seek = (event) => held && this.seek(event);
    this.svg.addEventListener("pointerdown", (event) => { held = true; this.seek(event); this.svg.setPointerCapture(event.pointerId); });
    this.svg.addEventListener("pointermove", seek);
    for (const end of ["pointerup", "pointercancel"]) this.svg.addEventListener(end, () => { held = false; });
    new ResizeObserver(() => this.draw()).observe(this.svg);
    this.draw();
  }

  range() {
    let low = Infinity, high = -Infinity;
    for (const { values } of this.chart.series) for (const x of values) if (Number.isFinite(x)) { low = Math.min(low, x); high = Math.max(high, x); }
    if (low > high) [low, high] = [0, 1];
    // Differences that are rounding alone are none.
    if (high - low < 1e-9 * Math.max(Math.abs(low), Math.abs(high))) low = high = (low + high) / 2;
    const room = (high - low) * 0.06 || Math.abs(high) * 0.1 || 1;
    Object.assign(this, { low: low - room, high: high + room, first: this.times[0] ?? 0, last: this.times[this.times.length - 1] ?? 1 });
    if (this.first === this.last) this.last = this.first + 1;
  }

  x(t) { return MARGIN.left + ((t - this.first) / (this.last - this.first)) * (this.width - MARGIN.left - MARGIN.right); }
  y(value) { return this.height - MARGIN.bottom - ((value - this.low) / (this.high - this.low)) * (this.height - MARGIN.top - MARGIN.bottom); }

  draw() {
    const box = this.svg.getBoundingClientRect();
    Object.assign(this, { width: box.width || 300, height: box.height || 150 });
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.svg.replaceChildren();
    const [from, to] = [Math.min(this.first, this.last), Math.max(this.first, this.last)];
    for (const t of ticks(from, to, this.width / 90)) this.tick(this.x(t), this.x(t), MARGIN.top, this.height - MARGIN.bottom, text(t), "middle");
    for (const value of ticks(this.low, this.high, 4)) this.tick(MARGIN.left, this.width - MARGIN.right, this.y(value), this.y(value), text(value), "end");
    for (const series of this.chart.series) {
      const curve = svgElement("path", "curve", this.svg);
      curve.setAttribute("stroke", series.color);
      curve.setAttribute("d", this.curve(series.values));
    }
    this.cursor = svgElement("line", "cursor", this.svg);
    this.cursor.setAttribute("y1", MARGIN.top);
    this.cursor.setAttribute("y2", this.height - MARGIN.bottom);
    this.dots = this.chart.series.map((series) => {
      const dot = svgElement("circle", "", this.svg);
      dot.setAttribute("r", 3.2);
      dot.setAttribute("fill", series.color);
      return dot;
    });
    this.show(this.index ?? 0);
  }

  tick(x1, x2, y1, y2, label, anchor) {
    const line = svgElement("line", "tick", this.svg), mark = svgElement("text", "label", this.svg);
    for (const [name, value] of Object.entries({ x1, x2, y1, y2 })) line.setAttribute(name, value);
    mark.setAttribute("x", anchor === "end" ? x1 - 5 : x1);
    mark.setAttribute("y", anchor === "end" ? y1 + 3.5 : y2 + 13);
    mark.setAttribute("text-anchor", anchor);
    mark.textContent = label;
  }

  // Of all frames in one column of pixels the first, the least, the greatest and the last are drawn; a gap lifts the pen.
  curve(values) {
    let d = "", pen = "M", pixel = null, group = [];
    const flush = () => {
      if (!group.length) return;
      const by = (best) => group.reduce((a, b) => (best(values[b], values[a]) ? b : a));
      const chosen = [...new Set([group[0], by((a, b) => a < b), by((a, b) => a > b), group[group.length - 1]])].sort((a, b) => a - b);
      for (const k of chosen) {
        d += `${pen}${this.x(this.times[k]).toFixed(1)} ${this.y(values[k]).toFixed(1)}`;
        pen = "L";
      }
      group = [];
    };
    for (let k = 0; k < values.length; k++) {
      if (!Number.isFinite(values[k])) {
        flush();
        pen = "M";
        continue;
      }
      const here = Math.floor(this.x(this.times[k]));
      if (here !== pixel) flush();
      pixel = here;
      group.push(k);
    }
    flush();
    return d;
  }

  show(index) {
    this.index = index;
    const x = this.x(between(this.times, index));
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
    this.chart.series.forEach((series, k) => {
      const value = between(series.values, index), known = Number.isFinite(value);
      this.dots[k].setAttribute("visibility", known ? "visible" : "hidden");
      if (known) {
        this.dots[k].setAttribute("cx", x);
        this.dots[k].setAttribute("cy", this.y(value));
      }
      this.values[k].textContent = `${series.name} ${text(value)}`;
    });
  }

  seek(event) {
    const box = this.svg.getBoundingClientRect();
    const share = (event.clientX - box.left - MARGIN.left) / (box.width - MARGIN.left - MARGIN.right);
    this.goTo(this.first + Math.max(0, Math.min(1, share)) * (this.last - this.first));
  }
}
