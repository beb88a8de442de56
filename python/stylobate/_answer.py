"""Comparisons, risk estimates, the past of a site, and pages of any file."""

import html
import os
import warnings

from . import _core
from ._forward import FiledFinding, forwarded
from ._study import _settings, number, whole_number
from ._table import Table
from ._view import View, chart, line, options, points, with_ends, words


class Answer(FiledFinding):
    """What comparisons, risk estimates and pasts have in common."""

    @property
    def rows(self):
        """The numbers that are asked for, a row each: a Table."""
        return Table(self._core.rows())

    def tables(self):
        """All tables (io/FORMAT.md): a Table by its name."""
        return {name: Table(table) for name, table in self._core.tables().items()}

    def to_pandas(self):
        """`rows` as a pandas.DataFrame."""
        return self.rows.to_pandas()

    def draw(self, path, limit_state=None):
        """Draws the picture of the program: .png, .svg or .pdf. A file that is there is replaced.

        limit_state: None: the principal one.
        """
        self._core.draw(os.fspath(path), limit_state or None)

    def __repr__(self):
        return f"<{type(self).__name__}: {len(self.rows[next(iter(self.rows))])} rows>"


class Comparison(Answer):
    """What interventions change (docs/compare.md). `Comparison(path)` reads the file of a comparison; `compare` makes
    one.

    `rows` has one for each variant, limit state and place ("all", or a cell): variant, limit_state, place, verdict;
    pairs by which study reached the limit state: both, base_only, variant_only, neither; base_probability,
    variant_probability and difference with their intervals; p and p_adjusted.
    """

    def __init__(self, path):
        super().__init__(_core.Comparison.from_file(os.fspath(path)))

    def _view(self):
        rows = [row for row in _records(self.rows) if row["place"] == "all"]
        first = rows[0]["limit_state"]
        of_first = [row for row in rows if row["limit_state"] == first]
        shown = View(f"{first}: " + "; ".join(f"{row['variant']} {with_ends(row, 'difference')}, {_verdict(row)}"
                                              for row in of_first))
        shown.figure(_whiskers(of_first, "variant", "difference", f"change of the probability of {first}"),
                     caption="Change by each variant over all cells, with its interval")
        shown.table(("variant", "limit state", "base", "variant", "difference", "verdict"),
                    ((row["variant"], row["limit_state"], row["base_probability"], row["variant_probability"],
                      with_ends(row, "difference"), _verdict(row)) for row in rows))
        return shown.more("The text of the program", self.text())

    def plot(self, ax=None, limit_state="collapse"):
        """Draws the difference of the probability of a limit state over all cells, for each variant, with its interval;
        returns the axes (Matplotlib)."""
        rows = [row for row in _records(self.rows) if row["limit_state"] == limit_state and row["place"] == "all"]
        if not rows:
            raise _core.InputError(f"plot: the comparison has no limit state {limit_state!r}")
        return _intervals(ax, rows, "variant", "difference", f"change of the probability of {limit_state}")


class Risk(Answer):
    """How often limit states are reached at a site, and how likely that is over years (docs/risk.md). `Risk(path)` reads
    the file of an estimate; `risk` makes one.

    `rows` of a study has one for each limit state: limit_state, meaning, determined (0: only bounds hold), and with
    their intervals annual_frequency [1/year] and probability_50_years for each of the years. Of a comparison it has one
    for each variant and limit state: variant, limit_state, meaning, verdict, these numbers as base_NAME and
    variant_NAME, and annual_frequency_change, annual_frequency_ratio and probability_50_years_change.
    """

    def __init__(self, path):
        super().__init__(_core.Risk.from_file(os.fspath(path)))

    def _view(self):
        rows, name = self._over_years()
        asked = next((row for row in rows if row["limit_state"] == "collapse"), rows[0])
        shown = View(f"{asked['name']}: {name.replace('_', ' ')} {with_ends(asked, name)}")
        shown.figure(_whiskers(rows, "name", name, name.replace("_", " ")), caption="With the interval of each")
        numbers = [column for column in self.rows if f"{column}_lower" in self.rows]
        shown.table(["", *(column.replace("_", " ") for column in numbers)],
                    ((row["name"], *(with_ends(row, column) for column in numbers)) for row in rows))
        return shown.more("The text of the program", self.text())

    def plot(self, ax=None):
        """Draws the probabilities of the limit states over the last of the years, or their changes by the variants, with
        their intervals; returns the axes (Matplotlib)."""
        rows, name = self._over_years()
        return _intervals(ax, rows, "name", name, name.replace("_", " "))


    def _over_years(self):
        """Rows with a name of their own, and the column of the probability over the last of the years, or its change."""
        rows = _records(self.rows)
        change = "variant" in self.rows
        ending = "_years_change" if change else "_years"
        name = [name for name in self.rows if name.startswith("probability_") and name.endswith(ending)][-1]
        for row in rows:
            row["name"] = f"{row['variant']}: {row['limit_state']}" if change else row["limit_state"]
        return rows, name


class Past(Answer):
    """The past shaking of a site from several structures (docs/past.md); `past` makes one.

    `rows` has what is excluded by each structure and by all together: structure (its file, or "together"), events, and
    with their intervals the peak ground accelerations by_likelihood_m_s2, by_profile_m_s2 and by_posterior_m_s2, from
    which shaking is excluded (infinite: none), and weaker_m_s2, below which it is too weak (0: none). The table
    "likelihood" has structure, events, pga_m_s2 and likelihood.
    """

    def _view(self):
        rows = _records(self.rows)
        together = next(row for row in rows if row["structure"] == "together")
        shown = View(f"{together['structure']}: shaking is excluded from {words(together['by_profile_m_s2'])} m/s² on by the "
                     f"profile, of {together['events']} events")
        curves = []
        for name, own, largest in self._likelihoods():
            curves.append(line([row["pga_m_s2"] for row in own], [row["likelihood"] / largest for row in own], name=name))
        shown.figure(chart("Likelihood of the shaking", "peak ground acceleration [m/s²]",
                           "likelihood / largest likelihood", curves), caption="Of one event")
        shown.table(list(self.rows), ((row[name] for name in self.rows) for row in rows))
        return shown.more("The text of the program", self.text())

    def _likelihoods(self):
        """Of one event: structure, its rows, and its largest likelihood."""
        rows = [row for row in _records(self.tables()["likelihood"]) if row["events"] == 1]
        for name in dict.fromkeys(row["structure"] for row in rows):
            own = [row for row in rows if row["structure"] == name]
            yield name, own, max(row["likelihood"] for row in own)

    def plot(self, ax=None):
        """Draws the likelihoods over the peak ground acceleration, of one event; returns the axes (Matplotlib)."""
        ax = _axes(ax)
        for name, own, largest in self._likelihoods():
            ax.plot([row["pga_m_s2"] for row in own], [row["likelihood"] / largest for row in own], label=name)
        ax.set_xlabel("peak ground acceleration [m/s²]")
        ax.set_ylabel("likelihood / largest likelihood")
        ax.legend()
        return ax


class Page:
    """A self-contained page (HTML), by `report`. In a notebook it is shown in a frame."""

    def __init__(self, core):
        self._core = core

    html = forwarded("html", "The page as text.")

    def write(self, path):
        """Writes it, whole or not at all. A file that is there is replaced."""
        self._core.write(os.fspath(path))

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.html)}" sandbox="allow-scripts" width="100%" height="600" '
                'title="page of stylobate"></iframe>')


def compare(*files, settings=None, folder="", level=0.95, adaptive=None, margin=0.05, threads=0, simd="auto",
            progress=None):
    """Runs studies under the same draws and the same shaking, and compares them: a Comparison.

    files     study files, the base first (one alone: its [variants]); or finished results of them
    settings  {"contact.friction": 0.7}, of every study file
    folder    of the results of study files, which are continued where they are there; "": the working folder
    level     of intervals and verdicts
    adaptive  most pairs of each variant of a surface, run where the difference is undecided; None: all pairs
    margin    adaptive: a difference that does not matter
    threads, simd   as of `run`; the result does not depend on them
    progress  called with a line of text; returns False to stop, and None is returned: what was run is kept

    InputError: as the program, exit status 2.
    """
    asked = options(_core.CompareOptions(), settings=_settings(settings), folder=os.fspath(folder),
                    level=number(level, "level"), margin=number(margin, "margin"), simd=simd,
                    adaptive=None if adaptive is None else whole_number(adaptive, "adaptive"),
                    threads=whole_number(threads, "threads"))
    found = _core.compare(_paths(files), asked, progress)
    return None if found is None else _made(Comparison, found)


def risk(file, hazard, *, site=None, limit_state=None, years=(50, 100), level=0.9, most_outside=0.25, sequences=0,
         threshold=None, pause_s=None, seed=1, settings=None, threads=0, simd="auto", progress=None):
    """How often limit states are reached at a site, and how likely that is over years: a Risk.

    file          results of a fragility study, or a comparison of fragility studies
    hazard        a file (CSV, OpenQuake's CSV or NRML) or several, or "k0=1e-4,k=2.5,measure=pga_g,sigma_ln=0.5"
    site          of several in the hazard: "LON,LAT" or its number from 0; None: there is one
    limit_state   one of the study; None: all
    years         for the probabilities
    level         of the intervals
    most_outside  largest share of a frequency from outside of the intensities of study or hazard
    sequences     histories of the last of the years, with the damage carried along; threshold, pause_s and seed are
                  theirs (None: by the results, and until the structure rests)
    settings      only {"excitation.file": path}, the present place of the study's record
    threads, simd   as of `run`
    progress      called with a line of text; returns False to stop, and None is returned

    InputError: as the program, exit status 2.
    """
    hazards = [hazard] if isinstance(hazard, (str, os.PathLike)) else hazard
    asked = options(_core.RiskOptions(), site=None if site in (None, "") else str(site), limit_state=limit_state or None,
                    years=[number(each, "years") for each in years], level=number(level, "level"),
                    most_outside=number(most_outside, "most_outside"), sequences=whole_number(sequences, "sequences"),
                    threshold=threshold, pause_s=pause_s, seed=whole_number(seed, "seed"),
                    settings=_settings(settings), threads=whole_number(threads, "threads"), simd=simd)
    found = _core.risk(os.fspath(file), _paths(hazards), asked, progress)
    return None if found is None else _made(Risk, found)


def past(*files):
    """The past shaking of a site, from results of survival studies of several of its structures: a Past.

    InputError: as the program, exit status 2.
    """
    return _made(Past, _core.past(_paths(files)))


def report(file, *, title=None, animate=None, animate_mb=None, animate_seconds=None, settings=None, threads=0,
           simd="auto", progress=None):
    """The page of results, a comparison, a diagnosis, a calibration or a risk estimate: a Page.

    title     None: by the study or the file
    animate   N realizations in motion that fell and N that stood, of each cell; None: one of each
    animate_mb, animate_seconds   most for all of them: size [1e6 bytes], and time to run them again [s]
    settings  only {"excitation.file": path}, the present place of the study's record
    threads, simd   as of `run`
    progress  called with a line of text; returns False to stop, and None is returned

    What the program prints as a warning is given to `warnings.warn`. InputError: as the program, exit status 2.
    """
    asked = options(_core.ReportOptions(), title=title or None, animate_mb=animate_mb, animate_seconds=animate_seconds,
                    animate=None if animate is None else whole_number(animate, "animate"),
                    settings=_settings(settings), threads=whole_number(threads, "threads"), simd=simd)
    page = _core.report(os.fspath(file), asked, progress)
    if page is None:
        return None
    for warning in page.warnings:
        warnings.warn(warning, stacklevel=2)
    return Page(page)


def _made(cls, core):
    """Without its file."""
    made = cls.__new__(cls)
    Answer.__init__(made, core)
    return made


def _paths(files):
    return [os.fspath(file) for file in files]


def _records(table):
    return [dict(zip(table, row)) for row in zip(*(table[name] for name in table))]


def _verdict(row):
    """In the words of the text."""
    return "undecided" if row["verdict"] == "open" else row["verdict"]


def _whiskers(rows, name, value, label):
    """As `_intervals`, as SVG."""
    series = points(range(len(rows)), *([row[value + end] for row in rows] for end in ("", "_lower", "_upper")))
    return chart(label, "", label, [series], x_ticks=[row[name] for row in rows])


def _axes(ax):
    import matplotlib.pyplot as plt

    return plt.figure().subplots() if ax is None else ax


def _intervals(ax, rows, name, value, label):
    """A point with its interval for each row."""
    ax = _axes(ax)
    values = [row[value] for row in rows]
    errors = [[row[value] - row[f"{value}_lower"] for row in rows], [row[f"{value}_upper"] - row[value] for row in rows]]
    ax.errorbar(values, range(len(rows)), xerr=errors, fmt="o", capsize=3)
    ax.set_yticks(range(len(rows)), [row[name] for row in rows])
    ax.set_xlabel(label)
    return ax
