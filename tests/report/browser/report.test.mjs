// The page as a reader meets it, in a real browser. Needs GLISSADE (the program) and Debian's chromium.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, afterEach, before, describe, test } from "node:test";
import { fileURLToPath } from "node:url";
import { builder, drawn, launch, open, SMALL } from "./browser.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const designs = path.join(here, "../../../designs");
const program = process.env.GLISSADE;
const work = mkdtempSync(path.join(tmpdir(), "glissade-report-"));
const build = builder(program, work);
const shipped = readdirSync(designs).filter((name) => name.endsWith(".yaml")).sort();

const nearly = (a, b, what) => assert.ok(Math.abs(a - b) <= 1e-9 * Math.max(Math.abs(a), Math.abs(b), 1e-12), `${what}: ${a} against ${b}`);

// A count as the whole page writes it.
const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");

let browser;
let plain; // without WebGL
let chute;
before(async () => {
  [browser, plain] = await Promise.all([launch(), launch({ webgl: false })]);
  chute = build(path.join(designs, "grain_chute.yaml"));
});
after(async () => {
  await Promise.all([browser.close(), plain.close()]);
  rmSync(work, { recursive: true, force: true });
});

describe("every shipped design", () => {
  // One page with and one without WebGL for all of them.
  let turning;
  let still;
  before(async () => {
    turning = await open(browser, chute.file, SMALL);
    still = await open(plain, chute.file, SMALL);
  });
  after(() => Promise.all([turning.page.close(), still.page.close()]));

  // Outside continuous integration every thirteenth of them; the second of each two is turned in the view, which takes most of
  // the time where what a graphics card would draw is drawn by hand, the other is the still picture that readers without
  // WebGL meet.
  const every = process.env.CI ? 1 : 13;
  for (const [i, name] of shipped.filter((_, at) => at % every === 0).entries()) {
    test(`${name}: the page opens without complaint and tells what --json tells`, async () => {
      const { file, json } = name === "grain_chute.yaml" ? chute : build(path.join(designs, name));
      const turned = Boolean(process.env.CI) || i % 2 === 1;
      const { page, complaints, visit } = turned ? turning : still;
      await visit(file);
      if (json.mesh) assert.equal(await page.locator("#solid").getAttribute("data-still"), turned ? null : "true");
      const doc = await page.evaluate(() => JSON.parse(document.getElementById("glissade-data").textContent));
      assert.deepEqual(complaints, []);
      for (const key of ["travel_time_s", "exit_speed_m_per_s", "exit_slope_angle_deg", "arc_length_m", "max_normal_load_m_per_s2"]) {
        nearly(doc.ride[key], json[key], key);
      }
      assert.equal(doc.mesh.triangles, json.mesh.triangles);
      assert.ok(doc.checks.every((check) => check.verdict !== "fail"), JSON.stringify(doc.checks));
      assert.ok(statSync(file).size < 10e6, "smaller than 10 MB");
      assert.equal(await page.title(), doc.design.name);
      // On a phone the page is no wider than its room: names of files have no place to break.
      await page.setViewportSize({ width: 360, height: SMALL.viewport.height });
      await drawn(page);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 360, "wider than a phone");
      await page.setViewportSize(SMALL.viewport);
    });
  }
});

describe("a solid of a million facets", () => {
  test("has a report smaller than 10 MB, whose view says how many facets it shows", { skip: !process.env.CI && "takes seconds: in continuous integration" }, async () => {
    const { file, json } = build(path.join(designs, "powder_chute.yaml"), "--set", "mesh.tolerance=0.003mm", "--set", "export=[stl]");
    assert.ok(json.mesh.triangles > 1e6, `${json.mesh.triangles} facets`);
    assert.ok(statSync(file).size < 10e6, `${statSync(file).size} bytes`);
    const { page, complaints } = await open(plain, file, SMALL);
    assert.match(await page.locator("#solid").textContent(), new RegExp(`The files hold ${grouped(json.mesh.triangles)} facets; this view shows`));
    assert.deepEqual(complaints, []);
    await page.close();
  });
});

// How many colours the view of the solid has, and how much of it is no background.
const coloursOf = (canvas) => {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  const seen = new Map();
  for (let i = 0; i < data.length; i += 4) {
    const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
    seen.set(colour, (seen.get(colour) ?? 0) + 1);
  }
  const background = Math.max(...seen.values());
  return { distinct: seen.size, drawn: 1 - background / (data.length / 4) };
};
const colours = async (page) => {
  await drawn(page);
  return page.locator("#view").evaluate(coloursOf);
};

describe("plots and profile", () => {
  // One page for all of them: each test leaves it as it was.
  let page;
  let complaints;
  before(async () => {
    ({ page, complaints } = await open(plain, chute.file));
  });
  after(() => page.close());

  test("hold the stations of the document, in the units that the axes name", async () => {
    const charts = await page.evaluate(() => window.glissadeReport.charts.map(({ chart, plot }) => ({
      id: chart.id, xs: plot.data[0], ys: plot.data[1], label: plot.axes[0].label,
    })));
    const doc = await page.evaluate(() => window.glissadeReport.document);
    const by = Object.fromEntries(charts.map((chart) => [chart.id, chart]));
    assert.deepEqual(by.speed.xs, doc.stations.arc_length_m);
    assert.deepEqual(by.speed.ys, doc.stations.speed_m_per_s);
    assert.equal(by.speed.label, "arc length s [m]");
    nearly(by.speed.ys.at(-1), chute.json.exit_speed_m_per_s, "exit speed in the plot");
    // At the vertical start the load is 0 but for rounding.
    by.load.ys.slice(1).forEach((g, i) => nearly(g * 9.80665, doc.stations.normal_load_m_per_s2[i + 1], "load in g"));
    assert.equal(by.load.ys[0], 0);
    assert.deepEqual(complaints, []);
  });

  test("switch from arc length to run and time", async () => {
    for (const [key, label] of [["time_s", "time [s]"], ["x_m", "run [m]"]]) {
      await page.getByLabel("Against").selectOption(key);
      const [xs, shown, wanted] = await page.evaluate((column) => {
        const { charts, document: doc } = window.glissadeReport;
        return [charts[0].plot.data[0], charts[0].plot.axes[0].label, doc.stations[column]];
      }, key);
      assert.deepEqual(xs, wanted);
      assert.equal(shown, label);
    }
    await page.getByLabel("Against").selectOption("arc_length_m");
  });

  test("share one cursor that the keyboard moves, and the read-out follows", async () => {
    await page.locator("#chart-slope").focus();
    await page.keyboard.press("End");
    const speed = await page.locator('#readout [data-field="speed_m_per_s"]').textContent();
    assert.ok(Math.abs(Number.parseFloat(speed) - chute.json.exit_speed_m_per_s) < 1e-4 * chute.json.exit_speed_m_per_s, speed);
    assert.match(await page.locator("#chart-load .chart-value").textContent(), /\u00a0g$/);
    const cursors = await page.evaluate(() => window.glissadeReport.charts.map(({ plot }) => Math.round(plot.cursor.left)));
    assert.equal(new Set(cursors.map((left) => left > 100)).size, 1, `cursors at ${cursors}`);
    await page.keyboard.press("Home");
    assert.match(await page.locator('#readout [data-field="arc_length_m"]').textContent(), /^0\.0+\u00a0m$/);
  });

  test("keep the cursor where it is when axis, units or theme change", async () => {
    await page.locator("#chart-slope").focus();
    await page.keyboard.press("Home");
    for (let i = 0; i < 7; i += 1) await page.keyboard.press("ArrowRight");
    for (const [label, values] of [["Against", ["time_s", "arc_length_m"]], ["Units", ["mm, m/s", "m, m/s"]], ["Theme", ["dark", "auto"]]]) {
      for (const value of values) {
        await page.getByLabel(label).selectOption(value);
        await drawn(page);
        const [station, left, wanted] = await page.evaluate(() => {
          const { store, charts: [{ plot }] } = window.glissadeReport;
          return [store.get("station"), plot.cursor.left, plot.valToPos(plot.data[0][7], "x")];
        });
        assert.equal(station, 7, `${label} ${value}`);
        assert.ok(Math.abs(left - wanted) < 1, `${label} ${value}: cursor drawn at ${left} instead of ${wanted}`);
      }
    }
  });

  test("follow the mouse across each other", async () => {
    const over = page.locator("#chart-speed .u-over");
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.5 * box.height);
    const [station, length] = await page.evaluate(() => {
      const { store, document: doc } = window.glissadeReport;
      return [doc.stations.arc_length_m[store.get("station")], doc.ride.arc_length_m];
    });
    assert.ok(Math.abs(station / length - 0.7) < 0.05, `${station} of ${length}`);
  });

  test("zoom together, and back", async () => {
    const spans = () => page.evaluate(() => window.glissadeReport.charts.map(({ plot }) => plot.scales.x.max - plot.scales.x.min));
    const whole = await spans();
    await page.locator("#chart-load").focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("+");
    const zoomed = await spans();
    zoomed.forEach((span, i) => assert.ok(span < 0.8 * whole[i], `${span} of ${whole[i]}`));
    await page.keyboard.press("0");
    assert.deepEqual(await spans(), whole);
  });

  test("split the energy without remainder at every station", async () => {
    const parts = await page.evaluate(() =>
      window.glissadeReport.charts.find(({ chart }) => chart.id === "energy").plot.data.slice(1));
    const sums = parts[0].map((_, i) => parts.reduce((sum, part) => sum + part[i], 0));
    sums.forEach((sum) => assert.ok(Math.abs(sum - sums[0]) < 1e-8 * sums[0], `${sum} against ${sums[0]}`));
  });

  test("show other units on request", async () => {
    await page.getByLabel("Units").selectOption("m, km/h");
    await page.locator("#chart-speed").focus();
    await page.keyboard.press("End");
    const text = await page.locator('#readout [data-field="speed_m_per_s"]').textContent();
    assert.match(text, /km\/h$/);
    assert.ok(Math.abs(Number.parseFloat(text) - 3.6 * chute.json.exit_speed_m_per_s) < 1e-2, text);
    await page.getByLabel("Units").selectOption("m, m/s");
  });

  test("let a body go on the track beside one on the straight line", async () => {
    await page.locator("#ride").click();
    await page.waitForFunction(() => Number.parseFloat(document.querySelector(".clock").textContent) > 0.3);
    const [track, straight] = await page.evaluate(() =>
      [".body-track", ".body-straight"].map((name) => document.querySelector(name).getAttribute("visibility")));
    assert.equal(track, "visible");
    assert.equal(straight, "visible");
    await page.locator("#ride").click();
    assert.deepEqual(complaints, []);
  });

  test("have a still picture of the solid beside them where there is no WebGL", async () => {
    assert.equal(await page.locator("#solid").getAttribute("data-still"), "true");
    const still = await colours(page);
    assert.ok(still.distinct > 50 && still.drawn > 0.02, JSON.stringify(still));
  });

  test("show the profile to scale", async () => {
    const box = await page.locator("svg.profile .line-track").evaluate((path) => {
      const { width, height } = path.getBBox();
      return { width, height };
    });
    const doc = await page.evaluate(() => window.glissadeReport.document);
    const run = Math.max(...doc.stations.x_m);
    const drop = Math.max(...doc.stations.drop_m);
    assert.ok(Math.abs(box.width / box.height - run / drop) < 0.01 * (run / drop));
  });
});

describe("solid", () => {
  let page;
  let complaints;
  before(async () => {
    ({ page, complaints } = await open(browser, chute.file, SMALL));
  });
  after(() => page.close());

  test("is drawn, and turns with the arrow keys", async () => {
    const first = await colours(page);
    assert.ok(first.distinct > 100 && first.drawn > 0.02, JSON.stringify(first));
    const shot = async () => {
      await drawn(page);
      return page.locator("#view").evaluate((canvas) => canvas.toDataURL());
    };
    const before = await shot();
    await page.locator("#view").focus();
    for (let i = 0; i < 4; i += 1) await page.keyboard.press("ArrowRight");
    assert.notEqual(await shot(), before);
    assert.deepEqual(complaints, []);
  });

  test("is cut by a section plane three ways, and coloured by load", async () => {
    const whole = await colours(page);
    for (const plane of ["Lengthwise", "Across", "Level"]) {
      await page.getByLabel("Section plane").first().selectOption(plane);
      const cut = await colours(page);
      assert.ok(cut.drawn !== whole.drawn && cut.drawn > 0.002, `${plane}: ${JSON.stringify(cut)}`);
    }
    await page.getByLabel("Colour by").selectOption("normal_load_m_per_s2");
    assert.match(await page.locator(".colour-legend").textContent(), /g/);
  });

  test("shows the sides of its bounding box beside it", async () => {
    const texts = await page.locator(".dimension").allTextContents();
    const sides = [0, 1, 2].map((axis) => chute.json.mesh.upper_m[axis] - chute.json.mesh.lower_m[axis]);
    texts.forEach((text, axis) => {
      assert.ok(Math.abs(Number.parseFloat(text.slice(2)) - sides[axis]) < 1e-3 * sides[axis], `${text} for ${sides[axis]} m`);
    });
  });

});

describe("a range of friction", () => {
  // One page for all of them, each with a design of its own.
  let view;
  before(async () => {
    view = await open(plain, build(path.join(designs, "grain_chute_with_limits.yaml")).file, SMALL);
  });
  after(() => view.page.close());

  test("a ride at another friction is held against the nominal one, not against an optimum of another friction", async () => {
    const { json } = build(path.join(designs, "grain_chute_with_limits.yaml"));
    const { page, complaints } = view;
    const told = () => page.locator("#summary dl.tiles").textContent();
    assert.match(await told(), /the exact optimum without limits/);
    for (const level of ["low", "high"]) {
      await page.locator("header select").first().selectOption(level);
      const text = await told();
      assert.ok(text.includes(`at ${level} friction`), text);
      assert.ok(text.includes(`% ${level === "low" ? "less" : "more"} than at nominal friction`), text);
      assert.ok(!text.includes("optimum") && !text.includes("straight line"), text);
    }
    assert.ok(json.rides[0].travel_time_s < json.travel_time_s);
    assert.deepEqual(complaints, []);
  });

  test("task, checks and ways through the air are those of the friction that is shown", async () => {
    const { file, json } = build(path.join(designs, "ore_transfer.yaml"));
    const { page, complaints, visit } = view;
    await visit(file);
    const summary = () => page.locator("#summary").textContent();
    const flights = () => page.evaluate(() => [...document.querySelectorAll("#profile path.flight")].map((path) => path.getAttribute("d")));
    const nominal = await flights();
    await page.locator("header select").first().selectOption("high");
    const high = json.rides.find(({ friction }) => friction === "high");
    const digits = (value) => String(Number(value.toPrecision(4)));
    const text = await summary();
    assert.match(text, new RegExp(`Friction angle${digits(high.friction_angle_deg)}\u00a0deg`));
    const entry = await page.evaluate(() => window.glissadeReport.document.rides.find(({ friction }) => friction === "high").stations.speed_m_per_s[0]);
    assert.match(text, new RegExp(`Entry speed${digits(entry)}\u00a0m/s`));
    assert.match(text, new RegExp(`lowest normal load ${digits(high.min_normal_load_m_per_s2 / 9.80665)}\u00a0g`));
    assert.notDeepEqual(await flights(), nominal);
    assert.deepEqual(complaints, []);
  });

  test("the numbers behind a check follow the units", async () => {
    const { file, json } = build(path.join(designs, "ore_transfer.yaml"));
    const { page, visit } = view;
    await visit(file);
    const units = page.locator("header label", { hasText: "Units" }).locator("select");
    await units.selectOption("mm, m/s");
    const text = await page.locator("#summary .checks").textContent();
    assert.match(text, new RegExp(`rode ${Number((1e3 * json.arc_length_m).toPrecision(4))}\u00a0mm of`));
    await units.selectOption("m, m/s, loads in m/s\u00b2");
    assert.match(await page.locator("#summary .checks").textContent(),
      new RegExp(`lowest normal load ${Number(json.min_normal_load_m_per_s2.toPrecision(4))}\u00a0m/s\u00b2`));
  });
});

describe("a design with limits", () => {
  const design = `glissade: 1
name: In-run
track: {start: {x: 0 m, z: 47.08 m}, finish: {x: 90.23 m, z: 0 m}}
body: {friction_coefficient: 0.03}
limits:
  slope_angle: {highest: 35 deg}
  entry_slope_angle: {lowest: 35 deg}
  highest_curvature_load: 7.14 m/s^2
  keep_outs:
    - {outline: [[30 m, 13 m], [40 m, 13 m], [40 m, 17 m], [30 m, 17 m]]}
cross_section: {kind: slab, width: 2 m, thickness: 100 mm}
mesh: {tolerance: 20 mm}
export: [stl]
`;

  test("shows each limit with its verdict and price, the keep-out, and the exact optimum beside the track", async () => {
    const file = path.join(work, "limited.yaml");
    writeFileSync(file, design);
    const { file: report, json } = build(file);
    const { page, complaints } = await open(plain, report, SMALL);
    const rows = await page.locator("#limits tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
    assert.equal(rows.length, json.limits.length);
    const slope = rows.find(([name]) => name === "slope angleslope_angle.highest");
    assert.equal(slope[1], "at most 35\u00a0deg");
    assert.equal(slope[4], "active");
    const price = json.limits.find(({ limit }) => limit === "slope_angle.highest");
    assert.ok(price, "the limit is among those of --json");
    // It leaves the entry slope angle one value: its price for relief is not that for tightening.
    assert.match(slope[5], /^0\.\d+ s per deg looser, no track tighter$/);
    assert.equal(price.tightening_price, null);
    const load = rows.find(([name]) => name.endsWith("highest_curvature_load"));
    assert.match(load[5], /^0\.\d+ s per g$/);
    assert.match(await page.locator("#summary .tally").textContent(), /^(\d+) of \1 checks hold/);
    // Curvature is bounded here: its plot shows all of it. That of the radius ends where the track is straight to the eye.
    const scales = await page.evaluate(() => Object.fromEntries(window.glissadeReport.charts.map(({ chart, plot }) =>
      [chart.id, { ...plot.scales.y, highest: Math.max(...plot.data[1]), lowest: Math.min(...plot.data[1]) }])));
    assert.ok(scales.curvature.max >= scales.curvature.highest && scales.curvature.min <= scales.curvature.lowest, JSON.stringify(scales.curvature));
    assert.ok(scales.radius.max <= 2.2 * json.arc_length_m, JSON.stringify(scales.radius));
    const box = await page.locator("svg.profile polygon.keep-out").evaluate((area) => {
      const { width, height } = area.getBBox();
      return width / height;
    });
    assert.ok(Math.abs(box - 10 / 4) < 0.01, `keep-out to scale: ${box}`);
    assert.equal(await page.locator("svg.profile .line-optimum").count(), 1);
    assert.deepEqual(complaints, []);
    await page.close();
  });
});

describe("a body that is no point, on a site far from its origin, over a range of friction", { skip: !process.env.CI && "takes seconds: in continuous integration" }, () => {
  const design = `glissade: 1
name: Site
track:
  start: {x: 3456789.12 m, y: 5432100.55 m, z: 2853.35 m}
  finish: {x: 3456791.62 m, y: 5432100.55 m, z: 2850.85 m}
body:
  friction_angle: {low: 14 deg, nominal: 17 deg, high: 20 deg}
  centre_height: 300 mm
  head_wind: 3 m/s
  drag: 0.01 1/m
  entry_speed: 0.5 m/s
probes: [{name: a, from_start: 10 mm}, {name: b, from_start: 70 mm}, {name: c, from_start: 1.23 m}]
centerline: {kind: fastest}
limits:
  smallest_radius: 1 m
  keep_outs:
    - {outline: [[3456789.82 m, 2853 m], [3456790.12 m, 2853 m], [3456790.12 m, 2853.3 m], [3456789.82 m, 2853.3 m]], clearance: 50 mm}
cross_section: {kind: slab, width: 400 mm, thickness: 50 mm}
mesh: {tolerance: 20 mm}
export: [stl]
`;
  let page;
  let complaints;
  let json;
  before(async () => {
    const file = path.join(work, "site.yaml");
    writeFileSync(file, design);
    const built = build(file);
    json = built.json;
    ({ page, complaints } = await open(plain, built.file, SMALL));
  });
  after(() => page.close());
  const choose = (label, value) => page.locator("header label", { hasText: label }).locator("select").selectOption(value);

  test("its task says what makes it ride as it does", async () => {
    const task = await page.locator("#summary").textContent();
    for (const text of ["Centre of mass0.3\u00a0m above the track", "Head wind3\u00a0m/s", "Drag0.01\u00a01/m"]) assert.ok(task.includes(text), text);
  });

  test("places are told to the millimetre and ticks apart, in every unit and at every zoom", async () => {
    for (const [units, factor] of [["m, m/s", 1], ["mm, m/s", 1000]]) {
      await choose("Units", units);
      const text = await page.locator("#summary").textContent();
      for (const place of [[3456789.12, 5432100.55, 2853.35], [3456791.62, 5432100.55, 2850.85]]) {
        const wanted = place.map((value) => String(Number((factor * value).toFixed(2)))).join(", ");
        assert.ok(text.includes(wanted), `${wanted} in ${text}`);
      }
      const z = await page.locator("#stations tbody tr").evaluateAll((rows) => rows.map((row) => Number(row.cells[3].textContent)));
      assert.ok(Math.abs(z.at(-1) - factor * 2850.85) < 1e-3 * factor && z.every((value, i) => value !== z[i - 1]), z.join(" "));
      for (let zoom = 0; zoom < 12; zoom += 1) {
        const axes = await page.evaluate(() => {
          const labels = [...document.querySelectorAll("svg.profile text.tick")].map((tick) => [tick.getAttribute("text-anchor"), tick.textContent, tick.getBoundingClientRect().left]);
          const left = document.querySelector("svg.profile").getBoundingClientRect().left;
          return { labels, left };
        });
        for (const anchor of ["middle", "end"]) {
          const values = axes.labels.filter(([own]) => own === anchor).map(([, text]) => Number(text));
          const steps = values.slice(1).map((value, i) => value - values[i]);
          const mean = (values.at(-1) - values[0]) / steps.length;
          steps.forEach((step) => assert.ok(mean > 0 && Math.abs(step - mean) < 1e-3 * mean, `${units}, zoom ${zoom}: ticks ${values.join(" ")}`));
        }
        axes.labels.forEach(([, text, at]) => assert.ok(at >= axes.left, `${text} sticks out`));
        await page.getByRole("button", { name: "Zoom in" }).click();
      }
      await page.getByRole("button", { name: "Whole track" }).first().click();
    }
    await choose("Units", "m, m/s");
    const { closest } = json.limits.find((limit) => limit.closest);
    const told = await page.locator("#limits .detail", { hasText: "closest" }).first().textContent();
    const [, x, z] = /x = (\S+)\u00a0m, z = (\S+)\u00a0m$/.exec(told).map(Number);
    assert.ok(Math.abs(x - closest.x_m) < 5e-4 && Math.abs(z - closest.z_m) < 5e-4, `${told} for ${closest.x_m}, ${closest.z_m}`);
    assert.deepEqual(complaints, []);
  });

  test("its stations are what the motion tells there, to the last digit, at each friction", async () => {
    for (const level of ["low", "high", "nominal"]) {
      await choose("Friction", level);
      await page.getByLabel("Spacing").selectOption("1");
      const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "CSV" }).click()]);
      const rows = readFileSync(await download.path(), "utf8").trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
      for (const probe of json.probes) {
        const row = rows.find(([s]) => s === probe.arc_length_m);
        assert.ok(row, `a row at ${probe.arc_length_m}`);
        const state = probe.states.find(({ friction }) => friction === level);
        for (const [value, wanted] of [[row[1], probe.position_m[0]], [row[2], probe.position_m[1]], [row[3], probe.position_m[2]], [row[4], probe.slope_angle_deg], [row[5], probe.curvature_per_m], [row[7], state.speed_m_per_s], [row[8], state.time_s], [row[9], state.normal_load_m_per_s2 / 9.80665]]) {
          assert.ok(Math.abs(value - wanted) <= 1e-11 * Math.abs(wanted), `${level}, s = ${row[0]}: ${value} for ${wanted}`);
        }
      }
    }
  });

  test("its energies add up at each friction", async () => {
    for (const level of ["low", "high", "nominal"]) {
      await choose("Friction", level);
      const parts = await page.evaluate(() => window.glissadeReport.charts.find(({ chart }) => chart.id === "energy").plot.data.slice(1));
      const sums = parts[0].map((_, i) => parts.reduce((sum, part) => sum + part[i], 0));
      sums.forEach((sum) => assert.ok(Math.abs(sum - sums[0]) < 1e-8 * sums[0], `${level}: ${sum} against ${sums[0]}`));
    }
  });
});

describe("places on the page", () => {
  // One page for all of them, each with a design of its own.
  let view;
  before(async () => {
    view = await open(plain, chute.file, SMALL);
  });
  after(() => view.page.close());

  const built = (name, track, more = "") => {
    const file = path.join(work, `${name}.yaml`);
    writeFileSync(file, `glissade: 1
track: ${track}
body: {friction_angle: 11 deg}
centerline: {kind: straight}
cross_section: {kind: slab, width: 200 mm, thickness: 20 mm}
export: [stl, csv]
${more}`);
    return build(file);
  };
  const rowsOf = (text) => text.trim().split("\n").map((line) => line.split(","));
  const download = async (page) => {
    const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "CSV" }).click()]);
    return rowsOf(readFileSync(await saved.path(), "utf8"));
  };
  const ofBuild = (file, stem) => {
    const [head, ...rows] = rowsOf(readFileSync(path.join(path.dirname(file), `${stem}.csv`), "utf8"));
    return ["x_m", "y_m", "z_m"].map((key) => [rows[0], rows.at(-1)].map((row) => Number(row[head.indexOf(key)])));
  };

  test("x is that of the site in table, cursor line and CSV, as in the build's CSV, and falls where the track runs to the left", async () => {
    const { file } = built("left", "{start: {x: 100 m, z: 2.5 m}, finish: {x: 97 m, z: 1 m}}");
    const { page, complaints, visit } = view;
    await visit(file);
    const [head, ...rows] = await download(page);
    assert.deepEqual(head.slice(0, 4), ["s [m]", "x [m]", "z [m]", "slope angle [deg]"]);
    const [x, , z] = ofBuild(file, "left");
    assert.deepEqual([rows[0], rows.at(-1)].map((row) => Number(row[1])), x);
    assert.deepEqual([rows[0], rows.at(-1)].map((row) => Number(row[2])), z);
    assert.ok(rows.every((row, i) => i === 0 || Number(row[1]) < Number(rows[i - 1][1])));
    const cells = await page.locator("#stations tbody tr").evaluateAll((all) => [all[0], all.at(-1)].map((row) => row.cells[1].textContent));
    assert.deepEqual(cells.map(Number), [100, 97]);
    await page.locator("#chart-slope").focus();
    for (const [key, wanted] of [["Home", 100], ["End", 97]]) {
      await page.keyboard.press(key);
      assert.equal(Number.parseFloat(await page.locator('#readout [data-field="site_x_m"]').textContent()), wanted);
    }
    assert.equal(await page.locator('#readout [data-field="site_y_m"]').count(), 0);
    assert.equal(await page.locator("svg.profile text.axis").first().textContent(), "run [m]");
    assert.deepEqual(complaints, []);
  });

  test("a track that is turned in plan has x and y, and what counts along its run says so", async () => {
    const more = "probes: [{x: 1 m}]\nlimits:\n  keep_outs: [{outline: [[1 m, 0 m], [1.5 m, 0 m], [1.2 m, 0.5 m]], clearance: 50 mm}]\n";
    const { file } = built("turned", "{start: {x: 10 m, y: 4 m, z: 2.5 m}, finish: {x: 12 m, y: 7 m, z: 1 m}}", more);
    const { page, complaints, visit } = view;
    await visit(file);
    const [head, ...rows] = await download(page);
    assert.deepEqual(head.slice(0, 4), ["s [m]", "x [m]", "y [m]", "z [m]"]);
    ofBuild(file, "turned").forEach((ends, axis) => assert.deepEqual([rows[0], rows.at(-1)].map((row) => Number(row[axis + 1])), ends));
    assert.match(await page.locator("#summary table.probes").textContent(), /run = 1 m/);
    assert.match(await page.locator("#limits .detail", { hasText: "closest" }).first().textContent(), /, at run = \S+\u00a0m, z = /);
    assert.deepEqual(complaints, []);
  });

  test("a tiny part has its volume in mm\u00b3", async () => {
    const file = path.join(work, "tiny.yaml");
    writeFileSync(file, `glissade: 1
track: {start: {x: 0 m, z: 1 mm}, finish: {x: 1.5 mm, z: 0 mm}}
body: {friction_angle: 17 deg}
centerline: {kind: straight}
cross_section: {kind: u-channel, width: 0.1 mm, wall_height: 0.05 mm, thickness: 0.002 mm}
mesh: {tolerance: 0.001 mm}
export: [stl]
`);
    const { file: report, json } = build(file);
    const { page, visit } = view;
    await visit(report);
    const [, told] = /Volume([\d.e-]+)\u00a0mm\u00b3/.exec(await page.locator("#summary").textContent());
    assert.ok(Math.abs(Number(told) / (1e9 * json.mesh.mesh_volume_m3 || 1e9 * json.mesh.volume_m3) - 1) < 1e-3, told);
  });

  test("counts have their thousands apart, one way on the whole page", async () => {
    const { page, visit } = view;
    await visit(chute.file);
    const text = await page.locator("#summary").textContent();
    const count = grouped(chute.json.mesh.triangles);
    assert.ok(count.includes("\u202f") && text.includes(`oriented outward; ${count} facets`) && text.includes(`${count} and `), text);
    assert.ok(!text.includes(String(chute.json.mesh.triangles)));
  });

  test("times are held against others as the summary of the program does", async () => {
    const { page, visit } = view;
    await visit(chute.file);
    const told = await page.locator("#summary dl.tiles").textContent();
    assert.match(told, /\d\u00a0% (more|less) than the straight line/);
    assert.doesNotMatch(told, /faster|slower/);
  });
});

describe("a rolling ball", { skip: !process.env.CI && "takes seconds: in continuous integration" }, () => {
  const design = `glissade: 1
name: Ball
track: {start: {x: 0 m, z: 120 mm}, finish: {x: 200 mm, z: 0 m}}
body: {kind: rolling, radius: 8 mm, rolling_resistance: {low: 0.005, nominal: 0.01, high: 0.02}}
centerline: {kind: straight}
cross_section: {kind: u-channel, width: 20 mm, wall_height: 10 mm, thickness: 2 mm}
export: [stl]
`;
  test("follows the switch in task, energies and the times of a ride that was let go", async () => {
    const file = path.join(work, "ball.yaml");
    writeFileSync(file, design);
    const { file: report, json } = build(file);
    const { page, complaints } = await open(plain, report, SMALL);
    await page.locator("#ride").click();
    await page.waitForFunction(() => document.querySelector(".clock").textContent.startsWith("this track"));
    for (const level of ["nominal", "low", "high"]) {
      await page.locator("header select").first().selectOption(level);
      const ride = json.rides.find(({ friction }) => friction === level);
      assert.ok((await page.locator(".clock").textContent()).startsWith(`this track ${ride.travel_time_s.toFixed(3)}\u00a0s`), level);
      assert.match(await page.locator("#summary").textContent(), new RegExp(`rolling resistance ${ride.friction_coefficient}(?!\\d)`));
      const parts = await page.evaluate(() => window.glissadeReport.charts.find(({ chart }) => chart.id === "energy").plot.data.slice(1));
      // From rest to the lowest place: all that there was is spin, motion and what was lost, 7/10 u^2 of a ball on a flat floor.
      assert.ok(Math.abs(parts[1].at(-1) - 0.7 * ride.exit_speed_m_per_s ** 2) < 1e-9);
      parts[0].forEach((_, i) => assert.ok(Math.abs(parts.reduce((sum, part) => sum + part[i], 0) - parts[0][0]) < 1e-9 * parts[0][0]));
    }
    assert.deepEqual(complaints, []);
    await page.close();
  });
});

describe("friction along the track", () => {
  test("is told as far as the track goes", async () => {
    const file = path.join(work, "mats.yaml");
    writeFileSync(file, `glissade: 1
name: Mats
track: {start: {x: 0 m, z: 4 m}, finish: {x: 10 m, z: 0 m}}
body: {friction: [{from: 0 m, angle: 4 deg}, {from: 8 m, coefficient: 0.5}, {from: 80 m, coefficient: 0.9}], entry_speed: 1 m/s}
centerline: {kind: straight}
cross_section: {kind: slab, width: 400 mm, thickness: 50 mm}
mesh: {tolerance: 20 mm}
export: [stl]
`);
    const { page } = await open(plain, build(file).file, SMALL);
    assert.match(await page.locator("#summary").textContent(), /4\u00a0deg \(coefficient 0\.06993\); from s = 8\u00a0m on 26\.57\u00a0deg \(coefficient 0\.5\)Entry/);
    await page.close();
  });
});

describe("gates", { skip: !process.env.CI && "takes seconds: in continuous integration" }, () => {
  test("save their charts as drawings and pictures", async () => {
    const { page, complaints } = await open(plain, build(path.join(designs, "hills/kulm_hs235.yaml")).file, SMALL);
    for (const chart of ["Speed at the measuring place", "Highest normal load"]) {
      for (const format of ["SVG", "PNG"]) {
        const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: `Save gates ${chart} as ${format}`, exact: true }).click()]);
        const bytes = readFileSync(await download.path());
        if (format === "SVG") {
          const text = bytes.toString();
          assert.match(text, /^<svg[^>]* width="640"[\s\S]*<polyline[\s\S]*<\/svg>$/);
          assert.ok(text.includes(`: ${chart.toLowerCase()}`) && text.includes("gate, from the lowest"));
          assert.ok(!/color\(|color-mix|var\(|rgba\(/.test(text.replaceAll(/ (?:fill|stroke)="var\([^)]*\)"/g, "")));
        } else {
          assert.equal(bytes.subarray(1, 4).toString(), "PNG");
          assert.equal(bytes.readUInt32BE(16), 1280);
        }
      }
    }
    assert.deepEqual(complaints, []);
    await page.close();
  });
});

describe("places of gates", () => {
  const rows = (page) => page.locator("table.gates").evaluate((table) => [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent)));

  test("are x, y and z on the site where the hill is turned in plan, x and z where it is not", async () => {
    for (const azimuth of [0, 30]) {
      const file = path.join(work, `turned${azimuth}.yaml`);
      writeFileSync(file, `glissade: 1
track: {edge: {x: 0 m, z: 0 m}, azimuth: ${azimuth} deg}
body: {friction_coefficient: 0.03, drag: 0.0013 1/m}
centerline: {kind: in-run, gamma: 35 deg, alpha: 11 deg, r1: 103 m, t: 6.9 m, e1: 96 m, es: 24 m, e_counts_to: table}
gates: {count: 5, measuring_place: 10 m}
export: [csv]
`);
      const { page, complaints } = await open(plain, build(file).file, SMALL);
      const list = await page.evaluate(() => window.glissadeReport.document.gates.list);
      const [heads, ...cells] = await rows(page);
      const axes = azimuth === 0 ? ["x", "z"] : ["x", "y", "z"];
      assert.deepEqual(heads.slice(0, 2 + axes.length), ["Gate", "To the edge [m]", ...axes.map((axis) => `${axis} [m]`)]);
      assert.equal(cells.length, list.length);
      cells.forEach((row, i) => axes.forEach((axis, k) => {
        assert.ok(Math.abs(Number(row[2 + k].replace("\u2212", "-")) - list[i][`${axis}_m`]) < 1e-3, `${axis} of gate ${i + 1}: ${row[2 + k]}`);
      }));
      assert.deepEqual(complaints, []);
      await page.close();
    }
  });
});

describe("a stream", () => {
  let page;
  let complaints;
  before(async () => {
    ({ page, complaints } = await open(plain, build(path.join(designs, "grain_chute_with_stream.yaml")).file, SMALL));
  });
  after(() => page.close());

  const saved = async (name) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name, exact: true }).click()]);
    return readFileSync(await download.path());
  };

  test("has rules that follow the switch of units", async () => {
    const cells = () => page.locator("table.rules tbody td:not(.words)").evaluateAll((all) => all.map((cell) => cell.textContent));
    await page.getByLabel("Units").selectOption("m, km/h");
    assert.ok((await cells()).some((text) => text.includes("1.8\u00a0km/h")));
    await page.getByLabel("Units").selectOption("mm, m/s");
    const millimetres = await cells();
    assert.deepEqual(millimetres.filter((text) => /\d\u00a0m(?![m/])/.test(text)), []);
    // Where a rule is kept all along its place is any of those.
    const places = millimetres.map((text) => /^s = (\d{4})\u00a0mm$/.exec(text)?.[1]).filter(Boolean);
    assert.ok(places.length > 0, millimetres.join(" | "));
    await page.getByLabel("Units").selectOption("m, m/s");
    const metres = await cells();
    for (const place of places) {
      assert.ok(metres.includes(`s = ${Number(place) / 1000}\u00a0m`), `${place} mm in ${metres.join(" | ")}`);
    }
  });

  test("shows the ride that the sliders say, and the switch moves them", async () => {
    const state = () => page.evaluate(() => {
      const { store, document: doc } = window.glissadeReport;
      const slider = document.querySelector("#what-if input[aria-label='Wall friction']");
      return {
        slider: slider.getAttribute("aria-valuetext"), told: document.querySelector("#what-if-facts").textContent, other: store.get("whatIf")?.friction_angle_deg ?? null,
        shown: doc.ride.friction_angle_deg ?? doc.body.friction_angle_deg, exit: doc.ride.exit_speed_m_per_s, stream: document.querySelector("svg.profile polygon.stream").getAttribute("points"),
      };
    });
    const streams = {};
    for (const level of ["low", "high", "nominal"]) {
      await page.locator("header select").first().selectOption(level);
      const now = await state();
      streams[level] = now.stream;
      assert.equal(now.other, null, "the page's own ride");
      assert.ok(Math.abs(Number.parseFloat(now.slider) - now.shown) < 0.06, `${now.slider} for ${now.shown}`);
      assert.ok(now.told.includes(`Exit speed${Number(now.exit.toPrecision(4))}\u00a0m/s`), now.told);
    }
    await page.locator("header select").first().selectOption("high");
    const slider = page.getByLabel("Wall friction");
    const middle = await page.evaluate(() => {
      const { document: doc } = window.glissadeReport;
      return [...new Set(doc.what_if.map((ride) => ride.friction_angle_deg))].indexOf(doc.what_if.find((ride) => ride.nominal).friction_angle_deg);
    });
    await slider.fill(String(middle));
    const back = await state();
    assert.ok(back.other !== null && back.other < back.shown, "the profile has the stream of the slider, not that of the switch");
    assert.ok(![streams.high, streams.low].includes(back.stream));
    await page.locator("header select").first().selectOption("nominal");
    assert.equal((await state()).stream, streams.nominal);
    assert.deepEqual(complaints, []);
  });

  test("prints no heading without what it heads", async () => {
    await page.emulateMedia({ media: "print" });
    assert.equal(await page.locator("#what-if").isVisible(), false);
    await page.emulateMedia({ media: "screen" });
    assert.equal(await page.locator("#what-if").isVisible(), true);
  });

  test("saves drawings that say what they show, in colours that drawing programs know", async () => {
    const profile = (await saved("Save Profile as SVG")).toString();
    for (const text of ["wheat: profile, to scale", ">straight line<", ">this track<", ">the stream<"]) assert.ok(profile.includes(text), text);
    assert.ok(!/color\(|color-mix|var\(|rgba\(/.test(profile));
    await page.locator("header select").first().selectOption("high");
    const speed = (await saved("Save Speed as SVG")).toString();
    assert.ok(speed.includes("at high friction; dashed: low and high friction"));
    const [, width, height] = /^<svg[^>]*? width="([\d.]+)" height="([\d.]+)"/.exec((await saved("Save Profile as SVG")).toString()).map(Number);
    const png = await saved("Save Profile as PNG");
    assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [2 * width, 2 * height].map(Math.floor));
    await page.locator("header select").first().selectOption("nominal");
    assert.deepEqual(complaints, []);
  });
});

describe("a comparison", () => {
  test("opens without complaint, and no drawing or table sticks out", async () => {
    const file = path.join(work, "kinds.html");
    execFileSync(program, ["compare", path.join(designs, "grain_chute.yaml"), "--html", file]);
    const page = await plain.newPage();
    const complaints = [];
    page.on("console", (message) => complaints.push(message.text()));
    page.on("request", (request) => {
      if (!request.url().startsWith("file://")) complaints.push(request.url());
    });
    await page.goto(`file://${file}`);
    for (const width of [1440, 390]) {
      await page.setViewportSize({ width, height: 900 });
      await drawn(page);
      const [content, room] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
      assert.ok(content <= room, `${content} px of content in ${room}`);
      // A table that goes on beyond its room says so, one that does not says nothing. What a scrolled box drives follows
      // its size some frames later.
      const state = () => {
        const holder = document.querySelector(".scroll");
        const goesOn = holder.scrollWidth > holder.clientWidth;
        const { height } = document.querySelector(".more").getBoundingClientRect();
        return { goesOn, height, agrees: height > 10 === goesOn };
      };
      await page.waitForFunction(`(${state})().agrees`).catch(() => undefined);
      const { goesOn, height } = await page.evaluate(state);
      assert.equal(goesOn, width === 390);
      assert.equal(height > 10, goesOn, `a remark ${height} px high at ${width}`);
    }
    assert.equal(await page.locator("figure").count(), 4);
    assert.deepEqual(complaints, []);
    await page.close();
  });
});

describe("page", () => {
  // One page for the tests that leave it as it was, and one in the dark.
  let page;
  let dark;
  before(async () => {
    ({ page } = await open(browser, chute.file, SMALL));
    ({ page: dark } = await open(plain, chute.file, { ...SMALL, colorScheme: "dark" }));
  });
  after(() => Promise.all([page.close(), dark.close()]));
  afterEach(async () => {
    await page.emulateMedia({ media: "screen" });
    await page.setViewportSize(SMALL.viewport);
  });

  test("a design named <script> is harmless", async () => {
    const name = "<script>alert(1)</script><img src=x onerror=alert(2)> & \"quotes\" </title>";
    const text = readFileSync(path.join(designs, "grain_chute.yaml"), "utf8").replace(/^name:.*$/m, `name: '${name}'`);
    const design = path.join(work, "<img src=x onerror=alert(3)>.yaml");
    writeFileSync(design, text);
    const { page, complaints } = await open(plain, build(design).file, SMALL);
    assert.equal(await page.locator("h1").textContent(), name);
    assert.equal(await page.locator("img").count(), 0);
    assert.deepEqual(complaints, []);
    await page.close();
  });

  test("fits a wide, a narrow and an A4 window: nothing sticks out to the right", async () => {
    for (const [width, media] of [[1600, "screen"], [390, "screen"], [718, "print"]]) {
      await page.setViewportSize({ width, height: 900 });
      await page.emulateMedia({ media });
      await drawn(page);
      const [content, room] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
      assert.ok(content <= room, `${content} px of content in ${room} at ${width}`);
    }
  });

  test("prints on A4 and Letter without clipped content", async () => {
    for (const format of ["A4", "Letter"]) {
      const pdf = await page.pdf({ format });
      assert.ok(pdf.length > 20000);
    }
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize({ width: 718, height: 1000 });
    await page.waitForSelector("html[data-printing=true]");
    const clipped = await page.evaluate(() => [...document.querySelectorAll("table, figure, svg, canvas, dl")]
      .filter((node) => node.getClientRects().length > 0 && node.getBoundingClientRect().right > innerWidth + 1)
      .map((node) => `${node.tagName} ${node.id || node.className.baseVal || node.className}`));
    assert.deepEqual(clipped, []);
    // Plots are drawn for paper: a label of 12 pixels there is one of 12 pixels on the page.
    const shrunk = await page.evaluate(() => window.glissadeReport.charts.map(({ plot }) =>
      plot.ctx.canvas.getBoundingClientRect().width / (plot.width / 2)));
    shrunk.forEach((factor) => assert.ok(factor > 0.9 && factor < 1.1, `plots shrunk by ${factor}`));
    // What was under the cursor on the screen says nothing on paper.
    assert.equal(await page.locator(".chart-value").first().isVisible(), false);
  });

  test("prints dark on white even where the system is dark", async () => {
    await dark.emulateMedia({ media: "print", colorScheme: "dark" });
    await dark.waitForSelector("html[data-printing=true]");
    const [paper, ink, axes] = await dark.evaluate(() => [
      getComputedStyle(document.body).backgroundColor, getComputedStyle(document.body).color,
      window.glissadeReport.charts[0].plot.axes[0].stroke(),
    ]);
    assert.equal(paper, "rgb(255, 255, 255)");
    assert.equal(ink, "rgb(22, 32, 42)");
    assert.equal(axes, "#52606d");
    await dark.emulateMedia({ media: "screen", colorScheme: "dark" });
    await dark.waitForSelector("html[data-printing=false]");
  });

  test("is dark where the system is dark, and on request", async () => {
    const lightness = () => dark.evaluate(() =>
      getComputedStyle(document.body).backgroundColor.match(/\d+/g).reduce((sum, c) => sum + Number(c), 0));
    assert.ok((await lightness()) < 200);
    await dark.getByLabel("Theme").selectOption("light");
    assert.ok((await lightness()) > 600);
    await dark.getByLabel("Theme").selectOption("auto");
  });

  test("every control is reached by Tab and has a name", async () => {
    const wanted = await page.evaluate(() => document.querySelectorAll(
      "button, select, input:not([disabled]), [tabindex='0']").length);
    const reached = new Set();
    const nameless = [];
    for (let i = 0; i < wanted + 5; i += 1) {
      await page.keyboard.press("Tab");
      const [key, name] = await page.evaluate(() => {
        const node = document.activeElement;
        const all = [...document.querySelectorAll("*")];
        const name = node.getAttribute("aria-label") ?? node.labels?.[0]?.textContent ?? node.textContent;
        return [node === document.body ? null : all.indexOf(node), name];
      });
      if (key !== null) reached.add(key);
      if (key !== null && !name?.trim()) nameless.push(key);
    }
    assert.equal(reached.size, wanted);
    assert.deepEqual(nameless, []);
  });

  test("the table of stations follows its spacing and gives CSV", async () => {
    const rows = () => page.locator("table.stations tbody tr").count();
    const before = await rows();
    const values = await page.getByLabel("Spacing").locator("option").evaluateAll((options) => options.map((o) => o.value));
    await page.getByLabel("Spacing").selectOption(values[0]);
    assert.ok((await rows()) > before);
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "CSV" }).click()]);
    const lines = readFileSync(await download.path(), "utf8").trim().split("\n");
    assert.match(lines[0], /^s \[m\],x \[m\],z \[m\]/);
    assert.equal(lines.length, (await rows()) + 1);
  });
});
