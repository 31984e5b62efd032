"""Takes the floor's facets out of the STL of the arc of arc.yaml: a particle code needs no underside.

usage: floor.py STL FLOOR_STL HALF_WIDTH     facets that reach within HALF_WIDTH of the middle [m]
"""
import math, struct, sys

RADIUS, START = 3.0, math.radians(75.0)
CENTRE = (RADIUS * math.sin(START), RADIUS * math.cos(START))


def on_floor(point):
    return abs(math.hypot(point[0] - CENTRE[0], point[2] - CENTRE[1]) - RADIUS) < 2e-4


def main():
    source, target, half = sys.argv[1], sys.argv[2], float(sys.argv[3])
    data = open(source, "rb").read()
    count = struct.unpack("<I", data[80:84])[0]
    kept = 0
    with open(target, "w") as out:
        out.write("solid floor\n")
        for i in range(count):
            numbers = struct.unpack("<12f", data[84 + 50 * i:132 + 50 * i])
            corners = [numbers[3:6], numbers[6:9], numbers[9:12]]
            if not all(map(on_floor, corners)) or min(abs(p[1]) for p in corners) >= half:
                continue
            kept += 1
            out.write("facet normal %.9g %.9g %.9g\nouter loop\n" % numbers[:3])
            for corner in corners:
                out.write("vertex %.9g %.9g %.9g\n" % corner)
            out.write("endloop\nendfacet\n")
        out.write("endsolid floor\n")
    print(f"{kept} of {count} facets are the floor's")


main()
