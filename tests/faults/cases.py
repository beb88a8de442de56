"""Disturbed runs of one sort, and what is to hold after each of them."""

from laboratory import digest

STUDY = "surface, rows"


class Case:
    """Many disturbed runs of one sort, and what was seen."""

    def __init__(self, name):
        self.name, self.runs, self.refused, self.unnoticed, self.faults = name, 0, 0, 0, []

    def row(self):
        return {
            "case": self.name,
            "runs": self.runs,
            "refused": self.refused,
            "whole all the same": self.unnoticed,
            "faults": self.faults,
        }


def look(lab, case, ended, results, wanted, what, heard=True):
    """What is to hold after a disturbed run, and after the one that goes on in peace.
    @param heard whether its messages were kept"""
    case.runs += 1
    path = lab.path(results)
    if ended.status is None:
        case.faults.append(f"{what}: the run hangs")
    elif ended.status == 0:
        # nothing was to be written any more, or the call did not matter: then all is there
        case.unnoticed += 1
        if digest(path) != wanted:
            case.faults.append(f"{what}: exit status 0, and the bytes differ")
    else:
        case.refused += 1
        if ended.status < 0:
            case.faults.append(f"{what}: ended by signal {-ended.status}")
        # (before the program begins the loader speaks)
        begins = ("stylobate:", f"{lab.program}: error while loading shared libraries")
        messages = [line for line in ended.err.splitlines() if line.startswith(begins)]
        if heard and len(messages) != 1:
            case.faults.append(f"{what}: {len(messages)} messages: {ended.err.strip()[:300]!r}")
    if path.exists():
        seen = lab.call(["info", results])
        if seen.status != 0:
            case.faults.append(f"{what}: afterwards `info` ends with {seen}")
    again = lab.call(lab.words(STUDY, results))
    if again.status != 0:
        case.faults.append(f"{what}: the run that goes on ends with {again}")
    elif digest(path) != wanted:
        case.faults.append(f"{what}: the run that goes on has other bytes")
    left = [p.name for p in lab.folder.iterdir() if p.name.startswith(path.name) and p != path]
    if left:
        case.faults.append(f"{what}: {left} stay behind")
        for name in left:
            lab.remove(name)


def undisturbed(lab):
    """The bytes of a run that is left alone, and its size."""
    lab.remove("whole.h5")
    first = lab.call(lab.words(STUDY, "whole.h5"))
    if first.status != 0:
        raise RuntimeError(f"{STUDY} does not run: {first}")
    return digest(lab.path("whole.h5")), lab.path("whole.h5").stat().st_size
