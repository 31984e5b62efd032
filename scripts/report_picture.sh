#!/usr/bin/env bash
# Draws docs/images/report.png and parts.png anew: the upper part of the shipped grain chute's report, and the parts of the
# fabricated one with a wall chosen. Needs what ./test installs.
set -eu
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for design in grain_chute grain_chute_fabricated; do
  ./run build "designs/$design.yaml" -q -o "$scratch"
done
node --input-type=module - "$PWD" "$scratch" <<'SCRIPT'
const [, , project, scratch] = process.argv;
const { drawn, launch, open } = await import(`${project}/tests/report/browser/browser.mjs`);
const browser = await launch();
const page_of = async (name, height) =>
  (await open(browser, `${scratch}/${name}.report.html`, { viewport: { width: 1240, height } })).page;
const box = async (page, id) => page.locator(id).boundingBox();

const report = await page_of("grain_chute", 2400);
const end = await box(report, "#profile");
await report.screenshot({
  path: `${project}/docs/images/report.png`, fullPage: true,
  clip: { x: 0, y: 0, width: 1240, height: Math.ceil(end.y + end.height + 8) },
});

const parts = await page_of("grain_chute_fabricated", 900);
await parts.evaluate(() => {
  const { parts: section } = window.glissadeReport;
  section.choose(section.parts.findIndex((part) => part.name === "wall_2"));
});
await drawn(parts);
const start = await box(parts, "#parts");
const list = await box(parts, "#parts .lists");
await parts.screenshot({
  path: `${project}/docs/images/parts.png`, fullPage: true,
  clip: { x: start.x, y: start.y, width: start.width, height: Math.ceil(list.y - start.y) },
});
await browser.close();
SCRIPT
