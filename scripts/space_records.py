"""Collapse shares of one column under recorded pairs of components, as tables in Markdown (scripts/space.sh).

    space_records.py FOLDER REALIZATIONS PAIRS.toml

PAIRS.toml lists the pairs as `fragility.records` of a study does: file, component, unit, and the table `second`. Needs the
Python module of Stylobate, which reads the records and runs the studies.

Every pair is scaled so that the geometric mean of its two PGAs is the same; all of its components, and its component in
the direction of the largest acceleration, keep that one factor.
"""

import math
import pathlib
import sys
import tomllib

import numpy as np
import space
import stylobate

LEVELS = (2, 3, 4, 6)

STUDY = """
[study]
kind = "fragility"
seed = 11
realizations = {realizations}

[excitation]
kind = "record"

[fragility]
method = "cloud"
scale = {level}
records = [
{records}
]
"""

CASES = [  # name, words, shape in space, components
    ("first", "in the plane, by the first component", "", "first"),
    ("second", "in the plane, by the second component", "", "second"),
    ("strongest", "in the plane, along the direction of the largest acceleration", "", "strongest"),
    ("round_first", "round, in space, by the first component alone", "round", "first"),
    ("round", "round, in space, both components at once", "round", "pair"),
    ("square", "square, both components at once", "square", "pair"),
]


def read_pairs(file):
    """[(name, dt, first, second)]: accelerations in m/s2, of the same length, their geometric mean PGA being 1 m/s2."""
    pairs = []
    for entry in tomllib.loads(file.read_text())["records"]:
        def read(of):
            at = file.parent / of.get("file", entry["file"])
            return stylobate.Record.read(at, component=of.get("component"), unit=of.get("unit", entry.get("unit")))

        first, second = read(entry), read(entry["second"])
        if first.dt_s != second.dt_s:
            sys.exit(f"{first.file} and {second.file} have different sampling times")
        n = min(len(first.acceleration_m_s2), len(second.acceleration_m_s2))
        a, b = first.acceleration_m_s2[:n], second.acceleration_m_s2[:n]
        mean = math.sqrt(np.abs(a).max() * np.abs(b).max())
        pairs.append((pathlib.Path(first.file).stem, first.dt_s, a / mean, b / mean))
    return pairs


def strongest(a, b):
    """The component along the direction in which the pair's largest acceleration points: its PGA is RotD100."""
    at = np.argmax(np.hypot(a, b))
    angle = math.atan2(b[at], a[at])
    return a * math.cos(angle) + b * math.sin(angle)


def write_components(pairs, folder):
    for i, (_, dt, a, b) in enumerate(pairs):
        for name, samples in (("first", a), ("second", b), ("strongest", strongest(a, b))):
            with open(folder / f"pair{i}_{name}.csv", "w") as out:
                out.writelines(f"{k * dt:.6f},{value:.9g}\n" for k, value in enumerate(samples))


def fallen(folder, case, level, pairs, realizations):
    """(pair, realization): whether it collapsed."""
    name, _, shape, components = case
    rows = []
    for i in range(len(pairs)):
        second = f', second = {{ file = "pair{i}_second.csv", unit = "m/s2" }}' if components == "pair" else ""
        rows.append(f'    {{ file = "pair{i}_{"first" if components == "pair" else components}.csv", unit = "m/s2"{second} }},')
    text = STUDY.format(realizations=realizations, level=level, records="\n".join(rows)) + space.column(space=shape)
    study = folder / f"{name}_{level}.toml"
    study.write_text(text)
    of = stylobate.run(study, folder / f"{name}_{level}.h5").arrays()
    return np.array([of["state"][of["cell"] == motion] == 3 for motion in range(len(pairs))])


def interval(shares, draws=10_000):
    """95 % of the means of as many pairs, drawn anew from these."""
    draw = np.random.default_rng(1).integers(0, len(shares), (draws, len(shares)))
    return np.percentile(shares[draw].mean(axis=1), [2.5, 97.5])


def main():
    folder, realizations = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    pairs = read_pairs(pathlib.Path(sys.argv[3]))
    write_components(pairs, folder)
    shares = {}
    for case in CASES:
        for level in LEVELS:
            shares[case[0], level] = fallen(folder, case, level, pairs, realizations).mean(axis=1)
    print(f"Share of collapsed realizations in % under {len(pairs)} recorded pairs, {realizations} realizations of each (in brackets: 95 % of the means of as many pairs drawn anew). The PGA is the geometric mean of the pair's; every column of the table has the pairs with the same factors:\n")
    print("| column and shaking | " + " | ".join(f"{level} m/s²" for level in LEVELS) + " |")
    print("|---|" + "---:|" * len(LEVELS))
    for name, words, _, _ in CASES:
        cells = []
        for level in LEVELS:
            of = 100 * shares[name, level]
            low, high = interval(of)
            cells.append(f"{of.mean():.1f} ({low:.0f} to {high:.0f})")
        print(f"| {words} | " + " | ".join(cells) + " |")
    larger = [float(np.abs(strongest(a, b)).max()) for _, _, a, b in pairs]
    print(f"\nThe largest acceleration in any direction (RotD100 of the PGA) is {min(larger):.2f} to {max(larger):.2f} of the geometric mean.")


if __name__ == "__main__":
    main()
