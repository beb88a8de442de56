"""Machines that lack something: memory, descriptors, streams, a folder, a steady clock, decimal points."""

import resource
import subprocess

from cases import STUDY, Case, look, undisturbed


def limited(which, value):
    return lambda: resource.setrlimit(which, (value, value))


def campaign(lab, library, random, thorough, tell):
    wanted, _ = undisturbed(lab)
    rows = []

    def case(name, runs):
        """@param runs (what, keyword arguments of `Laboratory.call`)"""
        of = Case(name)
        for what, how in runs:
            lab.remove("machine.h5")
            more = how.pop("more", [])
            ended = lab.call(lab.words(STUDY, "machine.h5", more), **how)
            look(lab, of, ended, "machine.h5", wanted, what, how.get("stderr") is None)
        rows.append(of.row())
        tell(f"{name}: {of.runs} runs, {len(of.faults)} faults")

    step = 10 if thorough else 60
    megabytes = range(20, 321, step)
    case(
        "`ulimit -v`: little memory",
        [(f"{mb} MB", {"before": limited(resource.RLIMIT_AS, mb << 20), "more": ["--threads", "1"]}) for mb in megabytes],
    )
    case(
        "`ulimit -n`: few files may be open",
        [(f"{n} files", {"before": limited(resource.RLIMIT_NOFILE, n)}) for n in range(3, 17, 1 if thorough else 4)],
    )
    jump = {"LD_PRELOAD": str(library), "STYLOBATE_CLOCK_JUMP_S": str(86400)}
    case("the clock of the day jumps by a day to and fro", [(str(i), {"environment": jump}) for i in range(2)])
    streams = []
    for stream in ("stdout", "stderr"):
        for target in ("/dev/full", "/dev/null"):
            streams.append((f"{stream} to {target}", {stream: open(target, "w", encoding="utf-8")}))
    case("output to a full device, and to none", streams)
    case(
        "no folder for temporary files, no home",
        [("TMPDIR, HOME", {"environment": {"TMPDIR": "/does/not/exist", "HOME": "/does/not/exist"}})],
    )
    known = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split()
    commas = [name for name in known if name.startswith(("de_", "fr_", "el_"))]
    if commas:
        case("a language with decimal commas", [(name, {"environment": {"LC_ALL": name}}) for name in commas[:3]])
    else:
        tell("decimal commas: skipped, there is no such locale here")
    return rows
