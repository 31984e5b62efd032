// A sequence of colours whose lightness rises evenly, so that it reads in grey print and with colour-blind eyes.
const RAMP = [
  [0.21, 0.16, 0.42], [0.19, 0.32, 0.57], [0.14, 0.47, 0.58], [0.13, 0.61, 0.52], [0.4, 0.74, 0.38], [0.75, 0.83, 0.25],
  [0.97, 0.91, 0.35],
];

export function colourAt(fraction) {
  const position = Math.min(Math.max(fraction, 0), 1) * (RAMP.length - 1);
  const index = Math.min(Math.floor(position), RAMP.length - 2);
  const t = position - index;
  return [0, 1, 2].map((i) => RAMP[index][i] + t * (RAMP[index + 1][i] - RAMP[index][i]));
}

export function stops() {
  return RAMP.map((colour) => `rgb(${colour.map((c) => Math.round(255 * c)).join(" ")})`);
}
