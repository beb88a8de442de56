#!/usr/bin/env python3
"""Gives the relaxed multiply-adds of a module the code that the standard has for them since 2022.

    relaxed.py OBJDUMP MODULE OUTPUT

The compiler of Debian 12 (LLVM 14) writes the code of an earlier draft, of as many bytes. These bytes may stand for
something else elsewhere; the disassembler counts the instructions, and another number of places is refused.
"""

import pathlib
import subprocess
import sys

DRAFT, STANDARD = bytes([0xFD, 0xCF, 0x01]), bytes([0xFD, 0x87, 0x02])  # f64x2.relaxed_madd


def main(objdump, module, output):
    code = pathlib.Path(module).read_bytes()
    listing = subprocess.run([objdump, "-d", module], check=True, stdout=subprocess.PIPE, text=True).stdout
    instructions = sum(line.endswith("f64x2.fma") for line in listing.splitlines())
    places = code.count(DRAFT)
    if instructions == 0 or places != instructions:
        sys.exit(f"relaxed.py: {module} has {instructions} multiply-adds of the draft, and their code at {places} "
                 "places; made for LLVM 14 (Debian 12)")
    pathlib.Path(output).write_bytes(code.replace(DRAFT, STANDARD))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
