// The page of a sweep: what was counted is drawn, a click shows the command that builds a point again. No request to anywhere.
"use strict";
const data = JSON.parse(document.getElementById("sweep-data").textContent);
const page = document.getElementById("page");

function make(name, attributes = {}, ...children) {
  const svg = ["svg", "g", "rect", "path", "line", "text", "title", "polyline"].includes(name) && attributes.xml !== false;
  const node = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "xml") continue;
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value);
  }
  for (const child of children.flat()) if (child !== null && child !== undefined) node.append(child);
  return node;
}

/** Five digits, as people read them. */
function shown(value) {
  if (value === null || value === undefined) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(3).replace("e+", "e");
  return String(Number(value.toPrecision(5)));
}

function unitOf(name) {
  const input = data.inputKeys.find(({ column, unit }) => column === name && unit);
  if (input) return { words: input.key.replaceAll("_", " "), unit: input.unit.replaceAll("^2", "²").replaceAll("^3", "³") };
  const units = [["_kg_per_m3", "kg/m³"], ["_kg_per_s", "kg/s"], ["_w_per_m2", "W/m²"], ["_m2_per_s2", "m²/s²"], ["_m2_per_s", "m²/s"],
    ["_per_m2", "1/m²"], ["_per_s", "1/s"], ["_pa", "Pa"], ["_m3", "m³"], ["_m2", "m²"], ["_mm_per_1000_h", "mm/1000 h"], ["_mm_per_mt", "mm/Mt"], ["_h", "h"],
    ["_m_per_s2", "m/s²"], ["_m_per_s", "m/s"], ["_per_m", "1/m"], ["_deg", "deg"], ["_j_per_kg", "J/kg"], ["_percent", "%"],
    ["_mm", "mm"], ["_kg", "kg"], ["_m", "m"], ["_s", "s"]];
  // Of "_m_per_s" and "_per_s" the longer one.
  const found = units.filter(([end]) => name.endsWith(end)).sort((a, b) => b[0].length - a[0].length)[0];
  return found ? { words: name.slice(0, -found[0].length).replaceAll("_", " "), unit: found[1] } : { words: name.replaceAll("_", " "), unit: "" };
}

function label(name) {
  const { words, unit } = unitOf(name);
  return unit ? `${words} [${unit}]` : words;
}

function quoted(text) {
  return /^[\w.,:=/+%-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

/** A point of its own is a design with these values; one on the frozen track is a sweep of one point. */
function commandOf(point) {
  const values = point.inputs.map((value, index) => `${data.inputKeys[index].key}=${value}${data.inputKeys[index].unit}`);
  const options = (name, texts) => texts.map((text) => ` ${name} ${quoted(text)}`).join("");
  if (!data.frozen) return `glissade solve ${quoted(data.design)}${options("--set", data.base.concat(values))}`;
  return `glissade sweep ${quoted(data.design)} --frozen${options("--set", data.base)}${options("--vary", values)} -o point_${point.index}`;
}

const command = make("pre", { class: "command", "aria-live": "polite" }, "Choose a cell or a row: its first point's command appears here.");
function showPoint(point, extra) {
  command.textContent = `# point ${point.index}${extra ? `, ${extra}` : ""}\n${commandOf(point)}`;
}

// --- axes -----------------------------------------------------------------------------------------------------------------

function ticks(lowest, highest, most) {
  const step0 = (highest - lowest) / Math.max(most, 1);
  if (!(step0 > 0)) return [lowest];
  const power = 10 ** Math.floor(Math.log10(step0));
  const step = [1, 2, 5, 10].map((times) => times * power).find((size) => size >= step0 * 0.999);
  const result = [];
  for (let n = Math.ceil(lowest / step - 1e-9); n * step <= highest + 1e-9 * step; ++n) result.push(n * step);
  return result;
}

const size = { width: 460, height: 270, left: 58, right: 12, top: 8, bottom: 38 };
const inner = { width: size.width - size.left - size.right, height: size.height - size.top - size.bottom };

function frame(across, up, acrossLabel, upLabel) {
  const svg = make("svg", { class: "plot", viewBox: `0 0 ${size.width} ${size.height}`, role: "img" });
  const x = (value) => size.left + (value - across[0]) / (across[1] - across[0] || 1) * inner.width;
  const y = (value) => size.top + inner.height - (value - up[0]) / (up[1] - up[0] || 1) * inner.height;
  for (const value of ticks(across[0], across[1], 6)) {
    svg.append(make("line", { class: "axis", x1: x(value), x2: x(value), y1: size.top, y2: size.top + inner.height }),
      make("text", { x: x(value), y: size.height - 22, "text-anchor": "middle" }, shown(value)));
  }
  for (const value of ticks(up[0], up[1], 5)) {
    svg.append(make("line", { class: "axis", x1: size.left, x2: size.left + inner.width, y1: y(value), y2: y(value) }),
      make("text", { x: size.left - 5, y: y(value) + 4, "text-anchor": "end" }, shown(value)));
  }
  svg.append(make("text", { x: size.left + inner.width / 2, y: size.height - 6, "text-anchor": "middle" }, acrossLabel),
    make("text", { x: 12, y: size.top + inner.height / 2, "text-anchor": "middle", transform: `rotate(-90 12 ${size.top + inner.height / 2})` }, upLabel));
  return { svg, x, y };
}

function figure(caption, node) {
  return make("figure", {}, make("figcaption", {}, caption), node);
}

function edges(axis) {
  if (axis.values.length === 0) {
    return Array.from({ length: axis.cells + 1 }, (_, n) => axis.lowest + (axis.highest - axis.lowest) * n / axis.cells);
  }
  const values = axis.values;
  const result = values.slice(1).map((value, n) => (value + values[n]) / 2);
  const first = values.length > 1 ? values[0] - (result[0] - values[0]) : values[0] - 0.5;
  const last = values.length > 1 ? values.at(-1) + (values.at(-1) - result.at(-1)) : values[0] + 0.5;
  return [first, ...result, last];
}

// --- plots ----------------------------------------------------------------------------------------------------------------

function histogram(facts) {
  const most = Math.max(...facts.histogram);
  const { svg, x, y } = frame([facts.lowest, facts.highest], [0, most], label(facts.name), "points");
  const width = (facts.highest - facts.lowest) / facts.histogram.length;
  facts.histogram.forEach((count, n) => {
    const from = x(facts.lowest + n * width);
    svg.append(make("rect", { class: "bar", x: from, width: Math.max(x(facts.lowest + (n + 1) * width) - from - 0.5, 0.5), y: y(count),
      height: Math.max(y(0) - y(count), 0) }, make("title", {}, `${shown(facts.lowest + n * width)} to ${shown(facts.lowest + (n + 1) * width)}: ${count} points`)));
  });
  return figure(`How often: ${label(facts.name)}`, svg);
}

function bandPlot(band, place) {
  const input = data.inputs[band.across.input];
  const cells = band.values[place];
  const used = cells.filter((cell) => cell !== null);
  if (used.length === 0) return null;
  const range = [Math.min(...used.map((cell) => cell[0])), Math.max(...used.map((cell) => cell[2]))];
  const ends = edges(band.across);
  const name = data.quantities[place].name;
  const { svg, x, y } = frame([ends[0], ends.at(-1)], range, label(input.name), label(name));
  const middle = (n) => x((ends[n] + ends[n + 1]) / 2);
  const there = cells.map((cell, n) => [cell, n]).filter(([cell]) => cell !== null);
  if (used.some((cell) => cell[2] > cell[0])) {
    svg.append(make("path", { class: "band", d: `M${there.map(([cell, n]) => `${middle(n)},${y(cell[2])}`).join("L")}L${there.slice().reverse().map(([cell, n]) => `${middle(n)},${y(cell[0])}`).join("L")}Z` }));
  }
  svg.append(make("polyline", { class: "line", points: there.map(([cell, n]) => `${middle(n)},${y(cell[1])}`).join(" ") }));
  for (const [cell, n] of there) {
    svg.append(make("rect", { class: "hit", fill: "transparent", x: x(ends[n]), width: Math.max(x(ends[n + 1]) - x(ends[n]), 1), y: size.top, height: inner.height,
      onclick: () => showPoint(band.first[n], `the first of ${band.counts[n]}`) },
    make("title", {}, `${shown((ends[n] + ends[n + 1]) / 2)}: ${shown(cell[0])} to ${shown(cell[2])}, mean ${shown(cell[1])}, ${band.counts[n]} points`)));
  }
  return figure(`${label(name)} over ${label(input.name)}: mean and range`, svg);
}

/** Blue to yellow, of even lightness steps (after the viridis map). */
function colour(share) {
  const stops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const n = Math.min(Math.floor(at), stops.length - 2);
  return `rgb(${stops[n].map((value, channel) => Math.round(value + (stops[n + 1][channel] - value) * (at - n))).join(",")})`;
}

function mapPlot(map, place) {
  const across = data.inputs[map.across.input];
  const up = data.inputs[map.up.input];
  const used = map.means[place].filter((mean) => mean !== null);
  if (used.length === 0) return null;
  const lowest = Math.min(...used);
  const highest = Math.max(...used);
  const acrossEnds = edges(map.across);
  const upEnds = edges(map.up);
  const name = data.quantities[place].name;
  const { svg, x, y } = frame([acrossEnds[0], acrossEnds.at(-1)], [upEnds[0], upEnds.at(-1)], label(across.name), label(up.name));
  map.means[place].forEach((mean, cell) => {
    if (map.counts[cell] === 0) return;
    const column = cell % map.across.cells;
    const row = Math.floor(cell / map.across.cells);
    const failed = mean === null;
    svg.append(make("rect", { class: "hit", fill: failed ? "var(--grid)" : colour((mean - lowest) / (highest - lowest || 1)),
      x: x(acrossEnds[column]), width: x(acrossEnds[column + 1]) - x(acrossEnds[column]) + 0.3, y: y(upEnds[row + 1]), height: y(upEnds[row]) - y(upEnds[row + 1]) + 0.3,
      onclick: () => showPoint(map.first[cell], `the first of ${map.counts[cell]} here`) },
    make("title", {}, `${label(name)}: ${failed ? "none" : shown(mean)} (mean of ${map.counts[cell]} points)`)));
  });
  return figure(`${label(name)}: ${shown(lowest)} (dark) to ${shown(highest)} (bright), grey where there is none`, svg);
}

// --- sections -------------------------------------------------------------------------------------------------------------

function section(title, ...children) {
  return make("section", {}, make("h2", {}, title), ...children);
}

function countsSection() {
  const grid = make("div", { class: "counts" });
  for (const { status, count, reason } of data.counts) {
    const share = count / data.points;
    const bar = make("div", { class: status === "arrived" ? "bar" : "bar bad" });
    bar.style.width = `${100 * share}%`;
    grid.append(make("span", {}, status), bar, make("span", {}, `${count} (${shown(100 * share)} %)`));
    if (reason) grid.append(make("span", { class: "reason" }, `the first of them: ${reason}`));
  }
  return section("How the points ended", grid);
}

function selector(text, options, change) {
  const select = make("select", { onchange: () => change(Number(select.value)) }, options.map((option, n) => make("option", { value: n }, option)));
  return { select, node: make("label", { class: "control" }, text, select) };
}

function quantitiesSection(choose) {
  const head = ["", "points", "lowest", "5 %", "25 %", "median", "75 %", "95 %", "highest", "mean", "deviation"];
  const rows = data.quantities.map((facts, place) => make("tr", { class: "pick", tabindex: 0, onclick: () => choose(place), onkeydown: (event) => event.key === "Enter" && choose(place) },
    [label(facts.name), facts.count, facts.lowest, ...facts.quantiles, facts.highest, facts.mean, facts.deviation].map((value) => make("td", {}, typeof value === "number" ? shown(value) : value))));
  const table = make("table", { class: "sheet" }, make("thead", {}, make("tr", {}, head.map((text) => make("th", {}, text)))), make("tbody", {}, rows));
  const fixed = data.constant.length ? make("p", { class: "hint" }, `The same at every point: ${data.constant.map(({ name, value }) => `${label(name)} ${shown(value)}`).join(", ")}.`) : null;
  return { node: section("Figures", make("p", { class: "hint" }, "Choose a row to see it below."), make("div", { class: "wide" }, table), fixed), rows };
}

function influenceSection() {
  const inputs = [...new Set(data.influences.map(({ input }) => input))];
  if (inputs.length === 0) return null;
  const cell = (quantity, input) => {
    const found = data.influences.find((one) => one.quantity === quantity && one.input === input);
    if (!found) return "–";
    const rank = `${found.rank.toFixed(2)} ± ${found.rankError.toFixed(2)}`;
    if (found.dependent) return `${rank}; *`;
    return found.firstOrder === null ? rank : `${rank}; ${(100 * found.firstOrder).toFixed(0)} ± ${Math.ceil(100 * found.firstOrderError)} %`;
  };
  const table = make("table", { class: "sheet" },
    make("thead", {}, make("tr", {}, make("th", {}, ""), inputs.map((input) => make("th", {}, label(data.inputs[input].name))))),
    make("tbody", {}, data.quantities.map((facts, place) => make("tr", {}, make("td", {}, label(facts.name)), inputs.map((input) => make("td", {}, cell(place, input)))))));
  return section("What moves what", make("p", { class: "hint" },
    "Rank correlation (-1 to 1), each ± its standard error; then, where the input is independent of the others, the share of the variance that it explains alone (first-order Sobol index)."),
  data.influences.some(({ dependent }) => dependent) ? make("p", { class: "hint" },
    "* The values of this input are drawn independently of the others', but among the points that have this figure they no longer are: which points lack it depends on several inputs together. No share of the variance is told there, and the rank correlation may be another input's.") : null,
  make("div", { class: "wide" }, table));
}

function bestSection() {
  const body = make("tbody");
  let place = 0;
  let low = true;
  const draw = () => {
    const points = (low ? data.lowest : data.highest)[place];
    body.replaceChildren(...points.map((point) => make("tr", { class: "pick", tabindex: 0, onclick: () => showPoint(point), onkeydown: (event) => event.key === "Enter" && showPoint(point) },
      make("td", {}, String(point.index)), make("td", {}, shown(point.value)), point.inputs.map((value) => make("td", {}, Number.isFinite(Number(value)) ? shown(Number(value)) : value)))));
    if (points.length === 0) body.replaceChildren(make("tr", {}, make("td", {}, "no point arrived")));
    heading.textContent = label(data.quantities[place].name);
  };
  const heading = make("th", {}, "");
  const quantity = selector("Objective", data.quantities.map(({ name }) => label(name)), (n) => { place = n; draw(); });
  const sense = selector("", ["lowest", "highest"], (n) => { low = n === 0; draw(); });
  const start = data.quantities.findIndex(({ name }) => name === data.objective);
  place = Math.max(start, 0);
  quantity.select.value = place;
  draw();
  const table = make("table", { class: "sheet" }, make("thead", {}, make("tr", {}, make("th", {}, "point"), heading, data.inputKeys.map(({ column }) => make("th", {}, label(column))))), body);
  return section("Best points", make("div", { class: "controls" }, quantity.node, sense.node), make("div", { class: "wide" }, table));
}

function exploreSection() {
  const plots = make("div", { class: "plots" });
  const draw = (place) => {
    plots.replaceChildren(...[histogram(data.quantities[place]), ...data.bands.map((band) => bandPlot(band, place)), ...data.maps.map((map) => mapPlot(map, place))].filter((node) => node !== null));
    select.select.value = place;
  };
  const select = selector("Quantity", data.quantities.map(({ name }) => label(name)), draw);
  return { node: section("A closer look", make("div", { class: "controls" }, select.node), plots), draw };
}

const remark = data.kept < data.points ? ` Quantiles and influences are of ${data.kept} points chosen at random, everything else is of all.` : "";
page.append(make("header", {}, make("div", {}, make("h1", {}, data.title), make("p", { class: "subtitle" },
  `${data.points} points, ${data.frozen ? "each ridden on the frozen track of the design" : "each designed anew"}.${remark}`))));
page.append(countsSection());
if (data.quantities.length > 0) {
  const explore = exploreSection();
  let rows = [];
  const choose = (place) => {
    explore.draw(place);
    rows.forEach((row, n) => row.setAttribute("aria-selected", n === place));
  };
  const quantities = quantitiesSection(choose);
  rows = quantities.rows;
  page.append(quantities.node, explore.node);
  page.append(section("The point", make("p", { class: "hint" }, "Run where the design file lies."), command,
    make("button", { onclick: () => navigator.clipboard?.writeText(command.textContent) }, "Copy")));
  const influence = influenceSection();
  if (influence) page.append(influence);
  page.append(bestSection());
  choose(Math.max(data.quantities.findIndex(({ name }) => name === data.objective), 0));
}
page.append(make("footer", {}, `Made by ${data.program}. SI units, angles in degrees.`));
