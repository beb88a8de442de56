"""The example notebooks: valid, without outputs in the repository, and every cell runs. Where Jupyter is installed it
runs them too; else a small runner alone does."""

import ast
import json

import pytest

from conftest import SOURCES
from test_views import checked

NOTEBOOKS = sorted((SOURCES / "python" / "examples").glob("*.ipynb"))


def run_cells(notebook):
    """Runs the code as Jupyter does; the values with which cells end."""
    names, shown = {"__name__": "__main__"}, []
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), cell["id"])
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, cell["id"], "exec"), names)
        if last is not None:
            shown.append(eval(compile(ast.Expression(last.value), cell["id"], "eval"), names))
    return names, [value for value in shown if value is not None]


def test_there_are_notebooks():
    assert [file.name for file in NOTEBOOKS] == ["first_surface.ipynb"]


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_the_format_is_that_of_notebooks(file):
    """By the rules of nbformat 4.5, as far as they concern what is written by hand; and outputs are not kept."""
    notebook = json.loads(file.read_text())
    assert notebook["nbformat"] == 4 and notebook["nbformat_minor"] == 5
    assert set(notebook) == {"cells", "metadata", "nbformat", "nbformat_minor"}
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)
    for cell in notebook["cells"]:
        assert isinstance(cell["source"], list) and all(isinstance(line, str) for line in cell["source"])
        kept = {"cell_type", "id", "metadata", "source"}
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
            kept |= {"outputs", "execution_count"}
        else:
            assert cell["cell_type"] == "markdown"
        assert set(cell) == kept


def test_the_first_notebook_shows_what_it_promises(folder):
    for package in ("xarray", "pandas"):
        pytest.importorskip(package)
    names, shown = run_cells(json.loads((SOURCES / "python" / "examples" / "first_surface.ipynb").read_text()))
    kinds = [type(value).__name__ for value in shown]
    assert kinds == ["Study", "Result", "Replay", "Comparison", "Result", "Replay"]
    for value in shown:
        tree, said = checked(value)
        assert list(tree.iter("{http://www.w3.org/2000/svg}svg")), said
    assert names["in_space"].dimensions == 3 and 0 < names["result"].share().count < names["result"].count
    assert shown[2].outcome["state"] == shown[5].outcome["state"] == "collapsed"


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_jupyter_runs_it(file, folder):
    nbformat = pytest.importorskip("nbformat", reason="nbformat (python3-nbformat) is not installed")
    nbclient = pytest.importorskip("nbclient", reason="nbclient (python3-nbclient) is not installed")
    pytest.importorskip("ipykernel", reason="ipykernel (python3-ipykernel) is not installed")
    notebook = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3",
                            resources={"metadata": {"path": str(folder)}}).execute()
    html = [output.data["text/html"] for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs
            if "text/html" in output.get("data", {})]
    assert len(html) == 6 and all("<svg" in text for text in html)
