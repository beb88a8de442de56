"""Outcomes of the realizations of a study."""

import os

from . import _core
from ._forward import forwarded
from ._replay import Replay, animation
from ._result_view import view_of
from ._study import Study, _settings, whole_number
from ._table import Table
from ._values import STATES
from ._view import Shown

REASONS = ("none", "not_finite", "energy")
UNITS = {"_m_s2": "m/s2", "_m_s": "m/s", "_m": "m", "_s": "s"}


class ResultGone(_core.Error, FileNotFoundError):
    """The file of a Result is not there any more, or is another one."""


class TooManyInvalid(_core.Error):
    """More realizations are invalid than the study allows. `result`: the complete Result."""

    def __init__(self, message, result):
        super().__init__(message)
        self.result = result


class Result(Shown):
    """The realizations of a study that have been run, all of them or not.

    `Result("column.h5")` reads a results file, complete or not; `run` gives one too.
    """

    def __init__(self, path):
        path = os.path.abspath(os.fspath(path))
        self._set(_core.Result.from_file(path), path)

    @classmethod
    def _of(cls, core, path):
        result = cls.__new__(cls)
        result._set(core, path)
        return result

    def _set(self, core, path):
        self._held = core
        self._path = path
        self._file = None if path is None else _identity(path)

    @property
    def _core(self):
        if self._path is not None:
            now = _identity(self._path)
            if now is None:
                raise ResultGone(f"{self._path}: the file of this result is not there any more. Run the study again, "
                                 "or give its new place to Result(path).")
            if now != self._file:
                raise ResultGone(f"{self._path}: the file of this result has changed since it was read. Read it again "
                                 "by Result(path).")
        return self._held

    @property
    def path(self):
        """The results file; None: in memory."""
        return self._path

    @property
    def study(self):
        """The Study, with every default."""
        return Study(_core.Study.from_text(self._core.study_text))

    @property
    def kind(self):
        """Kind of the study; "replay" for a file of one realization."""
        return self._core.kind

    complete = forwarded("complete", "Whether every realization of the study has been run.")
    count = forwarded("realizations", "Number of realizations that have been run.")
    invalid = forwarded("invalid", "Number of those that were set aside.")
    warnings = forwarded("warnings", "Warnings about the study, a text each.")
    code_version = forwarded("code_version", "Version of the program that computed it.")
    dimensions = forwarded("dimensions", "Dimensions of the structure: 2 in the plane, 3 in space.")
    blocks = forwarded("block_names", "Names of the blocks, in layout order.")

    def share(self, limit_state="collapse"):
        """How often a limit state was reached over all cells or motions: a Share with trials, count, probability, and
        lower and upper, its 95 % interval.

        limit_state: "collapse", "total", "unseated", "rocked", "slid" or "moving".
        """
        return self._core.share(limit_state)

    def surface(self, limit_state="collapse"):
        """The surface of a limit state: an xarray.Dataset over frequency_hz [Hz] (nf), or of a surface over directions
        direction_deg [degrees], and pga_m_s2 [m/s2] (np) with probability, lower and upper (its 95 % interval), trials and reached, each (nf, np).

        InputError: for a study of another kind.
        """
        import xarray

        surface = self._core.surface(limit_state)
        words = {"probability": f"probability of {limit_state}", "lower": "lower end of the interval",
                 "upper": "upper end of the interval", "trials": "valid realizations",
                 "reached": f"realizations that reached {limit_state}"}
        row, unit, meaning = (("frequency_hz", "Hz", "frequency of the shaking") if len(surface.frequency_hz) else
                              ("direction_deg", "degrees", "direction of the shaking, from x towards z"))
        axes = (row, "pga_m_s2")
        return xarray.Dataset(
            {name: (axes, getattr(surface, name), {"units": "1", "long_name": text}) for name, text in words.items()},
            coords={row: (row, getattr(surface, row), {"units": unit, "long_name": meaning}),
                    "pga_m_s2": ("pga_m_s2", surface.pga_m_s2,
                                 {"units": "m/s2", "long_name": "peak ground acceleration"})},
            attrs={"limit_state": surface.limit_state, "interval": surface.interval})

    def arrays(self):
        """The numbers of all realizations as read-only views without a copy: {name: array (n)}, by index.

        Names and units are those of `realizations`; times are -1 where a thing did not happen; `state` and
        `invalid_reason` are numbers.
        """
        return {name: values for name, (_, _, values) in self._core.columns().items()}

    def realizations(self):
        """A pandas.DataFrame with a row for each realization, by index: cell, frequency_hz, pga_m_s2, the outcome, the
        drawn inputs (`input_friction[0]`) and when each block fell (`fall_time_s[0]`).

        The columns are those of `export --to csv` of the program (which adds the unit to the names of inputs); a time
        is NaN where a thing did not happen; of blocks -1 is none and -2 several at once. `attrs["units"]`: the unit of
        each column.
        """
        import numpy as np
        import pandas

        core = self._core
        columns, units = {}, {}
        for name, (unit, is_event, values) in core.columns().items():
            if is_event:
                values = np.where(values == -1, np.nan, values)
            elif name == "state":
                values = pandas.Categorical.from_codes(values, STATES)
            elif name == "invalid_reason":
                values = pandas.Categorical.from_codes(values, REASONS)
            columns[name], units[name] = values, unit
        falls = core.fall_time_s()
        for i in range(falls.shape[1]):
            columns[f"fall_time_s[{i}]"] = np.where(falls[:, i] == -1, np.nan, falls[:, i])
            units[f"fall_time_s[{i}]"] = "s"
        inputs = core.inputs()
        for i, (name, unit) in enumerate(zip(core.input_names, core.input_units)):
            columns[f"input_{name}"], units[f"input_{name}"] = inputs[:, i], unit or "1"
        frame = pandas.DataFrame(columns).set_index("index")
        frame.attrs["units"] = units
        return frame

    def fragility(self):
        """Fragility curves: an xarray.Dataset over limit_state and intensity, with probability of the curve, median and
        dispersion of each limit state, trials and reached; with stripes also share over limit_state and stripe. Each has
        NAME_lower and NAME_upper, its 95 % interval. The unit of the intensity is in `attrs["measure"]`.

        InputError: for a study of another kind, and while the run is not complete.
        """
        import numpy as np
        import xarray

        fragility = self._core.fragility()
        curves = fragility.curves
        unit = next((unit for ending, unit in UNITS.items() if fragility.measure.endswith(ending)), "1")
        data = {"meaning": ("limit_state", [c.meaning for c in curves]),
                "trials": ("limit_state", [c.trials for c in curves], {"units": "1", "long_name": "realizations"}),
                "reached": ("limit_state", [c.reached for c in curves], {"units": "1", "long_name": "reached it"})}

        def add(name, dims, values, unit, text):
            for i, end in enumerate(("", "_lower", "_upper")):
                data[name + end] = (dims, values[..., i], {"units": unit, "long_name": text + end.replace("_", ", ")})

        if curves:
            add("median", "limit_state", np.array([c.median[0] for c in curves]), unit, "median")
            add("dispersion", "limit_state", np.array([c.dispersion[0] for c in curves]), "1", "dispersion")
            add("probability", ("limit_state", "intensity"), np.array([c.probability for c in curves]), "1",
                "probability of reaching the limit state")
            if len(fragility.stripe):
                add("share", ("limit_state", "stripe"), np.array([c.share for c in curves]), "1",
                    "share of the realizations of a stripe")
        coords = {"limit_state": [c.limit_state for c in curves],
                  "intensity": ("intensity", fragility.intensity, {"units": unit, "long_name": fragility.measure})}
        if len(fragility.stripe):
            coords["stripe"] = ("stripe", fragility.stripe, {"units": unit, "long_name": fragility.measure})
        return xarray.Dataset(data, coords=coords, attrs={"measure": fragility.measure})

    def tables(self):
        """What the study computes of its realizations beside shares and surface: a Table by its name, "fragility",
        "rare", "sensitivity", "survival" or "twins" (io/FORMAT.md has their columns); none while the run is not
        complete.
        """
        return {name: Table(table) for name, table in self._core.tables().items()}

    def replay(self, index, settings=None):
        """Runs realization `index` again and returns it through time: a Replay. The outcome has the same bits.

        settings: only {"excitation.file": path}, the present place of the study's record.
        """
        return Replay(_core.replay(self._core, whole_number(index, "index"), _settings(settings)))

    def plot(self, ax=None, limit_state="collapse"):
        """Draws a surface (probability over frequency, or direction, and PGA) or fragility curves with Matplotlib; returns the axes."""
        import matplotlib.pyplot as plt

        kind = self.kind
        if kind not in ("surface", "fragility"):
            raise _core.InputError(f"plot: a result of kind '{kind}' has no surface and no fragility curves; "
                                   "animate(index) draws a realization")
        if ax is None:
            ax = plt.figure().subplots()
        if kind == "surface":
            surface = self.surface(limit_state)
            row = surface.probability.dims[0]
            mesh = ax.pcolormesh(surface[row], surface.pga_m_s2, surface.probability.T, vmin=0, vmax=1,
                                 shading="nearest")
            ax.figure.colorbar(mesh, ax=ax, label=f"probability of {limit_state}")
            ax.set_xlabel("frequency [Hz]" if row == "frequency_hz" else "direction of the shaking [°]")
            ax.set_ylabel("peak ground acceleration [m/s²]")
            return ax
        fragility = self.fragility()
        for state in fragility.limit_state.values:
            curve = fragility.sel(limit_state=state)
            (line,) = ax.plot(curve.intensity, curve.probability, label=str(state))
            ax.fill_between(curve.intensity, curve.probability_lower, curve.probability_upper, color=line.get_color(),
                            alpha=0.2, linewidth=0)
        ax.set_xlabel(f"{fragility.measure} [{fragility.intensity.units}]")
        ax.set_ylabel("probability")
        ax.set_ylim(0, 1)
        ax.legend()
        return ax

    def animate(self, index, seconds=None, fps=25):
        """A matplotlib.animation.FuncAnimation of realization `index`; `save("fall.gif", writer="pillow")` writes it.

        seconds: length of the animation; None: as long as the shaking, in real time. A structure in space is
        seen obliquely from above.
        """
        return animation(self.replay(index), seconds, fps)

    def _view(self):
        return view_of(self._held, self._path)

    def __repr__(self):
        where = "in memory" if self._path is None else self._path
        return f"<Result: {self._held.kind}, {self._held.realizations} realizations, {where}>"


def _identity(path):
    """By which a file is known again; None: there is none."""
    try:
        stat = os.stat(path)
    except OSError:
        return None
    return stat.st_dev, stat.st_ino, stat.st_size, stat.st_mtime_ns
