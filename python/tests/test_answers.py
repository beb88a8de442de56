"""Comparisons, risk estimates, pasts and pages: those of the program."""

import json
import pathlib
import shutil

import numpy
import pytest

import stylobate
from conftest import SMALL_SURFACE, SOURCES, INPUTS, output_of, program

HAZARD = "k0=1e-3,k=3,measure=pga,sigma_ln=0.4"


@pytest.fixture
def compared(folder):
    """small.toml, a fragility study with variants, and its comparison by the program."""
    shutil.copy(SOURCES / "tests" / "library" / "small_fragility.toml", folder / "small.toml")
    return json.loads(output_of("compare", "small.toml", "--json", "--quiet"))


def without(said, *names):
    return {name: value for name, value in said.items() if name not in names}


def test_a_comparison_is_that_of_the_program(compared):
    lines = []
    pathlib.Path("own").mkdir()
    found = stylobate.compare("small.toml", folder="own", threads=2, progress=lines.append)
    assert len(lines) >= 3 and found.to_dict() == without(compared, "comparison", "complete")
    rows = found.rows
    assert rows.units["difference"] == "" and rows["both"].dtype == numpy.uint64 and not rows["both"].flags.writeable
    for row in range(len(rows["variant"])):
        if rows["place"][row] != "all":
            continue
        variant = next(v for v in compared["variants"] if v["name"] == rows["variant"][row])
        overall = variant["limit_states"][rows["limit_state"][row]]["overall"]
        assert rows["difference"][row] == overall["difference"] and rows["difference_upper"][row] == overall["upper"]
        assert rows["verdict"][row] == overall["verdict"] and rows["both"][row] == overall["both"]
    found.write("own.h5")
    assert pathlib.Path("own.h5").read_bytes() == pathlib.Path("small_comparison.h5").read_bytes()
    again = stylobate.Comparison("own.h5")
    assert again.text() == found.text() and again.tables().keys() == found.tables().keys()
    assert repr(again) == f"<Comparison: {len(rows['variant'])} rows>" and "<th>verdict</th>" in again._repr_html_()
    with pytest.raises(stylobate.InputError, match="margin"):
        stylobate.compare("small.toml", margin=2)


def test_a_risk_is_that_of_the_program(compared):
    for file, written in (("small.h5", "small_risk.h5"), ("small_comparison.h5", "small_comparison_risk.h5")):
        said = json.loads(output_of("risk", file, "--hazard", HAZARD, "--years", "10,50", "--json", "--quiet"))
        found = stylobate.risk(file, HAZARD, years=[10, 50])
        assert found.to_dict() == without(said, "written")
        found.write("own.h5")
        assert pathlib.Path("own.h5").read_bytes() == pathlib.Path(written).read_bytes()
        assert stylobate.Risk("own.h5").text() == found.text()
    rows = stylobate.risk("small.h5", HAZARD, years=[10]).rows
    assert rows["probability_10_years"] == pytest.approx(1 - numpy.exp(-10 * rows["annual_frequency"]), abs=1e-15)
    with pytest.raises(stylobate.InputError, match="years"):
        stylobate.risk("small.h5", HAZARD, years=[-1])


def test_tables_and_pictures(compared):
    pandas, plt = pytest.importorskip("pandas"), pytest.importorskip("matplotlib.pyplot")
    comparison, risk = stylobate.Comparison("small_comparison.h5"), stylobate.risk("small_comparison.h5", HAZARD)
    frame = risk.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame.attrs["units"]["base_annual_frequency"] == "1/year"
    neutral = frame[frame.variant == "neutral"]
    assert len(neutral) and (neutral.annual_frequency_change == 0).all()
    assert len(comparison.plot().get_yticks()) == 2 and len(risk.plot().get_yticks()) == len(frame)
    plt.close("all")
    with pytest.raises(stylobate.InputError, match="no limit state 'fallen'"):
        comparison.plot(limit_state="fallen")


def test_a_page_is_that_of_the_program(compared):
    program("report", "small_comparison.h5", "-o", "program.html")
    page = stylobate.report("small_comparison.h5")
    page.write("own.html")
    assert pathlib.Path("own.html").read_bytes() == pathlib.Path("program.html").read_bytes()
    assert page.html.startswith("<!") and page._repr_html_().startswith("<iframe srcdoc=")
    with pytest.raises(stylobate.InputError, match="contains no realizations"):
        stylobate.report("small_comparison.h5", animate=1)


def test_a_past_is_that_of_the_program(folder):
    plt = pytest.importorskip("matplotlib.pyplot")
    settings = SMALL_SURFACE | {"study.kind": "survival", "survival.monuments": 20,
                                "survival.observed": {"tolerance_m": 0.01}, "study.realizations": 12,
                                "surface.pga_m_s2": {"from": 4.0, "to": 12.0, "count": 3}}
    for number, name in ((1, "a.h5"), (2, "b.h5")):
        study = stylobate.Study.from_toml(INPUTS / "small_scale_column.toml", settings | {"survival.structure": number})
        stylobate.run(study, name)
    said = json.loads(output_of("past", "a.h5", "b.h5", "--json"))
    past = stylobate.past("a.h5", "b.h5")
    assert past.to_dict() == said and past.rows["structure"][:3] == ["a.h5", "b.h5", "together"]
    assert past.rows["weaker_m_s2"][0] == said["structures"][0]["exclusion"]["weaker_m_s2"]["value"]
    assert len(past.plot().get_lines()) == 3
    plt.close("all")
    with pytest.raises(stylobate.InputError, match="two structures"):
        stylobate.past("a.h5")
