#!/usr/bin/env python3
"""What an isolator or a cable has to bear: the stroke of the lowest joint, and the tension, at each frequency.

    scripts/demands.py STYLOBATE STUDY.toml VARIANT RESULTS.h5 WEIGHT_N

At each frequency the realization with the largest displacement of the top, among those that stand, is run again, and
its trajectory gives the stroke of the lowest joint (the middle of the lowest drum's lower face, from its start) and the
tension of the cable by kernels/planar/mechanisms/tendon.hpp. Prints a Markdown row for each of the two that the variant has.
"""
import csv
import math
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path


def rows_of(folder, name):
    with open(next(Path(folder).glob(name)), newline="") as file:
        return [{k: v for k, v in row.items()} for row in csv.DictReader(file)]


def largest_that_stand(rows):
    found = {}
    for row in rows:
        if row["state"] in ("collapsed", "invalid"):
            continue
        frequency = float(row["frequency_hz"])
        size = float(row["peak_top_displacement_m"])
        if frequency not in found or size > found[frequency][0]:
            found[frequency] = (size, row["index"], float(row["pga_m_s2"]))
    return found


def stroke_m(track):
    """Of the lowest block that moves."""
    blocks = sum(key.startswith("x_m[") for key in track[0])
    for block in range(blocks):
        half = float(track[0][f"half_height_m[{block}]"])

        def middle(row):  # of its lower face
            return float(row[f"x_m[{block}]"]) + half * math.sin(float(row[f"theta_rad[{block}]"]))

        stroke = max(abs(middle(row) - middle(track[0])) for row in track)
        if stroke > 0:
            return stroke
    return 0


def tension_n(track, cable):
    top = max(int(key[4:-1]) for key in track[0] if key.startswith("x_m["))
    half = float(track[0][f"half_height_m[{top}]"])
    rest_x = float(track[0][f"rest_x_m[{top}]"])
    stiffness, yields = cable["stiffness_n_m"], cable.get("yield_n", math.inf)
    stretch, plastic, most, length = cable.get("prestress_n", 0) / stiffness, 0.0, 0.0, None
    for row in track:
        angle = float(row[f"theta_rad[{top}]"])
        x = float(row[f"x_m[{top}]"]) - half * math.sin(angle)
        y = float(row[f"y_m[{top}]"]) + half * math.cos(angle)
        if length is None:
            rest_x, length = x, y  # vertical at rest, down to the ground at y = 0
        trial = stiffness * (stretch + math.hypot(x - rest_x, y) - length - plastic)
        plastic += max(trial - yields, 0) / stiffness
        most = max(most, min(max(trial, 0), yields))
    return most


def main():
    stylobate, study, variant, results, weight = sys.argv[1:]
    changes = tomllib.loads(Path(study).read_text())["variants"][variant].get("mechanisms", {})
    with tempfile.TemporaryDirectory() as work:
        run = lambda *words: subprocess.run([stylobate, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        run("export", results, "--to", "csv", "-o", f"{work}/rows")
        chosen = largest_that_stand(rows_of(f"{work}/rows", "realizations.csv"))
        strokes, tensions = [], []
        for frequency, (_, index, pga) in sorted(chosen.items()):
            run("replay", results, "--realization", index, "-o", f"{work}/{index}.h5")
            run("export", f"{work}/{index}.h5", "--to", "csv", "-o", f"{work}/{index}")
            track = rows_of(f"{work}/{index}", "trajectory_*.csv")
            strokes.append(f"{stroke_m(track):.2g}")
            if "tendon" in changes:
                tensions.append(f"{tension_n(track, changes['tendon']) / float(weight):.2g}")
    name = Path(study).stem
    if "joint_friction" in changes or "bearing" in changes:
        print(f"| {name} | `{variant}` | stroke of the isolator [m] | " + " | ".join(strokes) + " |")
    if "tendon" in changes:
        print(f"| {name} | `{variant}` | tension / weight | " + " | ".join(tensions) + " |")


main()
