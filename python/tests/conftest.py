"""What the tests of the Python module share: the program, to which it is compared, and a small study."""

import os
import pathlib
import shutil
import subprocess

import pytest

PROGRAM = os.environ["STYLOBATE_PROGRAM"]
SOURCES = pathlib.Path(os.environ["STYLOBATE_SOURCE_DIR"])
INPUTS = SOURCES / "studies" / "inputs"

SMALL_SURFACE = {
    "study.realizations": 3,
    "surface.frequency_hz": {"from": 1.0, "to": 4.0, "count": 3, "spacing": "log"},
    "surface.pga_m_s2": {"from": 4.0, "to": 12.0, "count": 2},
}
SMALL_FRAGILITY = {
    "study.realizations": 6,
    "fragility.motions": 8,
    "fragility.intensity": {"measure": "pgv", "from": 0.5, "to": 3.0, "count": 3, "spacing": "log"},
}

TWO_DRUMS_FOLDER = SOURCES / "tests" / "library" / "two_drums"
TWO_DRUMS = (TWO_DRUMS_FOLDER / "two_drums.toml").read_text()


def write_tests(folder):
    """A table of outcomes of two drums, tests.csv, and the study that it needs, two_drums.toml."""
    for name in ("two_drums.toml", "tests.csv"):
        shutil.copy(TWO_DRUMS_FOLDER / name, folder)


def toml_text(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml_text(each)}" for key, each in value.items()) + "}"
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else repr(value)


def ended_program(words, settings, status):
    sets = [word for key, value in (settings or {}).items() for word in ("--set", f"{key}={toml_text(value)}")]
    ended = subprocess.run([PROGRAM, *map(str, words), *sets], capture_output=True, text=True)
    assert ended.returncode == status, ended.stderr
    return ended


def program(*words, settings=None, status=0):
    """Runs the program; returns what it writes to standard error."""
    return ended_program(words, settings, status).stderr


def output_of(*words, settings=None, status=0):
    """Runs the program; returns what it writes to standard output."""
    return ended_program(words, settings, status).stdout


@pytest.fixture
def small_surface():
    import stylobate

    return stylobate.Study.from_toml(INPUTS / "small_scale_column.toml", SMALL_SURFACE)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path
