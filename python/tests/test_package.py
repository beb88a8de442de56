"""Docstrings, stubs and examples of the package; diagnoses."""

import ast
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import stylobate
from conftest import INPUTS, SMALL_FRAGILITY, SMALL_SURFACE, SOURCES, program, write_tests

EXAMPLES = SOURCES / "python" / "examples"


def members(thing):
    """Of a class, and of its bases up to one that is public itself."""
    names = set(vars(thing))
    for base in thing.__mro__[1:]:
        if base.__name__ in stylobate.__all__ or not base.__module__.startswith("stylobate"):
            break
        names |= set(vars(base))
    return {name for name in names if not name.startswith("_")}


def is_read_only(node):
    """NAME: Final[TYPE], a property in the stubs."""
    return (isinstance(node, ast.AnnAssign) and isinstance(node.annotation, ast.Subscript)
            and getattr(node.annotation.value, "id", "") == "Final")


def names_of(function):
    """Of the parameters of a function in the stubs."""
    arguments = function.args
    return [a.arg for a in [*arguments.args, *filter(None, [arguments.vararg]), *arguments.kwonlyargs]]


def test_stubs_are_those_of_the_package():
    tree = ast.parse((pathlib.Path(stylobate.__file__).parent / "__init__.pyi").read_text())
    stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(stubs) == set(stylobate.__all__)
    for name, stub in stubs.items():
        thing = getattr(stylobate, name)
        if isinstance(stub, ast.FunctionDef):
            assert names_of(stub) == list(inspect.signature(thing).parameters)
            continue
        functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
        public = {name for name in functions if not name.startswith("_")}
        public |= {node.target.id for node in stub.body if is_read_only(node)}
        assert public == members(thing), name
        for function, node in functions.items():
            real = inspect.getattr_static(thing, function)
            if inspect.isfunction(real):
                assert names_of(node) == list(inspect.signature(real).parameters), function


def test_everything_that_is_written_in_python_is_described():
    for name in stylobate.__all__:
        thing = getattr(stylobate, name)
        if getattr(thing, "__module__", "").startswith("stylobate._core"):
            continue
        assert thing.__doc__, name
        if inspect.isclass(thing):
            for member in members(thing):
                assert getattr(thing, member).__doc__, f"{name}.{member}"


def test_the_documentation_has_every_public_name():
    page = (SOURCES / "docs" / "python.md").read_text()
    code = " ".join(re.findall(r"```.*?```|`[^`]*`", page, re.S))
    named = set(re.findall(r"\w+", code))
    tree = ast.parse((pathlib.Path(stylobate.__file__).parent / "__init__.pyi").read_text())
    for declared in tree.body:
        if isinstance(declared, ast.FunctionDef):
            assert {declared.name, *names_of(declared)} <= named, declared.name
        elif isinstance(declared, ast.ClassDef):
            of = {node.name for node in declared.body if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")}
            of |= {node.target.id for node in declared.body if isinstance(node, ast.AnnAssign)}
            assert {declared.name} | of <= named, f"{declared.name}: {of - named}"


@pytest.fixture
def files(folder):
    """A study, results and a record for the examples."""
    record = "\n".join(f"{0.01 * i:.2f} {0.3 * ((i // 25) % 2 * 2 - 1)}" for i in range(400))
    pathlib.Path("record.txt").write_text(record)
    write_tests(folder)
    study = stylobate.Study.from_toml(INPUTS / "small_scale_column.toml", SMALL_SURFACE)
    pathlib.Path("column.toml").write_text(study.text)
    stylobate.run(study, "column.h5")
    stylobate.run(stylobate.Study.from_toml(INPUTS / "fragility_column.toml", SMALL_FRAGILITY), "fragility.h5")
    shutil.copy(SOURCES / "tests" / "library" / "small_fragility.toml", folder / "small.toml")
    stylobate.run("small.toml", "small.h5")
    return folder


ARGUMENTS = {
    "study.py": ["column.toml"],
    "check.py": ["column.toml", "column.png"],
    "run.py": ["column.toml", "new.h5"],
    "surface.py": ["column.h5", "surface.png"],
    "fragility.py": ["fragility.h5", "fragility.png"],
    "replay.py": ["column.h5", "17"],
    "animate.py": ["column.h5", "17", "fall.gif"],
    "record.py": ["record.txt", "g"],
    "compare.py": ["small.toml", "comparison.png"],
    "risk.py": ["small.h5", "k0=1e-3,k=3,measure=pga", "risk.html"],
    "calibrate.py": ["tests.csv", "two_drums.toml"],
    "diagnose.py": None,  # below
}


def run_example(name, *arguments):
    ended = subprocess.run([sys.executable, EXAMPLES / name, *arguments], capture_output=True, text=True,
                           env=os.environ | {"MPLBACKEND": "Agg"})
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


def test_every_example_is_run_here():
    assert {file.name for file in EXAMPLES.glob("*.py")} == set(ARGUMENTS)


@pytest.mark.parametrize("name", [name for name, arguments in ARGUMENTS.items() if arguments is not None])
def test_example(name, files):
    for package in ("matplotlib", "xarray", "pandas"):
        pytest.importorskip(package)
    assert run_example(name, *ARGUMENTS[name])
    for word in ARGUMENTS[name]:
        if word.endswith((".png", ".gif", ".h5", ".html")):
            assert pathlib.Path(word).stat().st_size > 1000


def test_diagnosis_of_a_campaign(folder):
    campaigns = sorted(pathlib.Path(os.environ.get("STYLOBATE_HIDDEN_CAMPAIGNS", "nowhere")).glob("*.h5"))
    if not campaigns:
        pytest.skip("no virtual campaign was generated (STYLOBATE_HIDDEN_CAMPAIGNS)")
    lines = []
    found = stylobate.diagnose(campaigns[0], nulls=0, progress=lines.append)
    assert found.verdict in ("none", "named", "unexplained") and lines
    assert found.verdict_text and found.text().startswith("DIAGNOSIS")
    assert found.to_dict()["verdict"] == found.verdict and len(found.causes) == len(found.to_dict()["causes"])
    found.write("diagnosis.h5")
    program("report", "diagnosis.h5", "-o", "page.html", "--quiet")
    assert stylobate.diagnose(campaigns[0], nulls=0, progress=lambda line: False) is None
    assert found.verdict in run_example("diagnose.py", campaigns[0], "0")


def test_a_campaign_that_is_none_has_the_message_of_the_program(folder):
    said = program("diagnose", "nothing.h5", status=2)
    with pytest.raises(stylobate.InputError, match="nulls = -1 is not a whole number"):
        stylobate.diagnose("nothing.h5", nulls=-1)
    with pytest.raises(stylobate.InputError) as error:
        stylobate.diagnose("nothing.h5")
    assert f"stylobate: {error.value}\n" == said
