// Figures as files: SVG, or PNG drawn from it.

import { button, svgElement } from "./dom.js";

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

// A copy of a drawing that stands alone: what the page's styles say is written into it, on the page's own paper.
export function standAlone(svg) {
  const copy = svg.cloneNode(true);
  const originals = [svg, ...svg.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((node, i) => {
    const style = getComputedStyle(originals[i]);
    for (const name of STYLES) {
      const value = style.getPropertyValue(name);
      if (value) node.style.setProperty(name, value);
    }
    for (const name of ["class", "tabindex", "role"]) node.removeAttribute(name);
  });
  copy.querySelectorAll("[data-screen-only]").forEach((node) => node.remove());
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const paper = getComputedStyle(document.documentElement).getPropertyValue("--panel").trim();
  copy.prepend(svgElement("rect", { width: "100%", height: "100%", fill: paper }));
  return new XMLSerializer().serializeToString(copy);
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
