"""Studies."""

import operator
import os

from . import _core, _toml


class Study:
    """A study: the structure, its contacts, the shaking, what is drawn, and what is asked.

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
        """What is run, in a few lines: kind, number of realizations, structure, contacts, excitation, what is drawn."""
        lines = [("Kind", self.kind), ("Realizations", str(self.realizations)), ("Seed", str(self.seed)),
                 *self._core.summary()]
        width = max(len(name) for name, _ in lines)
        return "\n".join(f"{name:<{width}}  {text}" for name, text in lines)

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
        """The seed of what is drawn."""
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


def study_of(given):
    """A Study from a Study, a dictionary or the path of a file."""
    if isinstance(given, Study):
        return given
    return Study.from_toml(given) if isinstance(given, (str, os.PathLike)) else Study(given)
