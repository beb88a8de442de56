"""What the tests of the Python module share: the program, to which it is compared, and a small study."""

import os
import pathlib
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

TWO_DRUMS = """[study]
kind = "single"
[structure]
kind = "column"
blocks = 3
fixed_blocks = 1
drum_width_m = 0.05
drum_height_m = 0.05
depth_m = 0.05
drum_mass_kg = 0.4
[contact]
normal_stiffness_n_m2 = 2e6
tangential_stiffness_n_m = 1e5
normal_damping_ratio = 0.1
tangential_damping_ratio = 0.1
friction = 0.7
[excitation]
kind = "full_sine"
frequency_hz = 3
pga_m_s2 = 4
"""


def write_tests(folder):
    """A table of outcomes of two drums, tests.csv, and the study that it needs, two_drums.toml."""
    (folder / "two_drums.toml").write_text(TWO_DRUMS)
    (folder / "tests.csv").write_text("pga_m_s2,frequency_hz,fell\n8,3,no\n14,3,yes\n20,4,yes\n12,5,no\n")


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
