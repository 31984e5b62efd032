"""What ezdxf finds in DXF files: python3 dxf_facts.py FILE...; one line a file:
errors fixes units area-of-closed-polylines-less-circles circles open-polylines texts other-entities
"""
import math
import sys

import ezdxf
from ezdxf import recover


def area(polyline):
    """Area inside a closed LWPOLYLINE: chords by the shoelace formula, arcs by their sectors."""
    points = list(polyline.get_points("xyb"))
    total = 0.0
    for (x0, y0, bulge), (x1, y1, _) in zip(points, points[1:] + points[:1]):
        total += 0.5 * (x0 * y1 - x1 * y0)
        if bulge:
            sweep = 4.0 * math.atan(bulge)
            radius = math.hypot(x1 - x0, y1 - y0) / (2.0 * math.sin(abs(sweep) / 2.0))
            total += 0.5 * radius * radius * (sweep - math.sin(sweep))
    return abs(total)


for name in sys.argv[1:]:
    ezdxf.readfile(name)  # strict: raises where the structure is broken
    document, auditor = recover.readfile(name)
    again = document.audit()
    space = document.modelspace()
    closed = [p for p in space.query("LWPOLYLINE") if p.closed]
    opened = [p for p in space.query("LWPOLYLINE") if not p.closed]
    circles = list(space.query("CIRCLE"))
    texts = list(space.query("TEXT MTEXT"))
    total = 2.0 * max((area(p) for p in closed), default=0.0) - sum(area(p) for p in closed)
    total -= sum(math.pi * c.dxf.radius**2 for c in circles)
    others = len(space) - len(closed) - len(opened) - len(circles) - len(texts)
    print(
        len(auditor.errors) + len(again.errors),
        len(auditor.fixes) + len(again.fixes),
        document.header.get("$INSUNITS"),
        repr(total),
        len(circles),
        len(opened),
        len(texts),
        others,
    )
