// The titles of saved figures, whatever the length of a design's name and the width of the screen.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { builder, launch, open } from "./browser.mjs";

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

// How far every text and curve of a drawing reaches, and its bold lines joined.
const measured = (page, svg) => page.evaluate((text) => {
  const holder = document.createElement("div");
  holder.style.cssText = "position: absolute; left: 0; top: 0";
  holder.innerHTML = text;
  document.body.append(holder);
  const drawing = holder.firstElementChild;
  const whole = drawing.getBoundingClientRect();
  const texts = [...drawing.querySelectorAll("text")].map((node) => {
    const box = node.getBoundingClientRect();
    return { text: node.textContent, bold: node.getAttribute("font-weight") === "600",
      left: box.left - whole.left, right: whole.right - box.right, top: box.top - whole.top, bottom: whole.bottom - box.bottom };
  });
  holder.remove();
  return { texts, title: texts.filter(({ bold }) => bold).map((one) => one.text).join(" ") };
}, svg);

const NAMES = {
  short: "Chute",
  words: "Materialrutsche unter dem Becherwerk, Bauabschnitt zwei, mit Absperrschieber und Verschleissblechen, Achse 14",
  word: "W".repeat(200),
};

test("a saved figure tells the whole name and what it shows, within the picture", async () => {
  for (const [key, name] of Object.entries(NAMES)) {
    const file = path.join(work, `${key}.yaml`);
    writeFileSync(file, `${readFileSync(shipped, "utf8").replace(/^name:.*$/m, `name: ${name}`)}`);
    const { file: report } = build(file);
    for (const width of [390, 1280]) {
      const { page, complaints } = await open(browser, report, { viewport: { width, height: 800 } });
      for (const [figure, quantity] of [["Normal load", "normal load"], ["Profile", "profile, to scale"]]) {
        const { texts, title } = await measured(page, await saved(page, `Save ${figure} as SVG`));
        const joined = key === "word" ? title.replaceAll("W ", "W") : title;
        assert.equal(joined, `${name}: ${quantity}`, `${key} at ${width}`);
        for (const { text, left, right, top, bottom } of texts) {
          assert.ok(Math.min(left, right, top, bottom) >= -0.5, `${figure} at ${width}: "${text}" lies ${left} ${right} ${top} ${bottom} inside`);
        }
      }
      assert.deepEqual(complaints, []);
      await page.close();
    }
  }
});
