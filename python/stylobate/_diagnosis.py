"""Errors of the simulation against measured data, and their cause."""

import os

from . import _core
from ._forward import FiledFinding, forwarded
from ._study import Study, study_of, whole_number
from ._view import View, chart, line, options


class Diagnosis(FiledFinding):
    """Where the simulation disagrees with a measured campaign, and why."""

    verdict = forwarded("verdict",
                        '"none": simulation and measurement agree; "named": a mechanism, or a set, explains the '
                        'difference; "unexplained".')
    verdict_text = forwarded("verdict_text", "The verdict in plain words.")
    causes = forwarded("causes",
                       "The named mechanisms, the most probable one first: Cause with mechanism, place, parameter, unit, "
                       "size, lower, upper (95 % interval), probability; None: not known.")

    @property
    def extended_study(self):
        """The study with the cause in it (a Study); None: there is none."""
        text = self._core.extended_study
        return Study(_core.Study.from_text(text)) if text else None

    def _view(self):
        causes = self.causes
        shown = View(self.verdict_text)
        shown.table(("mechanism", "place", "parameter", "size", "95 % interval", "probability"),
                    ((c.mechanism, c.place, c.parameter, c.size if c.size is None else f"{c.size:.4g} {c.unit}",
                      None if c.lower is None or c.upper is None else (c.lower, c.upper), c.probability)
                     for c in causes))
        judged = [c for c in causes if c.probability is not None]
        if judged:
            shown.figure(chart("Probabilities of the causes", "", "probability",
                               [line(range(len(judged)), [c.probability for c in judged], kind="bars")],
                               x_ticks=[f"{c.mechanism}, {c.place}" for c in judged]))
        return shown.more("The text of the program", self.text())

    def __repr__(self):
        return f"<Diagnosis: {self.verdict}, {len(self.causes)} causes>"


def diagnose(campaign, study=None, *, nulls=192, seed=1, threads=0, simd="auto", cache=None, progress=None):
    """Diagnoses a measured campaign: an HDF5 file, or a folder of tables (io/FORMAT.md).

    study     contacts to begin with; None: a bed of stone
    nulls     healthy campaigns that are simulated; 0: none, and only direct tests name a cause
    seed      of what is drawn in them
    cache     file that keeps the simulated campaigns, so that a stopped diagnosis goes on; None: they are not kept
    progress  called with a line of text for each stage; returns False to stop

    Returns a Diagnosis; None if `progress` stopped it. Ctrl-C raises KeyboardInterrupt after the campaign that is being
    simulated.
    """
    start = None if study is None else study_of(study)._core
    nulls, seed, threads = (whole_number(value, name) for value, name in
                            ((nulls, "nulls"), (seed, "seed"), (threads, "threads")))
    asked = options(_core.DiagnosisOptions(), study=start, nulls=nulls, seed=seed, threads=threads, simd=simd,
                    cache=os.fspath(cache) if cache else None)
    found = _core.diagnose(os.fspath(campaign), asked, progress)
    return None if found is None else Diagnosis(found)
