"""SIGKILL at random moments, over all kinds of studies: the file is readable after every kill, and the run that goes on
with other threads and instruction sets has the bytes of one that was left alone."""

from laboratory import STUDIES, digest


def kill_study(lab, study, kills, random):
    """Runs a study again and again, killed several times on its way, until there were so many kills."""
    whole, broken = "whole.h5", "broken.h5"
    lab.remove(whole, broken)
    first = lab.call(lab.words(study, whole, ["--threads", "1"]))
    if first.status != 0:
        raise RuntimeError(f"{study} does not run: {first}")
    wanted = digest(lab.path(whole))
    row = {"study": study, "kills": 0, "runs": 0, "before the file": 0, "faults": []}
    while row["kills"] < kills:
        lab.remove(broken)
        row["runs"] += 1
        left = first.seconds
        while True:
            threads, simd = str(random.choice([1, 2, 3])), random.choice(lab.simd)
            words = lab.words(study, broken, ["--threads", threads, "--simd", simd])
            if row["kills"] == kills or not lab.killed(words, random.uniform(0, left)):
                break
            row["kills"] += 1
            if not lab.path(broken).exists():
                row["before the file"] += 1
                continue
            seen = lab.call(["info", broken])
            if seen.status != 0:
                row["faults"].append(f"after a kill `info` ends with {seen}")
        ended = lab.call(lab.words(study, broken))
        if ended.status != 0:
            row["faults"].append(f"the run that goes on ends with {ended}")
        elif digest(lab.path(broken)) != wanted:
            row["faults"].append("the bytes differ from those of a run that was left alone")
    return row


def campaign(lab, kills, random, tell):
    rows = []
    for i, study in enumerate(STUDIES):
        share = kills // len(STUDIES) + (i < kills % len(STUDIES))
        rows.append(kill_study(lab, study, share, random))
        tell(f"{study}: {rows[-1]['kills']} kills, {len(rows[-1]['faults'])} faults")
    return rows
