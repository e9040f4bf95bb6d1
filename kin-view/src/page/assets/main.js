// Time: the slider, the buttons, the keys and the clock all end in `go`.

const SPEEDS = [1, 2, 5].flatMap((x) => [-3, -2, -1, 0, 1, 2, 3].map((power) => x * 10 ** power)).sort((a, b) => a - b);

const start = () => {
  const byId = (id) => document.getElementById(id);
  const data = load(), last = Math.max(data.frames - 1, 0);
  const [slider, play, time, speed] = ["slider", "play", "time", "speed"].map(byId);
  const span = Math.abs(data.times[last] - data.times[0]) || 1;
  let index = 0, playing = false, before = null;

  const stage = new Stage(byId("stage"), data);
  const indexAt = (t) => {
    const forward = data.times[last] >= data.times[0];
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (data.times[middle] <= t === forward) low = middle;
      else high = middle;
    }
    const step = data.times[high] - data.times[low];
    return high === low || step === 0 ? low : low + Math.max(0, Math.min(1, (t - data.times[low]) / step));
  };
  const charts = data.charts.map((chart) => new Chart(byId("charts"), chart, data.times, (t) => { stop(); go(Math.round(indexAt(t))); }));
  if (!charts.length) {
    byId("charts").hidden = true;
    document.querySelector("main").classList.add("alone");
  }

  const go = (to) => {
    index = Math.max(0, Math.min(last, to));
    const shown = shownAt(data, index);
    stage.show(shown);
    for (const chart of charts) chart.show(shown);
    slider.value = Math.round(shown);
    const t = text(between(data.times, shown), 5);
    const told = `${t} ${data.units[1]}`;
    time.textContent = `t = ${told}`;
    slider.setAttribute("aria-valuetext", told);
  };
  const tick = (now) => {
    if (!playing) return;
    const passed = before === null ? 0 : (now - before) / 1000;
    before = now;
    const sense = Math.sign(data.times[last] - data.times[0]) || 1;
    let t = between(data.times, index) + sense * passed * Number(speed.value);
    if ((t - data.times[last]) * sense > 0) t = data.times[0] + (((t - data.times[0]) * sense) % span) * sense;
    go(indexAt(t));
    requestAnimationFrame(tick);
  };
  const set = (on) => {
    playing = on && last > 0;
    before = null;
    play.textContent = playing ? "❚❚" : "▶";
    play.setAttribute("aria-label", playing ? "Pause" : "Play");
    if (playing) requestAnimationFrame(tick);
  };
  const stop = () => set(false);
  const step = (by) => { stop(); go(Math.round(index) + by); };
  const faster = (by) => { speed.selectedIndex = Math.max(0, Math.min(speed.options.length - 1, speed.selectedIndex + by)); };
  const theme = () => { const root = document.documentElement; root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark"; };

  // A turn of the whole takes some seconds, unless it is as long as that by itself.
  const usual = span >= 2 && span <= 30 ? 1 : span / 6;
  const best = SPEEDS.reduce((a, b) => (Math.abs(Math.log(b / usual)) < Math.abs(Math.log(a / usual)) ? b : a));
  const middle = SPEEDS.indexOf(best);
  for (const factor of SPEEDS.slice(Math.max(0, middle - 5), middle + 5)) {
    const option = new Option(`${text(factor)}×`, factor, factor === best, factor === best);
    speed.add(option);
  }
  const forces = byId("forces");
  forces.hidden = !data.pushes.length;
  const show = () => { if (!forces.hidden) forces.setAttribute("aria-pressed", stage.arrows.toggle()); };
  forces.addEventListener("click", show);
  slider.max = last;
  slider.addEventListener("input", () => { stop(); go(Number(slider.value)); });
  play.addEventListener("click", () => set(!playing));
  byId("back").addEventListener("click", () => step(-1));
  byId("next").addEventListener("click", () => step(1));
  byId("home").addEventListener("click", () => stage.home());
  byId("theme").addEventListener("click", theme);
  const keys = {
    " ": () => set(!playing), ArrowLeft: (event) => step(event.shiftKey ? -10 : -1), ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
    Home: () => { stop(); go(0); }, End: () => { stop(); go(last); }, "+": () => faster(1), "-": () => faster(-1), t: theme, f: show, 0: () => stage.home(),
    w: () => stage.turn(0, 8), s: () => stage.turn(0, -8), a: () => stage.turn(-8, 0), d: () => stage.turn(8, 0),
  };
  document.addEventListener("keydown", (event) => {
    const own = event.target.closest("select, button") && (event.key === " " || event.key === "Enter" || event.target.tagName === "SELECT");
    if (own || event.ctrlKey || event.metaKey || event.altKey || !Object.hasOwn(keys, event.key)) return;
    event.preventDefault();
    keys[event.key](event);
  });
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const follow = () => { document.documentElement.dataset.theme = dark.matches ? "dark" : "light"; };
  dark.addEventListener("change", follow);
  follow();
  go(0);
  set(!matchMedia("(prefers-reduced-motion: reduce)").matches);
};
start();
