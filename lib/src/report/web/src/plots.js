import uPlot from "uplot";
import { radiusOf } from "./data.js";
import { button, element, section, select, svgElement, themeColour } from "./dom.js";
import { TITLE_LINE, exportButtons, noteLines, titleLines } from "./export.js";
import { isPlace, siteColumns, siteFields } from "./site.js";
import { columnText, tickTexts } from "./units.js";

const SYNC = "glissade";
const HEIGHT = 220;
// Half of A4 between its margins, in CSS pixels, and how many times as large it is drawn.
const PAPER = { width: 336, scale: 2 };
const NOTE = 11;  // size of the note below the title of a saved chart, in CSS pixels

const AXES = {
  arc_length_m: ["arc length s", "length"],
  x_m: ["run", "length"],
  time_s: ["time", "time"],
};

// Of the motion of the centre of mass and of the spin; with what is lost and the potential energy of the centre it sums to one
// constant at every station (docs/theory.md, M3). None from where the ride ends.
const kineticEnergies = ({ stations, body }) =>
  stations.speed_m_per_s.map((speed) => (speed === null ? null : 0.5 * body.inertia_factor * speed * speed));

function energies(doc) {
  const { stations, body } = doc;
  const rise = (station) => Math.cos((stations.slope_angle_deg[station] * Math.PI) / 180);
  const drops = stations.drop_m.map((drop, i) => drop - body.centre_height_m * (rise(i) - rise(0)));
  const lowest = Math.max(...drops);
  return {
    potential: drops.map((drop) => body.gravity_m_per_s2 * (lowest - drop)),
    kinetic: kineticEnergies(doc),
    friction: stations.friction_loss_j_per_kg,
    drag: stations.drag_loss_j_per_kg,
    hasDrag: body.drag_per_m > 0,
  };
}

// The chart of one column, with the band between the ends of the friction range where there is one.
function ranged(chart, rides, key) {
  const band = rides.band(key);
  if (!band) return chart;
  const colour = chart.series[0][2];
  return { ...chart, band: true, series: [...chart.series, ["at low friction", band[0], colour, "band"], ["at high friction", band[1], colour, "band"]] };
}

function charts(doc, rides) {
  const { stations } = doc;
  const radius = radiusOf(stations);
  const energy = energies(doc);
  const longest = MOST_LENGTHS * stations.arc_length_m[stations.arc_length_m.length - 1];
  return [
    { id: "slope", title: "Slope angle", quantity: "angle", series: [["slope angle", stations.slope_angle_deg, "--series-1"]] },
    ranged({ id: "speed", title: "Speed", quantity: "speed", series: [["speed", stations.speed_m_per_s, "--series-2"]] }, rides, "speed_m_per_s"),
    ...streamCharts(doc, rides),
    ranged({ id: "load", title: "Normal load", quantity: "load", range: boundedRange, series: [["normal load", stations.normal_load_m_per_s2, "--series-3"]] }, rides, "normal_load_m_per_s2"),
    { id: "curvature", title: "Curvature", quantity: "curvature", range: boundedRange, series: [["curvature", stations.curvature_per_m, "--series-4"]] },
    { id: "radius", title: "Radius of curvature", quantity: "length", range: (column) => radiusRange(column, longest), series: [["radius", radius, "--series-5"]] },
    {
      id: "energy",
      title: "Energy per mass",
      quantity: "energy",
      legend: true,
      series: [
        ["potential", energy.potential, "--series-1"],
        ["kinetic", energy.kinetic, "--series-2"],
        ["lost to friction", energy.friction, "--series-3"],
        ...(energy.hasDrag ? [["lost to drag", energy.drag, "--series-4"]] : []),
      ],
    },
  ];
}

// What a stream of bulk solid adds: how deep it is, and what it does to the chute.
function streamCharts(doc, rides) {
  const { stations } = doc;
  if (!stations.burden_depth_m) return [];
  return [
    ranged({ id: "depth", title: "Burden depth", quantity: "length", series: [["burden depth", stations.burden_depth_m, "--series-5"]] }, rides, "burden_depth_m"),
    ranged({ id: "pressure", title: "Pressure on the floor", quantity: "pressure", series: [["pressure", stations.floor_pressure_pa, "--series-3"]] }, rides, "floor_pressure_pa"),
    ranged({ id: "wear", title: "Wear factor of the floor", quantity: "rubbing", series: [["floor", stations.floor_wear_w_per_m2, "--series-1"]] }, rides, "floor_wear_w_per_m2"),
  ];
}

function isAscending(column) {
  return column.every((value, i) => i === 0 || value >= column[i - 1]);
}

// A curvature or load without bound would flatten the rest of the curve: the axis then ends where all but the outer 4 % of
// stations lie. One that is bounded is shown whole.
function boundedRange(column) {
  if (!column.includes(null)) return null;
  const values = column.filter((v) => v !== null).sort((a, b) => a - b);
  if (values.length === 0) return [0, 1];
  const low = values[Math.floor(0.02 * (values.length - 1))];
  const high = values[Math.ceil(0.96 * (values.length - 1))];
  const margin = 0.08 * (high - low || Math.abs(high) || 1);
  return [low < 0 ? low - margin : 0, high + margin];
}

// Radii beyond this many lengths of the track are straight to the eye; the axis ends there.
const MOST_LENGTHS = 2;

function radiusRange(column, longest) {
  const largest = Math.max(...column.map((v) => v ?? 0));
  return [0, 1.05 * Math.min(largest || 1, longest)];
}

// The values of one chart at a station, in words.
function valuesAt({ chart, units }, station) {
  if (chart.legend) return "";
  const column = chart.series[0][1];
  const value = column[station];
  if (value === null) return chart.id === "radius" ? "straight" : "unbounded";
  const largest = Math.max(...column.map((v) => Math.abs(v ?? 0)));
  return units.text(chart.quantity, Math.abs(value) < 1e-9 * largest ? 0 : value, 4);
}

class Chart {
  constructor(chart, doc, store, units) {
    Object.assign(this, { chart, doc, store, units });
    this.holder = element("div", { class: "chart-canvas" });
    this.value = element("span", { class: "chart-value" });
    this.parts = chart.legend ? chart.series.map(() => element("span", { class: "chart-part" })) : [];
    const legend = chart.legend ? element("ul", { class: "legend" }, chart.series.map(([name, , colour], i) =>
      element("li", {}, element("span", { class: "swatch", style: `border-color: var(${colour})` }), name, this.parts[i]))) : null;
    this.node = element("figure", {
      class: "chart", id: `chart-${chart.id}`, tabindex: 0, role: "group",
      "aria-label": `${chart.title}. Arrow keys move the cursor along the track, plus and minus zoom, 0 shows all.`,
      onkeydown: (event) => this.key(event),
    }, element("figcaption", {}, element("span", { class: "chart-title" }, chart.title), this.value,
      element("span", { class: "exports" }, exportButtons(doc.design.stem, chart.title, () => this.file()))),
    legend, chart.band ? element("p", { class: "hint band-hint" }, "Shaded: from low to high friction.") : null, this.holder);
    store.on("station", (station) => this.show(station));
  }

  columns() {
    const { units, chart } = this;
    const axis = this.store.get("axis");
    // At one time bodies of different friction are at different places: there is no band over time.
    const shown = ([, column, , band]) => (band && axis === "time_s" ? column.map(() => null) : column.map((v) => units.convert(chart.quantity, v)));
    return [this.doc.stations[axis].map((v) => units.convert(AXES[axis][1], v)), ...chart.series.map(shown)];
  }

  draw() {
    const zoom = this.plot ? { ...this.plot.scales.x } : null;
    this.plot?.destroy();
    const { units, chart } = this;
    const data = this.columns();
    const [axisName, axisQuantity] = AXES[this.store.get("axis")];
    const ink = themeColour("--ink-soft");
    const grid = { stroke: themeColour("--grid"), width: 1 };
    // Paper has more dots than a screen: drawn larger, and shrunk to the width of a column by the print styles.
    const scale = this.store.get("paper") ? PAPER.scale : 1;
    const width = this.store.get("paper") ? PAPER.width : Math.max(this.holder.clientWidth, 200);
    const font = `${12 * scale}px system-ui, sans-serif`;
    const tick = (_, values) => tickTexts(values);
    // A range far from zero has many digits: the axis makes room for them.
    const room = (_, texts) => Math.max(60, 18 + 7 * Math.max(...(texts ?? []).map((text) => text.length), 0)) * scale;
    const bounds = chart.range?.(chart.series.flatMap(([, column]) => column))?.map((v) => units.convert(chart.quantity, v));
    this.plot = new uPlot({
      width: width * scale,
      height: HEIGHT * scale,
      legend: { show: false },
      cursor: { sync: { key: SYNC, setSeries: false }, drag: { x: true, y: false }, y: false },
      scales: { x: { time: false }, y: bounds ? { range: () => bounds } : {} },
      axes: [
        { label: `${axisName} [${units.unit(axisQuantity)}]`, labelFont: font, font, stroke: ink, grid, ticks: grid, values: tick, size: 44 * scale, labelSize: 26 * scale, gap: 5 * scale },
        { label: `[${units.unit(chart.quantity)}]`, labelFont: font, font, stroke: ink, grid, ticks: grid, values: tick, size: room, labelSize: 24 * scale, gap: 5 * scale },
      ],
      series: [{}, ...chart.series.map(([name, , colour, band]) => ({
        label: name, stroke: themeColour(colour) + (band ? "80" : ""), width: (band ? 1 : 2) * scale, points: { show: false },
      }))],
      bands: chart.band ? [{ series: [2, 3], fill: `${themeColour(chart.series[0][2])}2e` }] : [],
      hooks: {
        setScale: [(plot, key) => {
          if (key === "x" && plot === this.plot) this.onzoom?.(plot.scales.x);
        }],
        ready: [() => this.show(this.store.get("station"))],
        setCursor: [(plot) => {
          // Only the mouse moves the station: a plot that is drawn anew takes the one that there is.
          const pointed = plot.cursor.event && plot.over.matches(":hover");
          if (pointed && plot.cursor.idx !== null && plot.cursor.idx !== undefined && plot.cursor.left >= 0) {
            this.store.set("station", plot.cursor.idx);
          }
        }],
      },
    }, data, this.holder);
    if (zoom && this.axisDrawn === this.axisKey()) this.plot.setScale("x", { min: zoom.min, max: zoom.max });
    this.axisDrawn = this.axisKey();
  }

  // Of a range of friction: which one the thick line is of, and what lies beside it. Null without a range.
  note() {
    const { chart, doc } = this;
    if (doc.rides.length < 2) return null;
    const banded = chart.band && this.store.get("axis") !== "time_s";
    return `at ${doc.ride.friction ?? "nominal"} friction${banded ? "; dashed: low and high friction" : ""}`;
  }

  // The chart as it is shown now, drawn again as SVG.
  file() {
    const { plot, chart, doc } = this;
    const { width, height } = plot.over.getBoundingClientRect();
    const left = Number.parseFloat(plot.over.style.left);
    const room = plot.width - left - 8;
    const titles = titleLines(`${doc.design.name}: ${chart.title.toLowerCase()}`, room);
    const note = this.note();
    const notes = note ? noteLines(note, room, NOTE) : [];
    const more = TITLE_LINE * (titles.length - 1 + Math.max(notes.length - 1, 0));
    const top = Number.parseFloat(plot.over.style.top) + 22 + more;
    const whole = { width: plot.width, height: plot.height + 22 + more };
    const ink = themeColour("--ink");
    const soft = themeColour("--ink-soft");
    const font = { "font-family": "system-ui, sans-serif", "font-size": 12, fill: soft };
    const line = (ends) => svgElement("line", { stroke: themeColour("--grid"), ...ends });
    const text = (attributes, value) => svgElement("text", { ...font, ...attributes }, value);
    const path = (values) => {
      let drawn = "";
      let pen = "M";
      plot.data[0].forEach((x, i) => {
        if (values[i] === null) pen = "M";
        else {
          drawn += `${pen}${(left + plot.valToPos(x, "x")).toFixed(2)} ${(top + plot.valToPos(values[i], "y")).toFixed(2)}`;
          pen = "L";
        }
      });
      return drawn;
    };
    const [across, up] = plot.axes;
    const ticks = [
      ...across._splits.map((value, i) => [left + plot.valToPos(value, "x"), across._values[i]]).filter(([x]) => x >= left - 1 && x <= left + width + 1)
        .map(([x, label]) => [line({ x1: x, x2: x, y1: top, y2: top + height }), text({ x, y: top + height + 18, "text-anchor": "middle" }, label)]),
      ...up._splits.map((value, i) => [top + plot.valToPos(value, "y"), up._values[i]]).filter(([y]) => y >= top - 1 && y <= top + height + 1)
        .map(([y, label]) => [line({ x1: left, x2: left + width, y1: y, y2: y }), text({ x: left - 8, y: y + 4, "text-anchor": "end" }, label)]),
    ].flat();
    const clip = svgElement("clipPath", { id: "plot" }, svgElement("rect", { x: left, y: top, width, height }));
    const curves = svgElement("g", { "clip-path": "url(#plot)" }, chart.series.map(([name, , colour, band], i) => svgElement("path", {
      d: path(plot.data[i + 1]), fill: "none", stroke: themeColour(colour), "stroke-width": band ? 1 : 2,
      "stroke-dasharray": band ? "4 3" : null,
    }, svgElement("title", {}, name))));
    const legend = chart.legend ? chart.series.map(([name, , colour], i) =>
      text({ x: left + width - 4, y: top + 14 + 15 * i, "text-anchor": "end", fill: themeColour(colour) }, name)) : [];
    const svg = svgElement("svg", { xmlns: "http://www.w3.org/2000/svg", ...whole, viewBox: `0 0 ${whole.width} ${whole.height}` },
      svgElement("rect", { ...whole, fill: themeColour("--panel") }),
      titles.map((title, i) => text({ x: left, y: 16 + TITLE_LINE * i, fill: ink, "font-weight": 600 }, title)),
      notes.map((one, i) => text({ x: left, y: 16 + TITLE_LINE * (titles.length + i), "font-size": NOTE }, one)),
      clip, ticks, svgElement("rect", { x: left, y: top, width, height, fill: "none", stroke: themeColour("--grid") }), curves, legend,
      text({ x: left + width / 2, y: top + height + 38, "text-anchor": "middle" }, across.label),
      text({ transform: `translate(14 ${top + height / 2}) rotate(-90)`, "text-anchor": "middle" }, up.label));
    return { svg: new XMLSerializer().serializeToString(svg), ...whole };
  }

  resize() {
    if (this.store.get("paper")) return;
    this.plot?.setSize({ width: Math.max(this.holder.clientWidth, 200), height: HEIGHT });
  }

  axisKey() {
    return `${this.store.get("axis")} ${this.store.get("units")}`;
  }

  // Zooms about the cursor.
  zoomBy(factor) {
    const xs = this.plot.data[0];
    const { min, max } = this.plot.scales.x;
    const middle = Math.min(Math.max(xs[this.store.get("station")], min), max);
    this.plot.setScale("x", {
      min: Math.max(middle + factor * (min - middle), xs[0]), max: Math.min(middle + factor * (max - middle), xs[xs.length - 1]),
    });
  }

  resetZoom() {
    const xs = this.plot.data[0];
    this.plot.setScale("x", { min: xs[0], max: xs[xs.length - 1] });
  }

  show(station) {
    this.value.textContent = valuesAt(this, station);
    this.parts.forEach((part, i) => {
      part.textContent = this.units.text(this.chart.quantity, this.chart.series[i][1][station], 4);
    });
    if (this.plot) {
      const left = this.plot.valToPos(this.plot.data[0][station], "x");
      this.plot.setCursor({ left, top: 10 }, false);
    }
  }

  key(event) {
    const zooms = { "+": () => this.zoomBy(0.7), "-": () => this.zoomBy(1 / 0.7), 0: () => this.resetZoom() };
    if (zooms[event.key]) {
      event.preventDefault();
      zooms[event.key]();
      return;
    }
    const last = this.doc.stations.arc_length_m.length - 1;
    const step = event.shiftKey ? 10 : 1;
    const now = this.store.get("station");
    const next = { ArrowLeft: now - step, ArrowRight: now + step, Home: 0, End: last }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    this.store.set("station", Math.min(Math.max(next, 0), last));
  }
}

function readout(doc, store, units) {
  const { stations } = doc;
  const sites = siteColumns(doc, stations.x_m);
  const column = (key) => sites[key] ?? stations[key];
  const list = element("dl", { class: "readout", id: "readout", "aria-label": "At the cursor", "aria-live": "polite" });
  const fields = [
    ["s", "length", "arc_length_m"], ...siteFields(doc), ["z", "length", "z_m"], ["time", "time", "time_s"],
    ["speed", "speed", "speed_m_per_s"], ["slope", "angle", "slope_angle_deg"], ["load", "load", "normal_load_m_per_s2"],
  ];
  let texts = [];
  const measure = () => {
    const place = units.place(doc.ride.arc_length_m, true);
    texts = fields.map(([, quantity, key]) => {
      if (isPlace(key)) return (value) => `${place(value)}\u00a0${units.unit(quantity)}`;
      const text = columnText(column(key).map((v) => units.convert(quantity, v)), 5);
      return (value) => (value === null ? units.missing(quantity) : `${text(units.convert(quantity, value))}\u00a0${units.unit(quantity)}`);
    });
  };
  const draw = () => {
    const station = store.get("station");
    list.replaceChildren(...fields.map(([name, , key], i) => element("div", {},
      element("dt", {}, name), element("dd", { "data-field": key }, texts[i](column(key)[station])))));
  };
  measure();
  draw();
  store.on("station", draw);
  for (const key of ["units", "friction"]) {
    store.on(key, () => {
      measure();
      draw();
    });
  }
  return list;
}

export function plotSection(doc, store, units, rides) {
  const list = charts(doc, rides);
  const all = list.map((chart) => new Chart(chart, doc, store, units));
  let following = false;
  for (const chart of all) {
    // One zoom for all: each plot takes the range of the one that was zoomed.
    chart.onzoom = ({ min, max }) => {
      if (following) return;
      following = true;
      for (const other of all) if (other !== chart && other.plot) other.plot.setScale("x", { min, max });
      following = false;
    };
  }
  const axes = Object.entries(AXES).filter(([key]) => isAscending(doc.stations[key]));
  const control = select("Against", axes.map(([key, [name]]) => [key, name]), (value) => store.set("axis", value));
  const redraw = () => {
    following = true;
    all.forEach((chart) => chart.draw());
    following = false;
  };
  for (const key of ["axis", "units", "theme", "paper"]) store.on(key, redraw);
  store.on("friction", () => {
    const kinetic = list.find((chart) => chart.id === "energy").series[1][1];
    kineticEnergies(doc).forEach((energy, i) => {
      kinetic[i] = energy;
    });
    redraw();
  });
  new ResizeObserver(() => all.forEach((chart) => chart.resize())).observe(document.body);
  const node = section("plots", "Along the track",
    element("div", { class: "controls" }, control,
      button("Whole track", () => all.forEach((chart) => chart.resetZoom()))),
    readout(doc, store, units),
    element("p", { class: "hint" }, "Drag across a plot to zoom, double-click to see all. Keys, once a plot is selected: arrows move the cursor, + and \u2212 zoom, 0 shows all. "
      + "Potential energy is that of the centre of mass and counts from its lowest place, kinetic energy includes the spin of what rolls. Where curvature or load are unbounded, their axes end before; that of the radius ends at twice the length of the track."),
    element("div", { class: "charts" }, all.map((chart) => chart.node)));
  return { node, draw: redraw, charts: all };
}
