import { button, element, section, svgElement } from "./dom.js";
import { interpolate, stationAt } from "./data.js";
import { exportButtons, standAlone } from "./export.js";
import { number, tickTexts } from "./units.js";

const PAPER_WIDTH = 686;  // A4 between its margins, in CSS pixels
const LEAST_HEIGHTS = 3;  // ticks along the height
const DIGIT_WIDTH = 7;  // of a tick's label, in CSS pixels
const MARGIN = { left: 62, right: 18, top: 14, bottom: 44 };

function niceStep(span, count) {
  const rough = span / count;
  const decade = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * decade).find((step) => step >= rough);
}

// Side view to scale: one length along the run is the same length on z.
class Profile {
  constructor(doc, store, units) {
    Object.assign(this, { doc, store, units });
    this.svg = svgElement("svg", {
      class: "profile", role: "img", tabindex: 0,
      "aria-label": `Side view to scale: run ${number(doc.endpoints.run_m, 5)} m, drop ${number(doc.endpoints.drop_m, 5)} m. `
        + "Arrow keys move the cursor, plus and minus zoom, 0 shows the whole track.",
    });
    this.view = this.wholeView();
    this.svg.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.svg.addEventListener("pointerdown", (event) => this.grab(event));
    this.svg.addEventListener("pointermove", (event) => this.hover(event));
    this.svg.addEventListener("keydown", (event) => this.key(event));
    for (const key of ["units", "theme", "paper", "friction", "whatIf"]) store.on(key, () => this.draw());
    store.on("station", () => this.moveCursor());
  }

  lines() {
    const { doc } = this;
    return [
      ["straight line", doc.straight, "line-straight"],
      // Of the fastest track itself it would lie below the track.
      [doc.limits.length > 0 ? "exact optimum without limits" : "exact optimum", doc.design.centerline === "fastest" ? null : doc.optimum, "line-optimum"],
      ["this track", doc.stations, "line-track"],
    ].filter(([, line]) => line !== null);
  }

  // What a drawing that leaves the page says over itself.
  caption() {
    const { doc } = this;
    return {
      title: `${doc.design.name}: profile, to scale`,
      legend: [...this.lines().map(([name, , style]) => [style, name]), ["solid", "the solid from the side"], ["headroom", "headroom"],
        ["keep-out", doc.envelope ? "where the solid may not go" : "where the track may not go"], ["stream", "the stream"]],
    };
  }

  wholeView() {
    let [x0, x1, z0, z1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const line of [...this.lines().map(([, one]) => one), ...(this.doc.envelope?.edges ?? []), ...this.doc.rides.flatMap((ride) => ride.flights)]) {
      for (let i = 0; i < line.x_m.length; i += 1) {
        x0 = Math.min(x0, line.x_m[i]);
        x1 = Math.max(x1, line.x_m[i]);
        z0 = Math.min(z0, line.z_m[i]);
        z1 = Math.max(z1, line.z_m[i]);
      }
    }
    const pad = 0.04 * Math.max(x1 - x0, z1 - z0);
    return { x0: x0 - pad, x1: x1 + pad, z0: z0 - pad, z1: z1 + pad };
  }

  layout(left) {
    const paper = this.store.get("paper");
    const width = paper ? PAPER_WIDTH : Math.max(this.svg.parentElement?.clientWidth ?? 0, 260);
    const inner = width - left - MARGIN.right;
    const spanX = this.view.x1 - this.view.x0;
    const spanZ = this.view.z1 - this.view.z0;
    const height = Math.min(Math.max((inner * spanZ) / spanX, 160), paper ? 380 : 560);
    const scale = Math.min(inner / spanX, height / spanZ);
    const offset = (inner - scale * spanX) / 2;
    return {
      left, width, height: height + MARGIN.top + MARGIN.bottom, scale,
      px: (x) => left + offset + scale * (x - this.view.x0),
      pz: (z) => MARGIN.top + scale * (this.view.z1 - z) + (height - scale * spanZ) / 2,
      inner, plotHeight: height,
    };
  }

  path(line) {
    const { px, pz } = this.at;
    return line.x_m.map((x, i) => `${i ? "L" : "M"}${px(x).toFixed(2)} ${pz(line.z_m[i]).toFixed(2)}`).join("");
  }

  // The solid from the side, between its outermost edges, and the headroom above it.
  body() {
    if (!this.doc.envelope) return [];
    const { px, pz } = this.at;
    const { edges } = this.doc.envelope;
    const built = edges.filter((edge) => !edge.dashed);
    const floor = this.doc.stations;
    const below = built.find((edge) => edge.name === "underside") ?? floor;
    const above = built.find((edge) => edge.name !== "underside") ?? floor;
    const corners = [
      ...below.x_m.map((x, i) => [x, below.z_m[i]]), ...above.x_m.map((x, i) => [x, above.z_m[i]]).reverse(),
    ];
    return [
      svgElement("polygon", { class: "solid", "data-line": "solid", points: corners.map(([x, z]) => `${px(x).toFixed(2)},${pz(z).toFixed(2)}`).join(" ") },
        svgElement("title", {}, "the solid from the side")),
      ...edges.filter((edge) => edge.dashed).map((edge) => svgElement("path", { class: "line headroom", "data-line": "headroom", d: this.path(edge) },
        svgElement("title", {}, edge.name))),
    ];
  }

  // The surface of a stream, its depth square to the floor, and its ways through the air.
  stream() {
    const flights = this.doc.ride.flights ?? this.doc.flights;
    const { px, pz } = this.at;
    const other = this.store.get("whatIf");
    const height = this.doc.stations.z_m[0];
    const stations = other ? { ...other.line, z_m: other.line.z_m.map((z) => z + height) } : this.doc.stations;
    const falls = other === null ? flights : [...flights.filter((flight) => flight.name !== "the stream falls on the belt"),
      { name: "the stream falls on the belt", x_m: other.flight_m.map(([x]) => x), z_m: other.flight_m.map(([, z]) => z) }];
    const nodes = falls.filter((flight) => flight.x_m.length > 0).map((flight) => svgElement("path", { class: flight.name === "the hood" ? "line hood" : "line flight", d: this.path(flight) },
      svgElement("title", {}, flight.name)));
    const depth = stations.burden_depth_m;
    if (!depth) return nodes;
    const corner = (x, z) => `${px(x).toFixed(2)},${pz(z).toFixed(2)}`;
    const flowing = stations.x_m.map((_, i) => i).filter((i) => depth[i] !== null);
    const floor = flowing.map((i) => corner(stations.x_m[i], stations.z_m[i]));
    const surface = flowing.map((i) => {
      const slope = (stations.slope_angle_deg[i] * Math.PI) / 180;
      return corner(stations.x_m[i] + depth[i] * Math.sin(slope), stations.z_m[i] + depth[i] * Math.cos(slope));
    });
    return [svgElement("polygon", { class: "stream", "data-line": "stream", points: [...floor, ...surface.reverse()].join(" ") },
      svgElement("title", {}, "the stream, as deep as it is")), ...nodes];
  }

  // The nodes of the axes, and what room they need on the left: heights far above zero have many digits.
  axes() {
    const { units, at } = this;
    const unit = units.unit("length");
    const nodes = [];
    const right = at.left + at.inner;
    const bottom = MARGIN.top + at.plotHeight;
    const step = niceStep(Math.max(at.inner, at.plotHeight) / at.scale, Math.max(Math.max(at.inner, at.plotHeight) / 75, 4));
    const multiples = (low, high, by) => {
      const first = Math.ceil(low / by);
      return Array.from({ length: Math.max(Math.floor(high / by) - first + 1, 0) }, (_, i) => (first + i) * by);
    };
    const [lowest, highest] = [(at.pz(0) - bottom) / at.scale, (at.pz(0) - MARGIN.top) / at.scale];
    // A flat track has few heights at the step of its run: it gets a finer one, as a reader must tell heights too.
    const finer = multiples(lowest, highest, step).length < LEAST_HEIGHTS;
    const stepZ = finer ? niceStep(at.plotHeight / at.scale, at.plotHeight / 34) : step;
    const labels = (places) => tickTexts(places.map((place) => units.convert("length", place)));
    const runs = multiples((at.left - at.px(0)) / at.scale, (right - at.px(0)) / at.scale, step);
    const runLabels = labels(runs);
    for (const [i, k] of runs.entries()) {
      const x = at.px(k);
      nodes.push(svgElement("line", { class: "grid", x1: x, x2: x, y1: MARGIN.top, y2: bottom }),
        svgElement("text", { class: "tick", x, y: bottom + 16, "text-anchor": "middle" }, runLabels[i]));
    }
    const heights = multiples(lowest, highest, stepZ);
    const heightLabels = labels(heights);
    for (const [i, k] of heights.entries()) {
      const y = at.pz(k);
      nodes.push(svgElement("line", { class: "grid", x1: at.left, x2: right, y1: y, y2: y }),
        svgElement("text", { class: "tick", x: at.left - 8, y: y + 4, "text-anchor": "end" }, heightLabels[i]));
    }
    nodes.push(
      svgElement("text", { class: "axis", x: (at.left + right) / 2, y: bottom + 36, "text-anchor": "middle" }, `run [${unit}]`),
      svgElement("text", { class: "axis", transform: `translate(14 ${(MARGIN.top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, `height z [${unit}]`));
    return { nodes, room: 30 + DIGIT_WIDTH * Math.max(...heightLabels.map((text) => text.length), 0) };
  }

  draw() {
    this.at = this.layout(MARGIN.left);
    let axes = this.axes();
    if (axes.room > MARGIN.left) {
      this.at = this.layout(axes.room);
      axes = this.axes();
    }
    const { at, doc } = this;
    const frame = { x: at.left, y: MARGIN.top, width: at.inner, height: at.plotHeight };
    this.marker = svgElement("circle", { class: "cursor", r: 5, "data-screen-only": true });
    this.bodies = {
      track: svgElement("circle", { class: "body body-track", r: 7, visibility: "hidden", "data-screen-only": true }),
      straight: svgElement("circle", { class: "body body-straight", r: 6, visibility: "hidden", "data-screen-only": true }),
    };
    const clip = svgElement("clipPath", { id: "profile-clip" }, svgElement("rect", frame));
    const outline = (area) => area.points_m.map(([x, z]) => `${at.px(x).toFixed(2)},${at.pz(z).toFixed(2)}`).join(" ");
    const curves = svgElement("g", { "clip-path": "url(#profile-clip)" },
      // The band around an obstacle that is kept free: a stroke of twice its width.
      doc.keep_outs.filter((area) => area.clearance_m > 0).map((area) => svgElement(area.open ? "polyline" : "polygon", {
        class: "clearance", points: outline(area), "stroke-width": (2 * area.clearance_m * at.scale).toFixed(2),
      }, svgElement("title", {}, `${area.name}: clearance`))),
      doc.keep_outs.map((area) => svgElement(area.open ? "polyline" : "polygon", {
        class: area.open ? "keep-out open" : "keep-out", "data-line": "keep-out",
        points: outline(area),
      }, svgElement("title", {}, area.name))),
      this.body(),
      this.stream(),
      this.lines().map(([name, line, style]) => svgElement("path", { class: `line ${style}`, "data-line": style, d: this.path(line) }, svgElement("title", {}, name))),
      this.marker, this.bodies.straight, this.bodies.track);
    this.svg.setAttribute("viewBox", `0 0 ${at.width} ${at.height}`);
    this.svg.setAttribute("width", at.width);
    this.svg.setAttribute("height", at.height);
    this.svg.replaceChildren(clip, ...axes.nodes, svgElement("rect", { class: "frame", ...frame }), curves);
    this.moveCursor();
    this.moveBodies(this.clock ?? null);
  }

  moveCursor() {
    if (!this.at) return;
    const { stations } = this.doc;
    const station = this.store.get("station");
    this.marker.setAttribute("cx", this.at.px(stations.x_m[station]));
    this.marker.setAttribute("cy", this.at.pz(stations.z_m[station]));
  }

  // Bodies at `seconds` after the start; null hides them.
  moveBodies(seconds) {
    this.clock = seconds;
    for (const [name, line] of [["track", this.doc.stations], ["straight", this.doc.straight]]) {
      // A ride that ends before the finish stands still where it ended.
      const known = line?.time_s.indexOf(null) ?? -1;
      const times = known >= 0 ? line.time_s.slice(0, known) : line?.time_s;
      const body = this.bodies[name];
      const show = seconds !== null && line !== null && times.length > 0;
      body.setAttribute("visibility", show ? "visible" : "hidden");
      if (!show) continue;
      body.setAttribute("cx", this.at.px(interpolate(times, line.x_m, seconds)));
      body.setAttribute("cy", this.at.pz(interpolate(times, line.z_m, seconds)));
    }
  }

  zoom(factor, x, z) {
    const { view } = this;
    this.view = {
      x0: x + factor * (view.x0 - x), x1: x + factor * (view.x1 - x),
      z0: z + factor * (view.z0 - z), z1: z + factor * (view.z1 - z),
    };
    this.draw();
  }

  whole() {
    this.view = this.wholeView();
    this.draw();
  }

  pointer(event) {
    const box = this.svg.getBoundingClientRect();
    const origin = { x: this.at.px(0), z: this.at.pz(0) };
    return {
      x: (event.clientX - box.left - origin.x) / this.at.scale,
      z: (origin.z - (event.clientY - box.top)) / this.at.scale,
    };
  }

  wheel(event) {
    if (!event.ctrlKey && document.activeElement !== this.svg) return;
    event.preventDefault();
    const { x, z } = this.pointer(event);
    this.zoom(Math.exp(0.0015 * event.deltaY), x, z);
  }

  grab(event) {
    if (event.button !== 0) return;
    this.svg.setPointerCapture(event.pointerId);
    let last = this.pointer(event);
    const move = (next) => {
      const now = this.pointer(next);
      const { view } = this;
      const dx = last.x - now.x;
      const dz = last.z - now.z;
      this.view = { x0: view.x0 + dx, x1: view.x1 + dx, z0: view.z0 + dz, z1: view.z1 + dz };
      this.draw();
      last = this.pointer(next);
    };
    const stop = () => {
      this.svg.removeEventListener("pointermove", move);
      this.svg.removeEventListener("pointerup", stop);
    };
    this.svg.addEventListener("pointermove", move);
    this.svg.addEventListener("pointerup", stop);
  }

  hover(event) {
    if (event.buttons !== 0) return;
    const { x, z } = this.pointer(event);
    const { x_m: xs, z_m: zs } = this.doc.stations;
    let nearest = 0;
    let least = Infinity;
    for (let i = 0; i < xs.length; i += 1) {
      const distance = (xs[i] - x) ** 2 + (zs[i] - z) ** 2;
      if (distance < least) {
        least = distance;
        nearest = i;
      }
    }
    this.store.set("station", nearest);
  }

  key(event) {
    const last = this.doc.stations.x_m.length - 1;
    const now = this.store.get("station");
    const middle = [(this.view.x0 + this.view.x1) / 2, (this.view.z0 + this.view.z1) / 2];
    const actions = {
      ArrowLeft: () => this.store.set("station", Math.max(now - 1, 0)),
      ArrowRight: () => this.store.set("station", Math.min(now + 1, last)),
      Home: () => this.store.set("station", 0),
      End: () => this.store.set("station", last),
      "+": () => this.zoom(0.8, ...middle),
      "-": () => this.zoom(1.25, ...middle),
      0: () => this.whole(),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }
}

// Bodies let go together, one on the track and one on the straight line, in real time.
class Ride {
  constructor(doc, profile, store) {
    Object.assign(this, { doc, profile, store });
    this.label = element("output", { class: "clock" });
    this.toggle = button("Let go", () => (this.running ? this.stop() : this.start()), { class: "primary", id: "ride" });
    this.slow = element("input", { type: "checkbox", id: "ride-slow" });
    this.finished = false;
    // The times that stand there are those of the friction that is shown.
    store.on("friction", () => {
      if (this.finished) this.label.textContent = this.result();
    });
  }

  get duration() {
    const { stations, straight } = this.doc;
    return Math.max(...stations.time_s, straight ? straight.time_s.at(-1) : 0);
  }

  controls() {
    return [this.toggle, element("label", { class: "control" }, this.slow, element("span", {}, "slow motion")), this.label];
  }

  result() {
    const { ride, straight } = this.doc;
    const times = [ride.travel_time_s === null ? "on this track the body does not arrive" : `this track ${ride.travel_time_s.toFixed(3)}\u00a0s`];
    const level = (ride.friction ?? "nominal") === "nominal" ? "" : " at nominal friction";
    if (straight) times.push(`straight line${level} ${straight.time_s.at(-1).toFixed(3)}\u00a0s`);
    return times.join(", ");
  }

  start() {
    this.running = true;
    this.finished = false;
    this.toggle.textContent = "Stop";
    this.seconds = 0;
    this.last = null;
    requestAnimationFrame((now) => this.step(now));
  }

  stop() {
    this.running = false;
    this.toggle.textContent = "Let go";
    this.profile.moveBodies(null);
    this.finished = this.seconds > this.duration;
    this.label.textContent = this.finished ? this.result() : "";
  }

  step(now) {
    if (!this.running) return;
    if (this.last !== null) this.seconds += ((now - this.last) / 1000) * (this.slow.checked ? 0.1 : 1);
    this.last = now;
    const clamped = Math.min(this.seconds, this.duration);
    this.profile.moveBodies(clamped);
    const times = this.doc.stations.time_s;
    this.store.set("station", stationAt(times.includes(null) ? times.slice(0, times.indexOf(null)) : times, clamped));
    this.label.textContent = `${clamped.toFixed(2)} s`;
    if (this.seconds > this.duration + 1.5) this.stop();
    else requestAnimationFrame((next) => this.step(next));
  }
}

export function profileSection(doc, store, units) {
  const profile = new Profile(doc, store, units);
  const ride = new Ride(doc, profile, store);
  const legend = element("ul", { class: "legend" }, profile.lines().map(([name, , style]) =>
    element("li", {}, element("span", { class: `swatch ${style}` }), name)),
    doc.envelope ? element("li", {}, element("span", { class: "swatch swatch-solid" }), "the solid from the side") : null,
    doc.envelope?.edges.some((edge) => edge.dashed) ? element("li", {}, element("span", { class: "swatch headroom" }), "headroom") : null,
    doc.keep_outs.length === 0 ? null : element("li", {}, element("span", { class: "swatch swatch-area" }),
      doc.envelope ? "where the solid may not go; paler: clearance" : "where the track may not go; paler: clearance"));
  const node = section("profile", "Profile, to scale",
    element("div", { class: "controls" }, ride.controls(),
      button("Zoom in", () => profile.key({ key: "+", preventDefault() {} })),
      button("Zoom out", () => profile.key({ key: "-", preventDefault() {} })),
      button("Whole track", () => profile.whole()),
      exportButtons(doc.design.stem, "Profile", () => standAlone(profile.svg, profile.caption()))),
    legend, element("p", { class: "hint" }, "Drag to move; the wheel zooms once the drawing is selected."),
    element("div", { class: "profile-holder" }, profile.svg));
  new ResizeObserver(() => profile.draw()).observe(node);
  return { node, draw: () => profile.draw() };
}
