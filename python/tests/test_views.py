"""What notebooks show: every class has it, well-formed, without scripts and without anything from elsewhere."""

import html.parser
import os
import pathlib
import re
import shutil
import xml.etree.ElementTree

import pytest

import stylobate
from conftest import INPUTS, SMALL_SURFACE, SOURCES, write_tests
from stylobate import _core, _view

HAZARD = "k0=1e-3,k=3,measure=pga,sigma_ln=0.4"
HOSTILE = "<script>alert(1)</script> & \"'\x00\x1f\ud800"
SVG = "{http://www.w3.org/2000/svg}"


class Elements(html.parser.HTMLParser):
    """Names and attributes of all elements."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.found.append((tag, dict(attributes)))


def checked(thing):
    """The tree of its view, and its text."""
    text = thing._repr_html_()
    for tag, attributes in Elements(text).found:
        assert tag not in ("script", "link", "img", "object", "embed", "base", "meta", "a", "iframe"), tag
        for name, value in attributes.items():
            assert not name.startswith("on") and name not in ("href", "src", "xlink:href", "srcset"), name
    assert not re.search(r"url\s*\((?!#)|@import|https?:(?!//www\.w3\.org/2000/svg)", text)
    assert len(text) < 250_000
    tree = xml.etree.ElementTree.fromstring(text)
    return tree, "".join(tree.itertext())


def figures(thing):
    return len(list(checked(thing)[0].iter(SVG + "svg")))


def public_classes():
    classes = [getattr(stylobate, name) for name in stylobate.__all__ if isinstance(getattr(stylobate, name), type)]
    return [cls for cls in classes if not issubclass(cls, Exception)]


@pytest.mark.parametrize("cls", public_classes(), ids=lambda cls: cls.__name__)
def test_every_class_has_a_view(cls):
    assert callable(cls._repr_html_)
    if cls not in (stylobate.Page, stylobate.Answer):
        assert cls._view is not _view.Shown._view


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder with a comparison, small_comparison.h5, of small.h5."""
    folder = tmp_path_factory.mktemp("views")
    shutil.copy(SOURCES / "tests" / "library" / "small_fragility.toml", folder / "small.toml")
    stylobate.compare(folder / "small.toml", folder=folder).write(folder / "small_comparison.h5")
    write_tests(folder)
    return folder


def test_a_surface_and_its_realizations(small_surface):
    result = stylobate.run(small_surface)
    share = result.share()
    tree, said = checked(result)
    assert f"{share.count} of {share.trials}" in said and "moving" in said
    cells = [each for each in tree.iter(SVG + "rect") if "data-cell" in each.attrib]
    assert len(cells) == result.surface().probability.size
    assert f"{share.count} of {share.trials}" in checked(share)[1]
    replay = result.replay(17)
    assert figures(replay) == 5 and replay.outcome["state"] in checked(replay)[1]  # four snapshots, displacements
    assert small_surface.kind in checked(small_surface)[1] and figures(small_surface) == 1


def test_a_structure_in_space():
    study = stylobate.Study.from_toml(INPUTS / "round_column.toml", SMALL_SURFACE)
    result = stylobate.run(study)
    assert figures(result) == 1
    replay = result.replay(result.count - 1)
    assert figures(replay) == 6 and "obliquely" in checked(replay)[1]  # displacements along x and along z


def test_a_run_that_was_stopped_and_a_file_that_has_gone(small_surface, folder):
    long = stylobate.Study.from_toml(INPUTS / "small_scale_column.toml")
    assert "so far" in checked(stylobate.run(long, progress=lambda progress: False))[1]
    result = stylobate.run(small_surface, "here.h5")
    pathlib.Path("here.h5").unlink()
    assert "here.h5" in checked(result)[1]


@pytest.mark.parametrize("name, settings, words", [
    ("rare_collapse", {"rare.samples": 200, "rare.repeats": 5}, "Independent estimates"),
    ("sensitivity_column", {"sensitivity.samples": 16}, "normal_stiffness"),
    ("monument_past", {"study.realizations": 4, "survival.events": 1}, "stands probability"),
    ("small_scale_column_adaptive", {"surface.adaptive.budget": 400, "surface.frequency_hz.count": 3,
                                     "surface.pga_m_s2.count": 3}, "Probability of collapse"),
])
def test_other_kinds(name, settings, words):
    result = stylobate.run(stylobate.Study.from_toml(INPUTS / f"{name}.toml", settings))
    assert figures(result) == 1 and words in checked(result)[1]
    for table in result.tables().values():
        checked(table)


def test_answers(place):
    assert figures(stylobate.Result(place / "small.h5")) == 1
    found = stylobate.Comparison(place / "small_comparison.h5")
    rows = found.rows
    at = list(zip(rows["variant"], rows["limit_state"], rows["place"])).index(("slender", "collapse", "all"))
    assert figures(found) == 1 and f"slender {rows['difference'][at]:.4g}" in checked(found)[1]
    assert "more rows" in checked(rows)[1]
    for table in found.tables().values():
        checked(table)
    for file in ("small.h5", "small_comparison.h5"):
        risk = stylobate.risk(place / file, HAZARD, years=[100])
        assert figures(risk) == 1 and "100 years" in checked(risk)[1]
    page = stylobate.report(place / "small.h5")
    ((tag, attributes),) = Elements(page._repr_html_()).found
    assert tag == "iframe" and attributes["srcdoc"] == page.html and attributes["sandbox"] == "allow-scripts"


def test_a_past(folder):
    settings = SMALL_SURFACE | {"study.kind": "survival", "survival.monuments": 20,
                                "survival.observed": {"tolerance_m": 0.01},
                                "surface.pga_m_s2": {"from": 4.0, "to": 12.0, "count": 3}}
    for number in (1, 2):
        study = stylobate.Study.from_toml(INPUTS / "small_scale_column.toml", settings | {"survival.structure": number})
        stylobate.run(study, f"{number}.h5")
    past = stylobate.past("1.h5", "2.h5")
    assert figures(past) == 1 and "together: shaking is excluded" in checked(past)[1]


def test_a_check_and_what_it_has(small_surface):
    check = small_surface.check(pilot=16, trial_seconds=0.2, law_seconds=0)
    said = checked(check)[1]
    assert figures(check) == 1 and "drum" in said
    for spot in check.weak_spots:
        assert spot.remedy in said
        checked(spot)
    for value in (check.pilot, check.trial, check.time):
        assert value is None or checked(value)
    accurate = stylobate.Study.from_toml(INPUTS / "small_scale_column.toml", {**SMALL_SURFACE, "run.accuracy": 0.1})
    for chosen in accurate.check(trial_seconds=0).chosen:
        assert chosen.key in checked(chosen)[1]


def test_measured_data(place):
    found = stylobate.calibrate(place / "tests.csv", place / "two_drums.toml", fit={"contact.friction": (0.4, 0.9)}, hold=[
        "contact.tangential_stiffness_n_m", "contact.tangential_damping_ratio", "contact.normal_damping_ratio"])
    friction = found.parameters["contact.friction"]
    assert f"{friction.start:.4g}" in checked(found)[1] and f"{friction.value:.4g}" in checked(friction)[1]
    for thing in (found.best, found.best.held_out, *found.best.runs):
        assert thing is None or checked(thing)
    campaigns = sorted(pathlib.Path(os.environ.get("STYLOBATE_HIDDEN_CAMPAIGNS", "nowhere")).glob("*.h5"))
    if campaigns:
        diagnosis = stylobate.diagnose(campaigns[0], nulls=0)
        assert diagnosis.verdict_text in checked(diagnosis)[1]
        for cause in diagnosis.causes:
            assert cause.mechanism in checked(cause)[1]


def test_records_and_progress(small_surface):
    record = stylobate.Record.from_samples([0.3 * (-1) ** (i // 20) for i in range(400)], 0.01, HOSTILE[:-1])
    assert figures(record) == 1 and "<script>" in checked(record)[1]  # as text
    assert "PGA 0.3 m/s²" in checked(record.intensity())[1]
    seen = []
    stylobate.run(small_surface, progress=seen.append)
    assert f"{seen[-1].done} of" in checked(seen[-1])[1]


def test_texts_of_users_are_escaped(small_surface):
    class Made(_view.Shown):
        def _view(self):
            return (_view.View(HOSTILE).note(HOSTILE).facts({HOSTILE: HOSTILE}).table([HOSTILE], [[HOSTILE]])
                    .more(HOSTILE, HOSTILE).figure(_view.chart("<b>", "<i>", "&", [_view.line(
                        [0, 1], [0, float("nan")], name="</svg><script>")], x_ticks=["<u>", "\x01"]), caption=HOSTILE))

    tree, said = checked(Made())
    assert said.count("<script>alert(1)</script> & \"'") == 9 and "</svg><script>" in said
    small_surface.set("study.title", "</pre><script>alert(1)</script>")
    assert "<script>alert(1)</script>" in checked(small_surface)[1]


def test_a_figure_with_lists_that_do_not_fit_is_refused():
    with pytest.raises(stylobate.InputError, match='"drums" of a figure has 2 x, 1 y'):
        _view.chart("", "", "", [_view.line([0, 1], [0], name="drums")])
    with pytest.raises(stylobate.InputError, match="1 lower and 0 upper"):
        _view.chart("", "", "", [_view.line([0], [0], [0])])


def test_values_of_c_have_a_view_of_their_own():
    values = {cls for cls in public_classes() if cls.__module__ == "stylobate._core"}
    assert values and all("_view" in vars(cls) for cls in values) and _core.Share in values
