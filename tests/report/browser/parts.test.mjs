// The page of the parts as a workshop meets it, in a real browser. Needs GLISSADE (the program) and Debian's chromium.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { fileURLToPath } from "node:url";
import { builder, drawn, launch, open, SMALL } from "./browser.mjs";

const designs = path.join(path.dirname(fileURLToPath(import.meta.url)), "../../../designs");
const work = mkdtempSync(path.join(tmpdir(), "glissade-parts-"));
const build = builder(process.env.GLISSADE, work);

let browser;
let made;
let view; // one page for all of them: it opens the next one in half the time
before(async () => {
  browser = await launch();
  made = build(path.join(designs, "grain_chute_fabricated.yaml"));
});
after(async () => {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
});

// Volume and centre of a closed surface by its facets, on the data as the page unpacks it.
const measured = (page) => page.evaluate(() => {
  const { parts: { bodies } } = window.glissadeReport;
  return bodies.map(({ positions, indices, places: [place] }) => {
    let volume = 0;
    const first = [0, 0, 0];
    const corner = (i) => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
    for (let t = 0; t < indices.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => corner(indices[t + k]));
      const six = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      volume += six / 6;
      [0, 1, 2].forEach((axis) => {
        first[axis] += (six / 24) * (a[axis] + b[axis] + c[axis]);
      });
    }
    const [x, y, z] = first.map((moment) => moment / volume);
    return { volume, centre: [0, 1, 2].map((axis) => place.origin[axis] + x * place.x[axis] + y * place.y[axis] + z * place.z[axis]) };
  });
});

describe("every process", () => {
  // The last one stays open for the tests below.
  for (const name of ["grain_chute_with_limits_bent", "powder_chute_mitred", "marble_run_printed", "sand_ski_ramp_in_timber", "grain_chute_fabricated"]) {
    test(`${name}: the page has the bodies of --json, each piece in its place`, async () => {
      const { file, json } = name === "grain_chute_fabricated" ? made : build(path.join(designs, `${name}.yaml`));
      if (view) await view.visit(file);
      view ??= await open(browser, file, SMALL);
      const { page, complaints } = view;
      const doc = await page.evaluate(() => window.glissadeReport.document.fabrication);
      assert.equal(doc.parts.length, json.parts.length);
      const pieces = await page.evaluate(() => window.glissadeReport.parts.bodies.map((body) => body.places.length));
      assert.deepEqual(pieces, json.parts.map((part) => part.quantity));
      (await measured(page)).forEach(({ volume, centre }, i) => {
        const part = json.parts[i];
        // Holes of liners and covers are not in the bodies; chords cut corners off.
        assert.ok(Math.abs(volume / part.volume_m3 - 1) < 0.06, `${part.name}: ${volume} against ${part.volume_m3} m3`);
        centre.forEach((value, axis) => {
          const wanted = part.centre_of_gravity_m[axis] - doc.view.origin_m[axis];
          assert.ok(Math.abs(value - wanted) < 5e-3, `${part.name}, axis ${axis}: ${value} against ${wanted}`);
        });
      });
      assert.ok(statSync(file).size < 4e6, "smaller than 4 MB");
      await page.locator("table.parts tbody tr").last().click();
      assert.ok(await page.locator("#part svg").isVisible());
      assert.deepEqual(complaints, []);
    });
  }
});

describe("parts of a workshop", () => {
  let page;
  before(() => {
    ({ page } = view);
  });

  const chosen = () => page.evaluate(() => window.glissadeReport.store.get("part"));

  test("have what is not as asked for above them and among the warnings, and notes below", async () => {
    const { shortfalls, notes, warnings } = made.json;
    assert.ok(shortfalls.length > 0 && notes.length > 0);
    const told = (issues) => issues.map(({ what, why, hint }) => what + why + (hint ? `Try: ${hint}` : ""));
    assert.deepEqual(await page.locator("#parts .warnings li").allTextContents(), told(shortfalls));
    assert.deepEqual(await page.locator("#summary .warnings li").allTextContents(), told(warnings));
    assert.deepEqual(await page.locator("#parts .shop-notes li").allTextContents(), notes);
  });

  test("are chosen by a click on the picture, by keys and from the list", async () => {
    // A place of the picture that shows a wall, by what lies below the pointer.
    const canvas = page.locator("#parts-view");
    await canvas.scrollIntoViewIfNeeded();
    const at = await canvas.evaluate((node) => {
      const { parts } = window.glissadeReport;
      const wall = parts.parts.findIndex((part) => part.name.startsWith("wall"));
      const { left, top, width, height } = node.getBoundingClientRect();
      for (let y = 0.02; y < 1; y += 0.02) {
        for (let x = 0.02; x < 1; x += 0.02) {
          const event = { clientX: left + x * width, clientY: top + y * height };
          if (parts.view.partAt(event) === wall) return { x: x * width, y: y * height, wall };
        }
      }
      return null;
    });
    assert.ok(at, "a wall is in the picture");
    await canvas.click({ position: { x: at.x, y: at.y } });
    assert.equal(await chosen(), at.wall);
    const part = made.json.parts[at.wall];
    assert.equal(await page.locator("#part h3").textContent(), `${part.number} ${part.name.replaceAll("_", " ")}`);
    assert.equal(await page.locator("table.parts tr.chosen th").textContent(), part.name);
    await canvas.press("n");
    assert.equal(await chosen(), at.wall + 1);
    await canvas.press("p");
    await canvas.press("p");
    assert.equal(await chosen(), at.wall - 1);
    await canvas.press("Escape");
    assert.equal(await chosen(), null);
    assert.equal(await page.locator("#part svg").count(), 0);
    await page.locator("table.parts tbody tr").last().click();
    assert.equal(await chosen(), made.json.parts.length - 1);
    await page.locator("#parts select").first().selectOption("0");
    assert.equal(await page.locator("table.parts tr.chosen th").textContent(), made.json.parts[0].name);
  });

  test("show pattern, row and files of the one that is chosen", async () => {
    const doc = await page.evaluate(() => window.glissadeReport.document.fabrication);
    for (const [i, part] of made.json.parts.entries()) {
      const { pattern } = doc.parts[i];
      if (!["floor_1", "wall_1", "end_frame", "left_wall", "leg_1"].includes(part.name)) continue;
      await page.locator("#parts select").first().selectOption(String(i));
      const text = await page.locator("#part .part-facts").textContent();
      assert.ok(text.includes(part.material) && text.includes(`Pieces${part.quantity}`), text);
      if (pattern === null) {
        assert.ok((await page.locator("#part svg .edge").count()) > 1, `${part.name}: views of what has no pattern`);
      } else {
        assert.equal(await page.locator("#part svg .hole").count(), pattern.holes_m.length);
        assert.equal(await page.locator("#part svg .roll").count(), pattern.rolls.length);
      }
      const links = await page.locator("#part .part-files a").evaluateAll((all) => all.map((link) => link.getAttribute("href")));
      assert.deepEqual(links.map(decodeURIComponent), part.files);
      links.forEach((link) => assert.ok(statSync(path.join(path.dirname(made.file), decodeURIComponent(link))).size > 0));
    }
  });

  test("have patterns to scale, whose area times thickness is the volume of a flat plate", async () => {
    const doc = await page.evaluate(() => window.glissadeReport.document.fabrication);
    const i = doc.parts.findIndex(({ name }) => name === "wall_1");
    await page.locator("#parts select").first().selectOption(String(i));
    const [area, box, shown] = await page.evaluate(() => {
      const sheet = document.querySelector("#part svg .sheet");
      const { width, height } = sheet.getBBox();
      const length = sheet.getTotalLength();
      const points = Array.from({ length: 4000 }, (_, k) => sheet.getPointAtLength((length * k) / 4000));
      let twice = 0;
      points.forEach((to, k) => {
        const from = points.at(k - 1);
        twice += from.x * to.y - to.x * from.y;
      });
      const measures = [...document.querySelectorAll("#part svg .measure")].map((node) => Number.parseFloat(node.textContent));
      return [Math.abs(twice / 2), { width, height }, measures];
    });
    const scale = shown[0] / box.width;  // mm of the plate to one of the drawing
    assert.ok(Math.abs(scale - shown[1] / box.height) < 5e-3 * scale, `${scale} along, ${shown[1] / box.height} across`);
    const volume = area * scale * scale * 1e-6 * doc.parts[i].thickness_m;
    assert.ok(Math.abs(volume / doc.parts[i].volume_m3 - 1) < 5e-3, `${volume} against ${doc.parts[i].volume_m3}`);
  });

  test("lie on pictures of the sheets of stock, where a click chooses them, too", async () => {
    const { nests } = made.json;
    assert.equal(await page.locator(".nest").count(), nests.length);
    assert.equal(await page.locator(".nest .sheet").count(), nests.reduce((sum, nest) => sum + nest.pieces, 0));
    const captions = await page.locator(".nest-holder figcaption").allTextContents();
    captions.forEach((text, i) => {
      assert.ok(text.includes(`${nests[i].material}, `) && text.includes("% used"), text);
      const used = Number(text.match(/([0-9.]+)\u00a0% used/)[1]);
      assert.ok(Math.abs(used - 100 * nests[i].utilisation) < 0.06 * Math.max(1, used / 10), `${used} against ${nests[i].utilisation}`);
    });
    // Each piece is drawn inside its sheet.
    const outside = await page.evaluate(() => [...document.querySelectorAll(".nest")].flatMap((svg) => {
      const stock = svg.querySelector(".stock").getBBox();
      return [...svg.querySelectorAll(".sheet")].map((shape) => shape.getBBox()).filter((box) => box.x < stock.x - 0.02 || box.y < stock.y - 0.02
        || box.x + box.width > stock.x + stock.width + 0.02 || box.y + box.height > stock.y + stock.height + 0.02);
    }));
    assert.deepEqual(outside, []);
    const last = nests.at(-1).parts.at(-1).number;
    await page.locator(`.nest .sheet[data-part="${last}"]`).first().click();
    assert.equal(made.json.parts[await chosen()].number, last);
    const marked = await page.locator(".nest .sheet.chosen").evaluateAll((all) => all.map((shape) => Number(shape.dataset.part)));
    assert.ok(marked.length > 0 && marked.every((number) => number === last), String(marked));
    const files = await page.locator(".nest-holder a").evaluateAll((all) => all.map((link) => decodeURIComponent(link.getAttribute("href"))));
    assert.deepEqual(files, nests.map((nest) => nest.file));
  });

  test("are drawn apart by a slider, and one of them alone", async () => {
    const spread = async (share) => {
      await page.locator("#apart").fill(String(share));
      await drawn(page);
      return page.evaluate(() => {
        const { min, max } = window.glissadeReport.parts.view.box;
        return [max.x - min.x, max.y - min.y, max.z - min.z];
      });
    };
    const together = await spread(0);
    const apart = await spread(1);
    apart.forEach((side, axis) => assert.ok(side > 1.15 * together[axis], `${together} against ${apart}`));
    assert.ok(Math.abs(together[1] - 0.6) < 0.4, `chute and trestles are ${together[1]} m wide`);
    const alone = page.getByLabel("this part alone");
    await alone.check();
    const visible = () => page.evaluate(() => window.glissadeReport.parts.view.groups.filter((group) => group.visible).length);
    assert.equal(await visible(), 1);
    await alone.uncheck();
    assert.equal(await visible(), made.json.parts.length);
  });

  test("fit a phone and paper, and print what is chosen", async () => {
    for (const [width, media] of [[390, "screen"], [718, "print"]]) {
      await page.setViewportSize({ width, height: 900 });
      await page.emulateMedia({ media });
      await drawn(page);
      const stick = await page.evaluate(() => [...document.querySelectorAll("#parts, #part, #part svg, #parts-view, #parts .scroll")]
        .filter((node) => node.getBoundingClientRect().right > innerWidth + 1).map((node) => node.id || node.className));
      assert.deepEqual(stick, [], `at ${width}`);
      assert.ok(await page.locator("#part svg").isVisible());
    }
    await page.emulateMedia({ media: "screen" });
    await page.setViewportSize(SMALL.viewport);
  });

  test("are drawn and chosen without WebGL, too", async (t) => {
    const plain = await launch({ webgl: false });
    t.after(() => plain.close());
    const { page, complaints } = await open(plain, made.file, SMALL);
    assert.equal(await page.locator("#parts").getAttribute("data-still"), "true");
    await page.locator("#parts-view").scrollIntoViewIfNeeded();
    const at = await page.locator("#parts-view").evaluate((node) => {
      const { parts } = window.glissadeReport;
      const partAt = (x, y) => parts.partOf[parts.facetAt(x, y)];
      // Off its edges: the page places the picture to fractions of a pixel, a click goes to whole ones.
      const inside = (x, y, part) => [-3, 3].every((by) => partAt(x + by, y) === part && partAt(x, y + by) === part);
      for (let y = 10; y < node.height; y += 6) {
        for (let x = 10; x < node.width; x += 6) {
          const part = partAt(x, y);
          if (part !== undefined && inside(x, y, part)) return { x, y, part };
        }
      }
      return null;
    });
    await page.locator("#parts-view").click({ position: { x: at.x, y: at.y } });
    assert.equal(await page.evaluate(() => window.glissadeReport.store.get("part")), at.part);
    assert.deepEqual(complaints, []);
  });
});
