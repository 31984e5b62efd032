import { element, section } from "./dom.js";
import { bytesText, number } from "./units.js";

function figures(doc, units) {
  const { ride, endpoints, body } = doc;
  const versus = (time) =>
    time === null || ride.travel_time_s === null ? null : 100 * (ride.travel_time_s / time - 1);
  const against = (percent) =>
    percent === null ? "does not apply" : Math.abs(percent) < 5e-4 ? "equal" : `${percent >= 0 ? "+" : "\u2212"}${number(Math.abs(percent), 3)}\u00a0%`;
  const rows = [
    ["Travel time", units.text("time", ride.travel_time_s, 6), "key"],
    ["against the exact optimum", ride.optimum_travel_time_s === null ? "does not apply"
      : `${against(versus(ride.optimum_travel_time_s))} (${units.text("time", ride.optimum_travel_time_s, 6)})`],
    ["against the straight line", ride.straight_travel_time_s === null ? "the body does not arrive on it"
      : `${against(versus(ride.straight_travel_time_s))} (${units.text("time", ride.straight_travel_time_s, 6)})`],
    ["Exit speed", units.text("speed", ride.exit_speed_m_per_s, 5), "key"],
    ["Exit slope angle", units.text("angle", ride.exit_slope_angle_deg, 5)],
    ["Entry slope angle", units.text("angle", ride.entry_slope_angle_deg, 5)],
    ["Steepest slope angle", units.text("angle", Math.max(...doc.stations.slope_angle_deg), 5)],
    ["Highest normal load", `${units.text("load", ride.max_normal_load_m_per_s2, 4)} at s = `
      + units.text("length", ride.max_normal_load_at_m, 4), "key"],
    ["Smallest radius", ride.min_radius_m === null ? "straight"
      : ride.min_radius_m === 0 ? "0, at the vertical start" : `${units.text("length", ride.min_radius_m, 4)} at s = ${units.text("length", ride.min_radius_at_m, 4)}`],
    ["Arc length", units.text("length", ride.arc_length_m, 6)],
    ["Run and drop", `${units.text("length", endpoints.run_m, 6)} and ${units.text("length", endpoints.drop_m, 6)}`],
    ["Friction angle", `${units.text("angle", body.friction_angle_deg, 5)} (coefficient ${number(body.friction_coefficient, 5)})`],
    ["Entry speed", body.entry_speed_m_per_s === 0 ? "from rest" : units.text("speed", body.entry_speed_m_per_s, 5)],
    ["Drag", body.drag_per_m === 0 ? "none" : `${number(body.drag_per_m, 4)}\u00a01/m`],
    ["Gravity", `${number(body.gravity_m_per_s2, 7)}\u00a0m/s\u00b2`],
    ["Start (x, y, z)", doc.placement.start_m.map((v) => units.text("length", v, 6)).join(", ")],
    ["Finish (x, y, z)", doc.placement.finish_m.map((v) => units.text("length", v, 6)).join(", ")],
    ["Centerline", doc.design.centerline],
    ["Cross-section", doc.design.cross_section],
  ];
  return element("dl", { class: "figures" },
    rows.map(([name, value, role]) => element("div", { class: role },
      element("dt", {}, name), element("dd", {}, value))));
}

function mesh(doc, units) {
  const { mesh: facts } = doc;
  if (facts === null) return null;
  const sides = [0, 1, 2].map((axis) => units.text("length", facts.upper_m[axis] - facts.lower_m[axis], 5));
  const rows = [
    ["Facets and vertices", `${number(facts.triangles, 9)} and ${number(facts.vertices, 9)}`],
    ["Volume", `${number(facts.volume_m3, 5)}\u00a0m\u00b3`],
    ["Surface", `${number(facts.area_m2, 5)}\u00a0m\u00b2`],
    ["Bounding box (x, y, z)", sides.join(" \u00d7 ")],
    ["Largest deviation", units.text("length", facts.max_deviation_m, 3)],
    ["Smallest angle of a facet", units.text("angle", facts.smallest_angle_deg, 3)],
  ];
  return element("dl", { class: "figures" },
    rows.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
}

const VERDICTS = {
  pass: ["\u2713", "checked, holds"],
  fail: ["\u2717", "checked, does not hold"],
  "not-checked": ["\u2013", "not checked"],
};

function checks(doc) {
  return element("ul", { class: "checks" }, doc.checks.map((check) => {
    const [sign, words] = VERDICTS[check.verdict];
    return element("li", { class: check.verdict },
      element("span", { class: "sign", "aria-hidden": "true" }, sign),
      element("span", {}, element("strong", {}, check.name), ` \u2013 ${words}`,
        check.detail ? element("span", { class: "detail" }, check.detail) : null));
  }));
}

function files(doc) {
  if (doc.files.length === 0) return null;
  return element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Files" },
    element("table", { class: "files" },
      element("thead", {}, element("tr", {},
        ["File", "Size", "SHA-256"].map((head) => element("th", { scope: "col" }, head)))),
      element("tbody", {}, doc.files.map((file) => element("tr", {},
        element("th", { scope: "row" }, file.name),
        element("td", { title: `${file.bytes} bytes` }, bytesText(file.bytes)),
        element("td", { class: "hash" }, file.sha256))))));
}

export function summary(doc, units) {
  return section("summary", "Summary", figures(doc, units),
    element("h3", {}, "Verdicts"), checks(doc),
    doc.mesh === null ? null : element("h3", {}, "Mesh"), mesh(doc, units),
    doc.files.length ? element("h3", {}, "Files") : null, files(doc));
}
