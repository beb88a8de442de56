"""Stylobate: the probability that an ancient multi-drum column or colonnade collapses under given base shaking.

    import stylobate

    study = stylobate.Study.from_toml("column.toml")
    study.set("study.realizations", 64)
    result = stylobate.run(study, "column.h5")
    result.surface()                    # xarray: probability over frequency [Hz] and PGA [m/s2]

SI units; the unit is part of each name. Results have the bits of the program `stylobate`, for every number of threads.
"""

from ._core import Cause, Error, InputError, Intensity, Progress, Record, Share
from ._diagnosis import Diagnosis, diagnose
from ._replay import Replay
from ._result import Result, ResultGone, TooManyInvalid
from ._run import run
from ._study import Study

__all__ = [
    "Cause",
    "Diagnosis",
    "Error",
    "InputError",
    "Intensity",
    "Progress",
    "Record",
    "Replay",
    "Result",
    "ResultGone",
    "Share",
    "Study",
    "TooManyInvalid",
    "diagnose",
    "run",
]
