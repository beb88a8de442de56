#!/usr/bin/env python3
"""What `stylobate check` estimates of studies, against their runs, as the table of docs/check.md.

    scripts/check_estimates.py                  # all of the table: minutes
    scripts/check_estimates.py doric_column     # some studies of studies/inputs

Of each study `check` is run, and then `run`: processor time, the most resident memory, and the size of the results
file. Times are those of the processor, of all threads together, so that other programs on the machine matter little.
The program is build/release/studies/stylobate, or that of the environment variable STYLOBATE.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("STYLOBATE", str(ROOT / "build/release/studies/stylobate"))
STUDIES = [  # a study of studies/inputs, and settings
    ("doric_column", []),
    ("full_scale_colonnade_two", ["study.realizations=16"]),
    ("small_scale_column", []),
    ("small_scale_column", ["output.realizations=\"none\"", "study.realizations=32"]),
    ("rigid_column", ["study.realizations=128"]),
    ("synthetic_earthquake", ["study.realizations=128"]),
    ("fragility_column", ["study.realizations=18"]),
    ("sensitivity_column", ["sensitivity.samples=1000"]),
    ("twins_column", ["study.realizations=16"]),
    ("mechanisms", []),
    ("mechanisms", ["study.realizations=1200", "output.most_mb=400"]),
    ("small_scale_column_adaptive", []),
    ("rare_collapse", []),
]


def number(value):
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def run(words):
    """Standard output, processor time [s] and resident memory [bytes] of the program."""
    process = subprocess.Popen([PROGRAM, *words], stdout=subprocess.PIPE)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"stylobate {' '.join(words)} failed")
    return json.loads(text), usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss


def row(name, settings, folder):
    study = str(ROOT / "studies/inputs" / (name + ".toml"))
    words = [word for setting in settings for word in ("--set", setting)] + ["--quiet", "--json"]
    check, _, _ = run(["check", study, "--pilot", "0", *words])
    results = pathlib.Path(folder) / "results.h5"
    results.unlink(missing_ok=True)
    ran, processor_s, memory = run(["run", study, "-o", str(results), *words])
    time, threads = check["time"], check["threads"]
    low, high = threads * time["range_s"]["low"], threads * time["range_s"]["high"]
    estimate = (f"at most {number(high)}" if time["at_most"] else
                f"{number(time['processor_seconds'])} ({number(low)} to {number(high)})")
    most = "at most " if check["realizations_at_most"] else ""
    cells = [f"`{name}`" + "".join(f", {setting}" for setting in settings), str(ran["realizations"]),
             str(check["trial"]["realizations"]), estimate, number(processor_s),
             most + number(check["memory_bytes"] / 1e6), number(memory / 1e6),
             most + f"{check['file_bytes'] / 1e6:.3g}", f"{results.stat().st_size / 1e6:.3g}"]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    wanted = sys.argv[1:]
    print("| study | realizations run | of the trial | processor time [s]: estimated (range) | real "
          "| memory [MB]: estimated | real | file [MB]: estimated | real |")
    print("|---|---:|---:|---|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for name, settings in STUDIES if not wanted else [(name, []) for name in wanted]:
            row(name, settings, folder)


main()
