// Talks to rust-analyzer over the language server protocol, as an editor does. Only node's own library is used.

import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const crate = process.argv[2];
const files = { constraints: join(crate, "src/lib.rs"), mistakes: join(crate, "src/bin/mistakes.rs") };
const texts = Object.fromEntries(Object.entries(files).map(([name, path]) => [name, readFileSync(path, "utf8")]));
const uri = (name) => pathToFileURL(files[name]).href;

// -- the protocol

const server = spawn("rust-analyzer", [], { cwd: crate, stdio: ["pipe", "pipe", "inherit"] });
const waiting = new Map();
const published = new Map();
let ready;
const quiescent = new Promise((resolve) => (ready = resolve));
let last = 0;
let buffer = Buffer.alloc(0);

function send(message) {
  const body = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }));
  server.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
  server.stdin.write(body);
}

function asked(method, params) {
  const id = ++last;
  send({ id, method, params });
  return new Promise((resolve, reject) => waiting.set(id, { method, resolve, reject }));
}

/** Asks again where the server has seen a file change meanwhile, as an editor does. */
async function request(method, params) {
  const CONTENT_MODIFIED = -32801;
  for (let tries = 0; ; tries++) {
    try {
      return await asked(method, params);
    } catch (error) {
      if (error.code !== CONTENT_MODIFIED || tries === 50) throw error;
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }
}

server.stdout.on("data", (chunk) => {
  buffer = Buffer.concat([buffer, chunk]);
  for (;;) {
    const end = buffer.indexOf("\r\n\r\n");
    if (end < 0) return;
    const length = Number(/Content-Length: (\d+)/i.exec(buffer.subarray(0, end).toString())[1]);
    if (buffer.length < end + 4 + length) return;
    received(JSON.parse(buffer.subarray(end + 4, end + 4 + length).toString()));
    buffer = buffer.subarray(end + 4 + length);
  }
});

function received(message) {
  if (message.method === "textDocument/publishDiagnostics") {
    published.set(message.params.uri, message.params.diagnostics);
  } else if (message.method === "experimental/serverStatus") {
    if (message.params.health === "error") console.error(message.params.message);
    if (message.params.quiescent) ready();
  } else if (message.method === "workspace/configuration") {
    send({ id: message.id, result: message.params.items.map(() => settings) });
  } else if (message.id !== undefined && message.method) {
    send({ id: message.id, result: null });
  } else if (waiting.has(message.id)) {
    const { method, resolve, reject } = waiting.get(message.id);
    waiting.delete(message.id);
    if (message.error) reject(Object.assign(new Error(`${method}: ${message.error.message}`), { code: message.error.code }));
    else resolve(message.result);
  }
}

// -- places in a text

/** The place `offset` characters after the `nth` occurrence of `text` behind that of `after`. */
function place(name, after, text, offset = 0) {
  const from = texts[name].indexOf(after);
  const at = from < 0 ? -1 : texts[name].indexOf(text, from);
  if (at < 0) throw new Error(`${name}: there is no "${text}" behind "${after}"`);
  const before = texts[name].slice(0, at + offset).split("\n");
  return { line: before.length - 1, character: before.at(-1).length };
}

const at = (name, position) => ({ textDocument: { uri: uri(name) }, position });

/** Puts `text` in the place of the whole file, as typing does. */
let version = 1;
function type(name, text) {
  send({ method: "textDocument/didChange", params: { textDocument: { uri: uri(name), version: ++version }, contentChanges: [{ text }] } });
}

// -- what is asked

const failures = [];
function expect(what, holds, found) {
  console.log(`${holds ? "ok  " : "FAIL"} ${what}${holds ? "" : `\n     ${JSON.stringify(found)}`}`);
  if (!holds) failures.push(what);
}

async function diagnostics(name) {
  const report = await request("textDocument/diagnostic", { textDocument: { uri: uri(name) } });
  return [...report.items, ...(published.get(uri(name)) ?? [])];
}

/** Diagnostics where `typed` stands in the place of `replaced` behind `after`. */
async function diagnosed(name, after, replaced, typed) {
  return typedInstead(name, after, replaced, typed, () => diagnostics(name));
}

async function labels(name, position) {
  const found = await request("textDocument/completion", at(name, position));
  return (found?.items ?? found ?? []).map((item) => item.label.replace(/\(.*/, ""));
}

async function hover(name, position) {
  const found = await request("textDocument/hover", at(name, position));
  return found?.contents?.value ?? "";
}

/** What `ask` finds where `typed` stands in the place of `replaced` behind `after`. */
async function typedInstead(name, after, replaced, typed, ask) {
  const original = texts[name];
  const from = original.indexOf(replaced, original.indexOf(after));
  if (from < 0) throw new Error(`${name}: there is no "${replaced}" behind "${after}"`);
  texts[name] = original.slice(0, from) + typed + original.slice(from + replaced.length);
  type(name, texts[name]);
  const found = await ask();
  texts[name] = original;
  type(name, original);
  return found;
}

/** Completion where `typed` stands in the place of `replaced` behind `after`. */
async function completed(name, after, replaced, typed) {
  return typedInstead(name, after, replaced, typed, () => labels(name, place(name, after, typed, typed.length)));
}

function edits(change, name) {
  const documents = change?.documentChanges?.flatMap((document) => document.edits ?? []) ?? change?.changes?.[uri(name)] ?? [];
  return documents.map((edit) => edit.range.start.line);
}

const settings = {
  checkOnSave: false,
  procMacro: { enable: true, attributes: { enable: true } },
  cargo: { buildScripts: { enable: true }, targetDir: process.env.CARGO_TARGET_DIR ?? null },
  diagnostics: { enable: true, experimental: { enable: true } },
  cachePriming: { enable: false },
};

async function main() {
  const capabilities = {
    textDocument: { diagnostic: {}, publishDiagnostics: {}, hover: { contentFormat: ["plaintext"] }, rename: {}, definition: {}, completion: {} },
    workspace: { configuration: true, workspaceEdit: { documentChanges: true } },
    experimental: { serverStatusNotification: true },
  };
  await request("initialize", { processId: process.pid, rootUri: pathToFileURL(crate).href, capabilities, initializationOptions: settings });
  send({ method: "initialized", params: {} });
  for (const name of Object.keys(files)) {
    send({ method: "textDocument/didOpen", params: { textDocument: { uri: uri(name), languageId: "rust", version: 1, text: texts[name] } } });
  }
  await quiescent;

  // Fifty constraints without an error.
  const shown = await diagnostics("constraints");
  expect("no false error among fifty constraints", shown.length === 0, shown.map((d) => `${d.range.start.line + 1}: ${d.message}`).slice(0, 20));
  console.log(`     ${shown.length} diagnostics of ${texts.constraints.match(/#\[constraint/g).length} constraints`);

  // A server that looks into no body would show no error either: a slip in one of them is shown, at its line.
  for (const [after, right, wrong] of [
    ["fn parabolic_slot", "s.y - k", "s.nothing() - k"],
    ["fn cylindrical(", "j.direction(h_j)", "j.direction(h_j, 1.0)"],
    ["fn own_type", "gains.scaled(r.x)", "gains.scaled(r.nowhere)"],
  ]) {
    const slips = await diagnosed("constraints", after, right, wrong);
    const line = place("constraints", after, right).line;
    const there = slips.length > 0 && slips.every((d) => Math.abs(d.range.start.line - line) <= 1);
    expect(`a slip in a body is shown there: ${wrong}`, there, slips.map((d) => `${d.range.start.line + 1}: ${d.message}`));
  }

  // Hover: the types are those that the body sees.
  const slot = "fn parabolic_slot";
  const type_of_s = await hover("constraints", place("constraints", slot, "s.y"));
  expect("hover on a variable shows its type", /Vec2/.test(type_of_s), type_of_s);
  const type_of_point = await hover("constraints", place("constraints", slot, "point(u_i)"));
  expect("hover on a method shows its documentation", /fn point/.test(type_of_point), type_of_point);
  const type_of_i = await hover("constraints", place("constraints", slot, "i.point"));
  expect("hover on an argument shows the state of a body", /PlanarState/.test(type_of_i), type_of_i);

  // Go to definition.
  const definition = async (name, position) => [await request("textDocument/definition", at(name, position))].flat().filter(Boolean);
  const of_s = await definition("constraints", place("constraints", slot, "s.x"));
  const let_s = place("constraints", slot, "let s", 4);
  const start = (found) => (found.targetSelectionRange ?? found.range).start;
  expect("a variable leads to its `let`", of_s.some((found) => start(found).line === let_s.line), of_s);
  const of_k = await definition("constraints", place("constraints", slot, "k * s"));
  expect("a parameter leads to the signature", of_k.some((found) => start(found).line === place("constraints", slot, "k: f64").line), of_k);
  const of_wear = await definition("constraints", place("constraints", "fn on_cam", "wear("));
  expect("a function of one's own leads to itself", of_wear.some((found) => start(found).line === place("constraints", "fn wear", "fn wear").line), of_wear);
  const of_field = await definition("constraints", place("constraints", "fn own_type", "gains.k", 6));
  expect("a field of one's own leads to its declaration", of_field.some((found) => start(found).line === place("constraints", "struct Gains", "k: f64").line), of_field);

  // Rename.
  const renamed = async (position, newName) => edits(await request("textDocument/rename", { ...at("constraints", position), newName }), "constraints");
  const lines_of_s = await renamed(place("constraints", slot, "s.y"), "local");
  expect("renaming a variable changes all its four places", lines_of_s.length === 4, lines_of_s);
  const lines_of_reach = await renamed(place("constraints", "fn slot", "reach"), "half");
  expect("renaming a parameter changes its attributes too", lines_of_reach.length >= 4, lines_of_reach);

  // Completion.
  const wanted = (found, ...names) => names.every((name) => found.includes(name));
  const planar = await completed("constraints", slot, "i.point(u_i)", "i.");
  expect("`i.` of a planar body completes", wanted(planar, "r", "theta", "point", "direction", "local"), planar.slice(0, 12));
  const spatial = await completed("constraints", "fn cylindrical(", "j.direction(h_j)", "j.");
  expect("`j.` of a spatial body completes", wanted(spatial, "r", "p", "point", "direction", "local"), spatial.slice(0, 12));
  const vector = await completed("constraints", slot, "s.y", "s.");
  expect("`s.` of a vector completes", wanted(vector, "x", "y", "norm", "dot"), vector.slice(0, 12));
  const law = await completed("constraints", "fn on_cam", "profile.at(phi)", "profile.");
  expect("`profile.` of a law completes", wanted(law, "at", "slope"), law.slice(0, 12));
  const own = await completed("constraints", "fn own_type", "gains.scaled(r.x)", "gains.");
  expect("`gains.` of a type of one's own completes", wanted(own, "k", "offset", "scaled"), own.slice(0, 12));
  const variable = await completed("constraints", "fn own_type", "r.y - gains.k", "r.y - ga");
  expect("a parameter's name completes", wanted(variable, "gains"), variable.slice(0, 12));

  // After mistakes.
  const mistakes = await diagnostics("mistakes");
  const lines = mistakes.map((d) => d.range.start.line + 1);
  expect("mistakes are shown", mistakes.some((d) => /is a Law/.test(d.message)), mistakes.map((d) => `${d.range.start.line + 1}: ${d.message}`));
  const broken = await completed("mistakes", "fn law_as_a_number", "p.norm()", "i.");
  expect("`i.` completes beside a mistake", wanted(broken, "r", "theta", "point"), broken.slice(0, 12));
  const signature = await completed("mistakes", "fn wrong_signature", "i.r.x;", "k.");
  expect("`k.` completes below a mistake in the signature", wanted(signature, "sin", "sqrt"), signature.slice(0, 12));
  const unfinished = await labels("mistakes", place("mistakes", "fn unfinished", "i.", 2));
  expect("`i.` completes in a body that is no Rust yet", wanted(unfinished, "r", "theta", "point"), unfinished.slice(0, 12));
  const in_law = await completed("mistakes", "fn law_of_nothing", "y.nothing()", "y.");
  expect("`y.` completes in a law", wanted(in_law, "sin", "sqrt"), in_law.slice(0, 12));
  const type_of_p = await hover("mistakes", place("mistakes", "fn law_as_a_number", "p.norm"));
  expect("hover works beside a mistake", /Vec2/.test(type_of_p), type_of_p);

  await request("shutdown", null);
  send({ method: "exit" });
  console.log(failures.length ? `${failures.length} of these fail` : "an editor sees the functions as they were written");
  process.exit(failures.length ? 1 : 0);
}

setTimeout(() => {
  console.error("rust-analyzer has not answered in ten minutes");
  server.kill();
  process.exit(1);
}, 600_000).unref();
main().catch((error) => {
  console.error(error);
  server.kill();
  process.exit(1);
});
