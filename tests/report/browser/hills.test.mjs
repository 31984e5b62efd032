// Hills side by side as a planner chooses among them, in a real browser. Needs GLISSADE (the program) and Debian's chromium.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { launch, open } from "./browser.mjs";

const hills = path.join(path.dirname(fileURLToPath(import.meta.url)), "../../../designs/hills");
const work = mkdtempSync(path.join(tmpdir(), "glissade-hills-"));
const file = path.join(work, "hills.html");
// The redesign is searched for, which takes time; all others are certificates.
const designs = readdirSync(hills).filter((name) => name.endsWith(".yaml") && !name.includes("redesign"));

let browser;
let page; // one for all tests but those that read the page in another way
let complaints;
let visit;
before(async () => {
  execFileSync(process.env.GLISSADE, ["compare", ...designs.map((name) => path.join(hills, name)), "--html", file]);
  browser = await launch({ webgl: false });
  ({ page, complaints, visit } = await open(browser, file));
});
after(async () => {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
});

const column = (page, index) => page.evaluate((i) => [...document.querySelectorAll("tbody tr")]
  .filter((row) => getComputedStyle(row).display !== "none").map((row) => row.cells[i].textContent), index);
const headings = (page) => page.evaluate(() => [...document.querySelectorAll("thead th")].map((head) => head.textContent));
const heading = (page, text) => page.locator("thead th button", { hasText: text });
const lines = (page) => page.evaluate(() => [...document.querySelectorAll("figure svg path.line")]
  .filter((line) => getComputedStyle(line).display !== "none").length);

test("a heading sorts by its numbers, up, down and back, by mouse and by keyboard", async () => {
  await visit(file);
  const drop = (await headings(page)).indexOf("drop [m]");
  assert.ok(drop > 0);
  const before = await column(page, drop);
  assert.equal(before.length, designs.length);
  const rising = before.map(Number).sort((a, b) => a - b);
  await heading(page, "drop [m]").click();
  assert.deepEqual((await column(page, drop)).map(Number), rising);
  assert.equal(await page.locator("thead th").nth(drop).getAttribute("aria-sort"), "ascending");
  await heading(page, "drop [m]").focus();
  await page.keyboard.press("Enter");
  assert.deepEqual((await column(page, drop)).map(Number), rising.reverse());
  assert.equal(await page.locator("thead th").nth(drop).getAttribute("aria-sort"), "descending");
  await page.keyboard.press("Space");
  assert.deepEqual(await column(page, drop), before);
  assert.equal(await page.locator("[aria-sort]").count(), 0);
  assert.deepEqual(complaints, []);
});

test("hills without a value come last, whichever way", async () => {
  await visit(file);
  const gates = (await headings(page)).indexOf("gates");
  const missing = (await column(page, gates)).filter((text) => text === "-").length;
  assert.ok(missing > 0);
  for (let turn = 0; turn < 2; turn += 1) {
    await heading(page, "gates").click();
    assert.deepEqual((await column(page, gates)).slice(-missing), Array(missing).fill("-"));
  }
});

test("a box takes a hill out of the table and every figure, by mouse and by keyboard, and its address remembers it", async () => {
  await visit(file);
  const all = await lines(page);
  const name = (await column(page, 0))[1];
  await page.locator("label[for=choose-2]").click();
  assert.ok(!(await column(page, 0)).includes(name));
  const without = await lines(page);
  // Profile, slope, speed and load; the gates where the hill has them.
  assert.ok(all - without === 4 || all - without === 5, `${all} lines, then ${without}`);
  assert.equal(await page.locator(".choices output").textContent(), `${designs.length - 1} of ${designs.length} shown`);
  await page.reload();
  assert.equal(await lines(page), without);
  await page.locator("#choose-2").focus();
  await page.keyboard.press("Space");
  assert.equal(await lines(page), all);
  await page.getByRole("button", { name: "show none" }).click();
  assert.equal(await lines(page), 0);
  await page.getByRole("button", { name: "show all" }).click();
  assert.equal(await lines(page), all);
  assert.deepEqual(complaints, []);
});

test("a hill that is followed stands out in every figure, and can be left alone", async () => {
  await visit(file);
  await page.locator("tbody th button").nth(2).focus();
  await page.keyboard.press("Enter");
  const faint = await page.evaluate(() => [...document.querySelectorAll("figure svg path.line")].map((line) => [
    line.classList.contains("choice-3"), Number(getComputedStyle(line).opacity)]));
  for (const [followed, opacity] of faint) assert.equal(opacity === 1, followed);
  assert.equal(await page.locator("tbody th button").nth(2).getAttribute("aria-pressed"), "true");
  await page.getByRole("button", { name: "only the followed one" }).click();
  assert.equal((await column(page, 0)).length, 1);
  assert.deepEqual(complaints, []);
});

test("no two hills are drawn alike, and each alike in every figure", async () => {
  await visit(file);
  const styles = await page.evaluate(() => [...document.querySelectorAll("figure svg path.line, .choices path")].map((line) => [
    (line.closest("label")?.htmlFor ?? line.getAttribute("class")).match(/\d+/)[0],
    `${line.getAttribute("stroke")} ${line.getAttribute("stroke-dasharray")}`]));
  const style = new Map();
  for (const [hill, own] of styles) {
    assert.equal(style.get(hill) ?? own, own);
    style.set(hill, own);
  }
  assert.equal(style.size, designs.length);
  assert.equal(new Set(style.values()).size, designs.length);
});

test("on a phone nothing runs off the page, names stay while numbers are scrolled, and fingers find the buttons", async () => {
  const { page } = await open(browser, file, { viewport: { width: 390, height: 800 }, hasTouch: true, isMobile: true });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  const name = page.locator("tbody th").first();
  const left = (await name.boundingBox()).x;
  await page.evaluate(() => document.querySelector(".scroll").scrollBy(400, 0));
  assert.ok(await page.evaluate(() => document.querySelector(".scroll").scrollLeft > 100));
  assert.ok(Math.abs((await name.boundingBox()).x - left) < 12);
  for (const one of await page.locator(".choices label, .choices button").all()) {
    assert.ok((await one.boundingBox()).height >= 44);
  }
  await page.locator("label[for=choose-1]").tap();
  assert.equal((await column(page, 0)).length, designs.length - 1);
  await page.close();
});

test("without scripts the boxes still choose", async () => {
  const page = await browser.newPage({ javaScriptEnabled: false });
  await page.goto(`file://${file}`);
  assert.equal(await page.locator("tbody tr:visible").count(), designs.length);
  await page.locator("label[for=choose-2]").click();
  assert.equal(await page.locator("tbody tr:visible").count(), designs.length - 1);
  await page.close();
});

test("an address that says nonsense is taken for none", async () => {
  await visit(file);
  await page.goto(`file://${file}#sort=99&without=x.-1.400&follow=zzz`);
  await page.reload();
  assert.equal((await column(page, 0)).length, designs.length);
  assert.equal(await page.locator("[aria-sort]").count(), 0);
  assert.deepEqual(complaints, []);
});
