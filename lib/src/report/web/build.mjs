// Bundles src/ into dist/report.js, dist/report.css and dist/chooser.js, and gathers the licences of what went in.
// `node build.mjs --check` builds to memory and fails if the committed dist/ differs.
import { readFile, writeFile, mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import path from "node:path";
import * as esbuild from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const check = process.argv.includes("--check");

const result = await esbuild.build({
  absWorkingDir: here,
  entryPoints: { report: "src/main.js", chooser: "src/chooser.js" },
  outdir: "dist",
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "ascii",
  legalComments: "none",
  metafile: true,
  write: false,
});

async function licences(metafile) {
  const packages = new Set();
  for (const input of Object.keys(metafile.inputs)) {
    const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (match) packages.add(match[1]);
  }
  let text = "The page contains these packages, each under the licence printed below its name.\n";
  for (const name of [...packages].sort()) {
    const folder = path.join(here, "node_modules", name);
    const meta = JSON.parse(await readFile(path.join(folder, "package.json"), "utf8"));
    text += `\n${"=".repeat(72)}\n${meta.name} ${meta.version} (${meta.license})\n\n`;
    text += (await readFile(path.join(folder, "LICENSE"), "utf8")).trim() + "\n";
  }
  return text;
}

const outputs = result.outputFiles.map((file) => ({
  name: path.basename(file.path),
  bytes: Buffer.from(file.contents),
}));
outputs.push({ name: "LICENSES.txt", bytes: Buffer.from(await licences(result.metafile)) });

// The script stands inside an element of the page: these would end it, or open another, whatever surrounds them.
for (const { name, bytes } of outputs.filter(({ name }) => name.endsWith(".js"))) {
  for (const end of ["<!--", "</script", "]]>"]) {
    if (bytes.toString("latin1").toLowerCase().includes(end)) throw new Error(`dist/${name} contains ${end}`);
  }
}

let stale = 0;
await mkdir(path.join(here, "dist"), { recursive: true });
for (const { name, bytes } of outputs) {
  const target = path.join(here, "dist", name);
  if (check) {
    const committed = await readFile(target).catch(() => Buffer.alloc(0));
    if (!committed.equals(bytes)) {
      console.error(`dist/${name} is not what src/ gives; run: npm ci && npm run build`);
      stale += 1;
    }
  } else {
    await writeFile(target, bytes);
    console.log(`dist/${name}  ${bytes.length} bytes`);
  }
}
process.exit(stale === 0 ? 0 : 1);
