// A stream at any of the flows and frictions that were ridden beforehand: two sliders, and what it does then.

import { element, section } from "./dom.js";
import { number } from "./units.js";

const SAME = 1e-6;  // degrees: an angle that went through its tangent and back

const different = (values) => [...new Set(values)];

export class WhatIf {
  constructor(doc) {
    this.rides = doc.what_if ?? [];
    this.frictions = different(this.rides.map((ride) => ride.friction_angle_deg));
    this.flows = different(this.rides.map((ride) => ride.mass_flow_kg_per_s));
    this.nominal = this.rides.find((ride) => ride.nominal) ?? null;
  }

  at(friction, flow) {
    return this.rides[friction * this.flows.length + flow];
  }
}

function slider(label, values, start, text, onchange) {
  const output = element("output", {}, text(values[start]));
  const input = element("input", {
    type: "range", min: 0, max: values.length - 1, step: 1, value: start, "aria-label": label, "aria-valuetext": text(values[start]),
  });
  const tell = () => {
    const value = values[Number(input.value)];
    output.textContent = text(value);
    input.setAttribute("aria-valuetext", text(value));
    onchange(Number(input.value));
  };
  input.addEventListener("input", tell);
  const move = (index) => {
    input.value = String(index);
    tell();
  };
  return { move, node: element("label", { class: "control" }, element("span", {}, label), input, output) };
}

function facts(ride, units) {
  const { discharge } = ride;
  const status = ride.choked ? "chokes" : ride.status;
  const list = [
    ["Ride", ride.travel_time_s === null || ride.choked ? status : units.text("time", ride.travel_time_s, 4)],
    ["Greatest depth", `${units.text("length", ride.max_depth_m, 3)}, ${number(100 * ride.highest_filling, 3)}\u00a0% of what chokes it`],
    ["Exit speed", units.text("speed", ride.exit_speed_m_per_s, 4)],
    discharge && ["Along the belt", units.text("speed", discharge.speed_along_belt_m_per_s, 4)],
    discharge && ["Into the belt", units.text("speed", discharge.speed_into_belt_m_per_s, 4)],
    discharge && ["Lands beyond the finish", units.text("length", discharge.reach_m, 4)],
  ];
  return list.filter(Boolean).map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value)));
}

export function whatIfSection(doc, store, units) {
  const all = new WhatIf(doc);
  if (all.nominal === null) return null;
  const start = { friction: all.frictions.indexOf(all.nominal.friction_angle_deg), flow: all.flows.indexOf(all.nominal.mass_flow_kg_per_s) };
  const now = { ...start };
  const list = element("dl", { class: "readout", id: "what-if-facts", "aria-live": "polite" });
  // The page shows its own ride, which is told more finely, where the sliders stand at what it is ridden with.
  const ridden = ({ friction_angle_deg: angle }) => Math.abs(angle - (doc.ride.friction_angle_deg ?? doc.body.friction_angle_deg)) < SAME;
  const own = (ride) => now.flow === start.flow && ridden(ride);
  const show = () => {
    const ride = all.at(now.friction, now.flow);
    list.replaceChildren(...facts(ride, units));
    list.dataset.choked = String(ride.choked);
    store.set("whatIf", own(ride) ? null : ride);
  };
  const flow = slider("Mass flow", all.flows, start.flow, (value) => `${number(3.6 * value, 4)}\u00a0t/h`, (index) => {
    now.flow = index;
    show();
  });
  const friction = slider("Wall friction", all.frictions, start.friction, (value) => units.text("angle", value, 3), (index) => {
    now.friction = index;
    show();
  });
  show();
  store.on("units", show);
  // The switch of the whole page moves the slider to its friction.
  store.on("friction", () => {
    const level = all.frictions.findIndex((angle) => ridden({ friction_angle_deg: angle }));
    if (level >= 0) friction.move(level);
    show();
  });
  return section("what-if", "Another flow, another friction", element("div", { class: "controls" }, flow.node, friction.node), list,
    element("p", { class: "hint" }, `${all.rides.length} rides of this track, computed beforehand; the profile and the view above show the stream of the one chosen.`));
}
