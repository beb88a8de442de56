"""Calibrations: the results of the program."""

import json
import os
import pathlib
import signal
import tomllib

import pytest

import stylobate
from conftest import TWO_DRUMS, output_of, program, write_tests

HOLD = ["contact.tangential_stiffness_n_m", "contact.tangential_damping_ratio", "contact.normal_damping_ratio"]
HOLD_WORDS = [word for key in HOLD for word in ("--hold", key)]
OF_FILES = ("seconds", "results", "calibrated_study", "measured")


@pytest.fixture
def table(folder):
    write_tests(folder)
    return folder / "tests.csv"


def steady(calibration):
    return {name: value for name, value in calibration.items() if name not in OF_FILES}


def test_it_is_that_of_the_program(table):
    said = json.loads(output_of("calibrate", "tests.csv", "--study", "two_drums.toml", *HOLD_WORDS, "--form", "area,points",
                                "--fit", "contact.friction=0.4:0.9", "-o", "program.h5", "--json", "--quiet"))
    lines = []
    found = stylobate.calibrate(table, "two_drums.toml", hold=HOLD, forms=["area", "points"],
                                fit={"contact.friction": (0.4, 0.9)}, threads=2, progress=lines.append)
    assert steady(found.to_dict()) == steady(said) and lines
    assert found.evidence == "outcomes" and found.best.form == said["best_form"]
    assert [form.form for form in found.forms] == ["area", "points"]
    for form, want in zip(found.forms, said["forms"]):
        assert form.score == want["score"] and form.start_score == want["nominal_score"]
        assert form.held_out.nats == want["held_out_gain"]["nats"]
        assert [p.key for p in form.parameters] == [p["key"] for p in want["parameters"]]
        for p, w in zip(form.parameters, want["parameters"]):
            assert (p.start, p.value, p.lower, p.upper) == (w["start"], w["value"], w["low"], w["high"])
            assert p.range == (w["range_low"], w["range_high"]) and p.note == w["note"]
            assert (p.determined, p.effective) == (w["determined"], w["effective"])
            assert (p.bounded_below, p.bounded_above) == (w["bounded_below"], w["bounded_above"])
        assert [(r.run, r.motion_id, r.units, r.start, r.calibrated) for r in form.runs] == [
            (r["run"], r["motion_id"], r["units"], r["nominal_score"], r["calibrated_score"]) for r in want["runs"]]
    assert found.parameters["contact.friction"].range == (0.4, 0.9)
    assert found.notes == said["notes"] and found.parameter_sets == said["parameter_sets"]
    assert found.calibrated_study == stylobate.Study.from_toml("program_calibrated.toml")
    assert "\n  Contact form area\n" in found.text() and found.seconds > 0
    assert repr(found) == f"<Calibration: 2 parameters by outcomes, contact form {found.best.form}>"
    found.write("python.h5")
    program("report", "python.h5", "-o", "page.html", "--quiet")
    h5py = pytest.importorskip("h5py")
    with h5py.File("python.h5") as python, h5py.File("program.h5") as other:
        assert python.attrs["start_toml"] == other.attrs["start_toml"]
        for path in ("parameters/value", "parameters/high", "profile/score", "runs/calibrated_score"):
            assert (python["forms/points"][path][()] == other["forms/points"][path][()]).all(), path


def sets_in(line):
    """Of a line of progress: "scan: 17 of at most 216 parameter sets"; the first one is done alone."""
    return int(line.split(": ")[1].split(" of ")[0])


def brief(table, **more):
    return stylobate.calibrate(table, tomllib.loads(TWO_DRUMS), hold=HOLD, held_out=False, **more)


def test_a_stopped_one_goes_on(table):
    assert brief(table, cache="python_sets.bin", progress=lambda line: sets_in(line) < 2) is None
    assert pathlib.Path("python_sets.bin").exists()
    found = brief(table, cache="python_sets.bin")
    assert found.restored_sets >= 16 and not pathlib.Path("python_sets.bin").exists()
    assert found.calibrated_study == brief(table).calibrated_study
    assert found.best.held_out is None and found.best.score == sum(run.calibrated for run in found.best.runs)


def test_ctrl_c_keeps_what_is_done(table):
    sent = []

    def interrupt(line):
        if sets_in(line) > 1 and not sent:
            sent.append(line)
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        brief(table, cache="sets.bin", threads=1, progress=interrupt)
    assert brief(table, cache="sets.bin").restored_sets >= 16


def test_bad_input_has_the_message_of_the_program(table):
    pathlib.Path("no.h5").write_text("nothing")
    for name in ("no.h5", "none.h5", "two_drums.toml", "tests.csv"):
        said = program("calibrate", name, "-o", "c.h5", status=2)
        with pytest.raises(stylobate.InputError) as error:
            stylobate.calibrate(name)
        assert f"stylobate: {error.value}\n" == said
    for words, wanted in ((["--fit", "contact.frction"], {"fit": "contact.frction"}),
                          (["--fit", "contact.friction=0.9:0.3"], {"fit": {"contact.friction": (0.9, 0.3)}}),
                          (["--hold", "contact.damping"], {"hold": "contact.damping"})):
        said = program("calibrate", "tests.csv", "--study", "two_drums.toml", "-o", "c.h5", *words, status=2)
        with pytest.raises(stylobate.InputError) as error:
            stylobate.calibrate("tests.csv", "two_drums.toml", **wanted)
        assert f"stylobate: {error.value}\n" == said
    for wanted, message in (({"forms": "point"}, "Did you mean points"),
                            ({"forms": 3}, "forms = 3 is no list of texts"),
                            ({"hold": [3]}, r"hold = \[3\] is no list of texts"),
                            ({"fit": {"contact.friction": 0.5}}, "'contact.friction' = 0.5 is no range"),
                            ({"threads": -1}, "threads = -1 is not a whole number"),
                            ({"cache": "two_drums.toml"}, "keeps no parameter sets of a calibration")):
        with pytest.raises(stylobate.InputError, match=message):
            stylobate.calibrate("tests.csv", "two_drums.toml", **wanted)
    assert pathlib.Path("two_drums.toml").read_text() == TWO_DRUMS
    assert sorted(os.listdir()) == ["no.h5", "tests.csv", "two_drums.toml"]
