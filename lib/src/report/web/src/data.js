// The one JSON document of the report; docs/report-data.md describes every field.

const SCHEMA = "glissade-report/2";

export function readDocument() {
  const text = document.getElementById("glissade-data").textContent;
  const doc = JSON.parse(text);
  if (doc.schema !== SCHEMA) {
    throw new Error(`This page reads ${SCHEMA}, the document says ${doc.schema}.`);
  }
  return doc;
}

// Radius of curvature beside each station: 0 where the curvature is unbounded, none where the track is straight. A
// piece that turns by less than a millionth of a radian over the whole track's length is straight.
export function radiusOf(stations) {
  const length = stations.arc_length_m[stations.arc_length_m.length - 1];
  const straight = 1e-6 / length;
  return stations.curvature_per_m.map((k) => (k === null ? 0 : Math.abs(k) < straight ? null : 1 / Math.abs(k)));
}

const BYTES = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

// Arrays of the 3-D views travel as {type, data}: little-endian numbers in base64.
export function decodeArray({ type, data }) {
  const binary = atob(data);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i += 1) bytes[i] = binary.charCodeAt(i);
  return new BYTES[type](bytes.buffer);
}

// Index of the last station at or before `value` in an ascending column.
export function stationAt(column, value) {
  let low = 0;
  let high = column.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (column[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

export function interpolate(xs, ys, x) {
  const i = Math.min(stationAt(xs, x), xs.length - 2);
  if (i < 0) return ys[0];
  const span = xs[i + 1] - xs[i];
  const t = span > 0 ? Math.min(Math.max((x - xs[i]) / span, 0), 1) : 0;
  return ys[i] + t * (ys[i + 1] - ys[i]);
}
