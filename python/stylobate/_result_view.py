"""What notebooks show of a Result, by its kind."""

import math

from . import _core
from ._table import Table
from ._values import STATES, TOLD, named, shares_text
from ._view import View, chart, interval, line, points, words

LIMIT_STATES = ("collapse", "total", "unseated", "rocked", "slid", "moving")


def view_of(core, path):
    """The view of a Result, also where its file has gone. @param path None: in memory"""
    if core.kind == "replay":
        return _view_of_one(core)
    shares = _shares(core)
    so_far = "" if core.complete else " so far"
    shown = View(f"{core.kind}, {core.realizations} realizations{so_far}; {_collapse(core, shares)}")
    tables = {name: Table(table) for name, table in core.tables().items()}
    if core.kind == "surface" and "collapse" in shares:
        shown.figure(_core.svg(core.surface("collapse")), caption="Probability of collapse; lines at 0.05, 0.5 and 0.95")
    for name, add in (("fragility", _add_fragility), ("rare", _add_rare), ("sensitivity", _add_sensitivity),
                      ("survival", _add_survival)):
        if name in tables:
            add(shown, core, tables[name])
    if not tables and core.kind != "surface" and shares:
        ends = ([getattr(share, end) for share in shares.values()] for end in ("probability", "lower", "upper"))
        shown.figure(chart("Shares of the limit states", "", "probability", [points(range(len(shares)), *ends)],
                           x_ticks=shares))
    if len(shares) > 1:
        shown.table(("limit state", "reached by"), ((state, shares_text(share)) for state, share in shares.items()))
    for warning in core.warnings + ([core.too_many_invalid] if core.too_many_invalid else []):
        shown.note(warning)
    return shown.note(f"{core.invalid} set aside; {path or 'in memory'}; stylobate {core.code_version}")


def _view_of_one(core):
    """Of a file of one realization."""
    columns = {name: values[0] for name, (_, _, values) in core.columns().items()}
    shown = View(f"One realization, number {columns['index']}: {STATES[columns['state']]}")
    return shown.facts((named(name), columns[name]) for name in TOLD if name in columns)


def _shares(core):
    """Of the limit states of which the study has one, and some realization that counts."""
    shares = {}
    for state in LIMIT_STATES:
        try:
            shares[state] = core.share(state)
        except _core.InputError:  # of chosen realizations only that of the collapse is known, at the end
            pass
    return {state: share for state, share in shares.items() if share.trials}


def _collapse(core, shares):
    share = shares.get("collapse")
    if share is None:
        return "no share is known yet"
    if len(shares) == 1:  # realizations are chosen: their number means nothing
        return f"collapse: {interval(share.probability, share.lower, share.upper)}, 95 % interval"
    return f"collapse: {shares_text(share)}, 95 % interval"


def _add_fragility(shown, core, _):
    """Medians; curves and shares of the stripes of peaks and collapse."""
    fragility = core.fragility()
    shown.table(("limit state", "meaning", "reached", f"median, {fragility.measure}", "dispersion"),
                ((c.limit_state, c.meaning, f"{c.reached} of {c.trials}", interval(*c.median[0]),
                  interval(*c.dispersion[0])) for c in fragility.curves))
    series = []
    states = [c for c in fragility.curves if c.limit_state == "collapse" or c.limit_state.startswith("peak_")]
    for curve in states[-7:]:  # as many as there are colours
        name = curve.limit_state
        if math.isfinite(curve.median[0, 0]):
            series.append(line(fragility.intensity, *curve.probability.T, name=name, group=name))
        if len(fragility.stripe):
            series.append(points(fragility.stripe, *curve.share.T, name=name, group=name))
    if series:
        shown.figure(chart("Fragility curves", fragility.measure, "probability", series, x_log=True),
                     caption="Curves and shares of the stripes, with 95 % intervals by the motions")


def _add_rare(shown, core, table):
    repeats = table["repeats"]
    shown.figure(chart("Estimates of the repeats", "repeat", "probability of collapse",
                       [points(range(1, len(repeats) + 1), repeats)], y_log=True),
                 caption="Independent estimates; their scatter gives the interval")
    shown.note(f"{words(table.attributes['plain_realizations'])} plain realizations would give the same precision")


def _add_sensitivity(shown, core, table):
    """The indices of the first outcome, which is the collapse."""
    factors = table["factors"]
    ends = ("", "_lower", "_upper")
    shown.figure(chart(f"Indices of {table['outcomes'][0]}", "", "index", [
        points([i + shift for i in range(len(factors))], *(table[name + end][0] for end in ends), name=name)
        for name, shift in (("first", -0.08), ("total", 0.08))], x_ticks=factors), caption=f"Of {table['outcomes'][0]}, with 95 % intervals")
    shown.table(("factor", "first", "total"),
                ((factor, *(interval(*(table[name + end][0][i] for end in ends)) for name in ("first", "total")))
                 for i, factor in enumerate(factors)))


def _add_survival(shown, core, table):
    shown.figure(chart("Likelihood of one event", "peak ground acceleration [m/s²]", "likelihood",
                       [line(table["pga_m_s2"], *(table["events_likelihood" + end][0] for end in ("", "_lower", "_upper")))],
                       x_log=True), caption="Of one event by its PGA, with its 95 % interval")
    known = table.attributes
    shown.facts((name.replace("_", " "), interval(known[name], known[f"{name}_lower"], known[f"{name}_upper"]))
                for name in known if f"{name}_lower" in known)
