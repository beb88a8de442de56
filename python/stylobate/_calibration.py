"""Contact parameters, and other numbers of a study, from measured response."""

import os
from collections.abc import Mapping

from . import _core, _toml
from ._forward import FiledFinding, forwarded
from ._study import Study, study_of, whole_number
from ._values import add_parameters
from ._view import View, interval, options


class Calibration(FiledFinding):
    """Parameters of a study from measured data (docs/calibration.md). Scores are in nats; values have the unit of their
    key."""

    measured = forwarded("measured", "The file that was measured, or its campaign.")
    evidence = forwarded("evidence", '"histories" or "outcomes".')

    @property
    def parameters(self):
        """Those of the best form by key: {"contact.friction": CalibratedParameter, ...}, each with key, start, value,
        lower, upper (95 % interval), range (from, to), bounded_below, bounded_above, determined, effective, note.

        determined: a value of the specimen. effective: a value of this model with its contact form. Neither: the study's
        value was kept, and there is no interval.
        """
        return {parameter.key: parameter for parameter in self._core.best.parameters}

    best = forwarded("best",
                     "The contact form that predicts best, a CalibratedForm: form, parameters, score, start_score, runs "
                     "(run, motion_id, units, start, calibrated), held_out (None, or nats, lower, upper: the gain on "
                     "motions left out).")
    forms = forwarded("forms", "A CalibratedForm for each contact form, in the order asked for.")
    notes = forwarded("notes", "What could not be used or judged: texts.")

    @property
    def calibrated_study(self):
        """The study with the calibrated values of the best form (a Study)."""
        return Study(_core.Study.from_text(self._core.calibrated_study))

    parameter_sets = forwarded("parameter_sets", "How many sets of parameters were tried.")
    restored_sets = forwarded("restored_sets",
                              "How many of them come from the cache of a calibration that was stopped.")
    seconds = forwarded("seconds", "Duration [s].")

    def _view(self):
        gain = self.best.held_out
        shown = View(f"{len(self.parameters)} parameters by {self.evidence}, contact form {self.best.form}"
                     + (f": {interval(gain.nats, gain.lower, gain.upper)} nats on motions that were left out" if gain
                        else ""))
        add_parameters(shown, list(self.parameters.values()))
        if len(self.forms) > 1:
            shown.table(("contact form", "gain over the start study, all runs [nat]"),
                        ((form.form, form.score - form.start_score) for form in self.forms))
        for note in self.notes:
            shown.note(note)
        return shown.more("The text of the program", self.text())

    def __repr__(self):
        return f"<Calibration: {len(self.parameters)} parameters by {self.evidence}, contact form {self.best.form}>"


def calibrate(campaign, study=None, *, forms=(), fit=None, hold=(), outcomes=False, held_out=True, threads=0,
              simd="auto", cache=None, progress=None):
    """Fits contact parameters to measured data: a campaign (an HDF5 file, or a folder of tables) or a table of outcomes
    (.csv); io/FORMAT.md has the layouts.

    study     to begin from, a Study, a dictionary of tables or a path; the structure is the specimen's. None: the
              specimen, its nominal friction, a bed of 2e9 N/m3. A table of outcomes needs it
    forms     contact forms, such as ["area", "points"], or "all"; none: the study's
    fit       more numbers of the study file, {"contact.friction": (0.3, 0.9)} with the range to be searched (None: a
              fifth to five times the study's value), or a list of "KEY" or "KEY=FROM:TO"
    hold      keys of the contact that keep the study's value
    outcomes  use outcomes (fell or stood) even where there are histories
    held_out  predict each motion by parameters fitted to the others
    threads, simd   as of `run`; the result does not depend on them
    cache     file that keeps the parameter sets that are done, so that a stopped calibration goes on, here or by the
              program (NAME_sets.bin); it is removed when the calibration is complete. None: they are not kept
    progress  called with a line of text, up to ten times a second; returns False to stop

    Returns a Calibration; None if `progress` stopped it. Ctrl-C raises KeyboardInterrupt within a second and keeps, in
    `cache`, every portion of parameter sets that is done.

    InputError: as the program, exit status 2.
    """
    start = None if study is None else study_of(study)._core
    asked = options(_core.CalibrationOptions(), study=start, forms=_words(forms, "forms"), fit=_fitted(fit),
                    hold=_words(hold, "hold"), outcomes=bool(outcomes), held_out=bool(held_out),
                    threads=whole_number(threads, "threads"), simd=simd, cache=os.fspath(cache) if cache else None)
    found = _core.calibrate(os.fspath(campaign), asked, progress)
    return None if found is None else Calibration(found)


def _words(given, name):
    """A list of texts. `name` is for the message."""
    words = [given] if isinstance(given, str) else list(given) if hasattr(given, "__iter__") else [given]
    if not all(isinstance(word, str) for word in words):
        raise _core.InputError(f"{name} = {given!r} is no list of texts")
    return words


def _fitted(fit):
    """As the library takes them: "KEY" or "KEY=FROM:TO"."""
    if fit is None:
        return []
    if not isinstance(fit, Mapping):
        return _words(fit, "fit")
    words = []
    for key, limits in fit.items():
        if limits is None:
            words.append(key)
            continue
        try:
            low, high = limits
        except (TypeError, ValueError):
            raise _core.InputError(f"fit: {key!r} = {limits!r} is no range; give (FROM, TO), or None for a fifth to five "
                                   "times the study's value") from None
        words.append(f"{key}={_toml.value(low, key)}:{_toml.value(high, key)}")
    return _words(words, "fit")
