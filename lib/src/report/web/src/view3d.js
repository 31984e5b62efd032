import {
  Box3, Box3Helper, BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, Plane, ShapeUtils, SphereGeometry, SRGBColorSpace, Vector2, Vector3,
} from "three";
import { decodeArray, interpolate } from "./data.js";
import { button, element, section, select } from "./dom.js";
import { colourAt, stops } from "./colours.js";
import { DIRECTIONS, paintedSize, Stage } from "./stage.js";
import { stillPicture } from "./still.js";
import { countText } from "./units.js";

const COLOURINGS = [
  ["speed_m_per_s", "speed", "speed"],
  ["normal_load_m_per_s2", "normal load", "load"],
  ["slope_angle_deg", "slope angle", "angle"],
];

// Section planes, by the direction in which they are moved; what lies before the plane goes.
const SECTIONS = { None: null, Lengthwise: "left", Across: "along", Level: "up" };

// Vertices of the view in metres about the middle of the bounding box, and the arc length beside each.
function unpack(view) {
  const quantised = decodeArray(view.positions);
  const count = quantised.length / 3;
  const positions = new Float32Array(quantised.length);
  for (let i = 0; i < count; i += 1) {
    for (let axis = 0; axis < 3; axis += 1) {
      const span = view.upper_m[axis] - view.lower_m[axis];
      positions[3 * i + axis] = span * (quantised[3 * i + axis] / view.steps - 0.5);
    }
  }
  const along = decodeArray(view.arc_length);
  const arcLength = Float64Array.from(along, (a) => (a / view.steps) * view.length_m);
  return { positions, indices: decodeArray(view.indices), arcLength };
}

function colouring(doc, arcLength, key) {
  const { stations } = doc;
  const column = stations[key];
  const low = Math.min(...column);
  const high = Math.max(...column);
  const colours = new Float32Array(3 * arcLength.length);
  for (let i = 0; i < arcLength.length; i += 1) {
    const value = interpolate(stations.arc_length_m, column, arcLength[i]);
    colours.set(colourAt(high > low ? (value - low) / (high - low) : 0.5), 3 * i);
  }
  return { colours, low, high };
}

class View extends Stage {
  constructor(doc, canvas, solid) {
    super(canvas, (doc.placement.azimuth_deg * Math.PI) / 180);
    this.doc = doc;
    this.solid = solid;
    this.renderer.localClippingEnabled = true;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(solid.positions, 3));
    this.geometry.setIndex(new BufferAttribute(solid.indices, 1));
    this.plane = new Plane(new Vector3(0, 1, 0), 0);
    this.material = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, flatShading: true });
    this.scene.add(new Mesh(this.geometry, this.material));
    this.geometry.computeBoundingSphere();
    this.radius = this.geometry.boundingSphere.radius;
    this.box = new Box3().setFromBufferAttribute(this.geometry.getAttribute("position"));
    this.frame = new Box3Helper(this.box, new Color(0x888888));
    this.marker = new Mesh(new SphereGeometry(0.012 * this.radius, 16, 12), new MeshBasicMaterial({ color: 0xd0342c }));
    this.scene.add(this.marker);
    this.scene.add(this.frame);
    this.addObstacles();
    this.addStream(null);
    this.look("Three-quarter");
  }

  // The surface of a stream across its channel, and its ways through the air; of another ride where one is chosen.
  addStream(other) {
    const { doc } = this;
    const { placement, stations } = doc;
    this.stream?.removeFromParent();
    if (!stations.burden_depth_m) return;
    const [c, s] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    const { middle } = this;
    const place = (x, left, z) => [
      placement.start_m[0] + x * c - left * s - middle[0], placement.start_m[1] + x * s + left * c - middle[1], z - middle[2],
    ];
    const line = other ? { ...other.line, z_m: other.line.z_m.map((z) => z + stations.z_m[0]) } : stations;
    const flowing = line.x_m.map((_, i) => i).filter((i) => line.burden_depth_m[i] !== null);
    const corners = flowing.flatMap((i) => {
      const slope = (line.slope_angle_deg[i] * Math.PI) / 180;
      const depth = line.burden_depth_m[i];
      const [x, z] = [line.x_m[i] + depth * Math.sin(slope), line.z_m[i] + depth * Math.cos(slope)];
      const half = interpolate(stations.x_m, stations.channel_width_m, line.x_m[i]) / 2;
      return [place(x, half, z), place(x, -half, z)];
    });
    const indices = flowing.slice(1).flatMap((_, k) => [2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 1, 2 * k + 3, 2 * k + 2]);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flat()), 3));
    geometry.setIndex(indices);
    geometry.computeVertexNormals();
    this.stream = new Group();
    this.stream.add(new Mesh(geometry, new MeshLambertMaterial({ color: 0x9a7b4f, transparent: true, opacity: 0.75, side: DoubleSide })));
    const falls = (doc.ride.flights ?? doc.flights).filter((flight) => !other || flight.name !== "the stream falls on the belt").map((flight) => flight.x_m.map((x, i) => [x, flight.z_m[i]]));
    if (other && other.flight_m.length > 0) falls.push(other.flight_m);
    const material = new MeshLambertMaterial({ color: 0x9a7b4f, transparent: true, opacity: 0.35, side: DoubleSide });
    const first = stations.channel_width_m[0] / 2;
    const last = stations.channel_width_m[stations.channel_width_m.length - 1] / 2;
    for (const points of falls) {
      const half = points[0][0] > stations.x_m[0] + 1e-9 ? last : first;
      const sheet = new BufferGeometry();
      sheet.setAttribute("position", new BufferAttribute(new Float32Array(points.flatMap(([x, z]) => [...place(x, half, z), ...place(x, -half, z)])), 3));
      sheet.setIndex(points.slice(1).flatMap((_, k) => [2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 1, 2 * k + 3, 2 * k + 2]));
      sheet.computeVertexNormals();
      this.stream.add(new Mesh(sheet, material));
    }
    this.scene.add(this.stream);
  }

  // Obstacles as translucent bodies across the track, a little wider than the solid; lines as sheets. They do not count
  // for the frame of the picture.
  addObstacles() {
    const { placement, keep_outs: areas } = this.doc;
    const [c, s] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    const { middle } = this;
    const { positions } = this.solid;
    let half = 0;
    for (let i = 0; i < positions.length; i += 3) {
      const [x, y] = [positions[i] + middle[0] - placement.start_m[0], positions[i + 1] + middle[1] - placement.start_m[1]];
      half = Math.max(half, Math.abs(y * c - x * s));
    }
    const across = 1.3 * half;
    const corner = ([x, z], left) => [
      placement.start_m[0] + x * c - left * s - middle[0], placement.start_m[1] + x * s + left * c - middle[1], z - middle[2],
    ];
    const material = new MeshLambertMaterial({ color: 0xc0282d, transparent: true, opacity: 0.3, side: DoubleSide, depthWrite: false });
    for (const area of areas) {
      const { points_m: points, open } = area;
      const corners = [...points.map((p) => corner(p, across)), ...points.map((p) => corner(p, -across))];
      const count = points.length;
      const indices = [];
      for (let i = 0; i + (open ? 1 : 0) < count; i += 1) {
        const next = (i + 1) % count;
        indices.push(i, next, count + i, next, count + next, count + i);
      }
      if (!open) {
        const flat = points.map(([x, z]) => new Vector2(x, z));
        for (const [i, j, k] of ShapeUtils.triangulateShape(flat, [])) indices.push(i, j, k, count + i, count + k, count + j);
      }
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flat()), 3));
      geometry.setIndex(indices);
      geometry.computeVertexNormals();
      this.scene.add(new Mesh(geometry, material));
    }
  }

  colour(key) {
    const { colours, low, high } = colouring(this.doc, this.solid.arcLength, key);
    // The renderer shades linear light.
    const colour = new Color();
    for (let i = 0; i < colours.length; i += 3) {
      colour.setRGB(colours[i], colours[i + 1], colours[i + 2], SRGBColorSpace).toArray(colours, i);
    }
    this.geometry.setAttribute("color", new BufferAttribute(colours, 3));
    this.render();
    return { low, high };
  }

  // The middle of the picture in the frame of the site: the mesh lies in one of its own.
  get middle() {
    const { view, mesh } = this.doc;
    return [0, 1, 2].map((axis) => (view.lower_m[axis] + view.upper_m[axis]) / 2 + mesh.offset_m[axis]);
  }

  // Puts the marker beside a station of the ride.
  mark(station) {
    const { placement, stations } = this.doc;
    const x = stations.x_m[station];
    const at = [
      placement.start_m[0] + x * Math.cos(this.azimuth), placement.start_m[1] + x * Math.sin(this.azimuth), stations.z_m[station],
    ];
    this.marker.position.set(...at.map((value, axis) => value - this.middle[axis]));
    this.render();
  }

  // Cuts away what lies before the plane at `fraction` of the solid's reach in its direction.
  cut(name, fraction) {
    const { azimuth } = this;
    const kind = SECTIONS[name];
    if (kind === null) {
      this.material.clippingPlanes = [];
    } else {
      const normal = {
        left: new Vector3(-Math.sin(azimuth), Math.cos(azimuth), 0),
        along: new Vector3(Math.cos(azimuth), Math.sin(azimuth), 0),
        up: new Vector3(0, 0, -1),
      }[kind];
      const reach = this.reach(normal);
      this.plane.normal.copy(normal);
      this.plane.constant = -(reach.low + fraction * (reach.high - reach.low));
      this.material.clippingPlanes = [this.plane];
    }
    this.material.needsUpdate = true;
    this.render();
  }

  reach(direction) {
    const { positions } = this.solid;
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
      const d = positions[i] * direction.x + positions[i + 1] * direction.y + positions[i + 2] * direction.z;
      low = Math.min(low, d);
      high = Math.max(high, d);
    }
    return { low, high };
  }

  // Labels of the three sides of the box, each at an edge that faces the reader.
  dimensions(labels) {
    this.labels = labels;
    this.render();
  }

  placeLabels() {
    if (!this.labels) return;
    const { min, max } = this.box;
    const { position } = this.camera;
    const near = { x: position.x < 0 ? min.x : max.x, y: position.y < 0 ? min.y : max.y, z: min.z };
    const far = { x: position.x < 0 ? max.x : min.x, y: position.y < 0 ? max.y : min.y };
    const at = [new Vector3(0, near.y, near.z), new Vector3(near.x, 0, near.z), new Vector3(far.x, near.y, 0)];
    const { clientWidth: width, clientHeight: height } = this.canvas;
    at.forEach((point, axis) => {
      const seen = point.project(this.camera);
      const label = this.labels[axis];
      // In parts of the picture, which is smaller on paper.
      label.style.left = `${100 * Math.min(Math.max((seen.x + 1) / 2, 48 / width), 1 - 48 / width)}%`;
      label.style.top = `${100 * Math.min(Math.max((1 - seen.y) / 2, 12 / height), 1 - 12 / height)}%`;
    });
  }

}

// Where there is no WebGL.
function stillSolid(doc, canvas, solid, key) {
  const { colours, low, high } = colouring(doc, solid.arcLength, key);
  const colourOf = (t) => [0, 1, 2].map((axis) => colours[3 * solid.indices[3 * t] + axis]);
  stillPicture(canvas, solid, (doc.placement.azimuth_deg * Math.PI) / 180, colourOf);
  return { low, high };
}

function legend(units) {
  const gradient = `linear-gradient(to right, ${stops().join(", ")})`;
  const low = element("span");
  const high = element("span");
  const node = element("div", { class: "colour-legend" }, low,
    element("span", { class: "ramp", style: `background: ${gradient}` }), high);
  return { node, show: (quantity, range) => {
    low.textContent = units.text(quantity, range.low, 4);
    high.textContent = units.text(quantity, range.high, 4);
  } };
}

export function viewSection(doc, store, units) {
  if (doc.view === null) return null;
  const canvas = element("canvas", { id: "view", tabindex: 0, role: "img",
    "aria-label": "The solid in three dimensions. Arrow keys turn it, plus and minus zoom." });
  const colours = legend(units);
  const size = element("p", { id: "view-size" });
  const labels = ["x", "y", "z"].map((axis) => element("span", { class: "dimension", "aria-hidden": "true", "data-axis": axis }));
  const controls = element("div", { class: "controls" });
  const node = section("solid", "The solid", controls, element("div", { class: "view-holder" }, canvas, labels), colours.node, size,
    doc.view.note ? element("p", { class: "hint" }, doc.view.note) : null);

  let key = COLOURINGS[0][0];
  const quantity = () => COLOURINGS.find(([name]) => name === key)[2];
  const describe = () => {
    const [dx, dy, dz] = [0, 1, 2].map((axis) => doc.mesh.upper_m[axis] - doc.mesh.lower_m[axis]);
    size.textContent = `Bounding box ${units.text("length", dx, 5)} (x) by ${units.text("length", dy, 5)} (y) by `
      + `${units.text("length", dz, 5)} (z); ${countText(doc.mesh.triangles)} facets written.`;
    [dx, dy, dz].forEach((side, axis) => {
      labels[axis].textContent = `${"xyz"[axis]} ${units.text("length", side, 4)}`;
    });
  };

  const draw = () => {
    const solid = unpack(doc.view);
    let view = null;
    try {
      view = new View(doc, canvas, solid);
    } catch {
      node.dataset.still = "true";
      labels.forEach((label) => label.remove());
    }
    const paint = () => {
      const { width, height } = paintedSize(canvas);
      if (view === null) [canvas.width, canvas.height] = [width, height];
      else view.resize(width, height);
      colours.show(quantity(), view === null ? stillSolid(doc, canvas, solid, key) : view.colour(key));
    };
    controls.append(select("Colour by", COLOURINGS.map(([name, text]) => [name, text]), (value) => {
      key = value;
      paint();
    }));
    if (view !== null) {
      const position = element("input", { type: "range", min: 0, max: 1, step: 0.01, value: 0.5, "aria-label": "Position of the section plane", disabled: true });
      let section = "None";
      const update = () => {
        position.disabled = section === "None";
        view.cut(section, Number(position.value));
      };
      const cut = select("Section plane", Object.keys(SECTIONS).map((name) => [name, name.toLowerCase()]), (name) => {
        section = name;
        update();
      });
      position.addEventListener("input", update);
      controls.append(select("Seen from", Object.keys(DIRECTIONS).map((name) => [name, name.toLowerCase()]), (name) => view.look(name)),
        cut, position,
        button("Zoom in", () => view.key({ key: "+", preventDefault() {} })),
        button("Zoom out", () => view.key({ key: "-", preventDefault() {} })));
      canvas.addEventListener("keydown", (event) => view.key(event));
      store.on("station", (station) => view.mark(station));
      const flow = () => {
        view.addStream(store.get("whatIf"));
        view.render();
      };
      for (const change of ["whatIf", "friction"]) store.on(change, flow);
      view.mark(store.get("station"));
      view.dimensions(labels);
      size.before(element("p", { class: "hint" }, "Drag to turn, right button to move; the wheel zooms once the view is selected. "
        + "The red ball is the cursor."));
    } else {
      size.before(element("p", { class: "hint" }, "This browser offers no WebGL: a still picture instead."));
    }
    describe();
    store.on("units", () => {
      describe();
      paint();
    });
    for (const change of ["theme", "friction"]) store.on(change, paint);
    store.on("paper", () => {
      paint();
      // Paper does not wait for a frame.
      view?.renderNow();
    });
    new ResizeObserver(paint).observe(canvas.parentElement);
    paint();
  };
  return { node, draw };
}
