#!/usr/bin/env bash
# Draws docs/images/report.png anew: the upper part of the shipped grain chute's report. Needs what ./test installs.
set -eu
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
./run build designs/grain_chute.yaml -q -o "$scratch"
node --input-type=module - "$PWD" "$scratch/report.html" <<'SCRIPT'
const [, , project, file] = process.argv;
const { launch, open } = await import(`${project}/tests/report/browser/browser.mjs`);
const browser = await launch();
const { page } = await open(browser, file, { viewport: { width: 1240, height: 2400 } });
const box = async (id) => page.locator(id).boundingBox();
const end = await box("#profile");
await page.screenshot({
  path: `${project}/docs/images/report.png`, fullPage: true,
  clip: { x: 0, y: 0, width: 1240, height: Math.ceil(end.y + end.height + 8) },
});
await browser.close();
SCRIPT
