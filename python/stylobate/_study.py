"""Studies."""

import operator
import os

from . import _core, _toml
from ._view import Shown, View


class Study(Shown):
    """A study: the structure, its contacts, the shaking, the random quantities, and the question.

    Every key is checked and every default filled in; the keys are those of the study files of the program
    (docs/study_reference.md).

    `Study({"study": {"kind": "single"}, "structure": {...}, ...})` makes one from tables: a dictionary of dictionaries.
    Files that it names are looked for from the working folder. InputError has the message of the program; its line
    numbers are those of the text that the tables make.
    """

    def __init__(self, tables):
        if isinstance(tables, _core.Study):
            self._core = tables
        elif isinstance(tables, dict):
            self._core = _core.Study.from_text(_toml.document(tables))
        else:
            raise _core.InputError(f"a study is made from a dictionary of tables, not from a {type(tables).__name__}; "
                                   "Study.from_toml(path) reads a file")

    @classmethod
    def from_toml(cls, path, settings=None):
        """Reads a study file. `settings`: {"contact.friction": 0.7}, as `--set` of the program."""
        return cls(_core.Study.from_file(os.fspath(path), _settings(settings)))

    def set(self, key, value):
        """Sets one key, such as `set("surface.pga_m_s2.count", 4)`. The whole study is checked again.

        After an InputError the study is as it was.
        """
        self._core.set(f"{key}={_toml.value(value, key)}")

    def describe(self):
        """The study in a few lines: kind, number of realizations, structure, contacts, excitation, random quantities."""
        lines = [("Kind", self.kind), ("Realizations", str(self.realizations)), ("Seed", str(self.seed)),
                 *self._core.summary()]
        width = max(len(name) for name, _ in lines)
        return "\n".join(f"{name:<{width}}  {text}" for name, text in lines)

    def check(self, *, pilot=0, trial_seconds=2, law_seconds=20, threads=0, simd="auto", progress=None,
              record=None):
        """Before a run: what will be run, its time, memory and file, and where the study is weak. Returns a Check.

        pilot          realizations that are run twice, the second time with finer numerics: 16 to 10,000,000; 0: none
        trial_seconds  [s] spent on a fair sample of the realizations, for the time of the run; 0: none
        law_seconds    [s] most, spent on the pilot under other contact laws; 0: none. The text of the Check has the band
        threads, simd  of the run that is asked about, as of `run`
        progress       called with a line of text; returns False to stop, and None is returned
        record         a Record that shakes the base instead of the study's [excitation]

        The time is measured by the processor time of this process: what its other threads compute meanwhile is counted
        too. Ctrl-C raises KeyboardInterrupt within a second. InputError: for what `run` refuses. What the program prints
        as a warning is given to `warnings.warn`.
        """
        from . import _check

        return _check.check(self, pilot, trial_seconds, law_seconds, threads, simd, progress, record)

    @property
    def text(self):
        """The canonical text (TOML): every key with its default. Two studies are the same if their texts are."""
        return self._core.text()

    @property
    def kind(self):
        """ "single", "surface", "fragility", "sensitivity" or "rare"."""
        return self._core.kind()

    @property
    def seed(self):
        """The seed of all random quantities."""
        return self._core.seed()

    @property
    def realizations(self):
        """Realizations of the whole study; of an adaptive surface or rare events the most that it can take."""
        return self._core.realizations()

    def __eq__(self, other):
        return isinstance(other, Study) and self.text == other.text

    __hash__ = None  # a study can be changed

    def __copy__(self):
        return Study(self._core.__copy__())

    def __reduce__(self):  # deep copies, and other processes
        return _from_text, (self.text,)

    def _view(self):
        shown = View(f"A study of kind {self.kind}: {self.realizations} realizations, seed {self.seed}")
        shown.figure(_core.svg(self._core), caption="The structure, nothing drawn at random")
        return shown.facts(self._core.summary()).more("The study with every default (TOML)", self.text)

    def __repr__(self):
        return f"<Study: {self.kind}, {self.realizations} realizations>"


def _from_text(text):
    return Study(_core.Study.from_text(text))


def _settings(settings):
    """As the library takes them: "KEY=VALUE"."""
    return [f"{key}={_toml.value(value, key)}" for key, value in (settings or {}).items()]


def whole_number(value, name):
    """An int from Python's or NumPy's. `name` is for the message."""
    try:
        number = operator.index(value)
    except TypeError:
        number = -1
    if number < 0:
        raise _core.InputError(f"{name} = {value!r} is not a whole number, from 0 on")
    return number


def number(value, name):
    """A float from any number. `name` is for the message."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise _core.InputError(f"{name} = {value!r} is not a number") from None


def experiment_of(study, record):
    """A Study with the motions that shake it: its own excitation, or a Record."""
    if record is None:
        return _core.Experiment(study._core)
    if not isinstance(record, _core.Record):
        raise _core.InputError(f"record is a {type(record).__name__}; Record.read(path) reads one")
    return _core.Experiment(study._core, record)


def study_of(given):
    """A Study from a Study, a dictionary or the path of a file."""
    if isinstance(given, Study):
        return given
    return Study.from_toml(given) if isinstance(given, (str, os.PathLike)) else Study(given)
