#!/usr/bin/env python3
"""Disturbs runs of the program in the ways in which machines do, and reports what became of them.

  faults.py PROGRAM --library LIBRARY [--kills 1000] [--thorough] [--only PART] [--seed N] [--page docs/reliability.md]

The exit status is 1 where a fault is found. LIBRARY is that of failing_calls.cpp.
"""

import argparse
import pathlib
import random
import sys
import tempfile

import disks
import kills
import machines
import page
from laboratory import Laboratory

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PARTS = ["kills", "disks", "machines"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--kills", type=int, default=27, help="in all (default: 27)")
    parser.add_argument("--thorough", action="store_true", help="of each call on files up to 100 fail, not a few of them")
    parser.add_argument("--only", choices=PARTS, help="one part alone")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--page", type=pathlib.Path, help="Markdown page to write the tables into")
    options = parser.parse_args()

    chance = random.Random(options.seed)
    found = {}
    with tempfile.TemporaryDirectory(prefix="faults-") as folder:
        lab = Laboratory(options.program.resolve(), SOURCE / "studies/inputs", folder)
        tell = lambda text: print(text, flush=True)
        version, simd = lab.call(["--version"]).out.strip(), lab.simd[-1]
        for name in [options.only] if options.only else PARTS:
            if name == "kills":
                found[name] = kills.campaign(lab, options.kills, chance, tell)
            else:
                part = {"disks": disks, "machines": machines}[name]
                found[name] = part.campaign(lab, options.library.resolve(), chance, options.thorough, tell)
            if options.page: # part by part: each takes minutes
                page.write(options.page, {name: found[name]}, version, simd, options.seed)
    faults = [f"{row.get('study', row.get('case'))}: {fault}" for rows in found.values() for row in rows for fault in row["faults"]]
    for fault in faults:
        print(f"FAULT {fault}")
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
