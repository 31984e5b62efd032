import { button, element, scrollable, section, select } from "./dom.js";
import { decodeArray } from "./data.js";
import { isPlace, isTurned, siteColumns, siteFields } from "./site.js";
import { columnText, number, quantityOf, superscripts } from "./units.js";

const columnsFor = (doc) => [
  ["s", "length", "arc_length_m"],
  ...siteFields(doc),
  ["z", "length", "z_m"],
  ["slope angle", "angle", "slope_angle_deg"],
  ["curvature", "curvature", "curvature_per_m"],
  ["radius", "length", "radius_m"],
  ["speed", "speed", "speed_m_per_s"],
  ["time", "time", "time_s"],
  ["normal load", "load", "normal_load_m_per_s2"],
];

const MISSING = { curvature_per_m: "unbounded", radius_m: "straight", normal_load_m_per_s2: "unbounded" };

// Rows at a multiple of the finest spacing, each as the motion tells it; the radius from the curvature.
function rowsAt(table, columns, multiple) {
  const { arc_length_m: places } = table;
  const length = places[places.length - 1];
  const rows = places.map((_, i) => i).filter((i) => i % multiple === 0 || i === places.length - 1);
  return rows.map((i) => {
    const row = Object.fromEntries(columns.filter(([, , key]) => key !== "radius_m").map(([, , key]) => [key, table[key][i]]));
    const { curvature_per_m: curvature } = row;
    row.radius_m = curvature === null ? 0 : Math.abs(curvature) < 1e-6 / length ? null : 1 / Math.abs(curvature);
    return row;
  });
}

const unpacked = (table) => Object.fromEntries(Object.entries(table).filter(([, column]) => column.data !== undefined)
  .map(([key, column]) => [key, Array.from(decodeArray(column), (value) => (Number.isNaN(value) ? null : value))]));

// The finest spacing and its multiples that leave a table of two rows and more.
const multiplesOf = ({ arc_length_m: places }) => [1, 2, 5, 10, 20, 50].filter((k) => k === 1 || places.length > 2 * k);

function csv(columns, units, rows) {
  const head = columns.map(([name, quantity]) => `${name} [${units.unit(quantity)}]`).join(",");
  const body = rows.map((row) => columns.map(([, quantity, key]) => {
    const value = units.convert(quantity, row[key]);
    return value === null ? "" : String(value);
  }).join(","));
  return [head, ...body].join("\n") + "\n";
}

export function stationTable(doc, store, units) {
  const body = element("tbody");
  const head = element("thead");
  const status = element("span", { role: "status", class: "status" });
  const unsited = unpacked(doc.table);
  const track = { ...unsited, ...siteColumns(doc, unsited.x_m) };
  const columns = columnsFor(doc);
  const options = multiplesOf(track);
  let multiple = options[Math.min(3, options.length - 1)];

  const ride = () => doc.rides.find(({ friction }) => friction === (doc.ride.friction ?? "nominal"));
  const rows = () => rowsAt({ ...track, ...unpacked(ride().table) }, columns, multiple);
  const draw = () => {
    head.replaceChildren(element("tr", {}, columns.map(([name, quantity]) =>
      element("th", { scope: "col" }, name, element("span", { class: "unit" }, ` [${units.unit(quantity)}]`)))));
    const shown = rows();
    const place = units.place(doc.ride.arc_length_m, true);
    const texts = columns.map(([, quantity, key]) => {
      const values = shown.map((row) => units.convert(quantity, row[key]));
      // Radii of one track differ by orders of magnitude: each has its own digits.
      const text = key === "radius_m" ? (value) => number(value, 5) : columnText(values);
      if (isPlace(key)) return shown.map((row) => place(row[key]));
      return values.map((value) => (value === null ? MISSING[key] ?? "\u2013" : text(value)));
    });
    body.replaceChildren(...shown.map((_, i) =>
      element("tr", {}, texts.map((column) => element("td", {}, column[i])))));
  };
  draw();
  for (const key of ["units", "friction"]) store.on(key, draw);

  const copy = async () => {
    try {
      await navigator.clipboard.writeText(csv(columns, units, rows()).replaceAll(",", "\t"));
      status.textContent = "Copied.";
    } catch {
      status.textContent = "The browser refused the clipboard; use CSV.";
    }
  };
  const save = () => {
    const link = element("a", {
      href: URL.createObjectURL(new Blob([csv(columns, units, rows())], { type: "text/csv" })),
      download: `${doc.design.stem}-stations.csv`,
    });
    link.click();
    URL.revokeObjectURL(link.href);
    status.textContent = "Saved as CSV.";
  };

  const control = select("Spacing", [], (value) => {
    multiple = Number(value);
    draw();
  });
  const label = () => {
    const list = control.querySelector("select");
    list.replaceChildren(...options.map((k) => element("option", { value: k }, units.text("length", k * doc.table.spacing_m, 3))));
    list.value = String(multiple);
  };
  label();
  store.on("units", label);
  return section("stations", "Stations",
    element("div", { class: "controls" }, control, button("Copy", copy), button("CSV", save), status),
    scrollable("Table of stations", element("table", { class: "stations" }, head, body)));
}

// Limits that have no number, only a yes.
const WORDS = [
  [/^concave$/, "no crest", "no crest"], [/^finish$/, "met", "met"], [/^waypoints/, "passed", "passed"],
  [/^arrival/, "the body arrives", "arrives"],
];

function valueText({ unit }, value, units, digits) {
  return value === null ? "unbounded" : units.textOf(unit, value, digits);
}

function boundText(limit, units) {
  const words = WORDS.find(([pattern]) => pattern.test(limit.limit));
  if (words) return words[1];
  const side = limit.side === "exactly" ? "" : `${limit.side} `;
  return side + valueText(limit, limit.bound, units, 5);
}

function reachedText(limit, units) {
  const words = WORDS.find(([pattern]) => pattern.test(limit.limit));
  if (words && limit.kept) return words[2];
  // A radius beyond a million times its bound is that of a straight.
  const straight = limit.limit.includes("radius") && (limit.reached === null || limit.reached > 1e6 * limit.bound);
  return straight ? "straight" : valueText(limit, limit.reached, units, 4);
}

function placeText(limit, units) {
  const length = (value) => units.text("length", value, 3);
  const places = (limit.where ?? []).map(({ from_m: from, to_m: to }) => (length(to) === length(from) ? length(from) : `${length(from)} to ${length(to)}`));
  const text = places.length === 0 ? length(limit.at_m) : places.slice(0, 3).join(", ") + (places.length > 3 ? ", \u2026" : "");
  return `s = ${text}${limit.friction ? `, at ${limit.friction} friction` : ""}`;
}

// A price counts per unit of the limit: in the unit that is shown. Where another limit begins to bind at the same bound,
// relief wins less than tightening costs, and both are told. One that meshes do not tell closely comes with how closely, and one that
// changes by as much as itself as what it stays below.
function priceText(limit, units) {
  if (limit.price === null) return "\u2013";
  const quantity = quantityOf(limit.unit);
  const [objective] = limit.price_unit.split(" per ");
  const unit = quantity ? units.unit(quantity) : superscripts(limit.unit);
  const speed = objective === "m/s";
  const shown = (value) => {
    const price = speed ? units.convert("speed", value) : value;
    return number(quantity ? price / units.convert(quantity, 1) : price, 3);
  };
  const perUnit = `${speed ? units.unit("speed") : objective} per ${unit}`;
  if (limit.price_error >= 1) return `below some ${shown((1 + limit.price_error) * limit.price)} ${perUnit}`;
  const text = `${shown(limit.price)} ${perUnit}`;
  if (limit.price_error > 0) return `${text} (to ${number(100 * limit.price_error, 1)} %)`;
  if (limit.tightening_price === limit.price) return text;
  return `${text} looser, ${limit.tightening_price === null ? "no track" : shown(limit.tightening_price)} tighter`;
}

// Of a clearance that the whole solid keeps: which part of it comes closest, and where, as the design's limits count.
function closestText(limit, units, { placement, ride }) {
  if (!limit.closest) return null;
  const { part, x_m: x, z_m: z } = limit.closest;
  const place = (value) => units.placeText(value, ride.arc_length_m);
  return element("span", { class: "detail" }, `closest: ${part}, at ${isTurned(placement) ? "run" : "x"} = ${place(x)}, z = ${place(z)}`);
}

export function limitTable(doc, store, units) {
  if (doc.limits.length === 0) return null;
  const body = element("tbody");
  const draw = () => body.replaceChildren(...doc.limits.map((limit) => element("tr", { class: limit.status },
    element("th", { scope: "row" }, element("span", { class: "limit-name" }, limit.name), element("code", { class: "key" }, limit.limit)),
    element("td", {}, boundText(limit, units)),
    element("td", {}, reachedText(limit, units)),
    element("td", {}, placeText(limit, units), closestText(limit, units, doc)),
    element("td", {}, limit.status),
    element("td", {}, priceText(limit, units)))));
  draw();
  store.on("units", draw);
  return section("limits", "Limits and what they cost",
    scrollable("Table of limits", element("table", { class: "limits" },
      element("thead", {}, element("tr", {}, ["Limit", "Bound", "Reached", "Where", "Status", "Price"]
        .map((head) => element("th", { scope: "col" }, head)))),
      body)),
    element("p", { class: "note" }, "Active: the track lies at this bound. The price is what one unit of relief wins, and what one unit tighter costs where that is not the same."
      + (doc.rides.length > 1 ? " Limits hold over the whole range of friction; each row tells the friction that comes nearest to its bound." : "")));
}
