// Reads `cargo metadata` and refuses packages whose licence asks for more than a notice.

const ALLOWED = new Set([
  "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0", "ISC", "MIT", "MIT-0",
  "Unicode-3.0", "Unlicense", "Zlib",
]);

/** Whether one of the ways to take a licence expression (SPDX, or the older `MIT/Apache-2.0`) is allowed. */
export function allowed(expression) {
  const tokens = expression.replaceAll("/", " OR ").replaceAll(/[()]/g, " $& ").trim().split(/\s+/);
  let at = 0;
  const all = (operator, next, join) => {
    let value = next();
    while (tokens[at] === operator) {
      at++;
      const right = next();
      value = join(value, right);
    }
    return value;
  };
  const either = () => all("OR", both, (a, b) => a || b);
  const both = () => all("AND", one, (a, b) => a && b);
  const one = () => {
    if (tokens[at] === "(") {
      at++;
      const value = either();
      at++;
      return value;
    }
    let licence = tokens[at++];
    if (tokens[at] === "WITH") licence += ` WITH ${tokens[(at += 2) - 1]}`;
    return ALLOWED.has(licence);
  };
  const value = either();
  return value && at === tokens.length;
}

const tries = {
  "MIT OR Apache-2.0": true, "MIT/Apache-2.0": true, "GPL-3.0": false, "MIT AND GPL-3.0": false, "(MIT OR GPL-3.0) AND Unicode-3.0": true,
  "Apache-2.0 WITH LLVM-exception OR GPL-2.0": true, "GPL-2.0 WITH Classpath-exception-2.0": false, "": false,
};
for (const [expression, expected] of Object.entries(tries)) {
  if (allowed(expression) !== expected) throw new Error(`the reader of licences is wrong about "${expression}"`);
}

let text = "";
for await (const chunk of process.stdin) text += chunk;
const { packages } = JSON.parse(text);
const refused = packages.filter(({ license }) => !allowed(license ?? ""));
for (const { name, version, license } of refused) console.error(`${name} ${version}: ${license ?? "no licence"}`);
console.log(`${packages.length} packages, ${refused.length} with a licence that is not on the list`);
process.exit(refused.length ? 1 : 0);
