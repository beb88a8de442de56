"""Running a study."""

import os
import warnings

from . import _core
from ._result import Result, TooManyInvalid
from ._study import experiment_of, study_of, whole_number


def run(study, output=None, *, threads=0, simd="auto", progress=None, record=None):
    """Runs all realizations of a study and returns their Result.

    study     a Study, a dictionary of tables, or the path of a study file
    output    results file, with the same bytes as of `stylobate run`. One of the same study that is not complete is
              continued, one that is complete is read. None: the result stays in memory
    threads   0: as many as the process may use. The result does not depend on it
    simd      "auto", or an instruction set: "scalar", "avx2", "avx512". The result does not depend on it
    progress  called up to ten times a second with a Progress; if it returns False the run stops, and the Result is not
              complete
    record    a Record that shakes the base instead of the study's [excitation]

    Other Python threads go on meanwhile. Ctrl-C raises KeyboardInterrupt within a second and keeps, in `output`, every
    realization that has ended.

    InputError: as the program, exit status 2; nothing is written. TooManyInvalid: exit status 3; its `result` is
    complete. What the program prints as a warning is given to `warnings.warn`.
    """
    threads = whole_number(threads, "threads")
    experiment = experiment_of(study_of(study), record)
    for warning in experiment.warnings():
        warnings.warn(warning, stacklevel=2)
    path = None if output is None else os.path.abspath(os.fspath(output))
    ran = _core.run(experiment, None if output is None else os.fspath(output), threads, simd, progress)
    result = Result._of(ran, path)
    if ran.too_many_invalid:
        raise TooManyInvalid(ran.too_many_invalid, result)
    return result
