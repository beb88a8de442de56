"""Checks of a study before its run."""

import json
import os
import warnings

from . import _core
from ._study import experiment_of, number, whole_number


class Check:
    """The realizations, costs and weak spots of a study (docs/check.md); `Study.check` makes one."""

    def __init__(self, core):
        self._core = core

    @property
    def kind(self):
        """Kind of the study: "surface"."""
        return self._core.kind

    @property
    def form(self):
        """Contact form: "area"."""
        return self._core.form

    @property
    def realizations(self):
        """Realizations of the whole study; with `at_most` the most that it can take."""
        return self._core.realizations

    @property
    def at_most(self):
        """Whether the study chooses its realizations (an adaptive surface, rare events): then realizations, memory and
        file are upper bounds."""
        return self._core.at_most

    @property
    def cells(self):
        """Cells of a surface, motions times intensities of a fragility study; else 1."""
        return self._core.cells

    @property
    def blocks(self):
        """Blocks of one structure, without the ground."""
        return self._core.blocks

    @property
    def free_blocks(self):
        """Those of the blocks that can move."""
        return self._core.free_blocks

    @property
    def step_s(self):
        """Time step [s], from and to, over a sample of the realizations."""
        return self._core.step_s

    @property
    def longest_steps(self):
        """Steps of a realization that runs to the time limit, from and to."""
        return self._core.longest_steps

    @property
    def trial(self):
        """The fair sample that was run, a Trial: realizations, valid, collapsed, whole (all of the study), seconds; None:
        not asked for."""
        return self._core.trial

    @property
    def time(self):
        """Time of the run, a RunTime: seconds, range_s (from, to) in which it lies, at_most, processor_s (all threads),
        block_steps, steps (from, to) of a realization of the trial. None: there was no trial, or its first realizations
        did not end in time."""
        return self._core.time

    @property
    def memory_bytes(self):
        """Resident memory of this process if it ran the study: the most that it has held so far, and what the run
        adds."""
        return self._core.memory_bytes

    @property
    def file_bytes(self):
        """Size of the complete results file; while it is finished it is there twice."""
        return self._core.file_bytes

    @property
    def chosen(self):
        """The choices of `run.accuracy`: a ChosenKey for each key (key, value, reason)."""
        return self._core.chosen

    @property
    def weak_spots(self):
        """Choices that make the answer imprecise or dependent on the numerics: a WeakSpot for each (name, text with
        figures and source, remedy)."""
        return self._core.weak_spots

    @property
    def pilot(self):
        """A part of the study run twice, a Pilot: realizations, collapsed, collapsed_finer, difference of the collapse
        probability, its standard_error, accuracy_missed; None: not asked for, or not possible."""
        return self._core.pilot

    @property
    def warnings(self):
        """Implausible values of the study: texts."""
        return self._core.warnings

    def text(self):
        """What the program prints."""
        return self._core.text()

    def to_dict(self):
        """All of it, as `stylobate check --json`."""
        return json.loads(self._core.json())

    def draw(self, path):
        """Draws the structure to scale with its dimensions: .png, .svg or .pdf, by gnuplot. A file that is there is
        replaced."""
        self._core.draw(os.fspath(path))

    def __repr__(self):
        time = "" if self.time is None else f", {self.time.range_s[0]:.2g} to {self.time.range_s[1]:.2g} s"
        return (f"<Check: {self.kind}, {'at most ' if self.at_most else ''}{self.realizations} realizations{time}, "
                f"{len(self.weak_spots)} weak spots>")


def check(study, pilot, trial_seconds, law_seconds, threads, simd, progress, record):
    """`Study.check`."""
    pilot, threads = whole_number(pilot, "pilot"), whole_number(threads, "threads")
    found = _core.check(experiment_of(study, record), pilot, number(trial_seconds, "trial_seconds"),
                        number(law_seconds, "law_seconds"), threads, simd,
                        progress)
    if found is None:
        return None
    for warning in found.warnings:
        warnings.warn(warning, stacklevel=3)
    return Check(found)
