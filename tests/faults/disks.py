"""Disks that are full, broken, read-only or changed under a run: one message, an exit status that is not 0, nothing
lost of what was whole, and the run goes on once there is room."""

import errno
import os
import pathlib
import resource
import signal
import subprocess
import time

from cases import STUDY, Case, look, undisturbed
from laboratory import digest, state_of


def failing_calls(lab, library, wanted, most, tell):
    """Every call on files fails in its turn: once, or from then on."""
    rows = []
    sorts = [
        ("write", errno.ENOSPC, True),
        ("write", errno.EDQUOT, True),
        ("write", errno.EIO, False),
        ("fsync", errno.EIO, False),
        ("fsync", errno.ENOSPC, True),
        ("truncate", errno.EIO, False),
        ("rename", errno.ENOSPC, False),
        ("open", errno.EACCES, False),
        ("open", errno.EMFILE, True),
        ("lock", errno.ENOLCK, False),
    ]
    for call, error, stays in sorts:
        case = Case(f"`{call}` fails {'from then on' if stays else 'once'} with {errno.errorcode[error]}")
        count = lab.path("calls")
        environment = {"LD_PRELOAD": str(library), "STYLOBATE_FAIL_CALL": call, "STYLOBATE_FAIL_COUNT": str(count)}
        lab.remove("disk.h5")
        lab.call(lab.words(STUDY, "disk.h5", ["--threads", "1"]), environment)
        calls = int(count.read_text())
        step = max(1, -(-calls // most))
        for at in range(1, calls + 1, step):
            lab.remove("disk.h5")
            ended = lab.call(
                lab.words(STUDY, "disk.h5", ["--threads", "1"]),
                {
                    **environment,
                    "STYLOBATE_FAIL_AT": str(at),
                    "STYLOBATE_FAIL_ERRNO": str(error),
                    "STYLOBATE_FAIL_STAYS": "1" if stays else "0",
                },
            )
            look(lab, case, ended, "disk.h5", wanted, f"call {at} of {calls}")
        lab.remove("calls")
        row = case.row()
        row["calls"] = calls
        rows.append(row)
        tell(f"{case.name}: {case.runs} of {calls} calls, {len(case.faults)} faults")
    return rows


def full_disk(lab, wanted, sizes, tell):
    """A small file system of its own that fills up, and then gets larger. @returns None where it cannot be mounted"""
    case = Case("a file system of a few pages fills up, and is made larger")
    disk = lab.path("disk")
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=4k", "stylobate", str(disk)]
    if subprocess.run(mount, capture_output=True).returncode != 0:
        disk.rmdir()
        return None
    try:
        for kib in sizes:
            lab.remove("disk/disk.h5")
            subprocess.run(["mount", "-o", f"remount,size={kib}k", str(disk)], check=True)
            ended = lab.call(lab.words(STUDY, "disk/disk.h5"))
            subprocess.run(["mount", "-o", "remount,size=64m", str(disk)], check=True)
            inside = type(lab).__new__(type(lab))
            inside.__dict__ = {**lab.__dict__, "folder": disk}
            look(inside, case, ended, "disk.h5", wanted, f"{kib} KiB")
    finally:
        subprocess.run(["umount", str(disk)], check=True)
        disk.rmdir()
    tell(f"{case.name}: {case.runs} sizes, {len(case.faults)} faults")
    return case.row()


def size_limits(lab, wanted, sizes, tell):
    """`ulimit -f`: the file may not grow beyond a size."""
    case = Case("`ulimit -f`: no file may be larger")
    for kib in sizes:
        lab.remove("disk.h5")

        def limit(bytes_=kib * 1024):
            resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_, bytes_))

        ended = lab.call(lab.words(STUDY, "disk.h5"), before=limit)
        look(lab, case, ended, "disk.h5", wanted, f"{kib} KiB")
    tell(f"{case.name}: {case.runs} sizes, {len(case.faults)} faults")
    return case.row()


def held(lab, results, after_s):
    """Starts the run and holds it still some time after its results file has appeared, so that it cannot end between a
    look at that file and what is done to it. @returns the process, which goes on by SIGCONT"""
    process = lab.start(lab.words(STUDY, results.name, ["--threads", "1", "--simd", "scalar"]))
    while not results.exists() and process.poll() is None:
        time.sleep(0.001)
    time.sleep(after_s)
    process.send_signal(signal.SIGSTOP)
    while state_of(process.pid) not in "TZ":
        time.sleep(0.001)
    return process


def under_the_run(lab, wanted, random, times, tell):
    """The file is removed, replaced by another one, or cut while the run writes into it."""
    rows = []

    def replace(path):
        other = path.with_name("other")
        other.write_bytes(b"something else\n" * 100)
        other.rename(path)

    def cut(path):
        os.truncate(path, path.stat().st_size // 2)

    foreign = b"something else\n" * 100
    for name, disturb in [("removed", pathlib.Path.unlink), ("replaced by another file", replace), ("cut in half", cut)]:
        case = Case(f"the results file is {name} under the run")
        for _ in range(times):
            lab.remove("disk.h5")
            path = lab.path("disk.h5")
            process = held(lab, path, random.uniform(0, 0.5))
            if path.exists() and digest(path) != wanted:  # what befalls whole results is nothing that a run can notice
                disturb(path)
            process.send_signal(signal.SIGCONT)
            out, err = process.communicate()
            case.runs += 1
            if process.returncode == 0:
                case.unnoticed += 1
                if digest(path) != wanted:
                    case.faults.append("exit status 0, and the bytes differ")
            else:
                case.refused += 1
                if process.returncode < 0 or sum(l.startswith("stylobate:") for l in err.splitlines()) != 1:
                    case.faults.append(f"status {process.returncode}: {err.strip()[:300]}")
                rescued = path.with_name("disk.h5.rescued")
                if name.startswith("replaced") and (path.read_bytes() != foreign or digest(rescued) != wanted):
                    case.faults.append("the other file is not as it was, or the results are not beside it")
                rescued.unlink(missing_ok=True)
            if name.startswith("cut") and process.returncode != 0:
                again = lab.call(lab.words(STUDY, "disk.h5"))
                if (again.status != 0 or digest(path) != wanted) and not (again.status == 2 and "disk.h5" in again.err):
                    case.faults.append(f"the run that goes on: {again}")
            lab.remove("disk.h5")
        rows.append(case.row())
        tell(f"{case.name}: {case.runs} runs, {len(case.faults)} faults")
    return rows


def two_runs(lab, wanted, tell):
    """Two runs on one file: one of them says so, the other is undisturbed."""
    case = Case("a second run on the same file")
    path = lab.path("disk.h5")
    while True:
        lab.remove("disk.h5")
        first = held(lab, path, 0)
        if digest(path) != wanted:
            break
        first.send_signal(signal.SIGCONT)  # it was faster than this test
        first.communicate()
    second = lab.call(lab.words(STUDY, "disk.h5"), patience_s=30)
    first.send_signal(signal.SIGCONT)
    first.communicate()
    case.runs = 1
    case.refused = int(second.status == 2)
    if second.status != 2 or first.returncode != 0 or digest(path) != wanted:
        case.faults.append(f"the first ends with {first.returncode}, the second with {second}")
    lab.remove("disk.h5")
    tell(f"{case.name}: {len(case.faults)} faults")
    return case.row()


def campaign(lab, library, random, thorough, tell):
    wanted, size = undisturbed(lab)
    size //= 1024
    sizes = [size * i // (40 if thorough else 5) for i in range(1, 40 if thorough else 5)]
    rows = failing_calls(lab, library, wanted, 100 if thorough else 4, tell)
    full = full_disk(lab, wanted, sizes, tell)
    if full is None:
        tell("a full disk: skipped, no file system can be mounted here")
    else:
        rows.append(full)
    rows.append(size_limits(lab, wanted, sizes, tell))
    rows += under_the_run(lab, wanted, random, 20 if thorough else 2, tell)
    rows.append(two_runs(lab, wanted, tell))
    return rows
