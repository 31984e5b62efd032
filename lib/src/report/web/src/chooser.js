// Lets a reader sort the table of a comparison, choose what is shown and follow one line through every figure. Without it the
// boxes still take rows and lines away, by style alone.

const table = document.querySelector("main table");
const body = table.tBodies[0];
const rows = [...body.rows];
const boxes = [...document.querySelectorAll("input.choice")];
const names = boxes.map((box) => box.getAttribute("aria-label"));
const state = { column: null, down: false, lit: null };

function button(text, label, act) {
  const one = document.createElement("button");
  one.type = "button";
  one.textContent = text;
  if (label) one.setAttribute("aria-label", label);
  one.addEventListener("click", act);
  return one;
}

// --- sorting ---

const textOf = (row, column) => (row.cells[column] ? row.cells[column].textContent.trim() : "");
const valueOf = (text) => (/^[-+]?[\d.]/.test(text) ? Number(text) : NaN);

function order(a, b, column, numbers) {
  const [left, right] = [textOf(a, column), textOf(b, column)];
  if (!numbers) return left.localeCompare(right, "en", { numeric: true });
  return valueOf(left) - valueOf(right);
}

function sort() {
  const { column, down } = state;
  [...table.tHead.rows[0].cells].forEach((head, index) => {
    if (index === column) head.setAttribute("aria-sort", down ? "descending" : "ascending");
    else head.removeAttribute("aria-sort");
  });
  if (column === null) return body.append(...rows);
  const told = rows.filter((row) => textOf(row, column) !== "" && textOf(row, column) !== "-");
  const numbers = told.every((row) => Number.isFinite(valueOf(textOf(row, column))));
  // What has no value comes last, whichever way.
  const sorted = told.sort((a, b) => (down ? -1 : 1) * order(a, b, column, numbers));
  return body.append(...sorted, ...rows.filter((row) => !told.includes(row)));
}

// First up, then down, then as it was.
function turn(column) {
  if (state.column !== column) Object.assign(state, { column, down: false });
  else if (!state.down) state.down = true;
  else Object.assign(state, { column: null, down: false });
  sort();
  keep();
}

[...table.tHead.rows[0].cells].forEach((head, column) => {
  const text = head.textContent;
  head.textContent = "";
  head.append(button(text, null, () => turn(column)));
});

// --- which are shown ---

const count = document.createElement("output");

function tell() {
  const shown = boxes.filter((box) => box.checked).length;
  count.textContent = `${shown} of ${boxes.length} shown`;
}

function show(test) {
  boxes.forEach((box, index) => {
    box.checked = test(index);
  });
  tell();
  keep();
}

boxes.forEach((box) => box.addEventListener("change", () => {
  tell();
  keep();
}));

// --- one line through every figure ---

function light(index) {
  document.querySelectorAll(".lit").forEach((one) => one.classList.remove("lit"));
  document.body.toggleAttribute("data-lit", index !== null);
  if (index !== null) document.querySelectorAll(`.choice-${index + 1}`).forEach((one) => one.classList.add("lit"));
}

const holders = rows.map((row, index) => {
  const head = row.cells[0];
  const holder = button(head.textContent, null, () => {
    state.lit = state.lit === index ? null : index;
    mark();
    keep();
  });
  head.textContent = "";
  head.append(holder);
  row.addEventListener("pointerenter", (event) => {
    if (event.pointerType === "mouse") light(index);
  });
  row.addEventListener("pointerleave", () => light(state.lit));
  return holder;
});

function mark() {
  holders.forEach((holder, index) => holder.setAttribute("aria-pressed", String(index === state.lit)));
  light(state.lit);
}

// --- in the address, so that a choice can be kept and passed on ---

function keep() {
  const parts = new URLSearchParams();
  if (state.column !== null) parts.set("sort", (state.down ? "-" : "") + state.column);
  const hidden = boxes.flatMap((box, index) => (box.checked ? [] : [index + 1]));
  if (hidden.length > 0) parts.set("without", hidden.join("."));
  if (state.lit !== null) parts.set("follow", state.lit + 1);
  history.replaceState(null, "", `#${parts}`);
}

function restore() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const column = /^(-?)(\d+)$/.exec(parts.get("sort") ?? "");
  if (column && Number(column[2]) < table.tHead.rows[0].cells.length) Object.assign(state, { column: Number(column[2]), down: column[1] === "-" });
  const hidden = (parts.get("without") ?? "").split(".").map(Number);
  boxes.forEach((box, index) => {
    box.checked = !hidden.includes(index + 1);
  });
  const lit = Number(parts.get("follow")) - 1;
  if (names[lit] !== undefined) state.lit = lit;
  sort();
  mark();
  tell();
}

document.querySelector(".choices").append(
  button("all", "show all", () => show(() => true)),
  button("none", "show none", () => show(() => false)),
  button("only the followed one", null, () => show((index) => state.lit === null || index === state.lit)),
  count,
);
addEventListener("hashchange", restore);
restore();
document.documentElement.dataset.ready = "";
