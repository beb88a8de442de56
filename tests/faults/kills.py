"""SIGKILL at random moments, over all kinds of studies, of one process or of some of four ranks: the file is readable
after every kill, and the run that goes on with other threads and instruction sets has the bytes of one that was left
alone."""

from laboratory import STUDIES, WITHOUT_RANKS, digest

RANKS = 4


def kill_study(lab, study, ranks, kills, random):
    """Runs a study again and again, killed several times on its way, until there were so many kills.
    @param ranks that run it; 1: a process without MPI"""
    whole, broken = "whole.h5", "broken.h5"
    lab.remove(whole, broken)
    first = lab.call(lab.words(study, whole, ["--threads", "1"]))
    if first.status != 0:
        raise RuntimeError(f"{study} does not run: {first}")
    wanted = digest(lab.path(whole))
    name = study if ranks == 1 else f"{study}, {ranks} ranks"
    row = {"study": name, "kills": 0, "runs": 0, "before the file": 0, "faults": []}
    while row["kills"] < kills:
        lab.remove(broken)
        row["runs"] += 1
        left = first.seconds + (1 if ranks > 1 else 0) # ranks take that long to meet
        while True:
            threads, simd = str(random.choice([1, 2, 3])), random.choice(lab.simd)
            words = lab.words(study, broken, ["--threads", threads, "--simd", simd])
            if row["kills"] == kills:
                break
            after_s = random.uniform(0, left)
            if not (lab.killed(words, after_s) if ranks == 1 else lab.killed_ranks(ranks, words, after_s, random)):
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
    ways = [(study, 1) for study in STUDIES]
    if lab.has_ranks():
        ways += [(study, RANKS) for study in STUDIES if study not in WITHOUT_RANKS]
    rows = []
    for i, (study, ranks) in enumerate(ways):
        share = kills // len(ways) + (i < kills % len(ways))
        if share == 0:
            continue
        rows.append(kill_study(lab, study, ranks, share, random))
        tell(f"{rows[-1]['study']}: {rows[-1]['kills']} kills, {len(rows[-1]['faults'])} faults")
    return rows
