"""What Open CASCADE, through FreeCAD, finds in a STEP file: python3 step_facts.py FILE; first the number of solids, then a
line a solid: valid closed volume-in-mm3 planes cylinders cones other-faces
"""
import glob
import sys

sys.path.extend(glob.glob("/usr/lib/freecad*/lib"))
import FreeCAD  # noqa: F401  (Part needs it)
import Part

shape = Part.Shape()
shape.read(sys.argv[1])
print(len(shape.Solids))
for solid in shape.Solids:
    kinds = [type(face.Surface).__name__ for face in solid.Faces]
    known = [kinds.count(name) for name in ("Plane", "Cylinder", "Cone")]
    print(
        int(solid.isValid()),
        int(solid.isClosed()),
        repr(solid.Volume),
        *known,
        len(kinds) - sum(known),
    )
