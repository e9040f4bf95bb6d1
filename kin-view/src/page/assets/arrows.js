// Forces and torques: arrows as long as they are large; in the plane a torque is an arc, in space it has two heads.

const HEAD = [9, 3.6], RADIUS = 19, WHOLE = 5.6;

class Arrows {
  constructor(stage, data) {
    Object.assign(this, { stage, data, on: true, box: document.getElementById("scale"), layer: svgElement("g", "pushes", stage.svg) });
    this.pushes = data.pushes.map((push) => {
      const element = svgElement("path", `push ${push.acting}`, this.layer), title = svgElement("title", "", element);
      element.dataset.name = push.name;
      title.textContent = push.name;
      const unit = data.scales[push.torque ? 1 : 0].unit;
      element.addEventListener("pointerenter", () => { title.textContent = `${push.name}: ${text(this.size(push))} ${unit}`; });
      return { ...push, element };
    });
    this.box.hidden = !this.pushes.length;
  }

  vector(push) {
    const at = push.columns.map((values) => between(values, this.stage.index));
    return push.torque && this.data.planar ? [0, 0, at[0]] : [at[0], at[1], at[2] ?? 0];
  }

  size(push) {
    return Math.hypot(...this.vector(push));
  }

  show(frames) {
    if (!this.on) return;
    for (const push of this.pushes) {
      const foot = pointOf(frames[push.track], push.local), vector = this.vector(push), scale = this.data.scales[push.torque ? 1 : 0];
      const found = [...foot, ...vector].every(Number.isFinite)
        && (push.torque && this.data.planar ? this.arc(foot, vector[2] * scale.turn) : this.straight(foot, vector, scale.length, push.torque));
      push.element.setAttribute("visibility", found ? "visible" : "hidden");
      if (!found) continue;
      push.element.setAttribute("d", found.d);
      push.element.classList.toggle("cut", found.cut);
    }
  }

  straight(foot, vector, scale, two) {
    const whole = Math.hypot(...vector) * scale, most = this.data.longest, cut = whole > most, share = scale * (cut ? most / whole : 1);
    const from = this.stage.project(foot), to = this.stage.project(foot.map((x, k) => x + vector[k] * share));
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]], length = Math.hypot(dx, dy), { unit } = this.stage;
    if (!(length > 2 * unit)) return null;
    const along = [dx / length, dy / length], size = Math.min(1, length / (1.5 * HEAD[0] * unit)) * unit;
    const neck = [to[0] - along[0] * HEAD[0] * size, to[1] - along[1] * HEAD[0] * size];
    return { d: `M${from}L${neck}${this.head(to, along, size)}${two ? this.head(neck, along, size) : ""}`, cut };
  }

  // Counter-clockwise for a positive angle, from below; the way back along the same arc leaves nothing to be filled.
  arc(foot, angle) {
    const centre = this.stage.project(foot), { unit } = this.stage, turned = Math.max(-WHOLE, Math.min(WHOLE, angle)), size0 = Math.abs(turned) * RADIUS;
    if (!(size0 > 2)) return null;
    const radius = RADIUS * unit, place = (a) => [centre[0] + radius * Math.sin(a), centre[1] + radius * Math.cos(a)];
    const size = Math.min(1, size0 / (1.5 * HEAD[0])) * unit, to = place(turned), back = place(turned - (Math.sign(turned) * HEAD[0] * size) / radius);
    const length = Math.hypot(to[0] - back[0], to[1] - back[1]), along = [(to[0] - back[0]) / length, (to[1] - back[1]) / length];
    const large = Math.abs(turned) > Math.PI ? 1 : 0, sweep = turned < 0 ? 1 : 0, run = (way, p) => `A${radius} ${radius} 0 ${large} ${way} ${p}`;
    return { d: `M${place(0)}${run(sweep, back)}${run(1 - sweep, place(0))}${this.head(to, along, size)}`, cut: turned !== angle };
  }

  head(tip, along, size) {
    const [x, y] = [tip[0] - along[0] * HEAD[0] * size, tip[1] - along[1] * HEAD[0] * size];
    const [sx, sy] = [-along[1] * HEAD[1] * size, along[0] * HEAD[1] * size];
    return `M${tip}L${[x + sx, y + sy]}L${[x - sx, y - sy]}Z`;
  }

  // The scale, like that of a map: a round number that is no longer than so many pixels.
  legend() {
    if (!this.pushes.length) return;
    this.box.hidden = !this.on;
    this.box.replaceChildren();
    this.data.scales.forEach((scale, torque) => {
      if (torque && this.data.planar) {
        if (scale.turn > 0) this.row(null, "", `half a turn: ${text(Math.PI / scale.turn)} ${scale.unit}`);
      } else if (scale.length > 0) {
        const pixels = scale.length / this.stage.unit, most = 90 / pixels, power = 10 ** Math.floor(Math.log10(most));
        const number = [5, 2, 1].map((first) => first * power).find((x) => x <= most * (1 + 1e-12)) ?? power;
        this.row(number * pixels, torque ? "bar torque" : "bar", `${text(number)} ${scale.unit}`);
      }
    });
    const words = { joint: "joints", drive: "drives", load: "loads" };
    const key = this.row(null, "key", "");
    for (const [acting, word] of Object.entries(words)) {
      if (!this.pushes.some((push) => push.acting === acting)) continue;
      const entry = key.appendChild(document.createElement("span"));
      entry.className = acting;
      entry.textContent = word;
    }
  }

  row(width, className, words) {
    const row = this.box.appendChild(document.createElement("div"));
    if (width !== null) {
      const bar = row.appendChild(document.createElement("i"));
      bar.className = className;
      bar.style.width = `${width}px`;
    } else row.className = className;
    row.append(words);
    return row;
  }

  toggle() {
    this.on = !this.on;
    this.layer.setAttribute("display", this.on ? "inline" : "none");
    this.legend();
    this.stage.show(this.stage.index);
    return this.on;
  }
}
