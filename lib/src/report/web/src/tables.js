import { button, element, section, select } from "./dom.js";
import { interpolate } from "./data.js";
import { columnText, number } from "./units.js";

const COLUMNS = [
  ["s", "length", "arc_length_m"],
  ["x", "length", "x_m"],
  ["z", "length", "z_m"],
  ["slope angle", "angle", "slope_angle_deg"],
  ["curvature", "curvature", "curvature_per_m"],
  ["radius", "length", "radius_m"],
  ["speed", "speed", "speed_m_per_s"],
  ["time", "time", "time_s"],
  ["normal load", "load", "normal_load_m_per_s2"],
];

const MISSING = { curvature_per_m: "unbounded", radius_m: "straight", normal_load_m_per_s2: "unbounded" };

// Rows at a spacing, interpolated between the stations of the document; the radius from the curvature.
export function rowsAt(stations, spacing) {
  const length = stations.arc_length_m[stations.arc_length_m.length - 1];
  const rows = [];
  const count = Math.floor(length / spacing + 1e-9);
  for (let i = 0; i <= count; i += 1) rows.push(Math.min(i * spacing, length));
  if (length - rows[rows.length - 1] > 1e-9 * length) rows.push(length);
  return rows.map((s) => {
    const row = {};
    for (const [, , key] of COLUMNS) {
      if (key !== "radius_m") row[key] = valueAt(stations, key, s);
    }
    const { curvature_per_m: curvature } = row;
    row.radius_m = curvature === null ? 0 : Math.abs(curvature) < 1e-6 / length ? null : 1 / Math.abs(curvature);
    return row;
  });
}

function valueAt(stations, key, s) {
  const column = stations[key];
  const index = stations.arc_length_m.indexOf(s);
  if (index >= 0) return column[index];
  const value = interpolate(stations.arc_length_m, column, s);
  return Number.isFinite(value) ? value : null;
}

function spacings(length) {
  const rough = length / 20;
  const decade = 10 ** Math.floor(Math.log10(rough));
  return [0.1, 0.2, 0.5, 1, 2, 5].map((k) => k * decade).filter((d) => length / d <= 2000 && length / d >= 2);
}

function csv(doc, units, rows) {
  const head = COLUMNS.map(([name, quantity]) => `${name} [${units.unit(quantity)}]`).join(",");
  const body = rows.map((row) => COLUMNS.map(([, quantity, key]) => {
    const value = units.convert(quantity, row[key]);
    return value === null ? "" : String(value);
  }).join(","));
  return [head, ...body].join("\n") + "\n";
}

export function stationTable(doc, store, units) {
  const body = element("tbody");
  const head = element("thead");
  const status = element("span", { role: "status", class: "status" });
  const options = spacings(doc.ride.arc_length_m);
  let spacing = options[Math.min(3, options.length - 1)];

  const rows = () => rowsAt(doc.stations, spacing);
  const draw = () => {
    head.replaceChildren(element("tr", {}, COLUMNS.map(([name, quantity]) =>
      element("th", { scope: "col" }, name, element("span", { class: "unit" }, ` [${units.unit(quantity)}]`)))));
    const shown = rows();
    const columns = COLUMNS.map(([, quantity, key]) => {
      const values = shown.map((row) => units.convert(quantity, row[key]));
      // Radii of one track differ by orders of magnitude: each has its own digits.
      const text = key === "radius_m" ? (value) => number(value, 5) : columnText(values);
      return values.map((value) => (value === null ? MISSING[key] ?? "\u2013" : text(value)));
    });
    body.replaceChildren(...shown.map((_, i) =>
      element("tr", {}, columns.map((column) => element("td", {}, column[i])))));
  };
  draw();
  store.on("units", draw);

  const copy = async () => {
    try {
      await navigator.clipboard.writeText(csv(doc, units, rows()).replaceAll(",", "\t"));
      status.textContent = "Copied.";
    } catch {
      status.textContent = "The browser refused the clipboard; use CSV.";
    }
  };
  const save = () => {
    const link = element("a", {
      href: URL.createObjectURL(new Blob([csv(doc, units, rows())], { type: "text/csv" })),
      download: `${doc.design.stem}-stations.csv`,
    });
    link.click();
    URL.revokeObjectURL(link.href);
    status.textContent = "Saved as CSV.";
  };

  const control = select("Spacing", [], (value) => {
    spacing = Number(value);
    draw();
  });
  const label = () => {
    const list = control.querySelector("select");
    list.replaceChildren(...options.map((d) => element("option", { value: d }, units.text("length", d, 3))));
    list.value = String(spacing);
  };
  label();
  store.on("units", label);
  return section("stations", "Stations",
    element("div", { class: "controls" }, control, button("Copy", copy), button("CSV", save), status),
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Table of stations" },
      element("table", { class: "stations" }, head, body)));
}

const superscripts = (text) => text.replaceAll("^2", "\u00b2").replaceAll("^3", "\u00b3");

export function limitTable(doc) {
  if (doc.limits.length === 0) return null;
  return section("limits", "Limits and what they cost",
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Table of limits" },
      element("table", { class: "limits" },
        element("thead", {}, element("tr", {}, ["Limit", "Bound", "Reached", "Where", "Status", "Price"]
          .map((head) => element("th", { scope: "col" }, head)))),
        element("tbody", {}, doc.limits.map((limit) => element("tr", { class: limit.status },
          element("th", { scope: "row" }, limit.name),
          element("td", {}, superscripts(limit.bound)),
          element("td", {}, superscripts(limit.reached)),
          element("td", {}, limit.where),
          element("td", {}, limit.status),
          element("td", {}, limit.price === null ? "\u2013" : `${number(limit.price, 3)} ${superscripts(limit.price_unit)}`)))))),
    element("p", { class: "note" }, "Active: the track lies at this bound. The price is what one unit of relief wins."));
}
