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

const HEADING = 46;
const FONT = "system-ui, sans-serif";

// A title over a drawing, and a sample of each kind of line and area in it with its name.
function heading(copy, { title, legend }) {
  const pen = document.createElement("canvas").getContext("2d");
  pen.font = `12px ${FONT}`;
  const text = (x, y, value, attributes) => svgElement("text", { x, y, "font-family": FONT, "font-size": 12, fill: themeColour("--ink"), ...attributes }, value);
  const nodes = [text(16, 18 - HEADING, title, { "font-weight": 600 })];
  let x = 16;
  for (const [selector, name] of legend) {
    const drawn = copy.querySelector(`[data-line="${selector}"]`);
    if (!drawn) continue;
    const area = drawn.tagName === "polygon";
    const sample = area ? svgElement("rect", { x, y: 29 - HEADING, width: 22, height: 12 }) : svgElement("line", { x1: x, x2: x + 22, y1: 35 - HEADING, y2: 35 - HEADING });
    sample.setAttribute("style", drawn.getAttribute("style"));
    nodes.push(sample, text(x + 28, 39 - HEADING, name));
    x += 28 + pen.measureText(name).width + 20;
  }
  return nodes;
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
  const [width, top] = [box.width, caption ? HEADING : 0];
  const height = box.height + top;
  if (caption) copy.append(...heading(copy, caption));
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
