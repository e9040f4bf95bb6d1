// The mechanism: one SVG element for each shape, moved every frame; drag and wheel move the eye.

class Stage {
  constructor(svg, data) {
    Object.assign(this, { svg, data, index: 0, azimuth: data.eye[0], elevation: data.eye[1], zoom: 1, shift: [0, 0] });
    if (!data.planar) svg.classList.add("spatial");
    this.floor = data.planar ? [] : this.floorLines();
    this.paths = data.traces.map((trace) => this.styled("path", "path", trace.color));
    this.body = svgElement("g", "", svg);
    this.shapes = data.shapes.map((shape) => this.shape(shape));
    this.lines = data.lines.map((line) => ({ ...line, element: this.named(this.styled("polyline", line.style, line.color, this.body), line.name) }));
    this.supports = data.planar ? data.marks.filter((mark) => mark.grounded).map((mark) => this.support(mark)) : [];
    this.trails = data.traces.map((trace) => this.styled("path", "trail", trace.color));
    this.marks = data.marks.map((mark) => this.mark(mark, "pin", 4));
    this.dots = data.traces.map((trace) => this.mark(trace, "dot", 3.2));
    this.arrows = new Arrows(this, data);
    this.listen();
    new ResizeObserver(() => this.look()).observe(svg);
    this.look();
  }

  styled(tag, className, color, parent = this.svg) {
    const element = svgElement(tag, className, parent);
    if (className === "plate" || className === "dot") element.setAttribute("fill", color);
    if (className !== "dot") element.setAttribute("stroke", color);
    return element;
  }

  named(element, name) {
    svgElement("title", "", element).textContent = name;
    element.dataset.name = name;
    return element;
  }

  shape(shape) {
    const element = this.styled(shape.style === "plate" ? "polygon" : "polyline", shape.style, shape.color, this.body);
    return { ...shape, element: this.named(element, shape.name) };
  }

  mark(mark, className, radius) {
    const element = className === "dot" ? this.styled("circle", "dot", mark.color) : svgElement("circle", className, this.svg);
    return { ...mark, radius, element: this.named(element, mark.name) };
  }

  support(mark) {
    const element = svgElement("path", "support", this.svg);
    element.setAttribute("d", "M0 0L-8 13H8ZM-12 13H12M-10 13l-4 5M-4 13l-4 5M2 13l-4 5M8 13l-4 5");
    this.svg.insertBefore(element, this.body);
    return { ...mark, element };
  }

  floorLines() {
    const [low, high] = this.data.bounds, lines = [], count = 8;
    for (let k = 0; k <= count; k++) {
      const x = low[0] + ((high[0] - low[0]) * k) / count, y = low[1] + ((high[1] - low[1]) * k) / count;
      lines.push([[x, low[1], low[2]], [x, high[1], low[2]]], [[low[0], y, low[2]], [high[0], y, low[2]]]);
    }
    return lines.map((ends) => ({ ends, element: svgElement("polyline", "floor", this.svg) }));
  }

  // The directions to the right, upwards and to the eye.
  axes() {
    if (this.data.planar) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const [s, c, h, f] = [Math.sin(this.azimuth), Math.cos(this.azimuth), Math.sin(this.elevation), Math.cos(this.elevation)];
    return [[-s, c, 0], [-h * c, -h * s, f], [f * c, f * s, h]];
  }

  project(p) {
    const [right, up] = this.eye;
    return [right[0] * p[0] + right[1] * p[1] + right[2] * p[2], -(up[0] * p[0] + up[1] * p[1] + up[2] * p[2])];
  }

  depth(p) {
    const eye = this.eye[2];
    return eye[0] * p[0] + eye[1] * p[1] + eye[2] * p[2];
  }

  // After the eye has moved or the window has another size.
  look() {
    this.eye = this.axes();
    const { bounds: [low, high] } = this.data, corners = [];
    for (let k = 0; k < 8; k++) corners.push(this.project([0, 1, 2].map((axis) => (k >> axis & 1 ? high : low)[axis])));
    const xs = corners.map((p) => p[0]), ys = corners.map((p) => p[1]);
    const middle = this.data.planar ? [(Math.min(...xs) + Math.max(...xs)) / 2, (Math.min(...ys) + Math.max(...ys)) / 2]
      : this.project([0, 1, 2].map((axis) => (low[axis] + high[axis]) / 2));
    const wide = this.data.planar ? Math.max(...xs) - Math.min(...xs) : this.data.size;
    const reach = Math.max(...ys) - Math.min(...ys), tall = this.data.planar ? reach : Math.max(reach, this.data.size * 0.8);
    const box = this.svg.getBoundingClientRect(), room = 60;
    this.unit = Math.max(wide / Math.max(box.width - room, 40), tall / Math.max(box.height - room, 40), this.data.size * 1e-6) / this.zoom;
    const [w, h] = [box.width * this.unit, box.height * this.unit];
    this.svg.setAttribute("viewBox", `${middle[0] + this.shift[0] - w / 2} ${middle[1] + this.shift[1] - h / 2} ${w || 1} ${h || 1}`);
    this.svg.dataset.right = this.eye[0].join(" ");
    this.svg.dataset.up = this.eye[1].join(" ");
    // Seen from right above a floor is no floor.
    const above = Math.abs(this.eye[2][2]) > 0.999;
    for (const { ends, element } of this.floor) {
      element.setAttribute("points", this.listed(ends));
      element.setAttribute("visibility", above ? "hidden" : "visible");
    }
    for (const mark of [...this.marks, ...this.dots]) mark.element.setAttribute("r", mark.radius * this.unit);
    this.data.traces.forEach((trace, k) => this.drawPath(trace, k));
    this.arrows.legend();
    this.show(this.index);
  }

  // The whole path as text, and where in it each frame ends: a trail is its beginning.
  drawPath(trace, k) {
    let d = "", last = null, pen = "M";
    trace.ends = trace.path.map((p) => {
      if (!Number.isFinite(p[0])) pen = "M";
      else {
        const q = this.project(p);
        const near = pen === "L" && Math.abs(q[0] - last[0]) + Math.abs(q[1] - last[1]) < 0.4 * this.unit;
        if (!near) {
          d += `${pen}${+q[0].toPrecision(7)} ${+q[1].toPrecision(7)}`;
          last = q;
          pen = "L";
        }
      }
      return d.length;
    });
    trace.d = d;
    this.paths[k].setAttribute("d", d);
  }

  listed(points) {
    return points.map((p) => this.project(p).map((x) => +x.toPrecision(8)).join(",")).join(" ");
  }

  // The mechanism at a frame, whole or between two.
  show(index) {
    this.index = index;
    const frames = this.data.tracks.map((track) => frameOf(track, index));
    const order = [];
    const place = (item, points) => {
      const known = points.every((p) => Number.isFinite(p[0] + p[1] + p[2]));
      item.element.setAttribute("visibility", known ? "visible" : "hidden");
      if (!known) return;
      item.element.setAttribute("points", this.listed(points));
      order.push([points.reduce((sum, p) => sum + this.depth(p), 0) / points.length, item.element]);
    };
    for (const shape of this.shapes) place(shape, shape.points.map((p) => pointOf(frames[shape.track], p)));
    for (const line of this.lines) place(line, line.points.map(([track, p]) => pointOf(frames[track], p)));
    if (!this.data.planar) this.sort(order);
    for (const mark of [...this.marks, ...this.dots]) {
      const p = pointOf(frames[mark.track], mark.local), known = Number.isFinite(p[0] + p[1] + p[2]);
      mark.element.setAttribute("visibility", known ? "visible" : "hidden");
      if (!known) continue;
      const [x, y] = this.project(p);
      mark.element.setAttribute("cx", x);
      mark.element.setAttribute("cy", y);
    }
    for (const { track, local, element } of this.supports) {
      const [x, y] = this.project(pointOf(frames[track], local));
      if (Number.isFinite(x + y)) element.setAttribute("transform", `translate(${x} ${y}) scale(${this.unit})`);
    }
    this.arrows.show(frames);
    this.data.traces.forEach((trace, k) => this.trails[k].setAttribute("d", trace.d.slice(0, trace.ends[Math.floor(index)])));
  }

  // The farther first.
  sort(order) {
    order.sort((a, b) => a[0] - b[0]);
    if (order.some(([, element], k) => this.body.children[k] !== element)) for (const [, element] of order) this.body.appendChild(element);
  }

  turn(dx, dy) {
    this.azimuth -= dx * 0.01;
    this.elevation = Math.max(-1.55, Math.min(1.55, this.elevation + dy * 0.01));
    this.look();
  }

  pan(dx, dy) {
    this.shift = [this.shift[0] - dx * this.unit, this.shift[1] - dy * this.unit];
    this.look();
  }

  scale(factor) {
    this.zoom = Math.max(0.1, Math.min(50, this.zoom * factor));
    this.look();
  }

  home() {
    Object.assign(this, { zoom: 1, shift: [0, 0], azimuth: this.data.eye[0], elevation: this.data.eye[1] });
    this.look();
  }

  listen() {
    const held = new Map(), { svg } = this, where = document.getElementById("where");
    svg.addEventListener("pointerdown", (event) => {
      held.set(event.pointerId, [event.clientX, event.clientY]);
      svg.setPointerCapture(event.pointerId);
    });
    for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, (event) => held.delete(event.pointerId));
    const hint = this.data.planar ? "" : "drag: go round · shift and drag: move · wheel: nearer";
    where.textContent = hint;
    svg.addEventListener("pointerleave", () => { where.textContent = hint; });
    svg.addEventListener("pointermove", (event) => {
      this.tell(event, where);
      const before = held.get(event.pointerId);
      if (!before) return;
      const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
      if (held.size > 1) {
        const [id, other] = [...held].find(([key]) => key !== event.pointerId);
        const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) + 1;
        this.scale(apart([event.clientX, event.clientY]) / apart(before));
      } else if (this.data.planar || event.shiftKey) this.pan(dx, dy);
      else this.turn(dx, dy);
      held.set(event.pointerId, [event.clientX, event.clientY]);
    });
    svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.scale(Math.exp(-event.deltaY * 0.0015));
    }, { passive: false });
  }

  // Coordinates under the pointer.
  tell(event, where) {
    if (!this.data.planar) return;
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return;
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    where.textContent = `x ${text(p.x)}  y ${text(-p.y)} ${this.data.units[0]}`;
  }
}
