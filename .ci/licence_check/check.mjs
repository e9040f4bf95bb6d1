// Reads `cargo metadata` and refuses packages whose licence asks for more than a notice.
import satisfies from "spdx-satisfies";

const ALLOWED = [
  "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "CC0-1.0", "ISC", "MIT", "MIT-0",
  "Unicode-3.0", "Unlicense", "Zlib",
];

/** Whether one of the ways to take a licence expression (SPDX, or the older `MIT/Apache-2.0`) is allowed; one that cannot be read is not. */
function allowed(expression) {
  try {
    return satisfies(expression.replaceAll("/", " OR "), ALLOWED);
  } catch {
    return false;
  }
}

let text = "";
for await (const chunk of process.stdin) text += chunk;
const { packages } = JSON.parse(text);
const refused = packages.filter(({ license }) => !allowed(license ?? ""));
for (const { name, version, license } of refused) console.error(`${name} ${version}: ${license ?? "no licence"}`);
console.log(`${packages.length} packages, ${refused.length} with a licence that is not on the list`);
process.exit(refused.length ? 1 : 0);
