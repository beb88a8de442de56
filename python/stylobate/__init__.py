"""Stylobate: the probability that an ancient multi-drum column or colonnade collapses under given base shaking.

    import stylobate

    study = stylobate.Study.from_toml("column.toml")
    study.set("study.realizations", 64)
    result = stylobate.run(study, "column.h5")
    result.surface()                    # xarray: probability over frequency [Hz] and PGA [m/s2]

SI units; the unit is part of each name. Results have the bits of the program `stylobate`, for every number of threads.
"""

from ._answer import Answer, Comparison, Page, Past, Risk, compare, past, report, risk
from ._calibration import Calibration, calibrate
from ._check import Check
from ._core import (
    CalibratedForm,
    CalibratedParameter,
    CalibratedRun,
    Cause,
    ChosenKey,
    Error,
    HeldOutGain,
    InputError,
    Intensity,
    Pilot,
    Progress,
    Record,
    RunTime,
    Share,
    Trial,
    WeakSpot,
)
from ._diagnosis import Diagnosis, diagnose
from ._replay import Replay
from ._result import Result, ResultGone, TooManyInvalid
from ._run import run
from ._study import Study
from ._table import Table

__all__ = [
    "Answer",
    "CalibratedForm",
    "CalibratedParameter",
    "CalibratedRun",
    "Calibration",
    "Cause",
    "Check",
    "ChosenKey",
    "Comparison",
    "Diagnosis",
    "Error",
    "HeldOutGain",
    "InputError",
    "Intensity",
    "Page",
    "Past",
    "Pilot",
    "Progress",
    "Record",
    "Replay",
    "Result",
    "ResultGone",
    "Risk",
    "RunTime",
    "Share",
    "Study",
    "Table",
    "TooManyInvalid",
    "Trial",
    "WeakSpot",
    "calibrate",
    "compare",
    "diagnose",
    "past",
    "report",
    "risk",
    "run",
]
