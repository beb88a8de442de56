"""Checks of a study before its run."""

import os
import warnings

from . import _core
from ._forward import Finding, forwarded
from ._study import experiment_of, number, whole_number
from ._view import View, options, words


class Check(Finding):
    """The realizations, costs and weak spots of a study (docs/check.md); `Study.check` makes one."""

    kind = forwarded("kind", 'Kind of the study: "surface".')
    form = forwarded("form", 'Contact form: "area".')
    realizations = forwarded("realizations",
                             "Realizations of the whole study; with `at_most` the most that it can take.")
    at_most = forwarded("at_most",
                        "Whether the study chooses its realizations (an adaptive surface, rare events): then "
                        "realizations, memory and file are upper bounds.")
    cells = forwarded("cells", "Cells of a surface, motions times intensities of a fragility study; else 1.")
    blocks = forwarded("blocks", "Blocks of one structure, without the ground.")
    free_blocks = forwarded("free_blocks", "Those of the blocks that can move.")
    step_s = forwarded("step_s", "Time step [s], from and to, over a sample of the realizations.")
    longest_steps = forwarded("longest_steps", "Steps of a realization that runs to the time limit, from and to.")
    trial = forwarded("trial",
                      "The fair sample that was run, a Trial: realizations, valid, collapsed, whole (all of the study), "
                      "seconds; None: not asked for.")
    time = forwarded("time",
                     "Time of the run, a RunTime: seconds, range_s (from, to) in which it lies, at_most, processor_s "
                     "(all threads), block_steps, steps (from, to) of a realization of the trial. None: there was no "
                     "trial, or its first realizations did not end in time.")
    memory_bytes = forwarded("memory_bytes",
                             "Resident memory of this process if it ran the study: the most that it has held so far, and what "
                             "the run adds.")
    file_bytes = forwarded("file_bytes", "Size of the complete results file; while it is finished it is there twice.")
    chosen = forwarded("chosen", "The choices of `run.accuracy`: a ChosenKey for each key (key, value, reason).")
    weak_spots = forwarded("weak_spots",
                           "Choices that make the answer imprecise or dependent on the numerics: a WeakSpot for each (name, "
                           "text with figures and source, remedy).")
    pilot = forwarded("pilot",
                      "A part of the study run twice, a Pilot: realizations, collapsed, collapsed_finer, difference of "
                      "the collapse probability, its standard_error, accuracy_missed; None: not asked for, or not "
                      "possible.")
    warnings = forwarded("warnings", "Implausible values of the study: texts.")

    def draw(self, path):
        """Draws the structure to scale with its dimensions: .png, .svg or .pdf. A file that is there is
        replaced."""
        self._core.draw(os.fspath(path))

    def _view(self):
        most = "at most " if self.at_most else ""
        time = "" if self.time is None else f", {words(self.time.range_s)} s"
        shown = View(f"A study of kind {self.kind}: {most}{self.realizations} realizations of {self.free_blocks} free "
                     f"blocks{time}")
        shown.figure(_core.svg(self._core), caption="The structure, nothing drawn at random")
        shown.facts([("contact form", self.form), ("cells", self.cells), ("time step [s]", self.step_s),
                     ("memory [MB]", self.memory_bytes / 1e6), ("results file [MB]", self.file_bytes / 1e6)])
        shown.table(("weak spot", "why", "remedy"),
                    ((spot.name.replace("_", " "), spot.text, spot.remedy) for spot in self.weak_spots))
        shown.table(("chosen", "value", "why"), ((each.key, each.value, each.reason) for each in self.chosen))
        for warning in self.warnings:
            shown.note(warning)
        return shown.more("The text of the program", self.text())

    def __repr__(self):
        time = "" if self.time is None else f", {self.time.range_s[0]:.2g} to {self.time.range_s[1]:.2g} s"
        return (f"<Check: {self.kind}, {'at most ' if self.at_most else ''}{self.realizations} realizations{time}, "
                f"{len(self.weak_spots)} weak spots>")


def check(study, pilot, trial_seconds, law_seconds, threads, simd, progress, record):
    """`Study.check`."""
    pilot, threads = whole_number(pilot, "pilot"), whole_number(threads, "threads")
    found = _core.check(experiment_of(study, record),
                        options(_core.CheckOptions(), pilot=pilot, threads=threads, simd=simd,
                                trial_seconds=number(trial_seconds, "trial_seconds"),
                                law_seconds=number(law_seconds, "law_seconds")), progress)
    if found is None:
        return None
    for warning in found.warnings:
        warnings.warn(warning, stacklevel=3)
    return Check(found)
