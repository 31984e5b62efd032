// Quantities and the units that a reader can switch between. The document is SI and degrees; only the
// display converts.

const STANDARD_GRAVITY = 9.80665;  // one g, whatever the gravity of a design

const SYSTEMS = {
  "m, m/s": {
    length: ["m", 1], curvature: ["1/m", 1], speed: ["m/s", 1], time: ["s", 1], angle: ["deg", 1],
    load: ["g", null], energy: ["J/kg", 1], pressure: ["Pa", 1], rubbing: ["W/m\u00b2", 1],
  },
  "mm, m/s": {
    length: ["mm", 1e3], curvature: ["1/m", 1], speed: ["m/s", 1], time: ["s", 1], angle: ["deg", 1],
    load: ["g", null], energy: ["J/kg", 1], pressure: ["Pa", 1], rubbing: ["W/m\u00b2", 1],
  },
  "m, km/h": {
    length: ["m", 1], curvature: ["1/m", 1], speed: ["km/h", 3.6], time: ["s", 1], angle: ["deg", 1],
    load: ["g", null], energy: ["J/kg", 1], pressure: ["Pa", 1], rubbing: ["W/m\u00b2", 1],
  },
  "m, m/s, loads in m/s\u00b2": {
    length: ["m", 1], curvature: ["1/m", 1], speed: ["m/s", 1], time: ["s", 1], angle: ["deg", 1],
    load: ["m/s\u00b2", 1], energy: ["J/kg", 1], pressure: ["Pa", 1], rubbing: ["W/m\u00b2", 1],
  },
};

// What a missing value of a quantity means: a curvature without bound has no number, nor has its load.
const MISSING = { curvature: "unbounded", load: "unbounded" };

// Which quantity of the units a document's unit is.
const QUANTITIES = { m: "length", deg: "angle", "m/s": "speed", "m/s^2": "load", "1/m": "curvature" };

export const quantityOf = (unit) => QUANTITIES[unit] ?? null;

export const superscripts = (text) => text.replaceAll("^2", "\u00b2").replaceAll("^3", "\u00b3");

export class Units {
  constructor() {
    this.system = "m, m/s";
  }

  static systems() {
    return Object.keys(SYSTEMS);
  }

  unit(quantity) {
    return SYSTEMS[this.system][quantity][0];
  }

  convert(quantity, value) {
    if (value === null || value === undefined) return null;
    // The cosine of a right angle is not quite 0 in a computer.
    if (quantity === "load" && Math.abs(value) < 1e-12) return 0;
    const factor = SYSTEMS[this.system][quantity][1];
    return factor === null ? value / STANDARD_GRAVITY : value * factor;
  }

  // A value in a unit of the document; what no unit system changes stands as it is.
  textOf(unit, value, digits = 5) {
    const quantity = quantityOf(unit);
    if (quantity) return this.text(quantity, value, digits);
    return unit ? `${number(value, digits)}\u00a0${superscripts(unit)}` : number(value, digits);
  }

  missing(quantity) {
    return MISSING[quantity] ?? "\u2013";
  }

  // Gives texts of places on the site, to the millimetre and finer on a track that is small, however far away its origin lies.
  // @param extent  length of the track [m]
  // @param even    all with the same decimals, for a column
  place(extent, even = false) {
    const decimals = Math.max(placeDecimals(extent) - Math.round(Math.log10(this.convert("length", 1))), 0);
    return (value) => {
      const text = this.convert("length", value).toFixed(decimals).replace(/^-(0(\.0+)?)$/, "$1");
      return even ? text : text.replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
    };
  }

  placeText(value, extent) {
    return `${this.place(extent)(value)}\u00a0${this.unit("length")}`;
  }

  text(quantity, value, digits = 5) {
    if (value === null || value === undefined) return this.missing(quantity);
    // What an angle is off level by rounding is no angle.
    if (quantity === "angle" && Math.abs(value) < 1e-9) return `0\u00a0${this.unit(quantity)}`;
    // A tolerance reads better in millimetres, whatever the unit of the track.
    const small = quantity === "length" && this.unit("length") === "m" && value !== 0 && Math.abs(value) < 0.01;
    if (small) return `${number(1e3 * value, digits)}\u00a0mm`;
    return `${number(this.convert(quantity, value), digits)}\u00a0${this.unit(quantity)}`;
  }
}

// Decimals of a place in metres, five digits of the track's length and at least the millimetre.
const placeDecimals = (extent) => Math.min(Math.max(4 - Math.floor(Math.log10(extent || 1)), 3), 9);

export function number(value, digits = 5) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  // A large number whose digits reach below its decimal point is written out.
  if ((size >= 1e7 && size >= 10 ** digits) || size < 1e-4) return value.toExponential(digits - 1);
  return String(Number(value.toPrecision(digits)));
}

// The decimals that tell every multiple of a step; it may be 2.5 times a power of ten. More than a double has none.
function decimalsOf(step) {
  for (let decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)); decimals < 16; decimals += 1) {
    const count = step * 10 ** decimals;
    if (Math.abs(count - Math.round(count)) < 1e-6 * count) return decimals;
  }
  return 16;
}

// Texts of the ticks of an axis, each with the digits that tell it from its neighbours; null is none.
export function tickTexts(values) {
  const shown = values.filter((value) => value !== null);
  const step = shown.length > 1 ? Math.abs(shown[shown.length - 1] - shown[0]) / (shown.length - 1) : Math.abs(shown[0] ?? 0);
  const largest = Math.max(...shown.map(Math.abs), 0);
  if (step === 0 || largest === 0) return values.map((value) => (value === null ? "" : number(value, 4)));
  // Of evenly spaced ticks the mean of their steps is the step, but for rounding.
  const decimals = decimalsOf(Number(step.toPrecision(9)));
  const digits = Math.min(Math.max(4, Math.floor(Math.log10(largest)) + 1 + decimals), 16);
  return values.map((value) => (value === null ? "" : Math.abs(value) < 1e-9 * step ? "0" : number(value, digits)));
}

// Writes the values of one column with the same number of decimals, so that digits stand below digits; what is
// far below the column's own size is rounding, not a value.
export function columnText(values, digits = 5) {
  const largest = Math.max(...values.map((v) => (v === null || !Number.isFinite(v) ? 0 : Math.abs(v))), 0);
  if (largest === 0 || largest >= 1e15 || largest < 1e-6) return (value) => number(value, digits);
  const decimals = Math.min(Math.max(digits - 1 - Math.floor(Math.log10(largest)), 0), 9);
  return (value) => (value === null || !Number.isFinite(value) ? "\u2013" : value.toFixed(decimals).replace(/^-(0(\.0+)?)$/, "$1"));
}

// A count with its thousands apart.
export function countText(count) {
  return String(count).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}

// What a workshop measures is in millimetres, whatever the unit of the track; what is below a tenth of a micrometre is
// rounding.
export function millimetres(metres) {
  return `${number(Math.round(1e7 * metres) / 1e4, 6)}\u00a0mm`;
}

// In the unit that suits its size, as the summary of the program has it.
export function volumeText(cubicMetres) {
  const size = Math.abs(cubicMetres);
  const [factor, unit] = size >= 1 ? [1, "m\u00b3"] : size >= 1e-4 || size === 0 ? [1e3, "litres"] : size >= 1e-7 ? [1e6, "cm\u00b3"] : [1e9, "mm\u00b3"];
  return `${number(factor * cubicMetres, 4)}\u00a0${unit}`;
}

export function bytesText(bytes) {
  if (bytes < 1e3) return `${bytes} B`;
  if (bytes < 1e6) return `${number(bytes / 1e3, 3)} kB`;
  return `${number(bytes / 1e6, 3)} MB`;
}
