"""What the classes pass on to the C++ objects behind them."""

import json
import os

from ._view import Shown


def forwarded(name, doc):
    """The property `name` of `self._core`."""
    return property(lambda self: getattr(self._core, name), doc=doc)


class Finding(Shown):
    """An answer of the program, as its text and as a dictionary."""

    def __init__(self, core):
        self._core = core

    def text(self):
        """The text that the program prints."""
        return self._core.text()

    def to_dict(self):
        """All of it, as the program prints it with `--json`; the names of its files are left out."""
        return json.loads(self._core.json())


class FiledFinding(Finding):
    """A finding that has a results file."""

    def write(self, path):
        """Writes the results file of the program, which `stylobate report` accepts."""
        self._core.write(os.fspath(path))
