// One still picture of facets, drawn from back to front: where there is no WebGL.

import { themeColour } from "./dom.js";

// Positions as a reader beside the track sees them, from before it and above.
function seen(positions, azimuth) {
  const [c, s] = [Math.cos(azimuth), Math.sin(azimuth)];
  const count = positions.length / 3;
  const [x, y, depth] = [new Float32Array(count), new Float32Array(count), new Float32Array(count)];
  for (let i = 0; i < count; i += 1) {
    const along = positions[3 * i] * c + positions[3 * i + 1] * s;
    const left = -positions[3 * i] * s + positions[3 * i + 1] * c;
    const up = positions[3 * i + 2];
    x[i] = 0.86 * along + 0.5 * left;
    y[i] = 0.82 * up + 0.3 * (0.86 * left - 0.5 * along);
    depth[i] = 0.5 * along - 0.86 * left + 0.5 * up;
  }
  return { x, y, depth };
}

function range(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return { low, high };
}

// The facets that face the reader, the farthest first; those behind a closed solid nobody sees.
function shown({ x, y, depth }, indices) {
  const far = new Float32Array(indices.length / 3);
  const front = [];
  for (let t = 0; t < far.length; t += 1) {
    const [i, j, k] = [indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]];
    if ((x[j] - x[i]) * (y[k] - y[i]) <= (y[j] - y[i]) * (x[k] - x[i])) continue;
    far[t] = depth[i] + depth[j] + depth[k];
    front.push(t);
  }
  return Uint32Array.from(front).sort((a, b) => far[a] - far[b]);
}

// `colourOf` gives red, green and blue of a facet of a closed solid, 0 to 1.
// Returns which facet lies at a point of the canvas: null where there is none.
export function stillPicture(canvas, { positions, indices }, azimuth, colourOf) {
  const view = seen(positions, azimuth);
  const order = shown(view, indices);
  const { x, y } = view;
  const [wide, tall] = [range(x), range(y)];
  const scale = 0.94 * Math.min(canvas.width / (wide.high - wide.low), canvas.height / (tall.high - tall.low));
  const px = (i) => canvas.width / 2 + scale * (x[i] - (wide.low + wide.high) / 2);
  const py = (i) => canvas.height / 2 - scale * (y[i] - (tall.low + tall.high) / 2);
  const context = canvas.getContext("2d");
  context.fillStyle = themeColour("--panel");
  context.fillRect(0, 0, canvas.width, canvas.height);
  // Neighbours of one colour make one path: setting colours takes longest.
  let colour = null;
  const paint = () => {
    context.fillStyle = context.strokeStyle = `#${colour.toString(16).padStart(6, "0")}`;
    context.fill();
    context.stroke();
  };
  for (const t of order) {
    const [i, j, k] = [indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]];
    const light = 255 * (0.65 + 0.35 * Math.abs(facing(positions, i, j, k)));
    const next = colourOf(t).reduce((sum, part) => 256 * sum + Math.round(light * part), 0);
    if (next !== colour) {
      if (colour !== null) paint();
      colour = next;
      context.beginPath();
    }
    context.moveTo(px(i), py(i));
    context.lineTo(px(j), py(j));
    context.lineTo(px(k), py(k));
    context.closePath();
  }
  if (colour !== null) paint();
  return (atX, atY) => {
    const side = (i, j) => (px(j) - px(i)) * (atY - py(i)) - (py(j) - py(i)) * (atX - px(i));
    for (let n = order.length - 1; n >= 0; n -= 1) {
      const t = order[n];
      const [i, j, k] = [indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]];
      const [a, b, c] = [side(i, j), side(j, k), side(k, i)];
      if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return t;
    }
    return null;
  };
}

// How far up a facet looks: the upward part of its unit normal.
function facing(positions, i, j, k) {
  const side = (v, axis) => positions[3 * v + axis] - positions[3 * i + axis];
  const [ax, ay, az, bx, by, bz] = [side(j, 0), side(j, 1), side(j, 2), side(k, 0), side(k, 1), side(k, 2)];
  const [nx, ny, nz] = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
  return nz / (Math.hypot(nx, ny, nz) || 1);
}
