// Starts Debian's Chromium without a network of its own, and opens report pages while watching what they do.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const web = path.join(here, "../../../lib/src/report/web/");
const { chromium } = createRequire(web)("playwright-core");

const QUIET = [
  "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  "--disable-quic",
];
const SOFTWARE_GL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

// A browser without a graphics card draws every pixel by hand: where the size does not matter, a small window.
export const SMALL = { viewport: { width: 640, height: 480 } };

// Gives a function that builds a design below `work`, once, and tells its report page and what --json says.
export function builder(program, work) {
  const built = new Map();
  const build = (design, options) => {
    const folder = path.join(work, path.basename(design, ".yaml") + options.join("").replace(/\W/g, ""));
    const json = execFileSync(program, ["build", design, "-o", folder, "--json", ...options], { encoding: "utf8" });
    const report = readdirSync(folder).find((name) => name.endsWith(".report.html"));
    assert.ok(report, `no report page among ${readdirSync(folder)}`);
    return { file: path.join(folder, report), json: JSON.parse(json) };
  };
  return (design, ...options) => {
    const key = [design, ...options].join("\n");
    if (!built.has(key)) built.set(key, build(design, options));
    return built.get(key);
  };
}

// Those without WebGL: they draw still pictures of solids, which costs a fraction of what a graphics card done by hand does.
const plain = new WeakSet();

export async function launch({ webgl = true } = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [...QUIET, ...(webgl ? SOFTWARE_GL : ["--disable-gpu", "--disable-3d-apis"])],
  });
  if (!webgl) plain.add(browser);
  return browser;
}

// Opens a file in a page of its own; `complaints` fills with console errors, exceptions and requests that leave the page.
// `visit` opens another one in the same page, in half the time, its complaints from nothing.
export async function open(browser, file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  const complaints = [];
  let url;
  page.on("console", (message) => {
    // That there is no WebGL is what the browser itself says of one without.
    if (plain.has(browser) && message.text().includes("WebGL")) return;
    if (message.type() === "error") complaints.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => complaints.push(`exception: ${error.message}`));
  page.on("dialog", (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on("request", (request) => {
    if (request.url() !== url && !/^(data|blob):/.test(request.url())) complaints.push(`request: ${request.url()}`);
  });
  const visit = async (another) => {
    complaints.length = 0;
    url = pathToFileURL(another).href;
    // A busy machine without a graphics card takes its time.
    await page.goto(url, { timeout: 120000 });
    await page.waitForSelector("html[data-ready]", { timeout: 120000 });
    await drawn(page);
  };
  await visit(file);
  return { page, complaints, visit };
}

// Waits until what has changed is on the canvases.
export function drawn(page) {
  return page.evaluate(() => new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
  }));
}
