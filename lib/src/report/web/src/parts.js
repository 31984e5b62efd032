// What a workshop makes: the parts in three dimensions, drawn apart, with the pattern, the row and the files of the one
// that is chosen; the list of them; the rules of the shop.

import {
  Box3, BufferAttribute, BufferGeometry, DoubleSide, EdgesGeometry, Group, LineBasicMaterial, LineSegments,
  Matrix4, Mesh, MeshLambertMaterial, Raycaster, SRGBColorSpace, Vector2, Vector3,
} from "three";
import { decodeArray } from "./data.js";
import { button, element, issueList, scrollable, section, select } from "./dom.js";
import { exportButtons, standAlone } from "./export.js";
import { nestDrawing, patternDrawing, viewsDrawing } from "./pattern.js";
import { DIRECTIONS, paintedSize, Stage } from "./stage.js";
import { stillPicture } from "./still.js";
import { NO_BREAK, SIGNS } from "./summary.js";
import { countText, millimetres, number, volumeText } from "./units.js";

const PER_PLACE = 15;  // numbers: origin, three axes, the way to go when drawn apart
const CREASE = 25;     // degrees between facets whose edge is drawn

// A body's vertices in its own frame and the places of its pieces, from the middle of the assembly.
function unpack(body, steps) {
  const quantised = decodeArray(body.positions);
  const positions = new Float32Array(quantised.length);
  for (let i = 0; i < quantised.length; i += 1) {
    const axis = i % 3;
    positions[i] = body.lower_m[axis] + (quantised[i] / steps) * (body.upper_m[axis] - body.lower_m[axis]);
  }
  const numbers = decodeArray(body.places);
  const places = [];
  for (let i = 0; i < numbers.length; i += PER_PLACE) {
    const [origin, x, y, z, apart] = [0, 3, 6, 9, 12].map((k) => Array.from(numbers.slice(i + k, i + k + 3)));
    places.push({ origin, x, y, z, apart });
  }
  return { positions, indices: decodeArray(body.indices), places, lower: body.lower_m, upper: body.upper_m, colour: body.colour };
}

function matrixOf({ origin, x, y, z, apart }, share, middle) {
  const at = [0, 1, 2].map((axis) => origin[axis] + share * apart[axis] - middle[axis]);
  return new Matrix4().set(
    x[0], y[0], z[0], at[0],
    x[1], y[1], z[1], at[1],
    x[2], y[2], z[2], at[2],
    0, 0, 0, 1);
}

// The corners of the boxes of a part's pieces, as they lie.
function cornersOf(body, share, middle) {
  const own = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [0, 1, 2].map((axis) => ((k >> axis) & 1 ? body.upper : body.lower)[axis]));
  return body.places.flatMap((place) => {
    const matrix = matrixOf(place, share, middle);
    return own.map((corner) => new Vector3(...corner).applyMatrix4(matrix));
  });
}

// Drawn from the middle of the assembly, so that numbers stay small.
function middleOf(bodies) {
  const box = new Box3().setFromPoints(bodies.flatMap((body) => cornersOf(body, 0, [0, 0, 0])));
  return box.getCenter(new Vector3()).toArray();
}

function geometryOf(body) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(body.positions, 3));
  geometry.setIndex(new BufferAttribute(body.indices, 1));
  return geometry;
}

class PartsView extends Stage {
  constructor(canvas, azimuth, bodies, middle, onchoose) {
    super(canvas, azimuth);
    this.bodies = bodies;
    this.middle = middle;
    this.share = 0;
    this.chosen = null;
    this.alone = false;
    this.groups = bodies.map((body, part) => this.group(body, part));
    this.scene.add(...this.groups);
    let down = null;
    canvas.addEventListener("pointerdown", (event) => {
      down = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointerup", (event) => {
      // Who drags turns the view.
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 6) onchoose(this.partAt(event));
    });
    this.arrange();
    this.look("Three-quarter");
  }

  group(body, part) {
    const geometry = geometryOf(body);
    const edges = new EdgesGeometry(geometry, CREASE);
    const group = new Group();
    group.userData = {
      surface: new MeshLambertMaterial({ side: DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
      line: new LineBasicMaterial(),
    };
    for (const place of body.places) {
      const piece = new Group();
      piece.matrixAutoUpdate = false;
      piece.userData = { place };
      const mesh = new Mesh(geometry, group.userData.surface);
      mesh.userData = { part };
      piece.add(mesh, new LineSegments(edges, group.userData.line));
      group.add(piece);
    }
    return group;
  }

  // The part below the pointer; null: none.
  partAt(event) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const at = new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const [hit] = ray.intersectObjects(this.groups.filter((group) => group.visible)).filter(({ object }) => object.isMesh);
    return hit ? hit.object.userData.part : null;
  }

  // Puts every piece where it is, drawn apart by a share, and frames what is shown.
  arrange() {
    this.shown = [];
    this.groups.forEach((group, part) => {
      group.visible = !this.alone || this.chosen === null || this.chosen === part;
      for (const piece of group.children) {
        piece.matrix.copy(matrixOf(piece.userData.place, this.share, this.middle));
        piece.matrixWorldNeedsUpdate = true;
      }
      if (group.visible) this.shown.push(...cornersOf(this.bodies[part], this.share, this.middle));
    });
    this.box = new Box3().setFromPoints(this.shown);
    this.radius = Math.max(this.box.getSize(new Vector3()).length() / 2, 1e-6);
    if (this.direction !== null && this.direction !== undefined) this.look(this.direction);
    this.render();
  }

  corners() {
    return this.shown;
  }

  // The chosen part in one that no part has.
  paint() {
    this.groups.forEach((group, part) => {
      group.userData.surface.color.setRGB(...colourOf(this.bodies, part, this.chosen), SRGBColorSpace);
      group.userData.line.color.set(part === this.chosen ? "#5c2404" : "#44505a");
    });
    this.render();
  }

  numbers(labels) {
    this.labels = labels;
    this.render();
  }

  // Each number at its part's first piece; those that would lie on a nearer one are left out.
  placeLabels() {
    if (!this.labels) return;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const seen = this.bodies.map((body, part) => {
      const middle = new Vector3(...[0, 1, 2].map((axis) => (body.lower[axis] + body.upper[axis]) / 2));
      const at = middle.applyMatrix4(matrixOf(body.places[0], this.share, this.middle)).project(this.camera);
      return { part, x: (at.x + 1) / 2, y: (1 - at.y) / 2, depth: part === this.chosen ? -2 : at.z };
    }).sort((a, b) => a.depth - b.depth);
    const taken = [];
    for (const { part, x, y } of seen) {
      const inside = x > 0.01 && x < 0.99 && y > 0.02 && y < 0.98;
      const free = taken.every((other) => Math.abs(other.x - x) * width > 24 || Math.abs(other.y - y) * height > 19);
      const label = this.labels[part];
      label.hidden = !(inside && free && this.groups[part].visible);
      if (label.hidden) continue;
      taken.push({ x, y });
      label.style.left = `${100 * x}%`;
      label.style.top = `${100 * y}%`;
    }
  }
}

// Red, green, blue from 0 to 1: the part's own, calmer beside a chosen one.
function colourOf(bodies, part, chosen) {
  if (part === chosen) return [0.95, 0.45, 0.05];
  const { colour } = bodies[part];
  return chosen === null ? colour : colour.map((value) => 0.5 * value + 0.38);
}

// Every piece as facets of one mesh, for the still picture.
function gathered(bodies, share, middle, shown) {
  const positions = [];
  const indices = [];
  const parts = [];
  bodies.forEach((body, part) => {
    if (!shown(part)) return;
    for (const place of body.places) {
      const first = positions.length / 3;
      const matrix = matrixOf(place, share, middle);
      for (let i = 0; i < body.positions.length; i += 3) {
        const at = new Vector3(body.positions[i], body.positions[i + 1], body.positions[i + 2]).applyMatrix4(matrix);
        positions.push(at.x, at.y, at.z);
      }
      for (const index of body.indices) indices.push(first + index);
      for (let t = 0; t < body.indices.length; t += 3) parts.push(part);
    }
  });
  return { positions, indices, parts };
}

const massText = (kilograms) => (kilograms < 1 ? `${number(1e3 * kilograms, 4)}${NO_BREAK}g` : `${number(kilograms, 4)}${NO_BREAK}kg`);
const nameOf = (part) => `${part.number} ${part.name.replaceAll("_", " ")}`;

// --- the chosen part

function diameters(holes) {
  const counts = new Map();
  for (const [, , diameter] of holes) counts.set(diameter, (counts.get(diameter) ?? 0) + 1);
  return [...counts].sort(([a], [b]) => a - b).map(([diameter, count]) => `${count} of ${millimetres(diameter)}`).join(", ");
}

function facts(part, body) {
  const sides = body ? [0, 1, 2].map((axis) => body.upper[axis] - body.lower[axis]).sort((a, b) => b - a) : null;
  const rows = [
    ["Material", `${part.material}, ${millimetres(part.thickness_m)}`],
    ["Pieces", String(part.quantity)],
    ["Mass", part.quantity > 1 ? `${massText(part.mass_kg)} each, ${massText(part.quantity * part.mass_kg)} in all` : massText(part.mass_kg)],
    ["Volume of one", volumeText(part.volume_m3)],
    ["Finished size", sides ? sides.map((side) => millimetres(side)).join(" \u00d7 ") : null],
    ["Centre of gravity of the first", part.centre_of_gravity_m.map((value) => millimetres(value)).join(", ")],
    ["Holes", part.pattern && part.pattern.holes_m.length > 0 ? diameters(part.pattern.holes_m) : null],
    ["Cutouts", part.pattern && part.pattern.cutouts_m.length > 0 ? String(part.pattern.cutouts_m.length) : null],
  ];
  return element("dl", { class: "figures part-facts" }, rows.filter(([, text]) => text !== null)
    .map(([name, text]) => element("div", {}, element("dt", {}, name), element("dd", {}, text))));
}

// How far a bend lies from the edge of the pattern before it, square to the bend.
function fromEdge(bend, outline) {
  const [dx, dy] = [bend.to_m[0] - bend.from_m[0], bend.to_m[1] - bend.from_m[1]];
  const length = Math.hypot(dx, dy);
  const across = ([x, y]) => (dy * x - dx * y) / length;
  const sides = outline.map(across);
  const at = across(bend.from_m);
  return dy < 0 ? Math.max(...sides) - at : at - Math.min(...sides);
}

function bends({ pattern }, units) {
  if (!pattern || pattern.bends.length === 0) return null;
  return scrollable("Bends of this part", element("table", { class: "bends" },
    element("thead", {}, element("tr", {}, ["Bend", "From the edge", "Angle", "Direction", "Inner radius"].map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, pattern.bends.map((bend, i) => element("tr", {},
      element("td", {}, String(i + 1)), element("td", {}, millimetres(fromEdge(bend, pattern.outline_m))), element("td", {}, units.text("angle", bend.angle_deg, 4)),
      element("td", {}, bend.up ? "up" : "down"), element("td", {}, millimetres(bend.inner_radius_m)))))));
}

function fileLinks(part) {
  if (part.files.length === 0) return element("p", { class: "note" }, "No file of its own: the lists and the assembly hold it.");
  const address = (name) => name.split("/").map(encodeURIComponent).join("/");
  return [
    element("h4", {}, "Files"),
    element("ul", { class: "part-files" }, part.files.map((name) => element("li", {}, element("a", { href: address(name) }, name)))),
  ];
}

function details(doc, part, body, units) {
  const edges = () => {
    const lines = new EdgesGeometry(geometryOf(body), CREASE);
    return lines.getAttribute("position").array;
  };
  const svg = part.pattern ? patternDrawing(part, units) : body ? viewsDrawing(part, edges()) : null;
  const make = () => standAlone(svg);
  const title = part.pattern ? "Flat pattern" : "Views from above, the side and the end";
  return [
    element("h3", {}, nameOf(part)),
    facts(part, body),
    svg ? element("figure", { class: "pattern-holder" },
      element("figcaption", {}, element("span", { class: "chart-title" }, title),
        element("span", { class: "exports" }, exportButtons(doc.design.stem, `part ${part.number} ${part.name}`, make))), svg) : null,
    bends(part, units),
    fileLinks(part),
  ];
}

// --- lists

function builtText({ master_curve: master, as_built: ride }, units) {
  const change = 100 * (ride.exit_speed_change ?? 0);
  const cost = Math.abs(change) < 1e-4 ? "" : `, ${number(Math.abs(change), 2)} % ${change < 0 ? "less" : "more"} than designed`;
  const hops = ride.hops > 0
    ? `; off the floor ${ride.hops === 1 ? "once" : `${ride.hops} times`}, by ${units.text("length", ride.highest_hop_m, 2)} at most` : "";
  const built = ride.arrives
    ? `${units.text("time", ride.travel_time_s, 5)}, ${units.text("speed", ride.exit_speed_m_per_s, 4)}${cost}; ${ride.bends} bends, ${ride.joints} joints${hops}`
    : `the body does not arrive${ride.stopped ? `: ${ride.stopped}` : ""}`;
  return `${master.arcs} arcs; no fewer than ${master.lower_bound} reach ${units.text("length", master.tolerance_m, 3)}. As built: ${built}.`;
}

function partsTable(parts, store) {
  const rows = parts.map((part, i) => element("tr", { "data-part": part.number, onclick: () => store.set("part", i) },
    element("td", {}, String(part.number)),
    element("th", { scope: "row" }, part.name),
    element("td", {}, part.material),
    element("td", {}, millimetres(part.thickness_m)),
    element("td", {}, String(part.quantity)),
    element("td", {}, massText(part.mass_kg))));
  const mark = (scroll) => rows.forEach((row, i) => {
    const chosen = store.get("part") === i;
    row.classList.toggle("chosen", chosen);
    if (chosen) row.setAttribute("aria-current", "true");
    else row.removeAttribute("aria-current");
    if (!chosen || !scroll) return;
    // The list alone moves, not the page.
    const holder = row.closest(".scroll");
    const [low, high] = [holder.scrollTop + 40, holder.scrollTop + holder.clientHeight - row.offsetHeight];
    if (row.offsetTop < low || row.offsetTop > high) holder.scrollTop = row.offsetTop - holder.clientHeight / 2;
  });
  mark(false);
  const heads = ["No.", "Part", "Material", "Thickness", "Pieces", "Mass of one"];
  const table = element("table", { class: "parts" },
    element("thead", {}, element("tr", {}, heads.map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, rows));
  return { table, mark };
}

// Every sheet of stock with its picture, and how much of each is used.
function stockSheets({ nests, parts }, store) {
  const figures = nests.map((nest) => {
    const [length, width] = nest.sheet_m;
    const what = `${nest.material}, ${millimetres(nest.thickness_m)}, ${millimetres(length)} \u00d7 ${millimetres(width)}: `
      + `${countText(nest.pieces)} ${nest.pieces === 1 ? "piece" : "pieces"}, ${number(100 * nest.utilisation, 3)}${NO_BREAK}% used`;
    const address = nest.file.split("/").map(encodeURIComponent).join("/");
    return element("figure", { class: "nest-holder" }, nestDrawing(nest, parts, (part) => store.set("part", part)),
      element("figcaption", {}, what, " ", element("a", { href: address }, "DXF")));
  });
  const node = element("div", { class: "nests" }, figures);
  const mark = () => {
    const chosen = store.get("part");
    const number = chosen === null ? "" : String(parts[chosen].number);
    for (const shape of node.querySelectorAll(".sheet")) shape.classList.toggle("chosen", shape.dataset.part === number);
  };
  mark();
  return { node, mark };
}

function itemsTable(items) {
  return scrollable("Table of bought-in items", element("table", { class: "items" },
    element("thead", {}, element("tr", {}, ["Pieces", "Item", "Standard", "Where"].map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, items.map((item) => element("tr", {},
      element("td", {}, String(item.quantity)), element("th", { scope: "row" }, item.name),
      element("td", { class: "words" }, item.standard), element("td", { class: "words" }, item.where))))));
}

function shopRules(checks) {
  return scrollable("Rules of the shop", element("table", { class: "rules" },
    element("thead", {}, element("tr", {}, ["Verdict", "Rule", "Value", "Bound", "Where", "Source"].map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, checks.map((check) => element("tr", { class: check.verdict === "fail" ? "violated" : "" },
      element("th", { scope: "row" }, `${SIGNS[check.verdict]} ${check.verdict}`),
      element("td", { class: "words" }, check.sentence), element("td", {}, check.value), element("td", {}, check.bound),
      element("td", {}, check.where),
      element("td", { class: "words" }, check.source,
        element("span", { class: "detail" }, check.certainty + (check.needs_checking ? ", to be checked" : ""))))))));
}

function notesList(notes) {
  return element("ul", { class: "shop-notes" }, notes.map((note) => element("li", {}, note)));
}

// --- the section

class PartsSection {
  constructor(doc, store, units) {
    Object.assign(this, { doc, store, units, made: doc.fabrication });
    this.parts = this.made.parts;
    this.canvas = element("canvas", { id: "parts-view", tabindex: 0, role: "img",
      "aria-label": "The parts in three dimensions. Arrow keys turn them, plus and minus zoom, n and p choose the next and the previous part, Escape none." });
    this.labels = this.parts.map((part) => element("span", { class: "part-number", "aria-hidden": "true", hidden: true }, String(part.number)));
    this.panel = element("div", { id: "part", "aria-live": "polite" });
    this.built = element("p", {});
    this.lists = element("div", { class: "lists" });
    this.controls = element("div", { class: "controls" });
    this.hint = element("p", { class: "hint" });
    this.share = 0.5;
    this.numbered = true;
    const { view } = this.made;
    const pieces = this.parts.reduce((sum, part) => sum + part.quantity, 0);
    const { shortfalls } = this.made;
    this.node = section("parts", "The parts", this.built, shortfalls.length > 0 ? issueList(shortfalls) : null, this.controls,
      element("div", { class: "parts-room" },
        element("div", {},
          view === null ? null : element("div", { class: "view-holder" }, this.canvas, this.labels),
          this.hint),
        this.panel),
      element("p", { class: "note" }, `${countText(this.parts.length)} parts in ${countText(pieces)} pieces, `
        + `${massText(this.parts.reduce((sum, part) => sum + part.quantity * part.mass_kg, 0))}.`),
      this.lists);
  }

  choose(index) {
    this.store.set("part", index);
  }

  // To the next part or the one before; round about.
  step(by) {
    const count = this.parts.length;
    const now = this.store.get("part");
    this.choose(now === null ? (by > 0 ? 0 : count - 1) : (now + by + count) % count);
  }

  fillLists() {
    const { made, units } = this;
    this.built.textContent = builtText(made, units);
    const { table, mark } = partsTable(this.parts, this.store);
    const stock = stockSheets(made, this.store);
    this.mark = (scroll) => {
      mark(scroll);
      stock.mark();
    };
    this.lists.replaceChildren(...[
      ...scrollable("Table of parts", table),
      ...(made.nests.length > 0 ? [element("h3", {}, "Sheets of stock"), stock.node] : []),
      ...(made.items.length > 0 ? [element("h3", {}, "Bought in"), ...itemsTable(made.items)] : []),
      element("h3", {}, "Rules of the shop"), ...shopRules(made.shop_checks),
      ...(made.notes.length > 0 ? [element("h3", {}, "Notes"), notesList(made.notes)] : []),
    ]);
  }

  fillPanel() {
    const chosen = this.store.get("part");
    this.panel.replaceChildren(...(chosen === null
      ? [element("p", { class: "hint" }, "Choose a part in the picture or in the list: its pattern, its row and its files come here.")]
      : details(this.doc, this.parts[chosen], this.bodies?.[chosen], this.units).flat(Infinity).filter((node) => node !== null)));
  }

  buildControls() {
    this.picker = select("Part", [["", "none"], ...this.parts.map((part, i) => [String(i), nameOf(part)])],
      (value) => this.choose(value === "" ? null : Number(value)));
    this.controls.append(this.picker, button("Previous", () => this.step(-1)), button("Next", () => this.step(1)));
    if (this.made.view === null) return;
    const slider = element("input", { type: "range", min: 0, max: 1, step: 0.01, value: this.share, id: "apart", "aria-label": "Drawn apart" });
    slider.addEventListener("input", () => {
      this.share = Number(slider.value);
      this.arrange();
    });
    const tick = (text, checked, onchange) => {
      const box = element("input", { type: "checkbox", checked });
      box.addEventListener("change", () => onchange(box.checked));
      return element("label", { class: "control" }, box, element("span", {}, text));
    };
    this.controls.append(element("label", { class: "control" }, element("span", {}, "Drawn apart"), slider),
      tick("this part alone", false, (on) => {
        this.alone = on;
        this.arrange();
      }));
    if (this.view === null) return;
    this.controls.append(
      tick("numbers", true, (on) => this.showNumbers(on)),
      select("Seen from", Object.keys(DIRECTIONS).map((name) => [name, name.toLowerCase()]), (name) => this.view.look(name)),
      button("Zoom in", () => this.view.key({ key: "+", preventDefault() {} })),
      button("Zoom out", () => this.view.key({ key: "-", preventDefault() {} })));
  }

  showNumbers(on) {
    this.labels.forEach((label) => {
      label.hidden = true;
    });
    this.view.numbers(on ? this.labels : null);
  }

  arrange() {
    if (this.view === null) this.paint();
    else {
      this.view.share = this.share;
      this.view.alone = this.alone === true;
      this.view.arrange();
    }
  }

  // All of the picture, in the size that its room has.
  paint() {
    const { canvas } = this;
    if (this.made.view === null) return;
    const { width, height } = paintedSize(canvas, 0.72);
    const chosen = this.store.get("part");
    if (this.view !== null) {
      this.view.chosen = chosen;
      this.view.resize(width, height);
      this.view.paint();
      return;
    }
    [canvas.width, canvas.height] = [width, height];
    const shown = (part) => !this.alone || chosen === null || part === chosen;
    const mesh = gathered(this.bodies, this.share, this.middle, shown);
    this.facetAt = stillPicture(canvas, mesh, this.azimuth, (t) => colourOf(this.bodies, mesh.parts[t], chosen));
    this.partOf = mesh.parts;
  }

  // Where there is no WebGL: a picture that is drawn anew with every change.
  stand() {
    this.node.dataset.still = "true";
    this.labels.forEach((label) => label.remove());
    this.canvas.addEventListener("click", (event) => {
      const { left, top, width, height } = this.canvas.getBoundingClientRect();
      const facet = this.facetAt(((event.clientX - left) / width) * this.canvas.width, ((event.clientY - top) / height) * this.canvas.height);
      this.choose(facet === null ? null : this.partOf[facet]);
    });
  }

  key(event) {
    const steps = { n: () => this.step(1), p: () => this.step(-1), Escape: () => this.choose(null) };
    if (steps[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      steps[event.key]();
    } else {
      this.view?.key(event);
    }
  }

  makeView() {
    this.view = null;
    const { view } = this.made;
    if (view === null) return;
    this.bodies = view.bodies.map((body) => unpack(body, view.steps));
    this.middle = middleOf(this.bodies);
    this.azimuth = (this.doc.placement.azimuth_deg * Math.PI) / 180;
    try {
      this.view = new PartsView(this.canvas, this.azimuth, this.bodies, this.middle, (part) => this.choose(part));
      this.view.numbers(this.labels);
    } catch {
      this.stand();
    }
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    this.hint.textContent = `${this.view === null ? "This browser offers no WebGL: a still picture instead. Click" : "Drag to turn, click"} a part to see its pattern. ${view.note}`;
  }

  draw() {
    this.makeView();
    this.buildControls();
    this.fillLists();
    this.fillPanel();
    this.store.on("part", () => {
      const chosen = this.store.get("part");
      this.picker.querySelector("select").value = chosen === null ? "" : String(chosen);
      this.mark(true);
      this.fillPanel();
      this.paint();
      this.arrange();
    });
    this.store.on("units", () => {
      this.fillLists();
      this.fillPanel();
    });
    this.store.on("theme", () => this.paint());
    this.store.on("paper", () => {
      this.paint();
      // Paper does not wait for a frame.
      this.view?.renderNow();
    });
    if (this.made.view === null) return;
    new ResizeObserver(() => this.paint()).observe(this.canvas.parentElement);
    this.arrange();
    this.paint();
  }
}

export function partsSection(doc, store, units) {
  return doc.fabrication === null ? null : new PartsSection(doc, store, units);
}
