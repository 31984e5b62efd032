// Flat patterns and views of single parts as drawings.

import { svgElement } from "./dom.js";
import { textWidth } from "./export.js";
import { millimetres } from "./units.js";

const WIDE = 400;
const MARGIN = 8;
const MEASURE = 12;  // size of a measure's text, as the page's styles have it

// --- paths of [x, y, bulge], y up

function pieces(path, closed) {
  return path.slice(0, closed ? path.length : path.length - 1).map((from, i) => ({ from, to: path[(i + 1) % path.length], bulge: from[2] }));
}

function radiusOf({ from, to, bulge }) {
  return (Math.hypot(to[0] - from[0], to[1] - from[1]) * (1 + bulge * bulge)) / (4 * Math.abs(bulge));
}

// Points of a path, arcs in steps of some degrees: enough for its bounds and its turn.
function pointsOf(path, closed) {
  return pieces(path, closed).flatMap((piece) => {
    const { from, to, bulge } = piece;
    if (bulge === 0) return [from, to];
    const sweep = 4 * Math.atan(bulge);
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const out = (1 - bulge * bulge) / (4 * bulge);
    const [cx, cy] = [from[0] + dx / 2 - dy * out, from[1] + dy / 2 + dx * out];
    const steps = Math.max(2, Math.ceil(Math.abs(sweep) / 0.05));
    return Array.from({ length: steps + 1 }, (_, i) => {
      const [c, s] = [Math.cos((sweep * i) / steps), Math.sin((sweep * i) / steps)];
      const [x, y] = [from[0] - cx, from[1] - cy];
      return [cx + c * x - s * y, cy + s * x + c * y];
    });
  });
}

function boundsOf(points) {
  const box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
  for (const [x, y] of points) {
    box.x0 = Math.min(box.x0, x);
    box.x1 = Math.max(box.x1, x);
    box.y0 = Math.min(box.y0, y);
    box.y1 = Math.max(box.y1, y);
  }
  return { ...box, width: box.x1 - box.x0, height: box.y1 - box.y0 };
}

const turned = (angle) => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return ([x, y, ...rest]) => [c * x - s * y, s * x + c * y, ...rest];
};

// The turn that lays an outline flat into its smallest box, long side level. One of the box's sides lies along a chord.
function lying(outline) {
  const points = pointsOf(outline, true);
  const step = Math.max(1, Math.floor(points.length / 180));
  const looks = points.filter((_, i) => i % step === 0);
  let best = { angle: 0, area: Infinity };
  for (let i = 0; i < looks.length; i += 1) {
    const [a, b] = [looks[i], looks[(i + 1) % looks.length]];
    const angle = -Math.atan2(b[1] - a[1], b[0] - a[0]);
    const { width, height } = boundsOf(looks.map(turned(angle)));
    if (width * height < best.area * (1 - 1e-9)) best = { angle: width >= height ? angle : angle + Math.PI / 2, area: width * height };
  }
  // Never upside down, and as it is where that does as well.
  const plain = boundsOf(looks);
  if (plain.width >= plain.height && plain.width * plain.height < 1.02 * best.area) return 0;
  return Math.cos(best.angle) < 0 ? best.angle + Math.PI : best.angle;
}

// An envelope with its two measures, and a place of the drawing for each point inside it.
class Figure {
  constructor(box, scale, left, top) {
    Object.assign(this, { box, scale, left, top });
  }

  at([x, y]) {
    return [this.left + this.scale * (x - this.box.x0), this.top + this.scale * (this.box.y1 - y)];
  }

  text(point) {
    return this.at(point).map((value) => String(Math.round(100 * value) / 100)).join(" ");
  }

  path(path, closed) {
    const arcs = pieces(path, closed).map((piece) => {
      if (piece.bulge === 0) return `L${this.text(piece.to)}`;
      const radius = Math.round(100 * this.scale * radiusOf(piece)) / 100;
      return `A${radius} ${radius} 0 ${Math.abs(piece.bulge) > 1 ? 1 : 0} ${piece.bulge > 0 ? 0 : 1} ${this.text(piece.to)}`;
    });
    return `M${this.text(path[0])}${arcs.join("")}${closed ? "Z" : ""}`;
  }

  line(from, to, attributes, title) {
    const [[x1, y1], [x2, y2]] = [this.at(from), this.at(to)];
    return svgElement("line", { x1, y1, x2, y2, ...attributes }, title ? svgElement("title", {}, title) : null);
  }

  measures() {
    const { box, scale, left, top } = this;
    const [width, height] = [scale * box.width, scale * box.height];
    const across = millimetres(box.width);
    // Below a figure that is narrower than its measure, this begins where the figure does: the drawing ends on the left of it.
    const middle = left + Math.max(width, textWidth(across, MEASURE)) / 2;
    return [
      svgElement("text", { class: "measure", x: middle, y: top + height + 16, "text-anchor": "middle" }, across),
      svgElement("text", { class: "measure", x: left + width + 6, y: top + height / 2 + 4 }, millimetres(box.height)),
    ];
  }
}

const ROOM = 86;  // for the measure beside a figure

function drawing(label, height, ...children) {
  return svgElement("svg", { class: "pattern", viewBox: `0 0 ${WIDE} ${Math.ceil(height)}`, width: WIDE, height: Math.ceil(height), role: "img", "aria-label": label }, ...children);
}

// A pattern to scale: outline, cutouts and holes; bends dashed, lines where a radius changes, marks.
export function patternDrawing(part, units) {
  const { pattern } = part;
  const turn = turned(lying(pattern.outline_m));
  const outline = pattern.outline_m.map(turn);
  const box = boundsOf(pointsOf(outline, true));
  const figure = new Figure(box, Math.min((WIDE - MARGIN - ROOM) / box.width, 360 / box.height), MARGIN, MARGIN);
  const region = [figure.path(outline, true), ...pattern.cutouts_m.map((path) => figure.path(path.map(turn), true))];
  const holes = pattern.holes_m.map(([x, y, diameter]) => {
    const [cx, cy] = figure.at(turn([x, y]));
    return svgElement("circle", { class: "hole", cx, cy, r: (figure.scale * diameter) / 2 },
      svgElement("title", {}, `hole of ${millimetres(diameter)}`));
  });
  const bends = pattern.bends.map((bend, i) => figure.line(turn(bend.from_m), turn(bend.to_m), { class: bend.up ? "bend" : "bend down" },
    `bend ${i + 1}: ${units.text("angle", bend.angle_deg, 4)} ${bend.up ? "up" : "down"}, inner radius ${millimetres(bend.inner_radius_m)}`));
  const rolls = pattern.rolls.map((roll) => figure.line(turn(roll.from_m), turn(roll.to_m), { class: "roll" },
    roll.radius_m === null ? "flat from here" : `radius ${millimetres(Math.abs(roll.radius_m))} ${roll.radius_m > 0 ? "up" : "down"} from here`));
  const marks = pattern.marks_m.filter((path) => path.length > 1).map((path) => svgElement("path", { class: "mark", d: figure.path(path.map(turn), false) }));
  return drawing(`Flat pattern of part ${part.number}`, 2 * MARGIN + figure.scale * box.height + 14,
    svgElement("path", { class: "sheet", d: region.join(""), "fill-rule": "evenodd" }), holes, rolls, bends, marks, figure.measures());
}

// A stock sheet with the outlines of what is cut from it.
// @param laid  pieces: `part` (index), and the motion of its pattern: `cosine`, `sine`, `shift_m`
// @param onchoose  takes the index of a part that is clicked
export function nestDrawing(nest, parts, onchoose) {
  const [width, height] = nest.sheet_m;
  const figure = new Figure({ x0: 0, x1: width, y0: 0, y1: height, width, height }, (WIDE - 2) / width, 1, 1);
  const pieces = nest.laid.map(({ part, cosine, sine, shift_m: [dx, dy] }) => {
    const { pattern, number, name } = parts[part];
    const placed = ([x, y, bulge]) => [cosine * x - sine * y + dx, sine * x + cosine * y + dy, bulge];
    const d = [pattern.outline_m, ...pattern.cutouts_m].map((path) => figure.path(path.map(placed), true)).join("");
    const shape = svgElement("path", { class: "sheet", d, "fill-rule": "evenodd", "data-part": number },
      svgElement("title", {}, `${number} ${name.replaceAll("_", " ")}`));
    shape.addEventListener("click", () => onchoose(part));
    return shape;
  });
  const svg = drawing(`Sheet ${nest.name} with ${nest.pieces} pieces`, figure.scale * height + 2,
    svgElement("rect", { class: "stock", x: 1, y: 1, width: figure.scale * width, height: figure.scale * height }), pieces);
  svg.classList.add("nest");
  return svg;
}

// Three views of a body by its edges, a list of six coordinates each: from above, from the side, from the end.
export function viewsDrawing(part, edges) {
  const views = [[0, 1], [0, 2], [1, 2]].map(([across, up]) => {
    const lines = [];
    for (let i = 0; i < edges.length; i += 6) lines.push([[edges[i + across], edges[i + up]], [edges[i + 3 + across], edges[i + 3 + up]]]);
    return { lines, box: boundsOf(lines.flat()) };
  }).filter(({ lines }) => lines.length > 0);
  const widest = Math.max(...views.map(({ box }) => box.width));
  const tallest = Math.max(...views.map(({ box }) => box.height));
  const scale = Math.min((WIDE - MARGIN - ROOM) / widest, 260 / tallest);
  let top = MARGIN;
  const figures = views.map(({ lines, box }) => {
    const figure = new Figure(box, scale, MARGIN, top);
    top += scale * box.height + 32;
    const d = lines.map(([a, b]) => `M${figure.text(a)}L${figure.text(b)}`).join("");
    return [svgElement("path", { class: "edge", d }), figure.measures()];
  });
  return drawing(`Three views of part ${part.number}`, top, figures);
}
