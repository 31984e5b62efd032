// Figures as files: SVG, or PNG drawn from it.

import { button, svgElement, themeColour } from "./dom.js";

const PNG_SCALE = 2;
const STYLES = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "opacity", "font-size", "font-family",
  "font-weight", "visibility"];

function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser reads the blob after the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const COLOURS = ["fill", "stroke"];

// Colours that the page mixes are told as "color(srgb r g b / a)", which drawing programs do not know.
function plainColour(value) {
  const parts = /^color\(srgb ([\d.e-]+) ([\d.e-]+) ([\d.e-]+)(?: \/ ([\d.e-]+))?\)$/.exec(value);
  const clear = /^rgba\((\d+), (\d+), (\d+), ([\d.]+)\)$/.exec(value);
  if (!parts && !clear) return null;
  const channels = parts ? parts.slice(1, 4).map((part) => Math.round(255 * Number(part))) : clear.slice(1, 4);
  return { colour: `rgb(${channels.join(", ")})`, opacity: (parts ?? clear)[4] ?? "1" };
}

function setStyle(node, name, value) {
  const plain = COLOURS.includes(name) ? plainColour(value) : null;
  node.style.setProperty(name, plain ? plain.colour : value);
  if (plain) node.style.setProperty(`${name}-opacity`, plain.opacity);
}

const FONT = "system-ui, sans-serif";
export const TITLE_LINE = 16;
const LEGEND_LINE = 18;
const MARGIN = 16;

function penOf(weight, size = 12) {
  const pen = document.createElement("canvas").getContext("2d");
  pen.font = `${weight} ${size}px ${FONT}`;
  return pen;
}

export const textWidth = (text, size) => penOf(400, size).measureText(text).width;

// The lines of a title, none wider than its room [px]; a word that is wider than that is cut.
export const titleLines = (title, room) => linesWithin(title, room, penOf(600));

// The lines of a note below a title, in the size [px] it is written in.
export const noteLines = (note, room, size) => linesWithin(note, room, penOf(400, size));

function linesWithin(text, room, pen) {
  const lines = [];
  let line = "";
  for (const piece of text.split(/(?<= )/)) {
    if (line && pen.measureText((line + piece).trimEnd()).width > room) {
      lines.push(line.trimEnd());
      line = "";
    }
    for (const character of piece) {
      if (line && pen.measureText((line + character).trimEnd()).width > room) {
        lines.push(line);
        line = "";
      }
      line += character;
    }
  }
  return [...lines, line];
}

// A title over a drawing of that width, and a sample of each kind of line and area in it with its name.
// @return {nodes, height}, from its own upper left corner
function heading(copy, { title, legend }, width) {
  const text = (x, y, value, attributes) => svgElement("text", { x, y, "font-family": FONT, "font-size": 12, fill: themeColour("--ink"), ...attributes }, value);
  const titles = titleLines(title, width - 2 * MARGIN);
  const nodes = titles.map((line, i) => text(MARGIN, 18 + TITLE_LINE * i, line, { "font-weight": 600 }));
  let [x, y] = [MARGIN, 35 + TITLE_LINE * (titles.length - 1)];
  for (const [selector, name] of legend) {
    const drawn = copy.querySelector(`[data-line="${selector}"]`);
    if (!drawn) continue;
    const needed = 28 + textWidth(name, 12);
    if (x > MARGIN && x + needed > width - MARGIN) [x, y] = [MARGIN, y + LEGEND_LINE];
    const area = drawn.tagName === "polygon";
    const sample = area ? svgElement("rect", { x, y: y - 6, width: 22, height: 12 }) : svgElement("line", { x1: x, x2: x + 22, y1: y, y2: y });
    sample.setAttribute("style", drawn.getAttribute("style"));
    nodes.push(sample, text(x + 28, y + 4, name));
    x += needed + 20;
  }
  return { nodes, height: y + 11 };
}

// A copy of a drawing that stands alone: what the page's styles say is written into it, on the page's own paper.
// @param caption  {title, legend: [[value of data-line, name]]}, or null for a drawing without
// @return {svg (text), width, height}
export function standAlone(svg, caption = null) {
  const copy = svg.cloneNode(true);
  const originals = [svg, ...svg.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((node, i) => {
    const style = getComputedStyle(originals[i]);
    for (const name of STYLES) {
      const value = style.getPropertyValue(name);
      if (value) setStyle(node, name, value);
    }
    for (const name of ["class", "tabindex", "role"]) node.removeAttribute(name);
  });
  copy.querySelectorAll("[data-screen-only]").forEach((node) => node.remove());
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const box = svg.viewBox.baseVal;
  const { width } = box;
  const { nodes, height: top } = caption ? heading(copy, caption, width) : { nodes: [], height: 0 };
  const height = box.height + top;
  if (caption) copy.append(svgElement("g", { transform: `translate(${box.x} ${box.y - top})` }, nodes));
  for (const [name, value] of Object.entries({ width, height, viewBox: `${box.x} ${box.y - top} ${width} ${height}` })) copy.setAttribute(name, value);
  copy.prepend(svgElement("rect", { x: box.x, y: box.y - top, width, height, fill: themeColour("--panel") }));
  return { svg: new XMLSerializer().serializeToString(copy), width, height };
}

async function picture(text, width, height) {
  const image = new Image(width, height);
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [PNG_SCALE * width, PNG_SCALE * height];
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}

// Two buttons that save a figure.
// `make` gives {svg (text), width, height} of the figure as it is shown now.
export function exportButtons(stem, name, make) {
  const file = `${stem}-${name.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-")}`;
  const asSvg = () => save(`${file}.svg`, new Blob([make().svg], { type: "image/svg+xml" }));
  const asPng = async () => {
    const { svg, width, height } = make();
    save(`${file}.png`, await picture(svg, width, height));
  };
  return [
    button("SVG", asSvg, { class: "export", "aria-label": `Save ${name} as SVG` }),
    button("PNG", asPng, { class: "export", "aria-label": `Save ${name} as PNG` }),
  ];
}
