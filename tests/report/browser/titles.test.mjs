// The texts of saved figures, whatever the length of a design's name and the width of the screen.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { builder, drawn, launch, open } from "./browser.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const shipped = path.join(here, "../../../designs/grain_chute.yaml");
const work = mkdtempSync(path.join(tmpdir(), "glissade-titles-"));
const build = builder(process.env.GLISSADE, work);

let browser;
before(async () => {
  browser = await launch({ webgl: false });
});
after(async () => {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
});

const saved = async (page, name) => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name, exact: true }).click()]);
  return readFileSync(await download.path(), "utf8");
};

// How far every text of a drawing lies within it, and its bold lines joined, and those of its small print.
const measured = (page, svg) => page.evaluate((text) => {
  const holder = document.createElement("div");
  holder.style.cssText = "position: absolute; left: 0; top: 0";
  holder.innerHTML = text;
  document.body.append(holder);
  const drawing = holder.firstElementChild;
  const whole = drawing.getBoundingClientRect();
  const texts = [...drawing.querySelectorAll("text")].map((node) => {
    const box = node.getBoundingClientRect();
    return { text: node.textContent, bold: node.getAttribute("font-weight") === "600", small: node.getAttribute("font-size") === "11",
      left: box.left - whole.left, right: whole.right - box.right, top: box.top - whole.top, bottom: whole.bottom - box.bottom };
  });
  holder.remove();
  const joined = (kind) => texts.filter((one) => one[kind]).map((one) => one.text).join(" ");
  return { texts, title: joined("bold"), note: joined("small") };
}, svg);

function assertWithin(texts, figure) {
  for (const { text, left, right, top, bottom } of texts) {
    assert.ok(Math.min(left, right, top, bottom) >= -0.5, `${figure}: "${text}" lies ${left} ${right} ${top} ${bottom} inside`);
  }
}

const NAMES = {
  short: "Chute",
  words: "Materialrutsche unter dem Becherwerk, Bauabschnitt zwei, mit Absperrschieber und Verschleissblechen, Achse 14",
  word: "W".repeat(200),
};

test("a saved figure tells the whole name and what it shows, within the picture", async () => {
  const { page, complaints, visit } = await open(browser, build(shipped).file);
  for (const [key, name] of Object.entries(NAMES)) {
    const file = path.join(work, `${key}.yaml`);
    writeFileSync(file, `${readFileSync(shipped, "utf8").replace(/^name:.*$/m, `name: ${name}`)}`);
    const { file: report } = build(file);
    for (const width of process.env.CI ? [390, 1280] : [390]) {
      await page.setViewportSize({ width, height: 800 });
      await visit(report);
      for (const [figure, quantity] of [["Normal load", "normal load"], ["Profile", "profile, to scale"]]) {
        const { texts, title } = await measured(page, await saved(page, `Save ${figure} as SVG`));
        const joined = key === "word" ? title.replaceAll("W ", "W") : title;
        assert.equal(joined, `${name}: ${quantity}`, `${key} at ${width}`);
        assertWithin(texts, `${figure} at ${width}`);
      }
      assert.deepEqual(complaints, []);
    }
  }
  await page.close();
});

// What a button would save: a browser refuses more than ten downloads in a second.
const unsaved = (page, name) => page.evaluate(async (label) => {
  const { createObjectURL } = URL;
  const { click } = HTMLAnchorElement.prototype;
  let blob = null;
  URL.createObjectURL = (one) => createObjectURL.call(URL, blob = one);
  HTMLAnchorElement.prototype.click = () => {};
  [...document.querySelectorAll("button.export")].find((one) => one.getAttribute("aria-label") === label).click();
  Object.assign(URL, { createObjectURL });
  Object.assign(HTMLAnchorElement.prototype, { click });
  return blob.text();
}, name);

// What saves a figure, of those that are shown.
const figures = async (page) => {
  const names = await page.getByRole("button", { name: /^Save .* as SVG$/ }).evaluateAll((all) =>
    all.filter((one) => one.checkVisibility()).map((one) => one.getAttribute("aria-label")));
  assert.ok(names.length >= 7, names.join(", "));
  return names;
};

// A friction range and a stream, a free finish with limits, and gates: every legend and note that there is.
const DESIGNS = { range: "powder_chute_with_stream.yaml", limits: "grain_chute_with_limits.yaml", gates: "hills/lahti_hs130.yaml" };
const NOTED = { Speed: true, "Burden depth": true, "Pressure on the floor": true, "Wear factor of the floor": true, "Normal load": true };

test("every text of every figure saved on a phone lies within the picture", async () => {
  for (const [key, design] of Object.entries(DESIGNS)) {
    const { file: report } = build(path.join(here, "../../../designs", design));
    const { page, complaints } = await open(browser, report, { viewport: { width: 390, height: 800 } });
    for (const width of process.env.CI ? [390, 360, 320] : [320]) {
      await page.setViewportSize({ width, height: 800 });
      await drawn(page);
      for (const figure of await figures(page)) {
        const { texts, note } = await measured(page, await unsaved(page, figure));
        assertWithin(texts, `${key}, ${figure} at ${width}`);
        if (key === "gates") continue;
        const banded = NOTED[figure.slice("Save ".length, -" as SVG".length)];
        const wanted = figure.includes("Profile") ? "" : `at nominal friction${banded ? "; dashed: low and high friction" : ""}`;
        assert.equal(note, wanted, `${key}, ${figure} at ${width}`);
      }
    }
    assert.deepEqual(complaints, []);
    await page.close();
  }
});

test("every measure of every part lies within its drawing", async () => {
  const { file: report } = build(path.join(here, "../../../designs/grain_chute_fabricated.yaml"));
  const { page, complaints } = await open(browser, report, { viewport: { width: 360, height: 800 } });
  const rows = page.locator("table.parts tbody tr");
  // A leg is tall and narrow.
  let narrow = 0;
  for (const name of await rows.locator("th").allTextContents()) {
    if (!(process.env.CI ? /^(leg|floor|wall|end)/ : /^(leg|end)/).test(name)) continue;
    await rows.filter({ has: page.locator("th", { hasText: new RegExp(`^${name}$`) }) }).first().click();
    const [save] = await page.locator("#part").getByRole("button", { name: /as SVG$/ }).evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
    const { texts } = await measured(page, await unsaved(page, save));
    assert.ok(texts.length >= 2, name);
    assertWithin(texts, name);
    narrow += name.startsWith("leg");
  }
  assert.ok(narrow >= 4, `${narrow} legs`);
  assert.deepEqual(complaints, []);
  await page.close();
});
