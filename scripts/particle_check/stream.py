"""Mean speed, depth and density of the grains of a dump in windows along the arc, beside the speed of a Glissade ride.

usage: stream.py GRAINS_DUMP GLISSADE RATIO...
The ride starts with the speed and the bulk density of the first window; mass flow, friction and width are those of
stream.in; one ride for each lateral pressure ratio. A depth is twice the mean height of the grains above the floor.
"""
import json, math, subprocess, sys

RADIUS, START, WIDTH, GRAIN = 3.0, math.radians(75.0), 0.1, 0.006
MASS = 2500.0 * math.pi / 6.0 * GRAIN ** 3
CENTRE = (RADIUS * math.sin(START), RADIUS * math.cos(START))  # of the arc, seen from the start of the track
FIRST, LAST, STEPS = 68.0, 32.0, 9  # windows by slope angle [deg]
FROM, TO = 0.60, 0.74               # [s]: the first grains have left, the last have not come


def snapshots(path):
    lines = iter(open(path))
    for line in lines:
        if not line.startswith("ITEM: TIMESTEP"):
            continue
        step = int(next(lines))
        next(lines)
        count = int(next(lines))
        for _ in range(5):
            next(lines)
        yield step * 2e-5, [tuple(map(float, next(lines).split())) for _ in range(count)]


def windows(path):
    size = (FIRST - LAST) / STEPS
    sums = [[0, 0.0, 0.0] for _ in range(STEPS)]
    seen = 0
    for time, grains in snapshots(path):
        if not FROM <= time <= TO:
            continue
        seen += 1
        for x, z, vx, vz in grains:
            across = (CENTRE[0] - x, CENTRE[1] - z)
            slope = math.degrees(math.atan2(across[0], across[1]))
            index = math.floor((FIRST - slope) / size)
            if not 0 <= index < STEPS:
                continue
            angle = math.radians(slope)
            bin_ = sums[index]
            bin_[0] += 1
            bin_[1] += vx * math.cos(angle) - vz * math.sin(angle)
            bin_[2] += RADIUS - math.hypot(*across)
    result = []
    for i, (count, speed, height) in enumerate(sums):
        middle = FIRST - (i + 0.5) * size
        length = RADIUS * math.radians(size)
        result.append((middle, speed / count, 2.0 * height / count, MASS * count / seen / length))
    return seen, result


def ride(glissade, first, rows, ratio):
    slope, speed, depth, per_length = rows[0]
    density = per_length / (WIDTH * depth)
    flow = per_length * speed
    mu = 0.4
    text = f"""glissade: 1
track: {{start: {{x: 0 m, z: 3 m}}}}
body: {{friction_coefficient: {mu}, entry_speed: {speed!r} m/s}}
stream: {{mass_flow: {flow!r} kg/s, bulk_density: {density!r} kg/m^3, lateral_pressure_ratio: {ratio}}}
centerline:
  kind: segments
  entry_slope_angle: {slope!r} deg
  segments: [{{length: {RADIUS * math.radians(slope - rows[-1][0])!r} m, curvature: {1.0 / RADIUS!r} 1/m}}]
cross_section: {{kind: u-channel, width: 100 mm, wall_height: 60 mm, thickness: 10 mm}}
probes: [{', '.join(f'{{from_start: {RADIUS * math.radians(slope - row[0])!r} m}}' for row in rows[1:])}]
"""
    open("stream_check.yaml", "w").write(text)
    out = subprocess.run([glissade, "solve", "--json", "stream_check.yaml"], capture_output=True, text=True)
    if out.returncode:
        sys.exit(out.stderr)
    document = json.loads(out.stdout)
    return density, flow, [probe["states"][0]["speed_m_per_s"] for probe in document["probes"]]


def main():
    dump, glissade, ratios = sys.argv[1], sys.argv[2], [float(r) for r in sys.argv[3:]]
    seen, rows = windows(dump)
    rides = [ride(glissade, FIRST, rows, ratio) for ratio in ratios]
    density, flow, _ = rides[0]
    print(f"{seen} snapshots; {flow:.3f} kg/s, {density:.0f} kg/m^3 in the first window")
    print("slope    flow   speed  depth  density | " + " ".join(f"ride, K_v {r}  " for r in ratios))
    print("  deg    kg/s     m/s     mm   kg/m^3 | " + " ".join("  m/s           " for _ in ratios))
    for i, (slope, speed, depth, per_length) in enumerate(rows):
        text = f"{slope:5.1f}  {per_length * speed:.3f}  {speed:.4f}  {1e3 * depth:5.2f}  {per_length / (WIDTH * depth):7.0f} | "
        for _, _, speeds in rides:
            told = rows[0][1] if i == 0 else speeds[i - 1]
            text += f"{told:.4f} {100 * (told / speed - 1):+5.2f} %  "
        print(text)


main()
