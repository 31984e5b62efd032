#!/usr/bin/env python3
"""build_counts.py PROGRAM PERFORMANCE_MD DESIGNS: the table "Whole builds" of docs/performance.md has the triangles and megabytes that builds have.

Its times are those of one run and one machine; what is built is not.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SHARE = 0.01  # of the bytes: reports tell the program's version, and numbers are as long as their digits


def rows(page):
    """Name, triangles and MB of each row of the table."""
    section = page.split("## Whole builds", 1)[1].split("\n## ", 1)[0]
    return re.findall(r"^(\w+) +(\d+) +([\d.]+) +[\d.]+ ms", section, re.MULTILINE)


def built(program, design, out):
    told = subprocess.run([program, "build", design, "-o", out, "--json"], check=True, capture_output=True, text=True)
    size = sum(file.stat().st_size for file in pathlib.Path(out).rglob("*") if file.is_file())
    return json.loads(told.stdout)["mesh"]["triangles"], size / 1e6


def main():
    program, page, designs = sys.argv[1:]
    table = rows(pathlib.Path(page).read_text(encoding="utf-8"))
    failures = 0
    for name, triangles, megabytes in table:
        with tempfile.TemporaryDirectory() as out:
            count, size = built(program, str(pathlib.Path(designs) / f"{name}.yaml"), out)
        if count != int(triangles) or abs(size - float(megabytes)) > SHARE * size:
            print(f"{name}: {triangles} triangles, {megabytes} MB in the table; built {count}, {size:.2f} MB")
            failures += 1
    print(f"{len(table)} designs, {failures} failures")
    return 1 if failures or not table else 0


sys.exit(main())
