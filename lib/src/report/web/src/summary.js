import { element, issueList, scrollable, section } from "./dom.js";
import { bytesText, countText, number, volumeText } from "./units.js";

export const NO_BREAK = "\u00a0";

// Of times, as the summary of the program says it: a time that is 8.64 % less is that of a speed that is 9.5 % more.
function against(time, other) {
  const percent = 100 * (time / other - 1);
  if (Math.abs(percent) < 5e-4) return "the same as";
  return `${number(Math.abs(percent), 3)}${NO_BREAK}% ${percent > 0 ? "more" : "less"} than`;
}

function timeRemarks({ ride, rides, limits, design }, units) {
  if (ride.travel_time_s === null) return ["the body does not arrive"];
  const time = (seconds) => units.text("time", seconds, 5);
  // Optimum and straight line are those at nominal friction: no ride at another one is to be held against them.
  const nominal = rides.find(({ friction }) => friction === "nominal");
  if ((ride.friction ?? "nominal") !== "nominal") {
    if (nominal.travel_time_s === null) return ["at nominal friction the body does not arrive"];
    return [`${against(ride.travel_time_s, nominal.travel_time_s)} at nominal friction, ${time(nominal.travel_time_s)}`];
  }
  const optimum = limits.length > 0 ? "the exact optimum without limits" : "the exact optimum";
  const remarks = [
    ride.optimum_travel_time_s === null ? "the exact optimum is not known here"
      : `${against(ride.travel_time_s, ride.optimum_travel_time_s)} ${optimum}, ${time(ride.optimum_travel_time_s)}`,
    ride.straight_travel_time_s === null ? "on the straight line the body does not arrive"
      : `${against(ride.travel_time_s, ride.straight_travel_time_s)} the straight line, ${time(ride.straight_travel_time_s)}`,
  ];
  return design.centerline === "straight" ? remarks.slice(0, 1) : remarks;
}

function directionText(slope, units) {
  if (Math.abs(slope) < 5e-4) return "level";
  return `${units.text("angle", Math.abs(slope), 4)} ${slope > 0 ? "below" : "above"} the horizontal`;
}

function tiles(doc, units) {
  const { ride } = doc;
  const place = (s) => `at s = ${units.text("length", s, 4)}`;
  const radius = {
    text: ride.min_radius_m === null ? "straight" : ride.min_radius_m === 0 ? "0" : units.text("length", ride.min_radius_m, 4),
    remark: ride.min_radius_m === null ? "no curve anywhere" : ride.min_radius_m === 0 ? "at the vertical start" : place(ride.min_radius_at_m),
  };
  const all = [
    [doc.rides.length > 1 ? `Travel time at ${ride.friction ?? "nominal"} friction` : "Travel time", units.text("time", ride.travel_time_s, 5), timeRemarks(doc, units)],
    ["Exit speed", units.text("speed", ride.exit_speed_m_per_s, 4), [directionText(ride.exit_slope_angle_deg, units)]],
    ["Highest normal load", units.text("load", ride.max_normal_load_m_per_s2, 4), [place(ride.max_normal_load_at_m)]],
    ["Smallest radius", radius.text, [radius.remark]],
    ...streamTiles(ride, units, place),
  ];
  return element("dl", { class: "tiles" }, all.map(([name, value, remarks]) => element("div", {},
    element("dt", {}, name), element("dd", { class: "value" }, value),
    remarks.map((remark) => element("dd", { class: "remark" }, remark)))));
}

function streamTiles({ stream }, units, place) {
  if (!stream) return [];
  const left = stream.choked ? "chokes" : `${number(100 * stream.highest_filling, 3)} % of what chokes it`;
  return [
    ["Greatest burden depth", units.text("length", stream.max_depth_m, 4), [place(stream.max_depth_at_m), left]],
    ["Burden depth at the finish", stream.exit_depth_m === null ? "none" : units.text("length", stream.exit_depth_m, 4), []],
  ];
}

function list(rows) {
  return element("dl", { class: "figures" }, rows.map(([name, value]) => element("div", {},
    element("dt", {}, name), element("dd", {}, value))));
}

// What slides has a friction angle, what rolls a resistance; either may change along the track.
function frictionRow(body, changes, units) {
  const rolls = body.body === "rolling";
  const one = ({ friction_angle_deg: angle, friction_coefficient: coefficient }) =>
    (rolls ? number(coefficient, 4) : `${units.text("angle", angle, 4)} (coefficient ${number(coefficient, 4)})`);
  const all = [one(body), ...changes.map((change) => `from s = ${units.text("length", change.from_m, 5)} on ${one(change)}`)].join("; ");
  return rolls ? ["Rolling body", `radius ${units.text("length", body.radius_m, 4)}, rolling resistance ${all}`] : ["Friction angle", all];
}

// What makes a body other than a point in still air.
function bodyRows(body, units) {
  const wind = body.head_wind_m_per_s ?? 0;
  return [
    // A ball's is its radius where nothing else is said.
    ...(body.centre_height_m === 0 || body.centre_height_m === body.radius_m ? [] : [["Centre of mass", `${units.text("length", body.centre_height_m, 4)} above the track`]]),
    ...(wind === 0 ? [] : [[wind > 0 ? "Head wind" : "Tail wind", units.text("speed", Math.abs(wind), 4)]]),
  ];
}

// The task at the friction that is shown: with a feed the entry speed follows from it.
function task({ endpoints, body: nominal, placement, ride }, units) {
  const shown = Object.fromEntries(["friction_angle_deg", "friction_coefficient", "entry_speed_m_per_s"]
    .filter((key) => ride[key] !== undefined && nominal[key] !== undefined).map((key) => [key, ride[key]]));
  const body = { ...nominal, ...shown };
  // What begins beyond the finish has no effect.
  const changes = (body.friction_along_the_track ?? []).filter(({ from_m: from }) => from > 0 && from < ride.arc_length_m);
  const place = units.place(ride.arc_length_m);
  const point = (values) => values.map(place).join(", ") + NO_BREAK + units.unit("length");
  return list([
    ["Run and drop", `${units.text("length", endpoints.run_m, 5)} and ${units.text("length", endpoints.drop_m, 5)}`],
    ["Start (x, y, z)", point(placement.start_m)],
    ["Finish (x, y, z)", point(placement.finish_m)],
    frictionRow(body, changes, units),
    ...bodyRows(body, units),
    ...(body.mass_flow_kg_per_s === undefined ? [] : [
      ["Stream", `${number(3.6 * body.mass_flow_kg_per_s, 4)}${NO_BREAK}t/h at ${number(body.bulk_density_kg_per_m3, 4)}${NO_BREAK}kg/m\u00b3`],
    ]),
    ["Entry speed", body.entry_speed_m_per_s === 0 ? "from rest" : units.text("speed", body.entry_speed_m_per_s, 4)],
    ["Drag", body.drag_per_m === 0 ? "none" : `${number(body.drag_per_m, 4)}${NO_BREAK}1/m`],
    ["Gravity", `${number(body.gravity_m_per_s2, 6)}${NO_BREAK}m/s\u00b2`],
  ]);
}

function marginText({ rides, ride }, units) {
  const level = ride.friction ?? "nominal";
  const { stall_friction_angle_deg: angle, stall_margin_deg: margin } = rides.find(({ friction }) => friction === level);
  return angle === null ? "none below 89.9 deg" : `${units.text("angle", angle, 4)} (margin ${units.text("angle", margin, 3)})`;
}

function track(doc, units) {
  const { ride, design } = doc;
  return list([
    ["Centerline", design.centerline],
    ["Cross-section", design.cross_section],
    ...(doc.body.body === "rolling" ? [] : [["Stalls from a friction angle of", marginText(doc, units)]]),
    ["Arc length", units.text("length", ride.arc_length_m, 5)],
    ["Entry slope angle", units.text("angle", ride.entry_slope_angle_deg, 4)],
    ["Steepest slope angle", units.text("angle", ride.steepest_slope_angle_deg, 4)],
    ["Exit slope angle", units.text("angle", ride.exit_slope_angle_deg, 4)],
  ]);
}

// Where the origin of the mesh files lies on the site.
function offsetText(offset, units) {
  if (offset.every((value) => value === 0)) return "none: files are in the site's coordinates";
  const finest = 1e-3;  // to a tenth of a micrometre
  return `${offset.map(units.place(finest)).join(", ")}${NO_BREAK}${units.unit("length")}`;
}

function mesh({ mesh: facts }, units) {
  const sides = [0, 1, 2].map((axis) => units.text("length", facts.upper_m[axis] - facts.lower_m[axis], 4));
  return list([
    ["Facets and vertices", `${countText(facts.triangles)} and ${countText(facts.vertices)}`],
    ["Volume", volumeText(facts.volume_m3)],
    ["Surface", `${number(facts.area_m2, 4)}${NO_BREAK}m\u00b2`],
    ["Bounding box (x \u00d7 y \u00d7 z)", sides.join(" \u00d7 ")],
    ["Offset of the files to the site (x, y, z)", offsetText(facts.offset_m, units)],
    ["Largest deviation", units.text("length", facts.max_deviation_m, 3)],
    ["Smallest angle of a facet", units.text("angle", facts.smallest_angle_deg, 3)],
  ]);
}

const VERDICTS = {
  pass: ["\u2713", "checked, holds: "],
  fail: ["\u2717", "checked, does not hold: "],
  "not-checked": ["\u2013", "not checked: "],
};

// The checks, those of a ride as they are of the one that is shown.
function checksOf({ checks, ride }) {
  return checks.map((check) => ride.checks?.find(({ name }) => name === check.name) ?? check);
}

function detailText(check, units) {
  if (!check.detail_pieces) return check.detail;
  return check.detail_pieces.map((piece) => (typeof piece === "string" ? piece : units.textOf(piece.unit, piece.value, piece.digits))).join("");
}

function tally(doc) {
  const checks = checksOf(doc);
  const count = (verdict) => checks.filter((check) => check.verdict === verdict).length;
  const [held, failed, open] = [count("pass"), count("fail"), count("not-checked")];
  const text = (failed === 0 ? `${held} of ${held} checks hold` : `${failed} of ${held + failed} checks fail`)
    + (open === 0 ? "." : `; ${open} not checked.`);
  return element("p", { class: `tally ${failed > 0 ? "fail" : held > 0 ? "pass" : "not-checked"}` }, text);
}

function checks(doc, units) {
  const nominal = (doc.ride.friction ?? "nominal") === "nominal";
  return element("ul", { class: "checks" }, checksOf(doc).map((check) => {
    const [sign, words] = VERDICTS[check.verdict];
    return element("li", { class: check.verdict },
      element("span", { class: "sign", "aria-hidden": "true" }, sign),
      element("span", {}, element("span", { class: "spoken" }, words), element("strong", {}, check.name),
        check.verdict === "not-checked" ? " \u2013 not checked" : null,
        check.of_nominal && !nominal ? " \u2013 at nominal friction" : null,
        check.detail ? element("span", { class: "detail" }, detailText(check, units)) : null));
  }));
}

function files(doc) {
  return scrollable("Files", element("table", { class: "files" },
    element("thead", {}, element("tr", {},
      ["File", "Size", "SHA-256"].map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, doc.files.map((file) => element("tr", {},
      element("th", { scope: "row" }, file.name),
      element("td", { title: `${countText(file.bytes)} bytes` }, bytesText(file.bytes)),
      element("td", { class: "hash" }, file.sha256))))));
}

// One row a friction of the design's range.
function frictions({ rides }, units) {
  const ended = (ride) => (ride.stall ? "stalls" : ride.stream?.choked ? "chokes" : ride.lift_off ? "leaves the track" : "does not arrive");
  const heads = ["Friction", "Travel time", "Exit speed", "Highest speed", "Highest load", "Lowest load", "Stall margin"];
  return scrollable("Range of rides", element("table", { class: "frictions" },
    element("thead", {}, element("tr", {}, heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, rides.map((ride) => element("tr", {},
      element("th", { scope: "row" }, `${ride.friction}, ${units.text("angle", ride.friction_angle_deg, 4)}`),
      element("td", {}, ride.travel_time_s === null ? ended(ride) : units.text("time", ride.travel_time_s, 5)),
      element("td", {}, units.text("speed", ride.exit_speed_m_per_s, 4)),
      element("td", {}, units.text("speed", ride.highest_speed_m_per_s, 4)),
      element("td", {}, units.text("load", ride.max_normal_load_m_per_s2, 4)),
      element("td", {}, units.text("load", ride.min_normal_load_m_per_s2, 4)),
      element("td", {}, ride.stall_margin_deg === null ? "never stalls" : units.text("angle", ride.stall_margin_deg, 3)))))));
}

// Places that the design asks about, one row a friction.
function probes(doc, units) {
  const several = doc.rides.length > 1;
  const heads = ["Probe", "s", "Slope angle", ...(several ? ["Friction"] : []), "Speed", "Normal load", "Time"];
  return scrollable("Table of probes", element("table", { class: "probes" },
    element("thead", {}, element("tr", {}, heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, doc.probes.flatMap((probe) => probe.states.map((state, i) => element("tr", {},
      element("th", { scope: "row" }, i === 0 ? probe.name : ""),
      element("td", {}, i === 0 ? units.text("length", probe.arc_length_m, 5) : ""),
      element("td", {}, i === 0 ? units.text("angle", probe.slope_angle_deg, 4) : ""),
      several ? element("td", {}, state.friction) : null,
      element("td", {}, units.text("speed", state.speed_m_per_s, 4)),
      element("td", {}, units.text("load", state.normal_load_m_per_s2, 4)),
      element("td", {}, units.text("time", state.time_s, 5))))))));
}

export const SIGNS = { pass: "\u2713", warn: "!", fail: "\u2717", "cannot be judged": "?" };

// Rules that the design is held against: what each asks, what there is, and how sure its bound is.
function rules(doc, units) {
  const value = (rule, key) => (rule[key] === null ? null : units.textOf(rule.unit, rule[key], 4));
  const bound = (rule) => [["lowest", "\u2265 "], ["highest", "\u2264 "]]
    .filter(([key]) => rule[key] !== null).map(([key, sign]) => sign + value(rule, key)).join(", ");
  const place = (rule) => [rule.where === null ? null : `s = ${units.text("length", rule.where, 4)}`, rule.place || null].filter(Boolean).join("; ");
  const heads = ["Verdict", "Rule", "Value", "Bound", "Where", "Source"];
  return scrollable("Table of rules", element("table", { class: "rules" },
    element("thead", {}, element("tr", {}, heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, doc.rules.map((rule) => element("tr", { class: rule.verdict === "fail" ? "violated" : "" },
      element("th", { scope: "row" }, `${SIGNS[rule.verdict]} ${rule.verdict}`),
      element("td", { class: "words" }, rule.sentence, rule.reason ? element("span", { class: "detail" }, rule.reason) : null),
      element("td", {}, value(rule, "value") ?? "\u2013"),
      element("td", {}, bound(rule)),
      element("td", {}, place(rule)),
      element("td", { class: "words" }, rule.source, element("span", { class: "detail" }, rule.certainty + (rule.needs_checking ? ", to be checked" : ""))))))));
}

// Every friction with every flow of a stream.
function cases(doc, units) {
  const heads = ["Friction", "Flow", "Ride", "Greatest depth", "Depth at the finish", "Highest speed", "Exit speed"];
  return scrollable("Range of flows", element("table", { class: "frictions" },
    element("thead", {}, element("tr", {}, heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, doc.cases.map((one) => element("tr", {},
      element("th", { scope: "row" }, `${one.friction}, ${units.text("angle", one.friction_angle_deg, 4)}`),
      element("td", {}, one.flow),
      element("td", {}, one.travel_time_s === null ? one.status : units.text("time", one.travel_time_s, 4)),
      element("td", {}, units.text("length", one.stream.max_depth_m, 3)),
      element("td", {}, one.stream.exit_depth_m === null ? "\u2013" : units.text("length", one.stream.exit_depth_m, 3)),
      element("td", {}, units.text("speed", one.highest_speed_m_per_s, 4)),
      element("td", {}, units.text("speed", one.exit_speed_m_per_s, 4)))))));
}

export function summary(doc, units) {
  const heading = (text) => element("h3", {}, text);
  return section("summary", "Summary", tiles(doc, units),
    doc.warnings.length === 0 ? null : issueList(doc.warnings),
    doc.rides.length < 2 ? null : [heading("Range of friction"), frictions(doc, units)],
    doc.probes.length === 0 ? null : [heading("Probes"), probes(doc, units)],
    doc.cases.length === 0 ? null : [heading("Frictions and flows"), cases(doc, units)],
    doc.rules.length === 0 ? null : [heading("Rules"), rules(doc, units)],
    heading("Verdicts"), tally(doc), checks(doc, units),
    heading("Task"), task(doc, units),
    heading("Track"), track(doc, units),
    doc.mesh === null ? null : [heading("Mesh"), mesh(doc, units)],
    doc.files.length === 0 ? null : [heading("Files"), files(doc)]);
}
