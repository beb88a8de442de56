import os
from collections.abc import Callable, Iterable, Iterator, KeysView, Mapping
from typing import Any, Final

import numpy as np
import numpy.typing as npt
import pandas
import xarray
from matplotlib.animation import FuncAnimation
from matplotlib.axes import Axes

_Path = str | os.PathLike[str]
_Numbers = npt.NDArray[np.float64]

class Error(Exception): ...
class InputError(Error, ValueError): ...
class ResultGone(Error, FileNotFoundError): ...

class TooManyInvalid(Error):
    result: Result
    def __init__(self, message: str, result: Result) -> None: ...

class Study:
    def __init__(self, tables: Mapping[str, Mapping[str, Any]]) -> None: ...
    @classmethod
    def from_toml(cls, path: _Path, settings: Mapping[str, Any] | None = None) -> Study: ...
    def set(self, key: str, value: Any) -> None: ...
    def describe(self) -> str: ...
    def check(
        self,
        *,
        pilot: int = 0,
        trial_seconds: float = 2,
        law_seconds: float = 20,
        threads: int = 0,
        simd: str = "auto",
        progress: Callable[[str], object] | None = None,
        record: Record | None = None,
    ) -> Check | None: ...
    text: Final[str]
    kind: Final[str]
    seed: Final[int]
    realizations: Final[int]

class Share:
    trials: Final[int]
    count: Final[int]
    probability: Final[float]
    lower: Final[float]
    upper: Final[float]

class Progress:
    done: Final[int]
    total: Final[int]
    collapsed: Final[int]
    invalid: Final[int]
    seconds: Final[float]
    realizations_per_second: Final[float]
    probability: Final[float]
    lower: Final[float]
    upper: Final[float]

class Replay:
    dimensions: int
    time_s: _Numbers
    x_m: _Numbers
    y_m: _Numbers
    theta_rad: _Numbers
    base_x_m: _Numbers
    rest_x_m: _Numbers
    rest_y_m: _Numbers
    half_width_m: _Numbers
    half_height_m: _Numbers
    z_m: _Numbers
    q_w: _Numbers
    q_x: _Numbers
    q_y: _Numbers
    q_z: _Numbers
    base_y_m: _Numbers
    base_z_m: _Numbers
    rest_z_m: _Numbers
    bottom_half_x_m: _Numbers
    bottom_half_z_m: _Numbers
    top_half_x_m: _Numbers
    top_half_z_m: _Numbers
    round: _Numbers
    blocks: list[str]
    fixed: list[bool]
    epistyle: list[bool]
    outcome: dict[str, Any]
    def corners(self) -> _Numbers: ...
    def rotations(self) -> _Numbers: ...
    def to_xarray(self) -> xarray.Dataset: ...

class Result:
    def __init__(self, path: _Path) -> None: ...
    path: Final[str | None]
    study: Final[Study]
    kind: Final[str]
    complete: Final[bool]
    count: Final[int]
    invalid: Final[int]
    warnings: Final[list[str]]
    code_version: Final[str]
    dimensions: Final[int]
    blocks: Final[list[str]]
    def share(self, limit_state: str = "collapse") -> Share: ...
    def surface(self, limit_state: str = "collapse") -> xarray.Dataset: ...
    def arrays(self) -> dict[str, npt.NDArray[Any]]: ...
    def realizations(self) -> pandas.DataFrame: ...
    def fragility(self) -> xarray.Dataset: ...
    def tables(self) -> dict[str, Table]: ...
    def replay(self, index: int, settings: Mapping[str, Any] | None = None) -> Replay: ...
    def plot(self, ax: Axes | None = None, limit_state: str = "collapse") -> Axes: ...
    def animate(self, index: int, seconds: float | None = None, fps: float = 25) -> FuncAnimation: ...

class Intensity:
    pga_m_s2: Final[float]
    pgv_m_s: Final[float]
    pgd_m: Final[float]
    arias_m_s: Final[float]
    d5_95_s: Final[float]
    cav_m_s: Final[float]
    predominant_frequency_hz: Final[float]
    mean_frequency_hz: Final[float]

class Record:
    @staticmethod
    def read(file: _Path, component: str | None = None, unit: str | None = None) -> Record: ...
    @staticmethod
    def from_samples(acceleration_m_s2: npt.ArrayLike, dt_s: float, name: str = "samples") -> Record: ...
    acceleration_m_s2: Final[_Numbers]
    dt_s: Final[float]
    duration_s: Final[float]
    file: Final[str]
    format: Final[str]
    component: Final[str]
    title: Final[str]
    def intensity(self) -> Intensity: ...
    def spectral_acceleration_m_s2(self, periods_s: npt.ArrayLike, damping_ratio: float = 0.05) -> _Numbers: ...

class WeakSpot:
    name: Final[str]
    text: Final[str]
    remedy: Final[str]

class ChosenKey:
    key: Final[str]
    value: Final[str]
    reason: Final[str]

class Trial:
    realizations: Final[int]
    valid: Final[int]
    collapsed: Final[int]
    whole: Final[bool]
    seconds: Final[float]

class RunTime:
    seconds: Final[float]
    range_s: Final[tuple[float, float]]
    at_most: Final[bool]
    processor_s: Final[float]
    block_steps: Final[float]
    steps: Final[tuple[float, float]]

class Pilot:
    realizations: Final[int]
    collapsed: Final[int]
    collapsed_finer: Final[int]
    difference: Final[float]
    standard_error: Final[float]
    accuracy_missed: Final[bool]

class Check:
    kind: Final[str]
    form: Final[str]
    realizations: Final[int]
    at_most: Final[bool]
    cells: Final[int]
    blocks: Final[int]
    free_blocks: Final[int]
    step_s: Final[tuple[float, float]]
    longest_steps: Final[tuple[float, float]]
    trial: Final[Trial | None]
    time: Final[RunTime | None]
    memory_bytes: Final[float]
    file_bytes: Final[float]
    chosen: Final[list[ChosenKey]]
    weak_spots: Final[list[WeakSpot]]
    pilot: Final[Pilot | None]
    warnings: Final[list[str]]
    def text(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def draw(self, path: _Path) -> None: ...

class CalibratedParameter:
    key: Final[str]
    start: Final[float]
    value: Final[float]
    lower: Final[float]
    upper: Final[float]
    range: Final[tuple[float, float]]
    bounded_below: Final[bool]
    bounded_above: Final[bool]
    determined: Final[bool]
    effective: Final[bool]
    note: Final[str]

class CalibratedRun:
    run: Final[str]
    motion_id: Final[int]
    units: Final[int]
    start: Final[float]
    calibrated: Final[float]

class HeldOutGain:
    nats: Final[float]
    lower: Final[float]
    upper: Final[float]

class CalibratedForm:
    form: Final[str]
    parameters: Final[list[CalibratedParameter]]
    score: Final[float]
    start_score: Final[float]
    runs: Final[list[CalibratedRun]]
    held_out: Final[HeldOutGain | None]

class Calibration:
    measured: Final[str]
    evidence: Final[str]
    parameters: Final[dict[str, CalibratedParameter]]
    best: Final[CalibratedForm]
    forms: Final[list[CalibratedForm]]
    notes: Final[list[str]]
    calibrated_study: Final[Study]
    parameter_sets: Final[int]
    restored_sets: Final[int]
    seconds: Final[float]
    def text(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def write(self, path: _Path) -> None: ...

class Cause:
    mechanism: Final[str]
    place: Final[str]
    parameter: Final[str]
    unit: Final[str]
    size: Final[float | None]
    lower: Final[float | None]
    upper: Final[float | None]
    probability: Final[float | None]
    gain_nats: Final[float | None]
    p: Final[float | None]

class Diagnosis:
    verdict: Final[str]
    verdict_text: Final[str]
    causes: Final[list[Cause]]
    extended_study: Final[Study | None]
    def text(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def write(self, path: _Path) -> None: ...

class Table:
    attributes: dict[str, str | float | int]
    units: dict[str, str]
    def __getitem__(self, column: str) -> Any: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> KeysView[str]: ...
    def to_pandas(self) -> pandas.DataFrame: ...

class Answer:
    rows: Final[Table]
    def tables(self) -> dict[str, Table]: ...
    def to_pandas(self) -> pandas.DataFrame: ...
    def text(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def write(self, path: _Path) -> None: ...
    def draw(self, path: _Path, limit_state: str | None = None) -> None: ...

class Comparison(Answer):
    def __init__(self, path: _Path) -> None: ...
    def plot(self, ax: Axes | None = None, limit_state: str = "collapse") -> Axes: ...

class Risk(Answer):
    def __init__(self, path: _Path) -> None: ...
    def plot(self, ax: Axes | None = None) -> Axes: ...

class Past(Answer):
    def plot(self, ax: Axes | None = None) -> Axes: ...

class Page:
    html: Final[str]
    def write(self, path: _Path) -> None: ...

def run(
    study: Study | Mapping[str, Mapping[str, Any]] | _Path,
    output: _Path | None = None,
    *,
    threads: int = 0,
    simd: str = "auto",
    progress: Callable[[Progress], object] | None = None,
    record: Record | None = None,
) -> Result: ...
def diagnose(
    campaign: _Path,
    study: Study | Mapping[str, Mapping[str, Any]] | _Path | None = None,
    *,
    nulls: int = 192,
    seed: int = 1,
    threads: int = 0,
    simd: str = "auto",
    cache: _Path | None = None,
    progress: Callable[[str], object] | None = None,
) -> Diagnosis | None: ...
def calibrate(
    campaign: _Path,
    study: Study | Mapping[str, Mapping[str, Any]] | _Path | None = None,
    *,
    forms: str | Iterable[str] = (),
    fit: Mapping[str, tuple[float, float] | None] | Iterable[str] | None = None,
    hold: str | Iterable[str] = (),
    outcomes: bool = False,
    held_out: bool = True,
    threads: int = 0,
    simd: str = "auto",
    cache: _Path | None = None,
    progress: Callable[[str], object] | None = None,
) -> Calibration | None: ...
def compare(
    *files: _Path,
    settings: Mapping[str, Any] | None = None,
    folder: _Path = "",
    level: float = 0.95,
    adaptive: int | None = None,
    margin: float = 0.05,
    threads: int = 0,
    simd: str = "auto",
    progress: Callable[[str], object] | None = None,
) -> Comparison | None: ...
def risk(
    file: _Path,
    hazard: _Path | Iterable[_Path],
    *,
    site: str | int | None = None,
    limit_state: str | None = None,
    years: Iterable[float] = (50, 100),
    level: float = 0.9,
    most_outside: float = 0.25,
    sequences: int = 0,
    threshold: float | None = None,
    pause_s: float | None = None,
    seed: int = 1,
    settings: Mapping[str, Any] | None = None,
    threads: int = 0,
    simd: str = "auto",
    progress: Callable[[str], object] | None = None,
) -> Risk | None: ...
def past(*files: _Path) -> Past: ...
def report(
    file: _Path,
    *,
    title: str | None = None,
    animate: int | None = None,
    animate_mb: float | None = None,
    animate_seconds: float | None = None,
    settings: Mapping[str, Any] | None = None,
    threads: int = 0,
    simd: str = "auto",
    progress: Callable[[str], object] | None = None,
) -> Page | None: ...
