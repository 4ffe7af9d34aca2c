// Bundles the playground's modules into the folder given as the first argument. Called by scripts/clinic/publish/bundle.py.

import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

const out = process.argv[2];
const options = /** @type {const} */ ({
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  outdir: out,
  legalComments: "none",
  logLevel: "warning",
  metafile: true,
});
const made = [
  await build({ ...options, entryPoints: ["docs/playground/start.js", "docs/playground/script.js", "docs/playground/diagnose.js"], splitting: true, chunkNames: "[name]-[hash]" }),
  await build({ ...options, entryPoints: ["docs/playground/loader.js", "docs/playground/search.js"], format: "iife" }),
  await build({
    ...options,
    entryPoints: ["worker", "script-worker", "diagnosis-worker", "diagnosis-launcher"].map((name) => `docs/playground/${name}.js`),
    external: ["module", "worker_threads", "node:*"],
  }),
];

// What the packages that went in ask to be said with them.
const packages = made
  .flatMap(({ metafile }) => Object.keys(metafile.inputs))
  .map((path) => /(?:^|\/)node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1] ?? "")
  .filter(Boolean);
const notices = [...new Set(packages)].sort().map((name) => {
  const folder = join("node_modules", name);
  const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  return `${name} ${version} (${license})\n\n${file ? readFileSync(join(folder, file), "utf8").trim() : ""}\n`;
});
writeFileSync(join(out, "licenses.txt"), notices.join(`\n${"-".repeat(60)}\n\n`));
