"""Checks before a run."""

import json
import os
import pathlib
import signal
import threading
import time

import pytest

import stylobate
from conftest import INPUTS, SMALL_SURFACE, output_of, program

COLUMN = INPUTS / "small_scale_column.toml"


def steady(text):
    """Without the memory of the process."""
    return [line for line in text.splitlines() if not line.startswith("memory: ")]


@pytest.mark.parametrize("name, settings", [
    ("small_scale_column", SMALL_SURFACE),
    ("rigid_column", {"run.accuracy": 0.2}),
    ("rare_collapse", {}),
    ("free_rocking", {}),
])
def test_it_is_that_of_the_program(folder, name, settings):
    file = INPUTS / f"{name}.toml"
    brief = ("--pilot", "0", "--trial-seconds", "0")
    said = json.loads(output_of("check", file, *brief, "--json", "--quiet", settings=settings))
    check = stylobate.Study.from_toml(file, settings).check(trial_seconds=0)
    told = check.to_dict()
    assert told.pop("memory_bytes") > 1e6 and said.pop("memory_bytes") > 1e6
    assert told == said
    assert steady(check.text()) == steady(output_of("check", file, *brief, settings=settings))
    for name in ("kind", "form", "realizations", "cells", "blocks", "free_blocks", "file_bytes"):
        assert getattr(check, name) == said[name], name
    assert check.at_most == said["realizations_at_most"]
    assert check.step_s == (said["step_s"]["low"], said["step_s"]["high"])
    assert check.longest_steps == (said["longest_steps"]["low"], said["longest_steps"]["high"])
    assert [(w.name, w.text, w.remedy) for w in check.weak_spots] == [
        (w["name"], w["text"], w["todo"]) for w in said["weak_spots"]]
    assert [(c.key, c.value, c.reason) for c in check.chosen] == [
        (c["key"], c["value"], c["reason"]) for c in said["chosen"]]
    assert (check.trial, check.time, check.pilot, check.warnings) == (None, None, None, [])
    assert repr(check).startswith(f"<Check: {check.kind}, ")


def test_trial_and_pilot(small_surface):
    lines = []
    small_surface.set("run.accuracy", 0.2)
    check = small_surface.check(pilot=16, threads=1, progress=lines.append)
    assert check.trial.whole and check.trial.realizations == check.trial.valid == 18
    collapsed = stylobate.run(small_surface).share().count
    assert check.trial.collapsed == collapsed
    assert check.time.range_s[0] <= check.time.seconds <= check.time.range_s[1]
    assert check.time.steps[0] <= check.time.steps[1] and not check.time.at_most
    assert check.time.block_steps == check.to_dict()["time"]["block_steps"]
    assert check.pilot.realizations == 16 and not check.pilot.accuracy_missed
    assert check.pilot.difference == (check.pilot.collapsed - check.pilot.collapsed_finer) / 16
    assert check.pilot.standard_error == check.to_dict()["its_standard_error"]
    assert "wide_interval" in {spot.name for spot in check.weak_spots}
    assert lines and all(isinstance(line, str) for line in lines)
    assert "wide_interval" in check.text()


def test_drawing(folder):
    check = stylobate.Study.from_toml(INPUTS / "doric_column.toml").check(trial_seconds=0)
    try:
        check.draw(folder / "column.svg")
    except stylobate.InputError as error:
        if "librsvg" in str(error):
            pytest.skip(str(error))
        raise
    program("check", INPUTS / "doric_column.toml", "--pilot", 0, "--trial-seconds", 0, "-o", "program.svg", "--quiet")
    assert pathlib.Path("column.svg").read_bytes() == pathlib.Path("program.svg").read_bytes()
    with pytest.raises(stylobate.InputError, match="is a .png, .svg or .pdf file"):
        check.draw("column.txt")


def test_what_can_hardly_be_meant_is_a_warning():
    study = stylobate.Study.from_toml(INPUTS / "small_scale_monolith.toml", {"surface.pga_m_s2.to": 40.0})
    with pytest.warns(UserWarning, match="If it is intended: study.allow") as caught:
        check = study.check(trial_seconds=0)
    assert [str(warning.message) for warning in caught] == check.warnings
    assert caught[0].filename == __file__


def test_a_record_shakes_the_base():
    study = stylobate.Study.from_toml(INPUTS / "doric_column.toml")
    still = stylobate.Record.from_samples([0.001 * (i % 2) for i in range(1000)], 0.01)
    with pytest.raises(stylobate.InputError, match="record is a str"):
        study.check(record="a.AT2")
    single = stylobate.Study.from_toml(INPUTS / "free_rocking.toml", {"initial": {"tilt_rad": 0.0}})
    assert "below_limit" in {spot.name for spot in single.check(trial_seconds=0, record=still).weak_spots}


def test_bad_input_has_the_message_of_the_program(folder, small_surface):
    said = program("check", COLUMN, "--pilot", 3, settings=SMALL_SURFACE, status=2)
    with pytest.raises(stylobate.InputError) as error:
        small_surface.check(pilot=3)
    assert f"stylobate: {error.value}\n" == said
    rare = INPUTS / "rare_collapse.toml"
    said = program("check", rare, "--pilot", 16, status=2)
    with pytest.raises(stylobate.InputError) as error:
        stylobate.Study.from_toml(rare).check(pilot=16)
    assert f"stylobate: {error.value}\n" == said
    for wrong, message in (({"pilot": -1}, "pilot = -1 is not a whole number"),
                           ({"pilot": 2.5}, "pilot = 2.5 is not a whole number"),
                           ({"threads": "two"}, "threads = 'two' is not a whole number"),
                           ({"trial_seconds": "two"}, "trial_seconds = 'two' is not a number"),
                           ({"trial_seconds": -1}, "--trial-seconds -1: a trial takes 0 to 3600 s"),
                           ({"trial_seconds": float("nan")}, "a trial takes 0 to 3600 s"),
                           ({"simd": "sse9"}, "--simd sse9: not available")):
        with pytest.raises(stylobate.InputError, match=message):
            small_surface.check(**wrong)


def test_progress_stops_it_and_what_it_raises_comes_out(small_surface):
    small_surface.set("study.realizations", 10_000)
    assert small_surface.check(trial_seconds=3600, progress=lambda line: False) is None
    lines = []

    def until_the_pilot(line):
        lines.append(line)
        return not line.startswith("pilot of 10000")

    assert small_surface.check(trial_seconds=0, pilot=10_000, progress=until_the_pilot) is None
    assert lines == ["weak spots", "pilot of 10000 realizations, run twice"]  # none is lost, none comes later

    def fail(line):
        raise ZeroDivisionError("of the caller")

    with pytest.raises(ZeroDivisionError, match="of the caller"):
        small_surface.check(trial_seconds=3600, progress=fail)


@pytest.mark.parametrize("wanted", [{"trial_seconds": 3600}, {"trial_seconds": 0, "pilot": 1_000_000}],
                         ids=["trial", "pilot"])
def test_ctrl_c_and_other_threads(small_surface, wanted):
    small_surface.set("study.realizations", 100_000)
    ticks = []

    def interrupt():
        while len(ticks) < 100:
            time.sleep(0.001)
            ticks.append(None)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    with pytest.raises(KeyboardInterrupt):
        thread.start()
        small_surface.check(threads=1, **wanted)
    thread.join()
    assert len(ticks) == 100
