// Where places along the run lie on the site: x and y of the design, as the build's CSV has them.

const ROUNDING = 1e-9;  // metres: what a y is off 0

// Whether y tells anything: a track in the plane of x and z has none.
export const hasY = ({ start_m: start, finish_m: finish }) => [start, finish].some(([, y]) => Math.abs(y) > ROUNDING);

// Whether limits and probes count x along the run: of a track that is turned in plan, x of the site tells no place alone.
export const isTurned = ({ start_m: start, finish_m: finish }) => Math.abs(finish[1] - start[1]) > ROUNDING;

// Columns of the site's x, and of y where it tells anything, beside runs from the start.
export function siteColumns({ placement }, runs) {
  const [x, y] = placement.start_m;
  const [along, aside] = placement.direction;
  const columns = { site_x_m: runs.map((run) => x + run * along) };
  if (hasY(placement)) columns.site_y_m = runs.map((run) => y + run * aside);
  return columns;
}

// The same as columns of a table; their texts are places, not sizes.
export const siteFields = ({ placement }) => [["x", "length", "site_x_m"], ...(hasY(placement) ? [["y", "length", "site_y_m"]] : [])];
export const isPlace = (key) => ["site_x_m", "site_y_m", "z_m"].includes(key);
