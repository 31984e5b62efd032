// The frictions of a design: which ride the page tells of, and between which curves the others lie.

const COLUMNS = ["time_s", "speed_m_per_s", "normal_load_m_per_s2", "friction_loss_j_per_kg", "drag_loss_j_per_kg",
  "burden_depth_m", "equivalent_friction", "floor_pressure_pa", "floor_wear_w_per_m2", "wall_wear_w_per_m2", "channel_width_m"];

export class Rides {
  constructor(doc) {
    this.doc = doc;
    this.level = "nominal";
  }

  get several() {
    return this.doc.rides.length > 1;
  }

  of(level) {
    return this.doc.rides.find((ride) => ride.friction === level) ?? null;
  }

  current() {
    return this.of(this.level);
  }

  name({ friction, friction_angle_deg: angle }) {
    return `${friction}, ${Number(angle.toPrecision(4))} deg`;
  }

  // The other parts of the page hold the columns themselves: they are refilled, not replaced.
  choose(level) {
    this.level = level;
    const { stations, ...facts } = this.of(level);
    Object.assign(this.doc.ride, facts);
    for (const key of COLUMNS) {
      const column = this.doc.stations[key];
      // Only a stream has the columns of one.
      if (!column) continue;
      stations[key].forEach((value, i) => {
        column[i] = value;
      });
    }
  }

  // Columns of the lowest and the highest friction, for a band; none without a range.
  band(key) {
    if (!this.several) return null;
    return [this.doc.rides[0].stations[key], this.doc.rides[this.doc.rides.length - 1].stations[key]];
  }
}
