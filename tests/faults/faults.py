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
        wanted = [options.only] if options.only else PARTS
        if "kills" in wanted:
            found["kills"] = kills.campaign(lab, options.kills, chance, tell)
        for name, part in (("disks", disks), ("machines", machines)):
            if name in wanted:
                found[name] = part.campaign(lab, options.library.resolve(), chance, options.thorough, tell)
        version = lab.call(["--version"]).out.strip()
        processor = lab.simd[-1]
    faults = [f"{row.get('study', row.get('case'))}: {fault}" for rows in found.values() for row in rows for fault in row["faults"]]
    for fault in faults:
        print(f"FAULT {fault}")
    if options.page:
        page.write(options.page, found, version, processor, options.seed)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
