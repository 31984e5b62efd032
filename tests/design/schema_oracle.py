#!/usr/bin/env python3
"""schema_oracle.py PROGRAM DESIGNS...: an independent validator (python3-jsonschema) holds designs against `glissade schema`.

Every design is valid, and none is any more with a key that is misspelt, left out or of the wrong unit.
"""
import copy
import json
import subprocess
import sys

try:
    import jsonschema
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def spoilt(design):
    """The design with one fault each, and the name of the fault."""
    def changed(name, change):
        copied = copy.deepcopy(design)
        change(copied)
        return name, copied

    yield changed("an unknown key", lambda d: d.update(colour="red"))
    yield changed("no track", lambda d: d.pop("track"))
    yield changed("a body's slip of the pen", lambda d: d.setdefault("body", {}).update(frction_angle="17 deg"))
    yield changed("a number without its unit", lambda d: d.update(gravity=9.8))
    yield changed("a unit of something else", lambda d: d.update(gravity="9.8 m"))
    yield changed("no format of an export", lambda d: d.update(export=[]))
    yield changed("a sheet of one side", lambda d: d.update(fabrication={"process": "plate", "split": {"sheet": ["3 m"]}}))
    yield changed("a bolt of no size", lambda d: d.update(fabrication={"process": "plate", "flanges": {"bolt": "M11"}}))
    yield changed("a kind that there is not", lambda d: d["centerline"].update(kind="fastets"))


def to_edge(design):
    """The design with a start that is free beside an edge, which is valid whatever else it is."""
    for start in ({"x": "free", "z": "47 m"}, {"x": "-50 m", "z": "free"}, {"x": "free", "z": "free"}):
        yield dict(design, track={"edge": {"x": "0 m", "z": "0 m"}, "start": start})


def main():
    program, *designs = sys.argv[1:]
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    failures = 0
    for path in designs:
        with open(path, encoding="utf-8") as stream:
            design = yaml.safe_load(stream)
        for error in validator.iter_errors(design):
            print(f"{path}: {list(error.absolute_path)}: {error.message[:200]}")
            failures += 1
        for free in to_edge(design):
            if not validator.is_valid(free):
                print(f"{path}: not valid with {free['track']}")
                failures += 1
        for name, faulty in spoilt(design):
            if validator.is_valid(faulty):
                print(f"{path}: valid with {name}")
                failures += 1
    print(f"{len(designs)} designs, {failures} failures")
    return 1 if failures or not designs else 0


sys.exit(main())
