// Small helpers to make elements. Text always goes in as text nodes: nothing from a design file is ever markup.

export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  assign(node, attributes, children);
  return node;
}

export function svgElement(tag, attributes = {}, ...children) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  assign(node, attributes, children);
  return node;
}

function assign(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined) continue;
    node.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
}

export function section(id, title, ...children) {
  return element("section", { id, "aria-labelledby": `${id}-title` },
    element("h2", { id: `${id}-title` }, title), ...children);
}

export function select(label, options, onchange) {
  const control = element("select", { onchange: () => onchange(control.value) },
    options.map(([value, text]) => element("option", { value }, text)));
  return element("label", { class: "control" }, element("span", {}, label), control);
}

export function button(text, onclick, attributes = {}) {
  return element("button", { type: "button", onclick, ...attributes }, text);
}

// A colour of the theme in force, by the name of its CSS variable.
export function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// A table that may be wider than its room: a remark says so where it is.
export function scrollable(label, table) {
  const remark = element("p", { class: "more", hidden: true, "aria-hidden": "true" }, "The table goes on to the right: swipe or scroll \u2192");
  const holder = element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": label }, table);
  const look = () => {
    remark.hidden = holder.scrollWidth <= holder.clientWidth + 1;
    holder.classList.toggle("cut", holder.scrollLeft + holder.clientWidth < holder.scrollWidth - 1);
  };
  holder.addEventListener("scroll", look);
  const observer = new ResizeObserver(look);
  observer.observe(holder);
  observer.observe(table);
  return [remark, holder];
}

// What to hear of: what, why, and what to try.
export function issueList(issues) {
  return element("ul", { class: "warnings" }, issues.map(({ what, why, hint }) => element("li", {},
    element("strong", {}, what),
    why ? element("span", { class: "detail" }, why) : null,
    hint ? element("span", { class: "detail" }, `Try: ${hint}`) : null)));
}
