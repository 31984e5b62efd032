"""One sphere on the exported floor against the ride that Glissade tells of it.

usage: sphere.py start CSV           where the sphere begins: X Z VX VZ of its centre
       sphere.py compare CSV LOG     speed and time where the slope is 60, 50, 40, 30 deg; ends with 1 beyond 0.2 %
"""
import csv, math, sys

RADIUS, START, BALL, BEGIN, BOUND = 3.0, math.radians(75.0), 0.005, 0.1, 2e-3
CENTRE = (RADIUS * math.sin(START), RADIUS * math.cos(START))


def rows_of(path):
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(open(path))]


def first_of(rows):
    return min(rows, key=lambda row: abs(row["arc_length_m"] - BEGIN))


def start(rows):
    row = first_of(rows)
    slope, speed = math.radians(row["slope_angle_deg"]), row["speed_m_per_s"]
    print("%.9g %.9g %.9g %.9g" % (row["run_m"] + BALL * math.sin(slope), -row["drop_m"] + BALL * math.cos(slope),
                                   speed * math.cos(slope), -speed * math.sin(slope)))


def states_of(log):
    for line in open(log):
        try:
            step, time, x, z, vx, vz = map(float, line.split())
        except ValueError:
            continue
        yield math.degrees(math.atan2(CENTRE[0] - x, CENTRE[1] - z)), math.hypot(vx, vz), time


def at_slope(pairs, target):
    before = None
    for now in pairs:
        if before and before[0] > target >= now[0]:
            share = (before[0] - target) / (before[0] - now[0])
            return [a + share * (b - a) for a, b in zip(before[1:], now[1:])]
        before = now
    sys.exit(f"nothing passes {target} deg")


def compare(rows, log):
    begin = first_of(rows)["time_s"]
    ridden = [(row["slope_angle_deg"], row["speed_m_per_s"], row["time_s"] - begin) for row in rows]
    seen = list(states_of(log))
    worst = 0.0
    print("slope deg   speed m/s: sphere   ride   off      time s: sphere   ride   off")
    for target in (60.0, 50.0, 40.0, 30.0):
        speed, time = at_slope(seen, target)
        told_speed, told_time = at_slope(ridden, target)
        off = (speed / told_speed - 1.0, time / told_time - 1.0)
        worst = max(worst, *map(abs, off))
        print(f"{target:6.0f}   {speed:.4f}  {told_speed:.4f}  {100 * off[0]:+.3f} %   "
              f"{time:.5f}  {told_time:.5f}  {100 * off[1]:+.3f} %")
    if worst > BOUND:
        sys.exit(f"off by {100 * worst:.3f} %, the bound is {100 * BOUND} %")


if sys.argv[1] == "start":
    start(rows_of(sys.argv[2]))
else:
    compare(rows_of(sys.argv[2]), sys.argv[3])
