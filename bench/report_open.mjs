// How long reports take from opening the file until everything is drawn, in headless Chromium with software WebGL:
//   node bench/report_open.mjs REPORT.html...
// Needs the packages of lib/src/report/web (npm ci there).
import { statSync } from "node:fs";
import path from "node:path";
import { launch, open } from "../tests/report/browser/browser.mjs";

const kRuns = 5;
const browser = await launch();
for (const file of process.argv.slice(2)) {
  const seconds = [];
  for (let run = 0; run < kRuns; run += 1) {
    const start = performance.now();
    const { page } = await open(browser, path.resolve(file));
    seconds.push((performance.now() - start) / 1000);
    await page.close();
  }
  seconds.sort((a, b) => a - b);
  const megabytes = statSync(file).size / 1e6;
  console.log(`${file}: ${megabytes.toFixed(2)} MB, opens in ${seconds[(kRuns - 1) / 2].toFixed(2)} s `
    + `(median of ${kRuns}, ${seconds[0].toFixed(2)} to ${seconds.at(-1).toFixed(2)} s)`);
}
await browser.close();
