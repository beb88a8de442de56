"""Collapse shares of one column in the plane and in space, as a table in Markdown (scripts/space.sh).

    space.py STYLOBATE FOLDER REALIZATIONS
"""

import csv
import math
import pathlib
import subprocess
import sys

PGAS = (3, 4, 5)

STUDY = """
[study]
kind = "surface"
seed = {seed}
realizations = {realizations}

[excitation]
kind = "noise"
{shaking}

[surface]
frequency_hz = {{ from = 2.0, to = 2.0, count = 1, spacing = "linear" }}
pga_m_s2 = {{ from = {first}, to = {last}, count = 3, spacing = "linear" }}
"""

COLUMN = """
[structure]
{space}kind = "column"
blocks = 6
drum_width_m = 1.0
drum_height_m = 1.0
density_kg_m3 = 2700

[contact]
{stiffness}
normal_damping_ratio = {damping}
tangential_damping_ratio = {damping}
friction = 0.7
{contact}

[perturbation]
drum_offset = {{ distribution = "normal", sd_m = 0.001, per = "block" }}
"""


def column(space="", stiffness=3e9, damping=0.1, contact=""):
    """The column of this page, as part of a study. @param space: the shape in space; nothing: in the plane"""
    return COLUMN.format(
        space=f'dimensions = 3\nshape = "{space}"\n' if space else "depth_m = 1.0\n",
        stiffness=f"normal_stiffness_n_m{3 if space else 2} = {stiffness:g}",
        damping=damping,
        contact=contact,
    )


def study(shaking="", factor=1.0, seed=7, realizations=0, **of_column):
    """@param factor: on the PGAs.  @param of_column: as in `column`"""
    return STUDY.format(
        seed=seed, realizations=realizations, shaking=shaking, first=factor * PGAS[0], last=factor * PGAS[-1]
    ) + column(**of_column)


BOTH = "second_ratio = 0.8"
ENDS = 'damping = "ends"'
SPREAD = 'damping_per = "chord"\n\n[mechanisms]\nface_damping = { share = 0.3333333333333333 }'
CASES = [  # name, words, settings
    ("plane", "in the plane, along x", {}),
    ("plane_spread", "the same, with dashpots spread over the faces as in space", {"contact": SPREAD}),
    ("plane_across", "in the plane, by the weaker component (0.8 of the PGA; independent noise)", {"factor": 0.8, "seed": 8}),
    ("one", "round, in space, one component", {"space": "round"}),
    ("both", "round, in space, both components at once", {"space": "round", "shaking": BOTH}),
    ("vector", "the same, the PGA being that of the vector", {"space": "round", "shaking": BOTH + '\npga_of_pair = "at_once"'}),
    ("vertical", "both components, and half of it vertically", {"space": "round", "shaking": BOTH + "\nvertical_ratio = 0.5"}),
    ("square_one", "square, one component", {"space": "square"}),
    ("square", "square, both components at once", {"space": "square", "shaking": BOTH}),
    ("soft", "round, both, a tenth of the stiffness", {"space": "round", "shaking": BOTH, "stiffness": 3e8}),
    ("stiff", "round, both, ten times the stiffness", {"space": "round", "shaking": BOTH, "stiffness": 3e10}),
    ("undamped", "round, both, damping ratio 0.02", {"space": "round", "shaking": BOTH, "damping": 0.02}),
    ("damped", "round, both, damping ratio 0.5", {"space": "round", "shaking": BOTH, "damping": 0.5}),
    ("ends", "round, both, dashpots at the ends", {"space": "round", "shaking": BOTH, "contact": ENDS}),
    ("ends_rigid", "round, both, dashpots at the ends, damping ratio 0.4", {"space": "round", "shaking": BOTH, "contact": ENDS, "damping": 0.4}),
    ("ends_soft", "the same, a tenth of the stiffness", {"space": "round", "shaking": BOTH, "contact": ENDS, "damping": 0.4, "stiffness": 3e8}),
    ("ends_stiff", "the same, ten times the stiffness", {"space": "round", "shaking": BOTH, "contact": ENDS, "damping": 0.4, "stiffness": 3e10}),
    ("ends_one", "round, one component, dashpots at the ends, damping ratio 0.4", {"space": "round", "contact": ENDS, "damping": 0.4}),
    ("ends_plane", "in the plane, along x, dashpots at the ends, damping ratio 0.4", {"contact": ENDS, "damping": 0.4}),
]


def fallen(stylobate, folder, name, text):
    """(PGA) lists of whether each realization collapsed, by its number under that PGA."""
    file = folder / f"{name}.toml"
    file.write_text(text)
    subprocess.run([stylobate, "run", file, "-o", folder / f"{name}.h5", "--quiet"], check=True, stdout=sys.stderr)
    subprocess.run([stylobate, "export", folder / f"{name}.h5", "--to", "csv", "-o", folder / name, "--quiet"], check=True, stdout=sys.stderr)
    cells = [[] for _ in PGAS]
    with open(folder / name / "realizations.csv", newline="") as rows:
        for row in csv.DictReader(rows):
            cells[int(row["cell"])].append(row["state"] in ("3", "collapsed"))
    return cells


def interval(share, n):
    """Wilson's, 95 %."""
    z2 = 1.96**2
    half = 1.96 * math.sqrt(share * (1 - share) / n + z2 / (4 * n * n)) / (1 + z2 / n)
    middle = (share + z2 / (2 * n)) / (1 + z2 / n)
    return middle - half, middle + half


def row(words, cells):
    shares = []
    for cell in cells:
        n = len(cell)
        share = sum(cell) / n
        low, high = interval(share, n)
        shares.append(f"{100 * share:.1f} ({100 * low:.1f} to {100 * high:.1f})")
    return f"| {words} | " + " | ".join(shares) + " |"


def main():
    stylobate, folder, realizations = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
    cells = {}
    for name, _, settings in CASES:
        cells[name] = fallen(stylobate, folder, name, study(**settings, realizations=realizations))
    print(f"Share of collapsed realizations in % (in brackets: 95 % interval), {realizations} of each PGA:\n")
    print("| column and shaking | " + " | ".join(f"{pga} m/s²" for pga in PGAS) + " |")
    print("|---|" + "---:|" * len(PGAS))
    for name, words, _ in CASES:
        print(row(words, cells[name]))
        if name == "plane_across":
            either = [[a or b for a, b in zip(x, y)] for x, y in zip(cells["plane"], cells["plane_across"])]
            print(row("either of these two", either))
    print("\nPaired: the same motion and the same offsets of the drums along x. Of the realizations")
    for pga, plane, both in zip(PGAS, cells["plane"], cells["both"]):
        more = sum(b and not a for a, b in zip(plane, both))
        less = sum(a and not b for a, b in zip(plane, both))
        print(f"- at {pga} m/s², {more} fall in space under both components and not in the plane, {less} the other way round.")


if __name__ == "__main__":
    main()
