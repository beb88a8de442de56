"""What notebooks show of an object: one small piece of HTML that needs no script, no style and no file from elsewhere."""

import html
import math
import re

from . import _core

MOST_ROWS = 12  # of a table

_STYLE = """
.stylobate-view { background: #fff; color: #1f2933; padding: .6em .8em; max-width: 62em; font: 14px/1.45 sans-serif; }
.stylobate-view p { margin: .2em 0 .5em; }
.stylobate-view .small { color: #5a6672; font-size: .88em; }
.stylobate-view table { border-collapse: collapse; margin: .3em 0 .6em; font-size: .92em; }
.stylobate-view tr { background: none !important; color: inherit !important; }
.stylobate-view th, .stylobate-view td { text-align: left !important; vertical-align: top; padding: .15em 1em .15em 0;
  border: 0; border-bottom: 1px solid #d5dbe1; max-width: 40em; white-space: normal; }
.stylobate-view .wide { overflow-x: auto; }
.stylobate-view figure { margin: .4em 0; }
.stylobate-view figcaption { color: #5a6672; font-size: .88em; }
.stylobate-view .row { display: flex; flex-wrap: wrap; gap: .4em; }
.stylobate-view .row div { flex: 1 1 9em; max-width: 16em; }
.stylobate-view svg { max-width: 100%; height: auto; }
.stylobate-view pre { white-space: pre-wrap; font-size: .85em; color: inherit; background: #f4f6f8; padding: .5em; }
"""


def options(made, **values):
    """Options of a C++ function, by their names."""
    for name, value in values.items():
        setattr(made, name, value)
    return made


def escaped(text):
    """Text as HTML and as XML; what neither may contain becomes U+FFFD."""
    return html.escape(re.sub("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", str(text)))


def words(value):
    """A value as a person reads it: numbers with four digits; "–": there is none."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (str, bytes)):
        return str(value)
    if isinstance(value, (list, tuple)):
        return " to ".join(words(each) for each in value) if len(value) == 2 else ", ".join(map(words, value)) or "–"
    if hasattr(value, "item"):  # of NumPy
        return words(value.item())
    if isinstance(value, float):
        return "∞" if value == math.inf else "-∞" if value == -math.inf else f"{value:.4g}"
    return str(value)


def interval(value, lower, upper):
    """ "0.64 (0.62 to 0.66)"; what is not known is left out."""
    ends = f"{words(lower)} to {words(upper)}"
    if words(lower) == words(upper) == "–":
        return words(value)
    return ends if words(value) == "–" else f"{words(value)} ({ends})"


def with_ends(row, name):
    """The interval of a column of a row, a dictionary with NAME, NAME_lower and NAME_upper."""
    return interval(row[name], row[f"{name}_lower"], row[f"{name}_upper"])


def percent(value, lower, upper):
    """ "64.1 % (62 to 66.2)"."""
    return f"{100 * value:.3g} % ({100 * lower:.3g} to {100 * upper:.3g})"


def line(x, y, lower=(), upper=(), name="", kind="line", group=""):
    """A series of a figure. `kind`: "line", "points" or "bars"; `lower` and `upper` are a band or error bars; series of
    one `group` have one colour."""
    return options(_core.FigureSeries(), name=name, kind=getattr(_core.SeriesKind, kind), group=group,
                   x=_floats(x), y=_floats(y), lower=_floats(lower), upper=_floats(upper))


def points(x, y, lower=(), upper=(), name="", group=""):
    """A series of points with error bars."""
    return line(x, y, lower, upper, name, "points", group)


def chart(title, x_label, y_label, series, *, x_log=False, y_log=False, x_ticks=()):
    """A figure as SVG. `x_ticks`: names at x = 0, 1, 2, ... instead of numbers."""
    return _core.svg(options(_core.Figure(), title=title, x_label=x_label, y_label=y_label, series=list(series),
                             x_log=x_log, y_log=y_log, x_ticks=list(x_ticks)))


class View:
    """Parts one below the other. All texts are escaped; only `drawings` are taken as they are."""

    def __init__(self, sentence):
        self._parts = [f"<p><b>{escaped(sentence)}</b></p>"]

    def note(self, text):
        self._parts.append(f'<p class="small">{escaped(text)}</p>')
        return self

    def facts(self, facts):
        """Names and values: a dictionary, or pairs."""
        pairs = facts.items() if isinstance(facts, dict) else facts
        rows = "".join(f"<tr><td>{escaped(name)}</td><td>{escaped(words(value))}</td></tr>" for name, value in pairs)
        self._parts.append(f"<table><tbody>{rows}</tbody></table>" if rows else "")
        return self

    def table(self, head, rows):
        """The first rows, and how many there are more."""
        rows = list(rows)
        body = "".join("<tr>" + "".join(f"<td>{escaped(words(value))}</td>" for value in row) + "</tr>"
                       for row in rows[:MOST_ROWS])
        top = "".join(f"<th>{escaped(name)}</th>" for name in head)
        if rows:
            self._parts.append(f'<div class="wide"><table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>')
        if len(rows) > MOST_ROWS:
            self.note(f"{len(rows) - MOST_ROWS} more rows")
        return self

    def figure(self, *drawings, caption=""):
        """SVG from the library; several stand side by side."""
        body = "".join(f"<div>{each}</div>" for each in drawings) if len(drawings) > 1 else drawings[0]
        body = f'<div class="row">{body}</div>' if len(drawings) > 1 else body
        self._parts.append(f"<figure>{body}<figcaption>{escaped(caption)}</figcaption></figure>")
        return self

    def more(self, title, text):
        """Text with its lines, which opens below its title."""
        self._parts.append(f"<details><summary>{escaped(title)}</summary><pre>{escaped(text)}</pre></details>")
        return self

    def html(self):
        return f'<div class="stylobate-view"><style>{_STYLE}</style>{"".join(self._parts)}</div>'


class Shown:
    """What has a view for notebooks; a class defines `_view`."""

    def _view(self):
        raise NotImplementedError(type(self).__name__)

    def _repr_html_(self):
        return self._view().html()


def _floats(values):
    return [float(value) for value in values]
