// Opens every page under a folder in headless Chromium and fails on the first thing that is not as it should be.
//
//   node check.mjs out
//
// Each folder with a page (index.html) also has the motion it shows (motion.csv). What a page draws under a name is compared with the
// columns NAME.x and NAME.y (and NAME.z) of that file.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const CANDIDATES = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const SHARES = [0.13, 0.5, 0.91];
const LOOKS = [
  { viewport: { width: 1200, height: 760 }, colorScheme: "light" },
  { viewport: { width: 1200, height: 760 }, colorScheme: "dark" },
  { viewport: { width: 390, height: 844 }, colorScheme: "dark", hasTouch: true },
  { viewport: { width: 390, height: 844 }, colorScheme: "light", hasTouch: true },
];

// A page with its ears open: whatever it logs or asks for ends up in `faults`.
const opened = async (browser, file, look) => {
  const context = await browser.newContext({ ...look, reducedMotion: "reduce" });
  const page = await context.newPage(), faults = [], url = pathToFileURL(file).href;
  page.on("console", (message) => faults.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
  page.on("request", (request) => request.url() === url || request.url().startsWith("data:") || faults.push(`request: ${request.url()}`));
  await page.goto(url);
  return { page, faults, context };
};

const moveTo = (page, index) => page.evaluate((k) => {
  const slider = document.getElementById("slider");
  slider.value = k;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}, index);

// Everything that the stage shows, as text.
const picture = (page) => page.evaluate(() => document.getElementById("stage").innerHTML);
const sliderValue = (page) => page.evaluate(() => Number(document.getElementById("slider").value));
const sliderMax = (page) => page.evaluate(() => Number(document.getElementById("slider").max));

// Rows of the motion by column name, units left out.
const motionOf = (folder) => {
  const fields = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map((m) => m[1].replace(/^"|"$/g, "").replaceAll('""', '"'));
  const [header, ...rows] = readFileSync(join(folder, "motion.csv"), "utf8").trim().split("\n");
  const names = fields(header).map((name) => name.replace(/ \[[^\]]*\]$/, ""));
  return { names, rows: rows.map((row) => row.split(",").map(Number)) };
};

// Where each circle of a name is drawn, against the motion.
const compare = async (page, motion, index) => {
  const drawn = await page.evaluate(() => {
    const stage = document.getElementById("stage");
    const axes = ["right", "up"].map((name) => stage.dataset[name].split(" ").map(Number));
    const circles = [...stage.querySelectorAll("circle[data-name]")].filter((c) => c.getAttribute("visibility") !== "hidden");
    const boxes = circles.map((c) => c.getBoundingClientRect());
    const matrix = stage.getScreenCTM().inverse();
    const middles = boxes.map((b) => new DOMPoint(b.x + b.width / 2, b.y + b.height / 2).matrixTransform(matrix));
    const unit = Math.abs(matrix.a);
    return { axes, unit, all: circles.map((c, k) => ({ name: c.dataset.name, x: +c.getAttribute("cx"), y: +c.getAttribute("cy"), seen: [middles[k].x, middles[k].y] })) };
  });
  let compared = 0;
  const size = Math.hypot(...await page.evaluate(() => { const b = document.getElementById("stage").viewBox.baseVal; return [b.width, b.height]; }));
  for (const circle of drawn.all) {
    const columns = ["x", "y", "z"].map((axis) => motion.names.indexOf(`${circle.name}.${axis}`));
    if (columns[0] < 0 || columns[1] < 0) continue;
    const p = columns.map((column) => (column < 0 ? 0 : motion.rows[index][column]));
    const along = (axis) => axis.reduce((sum, x, k) => sum + x * p[k], 0);
    const expected = [along(drawn.axes[0]), -along(drawn.axes[1])];
    for (const [k, x] of [circle.x, circle.y].entries()) {
      assert.ok(Math.abs(x - expected[k]) < 1e-6 * size, `${circle.name} at frame ${index} is drawn at ${x}, but the motion has ${expected[k]}`);
      assert.ok(Math.abs(circle.seen[k] - expected[k]) < 1.5 * drawn.unit, `${circle.name} at frame ${index} appears ${circle.seen[k]}, not ${expected[k]}`);
    }
    compared += 1;
  }
  return compared;
};

// Everything of the mechanism is within the stage, and there is something.
const within = async (page, index) => {
  const outside = await page.evaluate(() => {
    const stage = document.getElementById("stage").getBoundingClientRect();
    const seen = [...document.querySelectorAll("#stage :is(.plate, .bar, .slot, .rod, .barrel, .pin)")].filter((e) => e.getAttribute("visibility") !== "hidden");
    const out = (b) => b.left < stage.left - 1 || b.right > stage.right + 1 || b.top < stage.top - 1 || b.bottom > stage.bottom + 1;
    return seen.length ? seen.filter((e) => out(e.getBoundingClientRect())).map((e) => e.dataset.name) : ["all: the stage is empty"];
  });
  assert.deepEqual(outside, [], `outside of the stage at frame ${index}`);
};

// The page of a run that ended early says so, and why, before anything else; others say nothing.
const checkEnded = async (page, isEarly, wide) => {
  const note = await page.$("#ended");
  assert.equal(note !== null, isEarly, "a note on a run that ended early");
  if (!note) return;
  const box = await note.boundingBox();
  assert.ok(box.y < 200 && box.height > 30 && box.x >= 0 && box.x + box.width <= wide, `the note is at ${JSON.stringify(box)}`);
  const before = box.height;
  await page.click("#ended summary");
  assert.ok((await note.boundingBox()).height > before, "the note opens");
  await page.click("#ended summary");
  assert.match(await note.innerText(), /The run ended early: .* up to t = \S+ .*\n.*\S/s);
};

const checkPage = async (browser, folder) => {
  const motion = motionOf(folder);
  let compared = 0;
  for (const look of LOOKS) {
    const { page, faults, context } = await opened(browser, join(folder, "index.html"), look);
    const last = await sliderMax(page);
    assert.equal(last + 1, motion.rows.length, "frames of the page and rows of the motion");

    const dark = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const bright = dark.match(/\d+/g).slice(0, 3).every((x) => Number(x) > 128);
    assert.equal(bright, look.colorScheme === "light", `background ${dark} for ${look.colorScheme}`);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= look.viewport.width, `wider than the window: ${wide}`);
    await checkEnded(page, folder.endsWith("ended_early"), look.viewport.width);

    const seen = new Set([await picture(page)]);
    for (const share of SHARES) {
      const index = Math.round(last * share);
      await moveTo(page, index);
      seen.add(await picture(page));
      compared += await compare(page, motion, index);
      await within(page, index);
    }
    assert.equal(seen.size, SHARES.length + 1, "the slider moves the picture");
    const drawn = await page.evaluate(() => [...document.querySelectorAll("svg")].map((svg) => svg.outerHTML).join());
    assert.ok(!/NaN|Infinity|undefined/.test(drawn), "something drawn is not a number");

    await moveTo(page, last);
    await within(page, last);

    await moveTo(page, 0);
    await page.keyboard.press("ArrowRight");
    assert.equal(await sliderValue(page), 1, "the right arrow goes one frame on");
    await page.keyboard.press("End");
    assert.equal(await sliderValue(page), last, "End goes to the end");
    await page.keyboard.press("Home");
    const still = await picture(page);
    await page.click("#play");
    await page.waitForFunction((before) => document.getElementById("stage").innerHTML !== before, still, { timeout: 5000 });
    assert.equal(await page.getAttribute("#play", "aria-label"), "Pause");
    await page.focus("#slider");
    await page.keyboard.press(" ");
    const stopped = await picture(page);
    await page.waitForTimeout(120);
    assert.equal(await picture(page), stopped, "space stops it");

    await page.mouse.move(...await middle(page, "#stage"));
    await page.mouse.wheel(0, -300);
    await page.waitForTimeout(50);
    assert.notEqual(await picture(page), stopped, "the wheel comes nearer");
    if (await page.evaluate(() => document.getElementById("stage").classList.contains("spatial"))) await orbit(page);
    if (await page.isVisible("#forces")) await switchForces(page);
    if (last >= 10_000) await smooth(page, join(folder, "index.html"));
    const chart = await page.$("#charts figure svg");
    if (chart) await dragChart(page, chart, last);
    assert.deepEqual(faults, []);
    await context.close();
  }
  assert.ok(compared > 0, "nothing drawn could be compared: add_point under the name of a trace or pin");
  return compared;
};

const middle = async (page, selector) => {
  const box = await (await page.$(selector)).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};

const orbit = async (page) => {
  const axes = () => page.evaluate(() => document.getElementById("stage").dataset.right);
  const before = await axes(), [x, y] = await middle(page, "#stage");
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 20, { steps: 3 });
  await page.mouse.up();
  assert.notEqual(await axes(), before, "dragging goes round a spatial mechanism");
};

// Forces are drawn with the scale that they are read by, and can be switched off.
const switchForces = async (page) => {
  const shown = () => page.evaluate(() => [...document.querySelectorAll("#stage .push")].filter((arrow) => arrow.getClientRects().length && arrow.getAttribute("visibility") !== "hidden").length);
  const before = await shown();
  assert.ok(before > 0, "no force is drawn");
  assert.match(await page.innerText("#scale"), /\d/, "no scale is told");
  await page.click("#forces");
  assert.deepEqual([await shown(), await page.isVisible("#scale"), await page.getAttribute("#forces", "aria-pressed")], [0, false, "false"]);
  await page.keyboard.press("f");
  assert.deepEqual([await shown(), await page.isVisible("#scale"), await page.getAttribute("#forces", "aria-pressed")], [before, true, "true"]);
};

// Many frames are drawn as fast as a screen shows them, and the file stays small.
const smooth = async (page, file) => {
  const bytes = statSync(file).size;
  assert.ok(bytes < 400_000, `${bytes} bytes`);
  const each = await page.evaluate(() => {
    const slider = document.getElementById("slider"), from = performance.now(), count = 200;
    for (let k = 0; k < count; k++) {
      slider.value = Math.round((Number(slider.max) * k) / count);
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      document.getElementById("stage").getBoundingClientRect();
    }
    return (performance.now() - from) / count;
  });
  assert.ok(each < 16, `${each} ms for one frame`);
};

const dragChart = async (page, chart, last) => {
  await chart.scrollIntoViewIfNeeded();
  const box = await chart.boundingBox();
  await page.mouse.click(box.x + box.width * 0.6, box.y + box.height / 2);
  const value = await sliderValue(page);
  assert.ok(value > 0.3 * last && value < 0.8 * last, `a click on a chart goes to its time, not to frame ${value} of ${last}`);
};

// The index leads to every page, and shows a picture of each.
const checkIndex = async (browser, folder, pages) => {
  const { page, faults, context } = await opened(browser, join(folder, "index.html"), LOOKS[0]);
  const links = await page.$$eval("a", (all) => all.map((a) => a.getAttribute("href")));
  for (const name of pages) assert.ok(links.includes(`${name}/index.html`), `the index does not lead to ${name}`);
  const broken = await page.$$eval("img", (all) => all.filter((img) => !img.complete || img.naturalWidth === 0).map((img) => img.src));
  assert.deepEqual(broken, [], "pictures of the index that cannot be shown");
  assert.deepEqual(faults, []);
  await context.close();
};

// Every SVG under the folder is XML, has no NaN, and shows the first pose where a viewer shows no motion.
const checkPictures = async (browser, folder) => {
  const files = readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".svg"));
  const page = await browser.newPage();
  for (const file of files) {
    const svg = readFileSync(join(folder, file), "utf8");
    const fault = await page.evaluate((svg) => new DOMParser().parseFromString(svg, "image/svg+xml").querySelector("parsererror")?.textContent, svg);
    assert.equal(fault, undefined, `${file}: ${fault}`);
    const resting = await page.evaluate((svg) => {
      const moved = [...new DOMParser().parseFromString(svg, "image/svg+xml").querySelectorAll("animate, animateTransform")];
      return moved.filter((e) => !e.parentElement.hasAttribute(e.getAttribute("attributeName"))).length;
    }, svg);
    assert.equal(resting, 0, `${file}: where nothing moves ${resting} things have no place`);
    assert.ok(!/NaN|inf/.test(svg.replace(/<(title|text)[^]*?<\/\1>/g, "")), `${file} has a number that is none`);
  }
  return files.length;
};

const root = resolve(process.argv[2] ?? "out");
const executablePath = CANDIDATES.find((path) => path && existsSync(path));
assert.ok(executablePath, "no Chromium: apt-get install chromium, or set CHROMIUM to its path");
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
try {
  const pages = readdirSync(root).filter((name) => existsSync(join(root, name, "index.html"))).sort();
  assert.ok(pages.length > 0, `no page under ${root}`);
  for (const name of pages) {
    const compared = await checkPage(browser, join(root, name)).catch((error) => { throw new Error(`${name}: ${error.message}`, { cause: error }); });
    console.log(`${name}: ${compared} drawn positions agree with the motion`);
  }
  if (existsSync(join(root, "index.html"))) await checkIndex(browser, root, pages);
  console.log(`${pages.length} pages and ${await checkPictures(browser, root)} pictures are as they should be`);
} finally {
  await browser.close();
}
