// Start gates of a ski jump: speed and load against the gate, and the table.
import { element, scrollable, section, svgElement } from "./dom.js";
import { exportButtons, standAlone } from "./export.js";
import { columnText, number, tickTexts } from "./units.js";

const COLOURS = ["--series-1", "--series-3", "--series-2"];
const SIZE = { width: 640, height: 260, left: 64, right: 16, top: 26, bottom: 44 };

const CHARTS = [
  ["Speed at the measuring place", "speed", "speed_at_measuring_place_m_per_s"],
  ["Highest normal load", "load", "max_normal_load_m_per_s2"],
];

// The ride from a gate in a condition; the first condition is that of the design, which the gate itself carries.
const ridden = (gate, condition, first) => (condition === first ? gate : gate.conditions[condition]);

function steps(low, high, most) {
  const rough = (high - low) / most || 1;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * decade).find((s) => s >= rough);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) ticks.push(k * step);
  return ticks;
}

function drawn(doc, units, [title, quantity, key]) {
  const { list, conditions } = doc.gates;
  const curves = conditions.map((condition) => list.map((gate) => [gate.gate, units.convert(quantity, ridden(gate, condition, conditions[0])[key])])
    .filter(([, value]) => value !== null));
  const values = curves.flat().map(([, value]) => value);
  if (values.length === 0) return null;
  const margin = 0.05 * (Math.max(...values) - Math.min(...values) || Math.abs(values[0]) || 1);
  const [low, high] = [Math.min(...values) - margin, Math.max(...values) + margin];
  const [first, last] = [list[0].gate, Math.max(list[list.length - 1].gate, list[0].gate + 1)];
  const x = (gate) => SIZE.left + ((gate - first) / (last - first)) * (SIZE.width - SIZE.left - SIZE.right);
  const y = (value) => SIZE.height - SIZE.bottom - ((value - low) / (high - low)) * (SIZE.height - SIZE.top - SIZE.bottom);
  const text = (attributes, words) => svgElement("text", { "font-size": 12, "font-family": "system-ui, sans-serif", fill: "var(--ink-soft)", ...attributes }, words);
  const line = (ends) => svgElement("line", { stroke: "var(--grid)", ...ends });
  const heights = steps(low, high, 5);
  const heightTexts = tickTexts(heights);
  const bottom = SIZE.height - SIZE.bottom;
  return svgElement("svg", { xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, role: "img", "aria-label": `${title} against the gate`, class: "gates-plot" },
    heights.map((value, i) => [line({ x1: SIZE.left, x2: SIZE.width - SIZE.right, y1: y(value), y2: y(value) }),
      text({ x: SIZE.left - 6, y: y(value) + 4, "text-anchor": "end" }, heightTexts[i])]),
    steps(first, last, 12).filter(Number.isInteger).map((gate) => [line({ x1: x(gate), x2: x(gate), y1: SIZE.top, y2: bottom }),
      text({ x: x(gate), y: bottom + 16, "text-anchor": "middle" }, String(gate))]),
    curves.map((curve, i) => [
      svgElement("polyline", { points: curve.map(([gate, value]) => `${x(gate).toFixed(2)},${y(value).toFixed(2)}`).join(" "), fill: "none", stroke: `var(${COLOURS[i]})`, "stroke-width": 2 }),
      curve.length > 60 ? null : curve.map(([gate, value]) => svgElement("circle", { cx: x(gate).toFixed(2), cy: y(value).toFixed(2), r: 2.5, fill: `var(${COLOURS[i]})` },
        svgElement("title", {}, `gate ${gate}, ${conditions[i]}: ${number(value, 4)} ${units.unit(quantity)}`))),
      text({ x: SIZE.left + 8 + 90 * i, y: 16, fill: `var(${COLOURS[i]})` }, conditions[i]),
    ]),
    text({ x: 0.5 * (SIZE.left + SIZE.width), y: SIZE.height - 8, "text-anchor": "middle" }, "gate, from the lowest"),
    text({ transform: `translate(14 ${0.5 * SIZE.height}) rotate(-90)`, "text-anchor": "middle" }, `[${units.unit(quantity)}]`));
}

const PER_CONDITION = [
  ["Speed", "speed", "speed_at_measuring_place_m_per_s"],
  ["At the edge", "speed", "speed_at_edge_m_per_s"],
  ["Time", "time", "travel_time_s"],
  ["Load", "load", "max_normal_load_m_per_s2"],
];

function table(doc, units) {
  const { list, conditions } = doc.gates;
  const place = units.place(doc.ride.arc_length_m, true);
  // On the site; y where the track is turned in plan, but for rounding.
  const axes = ["x", "y", "z"].filter((axis) => axis !== "y" || list.some((gate) => Math.abs(gate.y_m) > 1e-9));
  const columns = [
    ["To the edge", "length", list.map((gate) => gate.distance_to_edge_m)],
    ...axes.map((axis) => [axis, "length", list.map((gate) => gate[`${axis}_m`])]),
    ...conditions.flatMap((condition) => PER_CONDITION.map(([head, quantity, key]) => [
      conditions.length > 1 ? `${head}, ${condition}` : head, quantity,
      list.map((gate) => ridden(gate, condition, conditions[0])[key]),
    ])),
  ].map(([head, quantity, values]) => {
    const shown = values.map((value) => units.convert(quantity, value));
    const text = axes.includes(head) ? (_, i) => place(values[i]) : columnText(shown, 4);
    return [head, units.unit(quantity), shown.map((value, i) => (value === null ? "\u2013" : text(value, i)))];
  });
  return scrollable("Table of gates", element("table", { class: "gates stations" },
    element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "Gate"), columns.map(([head, unit]) =>
      element("th", { scope: "col" }, head, element("span", { class: "unit" }, ` [${unit}]`))))),
    element("tbody", {}, list.map((gate, i) => element("tr", {},
      element("th", { scope: "row" }, String(gate.gate)), columns.map(([, , texts]) => element("td", {}, texts[i])))))));
}

// Null for a design without gates.
export function gatesSection(doc, store, units) {
  if (!doc.gates) return null;
  const holder = element("div");
  const draw = () => {
    const charts = CHARTS.map((chart) => [chart[0], drawn(doc, units, chart)]).filter(([, svg]) => svg !== null);
    holder.replaceChildren(element("div", { class: "charts gates-charts" }, ...charts.map(([title, svg]) => element("figure", { class: "chart" },
      element("figcaption", {}, element("span", { class: "chart-title" }, title),
        element("span", { class: "exports" }, exportButtons(doc.design.stem, `gates ${title}`, () => standAlone(svg, { title: `${doc.design.name}: ${title.toLowerCase()}`, legend: [] })))), svg))),
    ...[table(doc, units)].flat());
  };
  const hint = element("p", { class: "hint" });
  const tell = () => {
    const place = units.text("length", doc.gates.measuring_place_m, 4);
    const below = doc.gates.list.some((gate) => gate.distance_to_edge_m <= doc.gates.measuring_place_m);
    hint.textContent = `Gates count from the lowest; speed is measured ${place} before the edge.`
      + (below ? " From gates that lie no farther from it no body passes that place." : "");
  };
  for (const show of [draw, tell]) {
    show();
    store.on("units", show);
  }
  return section("gates", "Gates", hint, holder);
}
