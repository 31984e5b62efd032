import "uplot/dist/uPlot.min.css";
import "./page.css";
import { readDocument } from "./data.js";
import { element, select } from "./dom.js";
import { gatesSection } from "./gates.js";
import { partsSection } from "./parts.js";
import { plotSection } from "./plots.js";
import { profileSection } from "./profile.js";
import { Rides } from "./ranges.js";
import { Store } from "./store.js";
import { summary } from "./summary.js";
import { limitTable, stationTable } from "./tables.js";
import { Units } from "./units.js";
import { viewSection } from "./view3d.js";
import { whatIfSection } from "./whatif.js";

function header(doc, store, units, rides) {
  const theme = select("Theme", [["auto", "as the system"], ["light", "light"], ["dark", "dark"]], (value) => {
    if (value === "auto") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = value;
    store.set("theme", value);
  });
  const system = select("Units", Units.systems().map((name) => [name, name]), (value) => {
    units.system = value;
    store.set("units", value);
  });
  return element("header", {},
    element("div", {},
      element("h1", {}, doc.design.name),
      element("p", { class: "subtitle" }, `${doc.design.centerline} \u00b7 ${doc.generator.name} ${doc.generator.version}`)),
    element("div", { class: "controls" }, rides.several ? frictionSwitch(store, rides) : null, system, theme));
}

function frictionSwitch(store, rides) {
  const control = select("Friction", rides.doc.rides.map((ride) => [ride.friction, rides.name(ride)]), (level) => {
    rides.choose(level);
    store.set("friction", level);
  });
  control.querySelector("select").value = rides.level;
  return control;
}

function start() {
  const doc = readDocument();
  const rides = new Rides(doc);
  document.title = doc.design.name;
  const units = new Units();
  const store = new Store({ station: 0, axis: "arc_length_m", units: units.system, theme: "auto", paper: false, friction: "nominal", whatIf: null, part: null });
  const profile = profileSection(doc, store, units);
  const plots = plotSection(doc, store, units, rides);
  const view = viewSection(doc, store, units);
  const parts = partsSection(doc, store, units);
  const whatIf = whatIfSection(doc, store, units);

  const holder = element("div", {}, summary(doc, units));
  for (const key of ["units", "friction"]) store.on(key, () => holder.replaceChildren(summary(doc, units)));
  document.getElementById("page").replaceChildren(
    header(doc, store, units, rides),
    element("main", {}, holder, limitTable(doc, store, units) ?? "", profile.node, view?.node ?? "", parts?.node ?? "", whatIf ?? "", plots.node, gatesSection(doc, store, units) ?? "", stationTable(doc, store, units)),
    element("footer", {}, element("p", {}, `Made by ${doc.generator.name} ${doc.generator.version}. Every number comes from the `
      + "document embedded in this page; the ride is re-integrated along the centerline that was built.")));

  profile.draw();
  plots.draw();
  view?.draw();
  parts?.draw();
  // Paper is white: what is drawn on canvases is drawn anew for it, and again for the screen.
  const paper = (printing) => {
    document.documentElement.dataset.printing = String(printing);
    store.set("paper", printing);
  };
  const print = matchMedia("print");
  window.addEventListener("beforeprint", () => paper(true));
  window.addEventListener("afterprint", () => paper(print.matches));
  print.addEventListener("change", () => paper(print.matches));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (event) => store.set("theme", `auto-${event.matches}`));
  // For readers who want the numbers from the console.
  window.glissadeReport = { document: doc, store, charts: plots.charts, parts };
  document.documentElement.dataset.ready = "true";
}

try {
  start();
} catch (error) {
  document.getElementById("page").replaceChildren(element("p", { role: "alert" }, `This report cannot be shown: ${error.message}`));
  throw error;
}
