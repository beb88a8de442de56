"""Only the files that are chosen at run time are compiled for more than the oldest processor: check_instruction_sets.py BUILD.

The linker takes an inline function from any of the files that have it. One of a file for AVX-512 must not be taken for
the others: such a file may define no weak function.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys

build = pathlib.Path(sys.argv[1])
failures = []
chosen = 0
for entry in json.loads((build / "compile_commands.json").read_text()):
    words = entry.get("arguments") or shlex.split(entry["command"])
    flags = [word for word in words if re.match(r"-m(?!64$)", word)]
    if not flags:
        continue
    file = pathlib.Path(entry["file"])
    if not re.search(r"kernels/instances/step_\w+\.cpp$", str(file)):
        failures.append(f"{file} is compiled with {' '.join(flags)}")
        continue
    chosen += 1
    made = pathlib.Path(entry["directory"]) / words[words.index("-o") + 1]
    if not made.exists():
        print(f"skipped: {made} has not been built")
        sys.exit(77)
    symbols = subprocess.run(["nm", "--demangle", "--defined-only", made], check=True, capture_output=True, text=True)
    for line in symbols.stdout.splitlines():
        kind, name = line[17:18], line[19:]
        if kind in "WVu" and not name.startswith("DW.ref."):
            failures.append(f"{file} defines {name}, which another file may be given")
if chosen < 2:
    failures.append(f"only {chosen} files are for some instruction set")
print("\n".join(failures) or f"{chosen} files are for some instruction set, and keep it to themselves")
sys.exit(1 if failures else 0)
