"""Runs and results: the bytes of the program, interrupted or not."""

import csv
import gc
import os
import pathlib
import signal
import threading
import tomllib

import numpy
import pytest

import stylobate
from conftest import INPUTS, SMALL_FRAGILITY, SMALL_SURFACE, program

pandas = pytest.importorskip("pandas")
xarray = pytest.importorskip("xarray")
COLUMN = INPUTS / "small_scale_column.toml"


@pytest.mark.parametrize("name, settings", [
    ("small_scale_column", SMALL_SURFACE),
    ("small_scale_column", SMALL_SURFACE | {"output.realizations": "none"}),
    ("fragility_column", SMALL_FRAGILITY),
    ("free_rocking", {}),
    ("rare_collapse", {"rare.samples": 200, "rare.repeats": 5}),
])
def test_files_have_the_bytes_of_the_program(folder, name, settings):
    program("run", INPUTS / f"{name}.toml", "-o", "program.h5", "--quiet", settings=settings)
    study = stylobate.Study.from_toml(INPUTS / f"{name}.toml", settings)
    result = stylobate.run(study, "python.h5", threads=2)
    assert result.complete and result.path == str(folder / "python.h5")
    assert pathlib.Path("python.h5").read_bytes() == pathlib.Path("program.h5").read_bytes()


def test_a_stopped_run_continues_to_the_same_bytes(folder, small_surface):
    program("run", COLUMN, "-o", "program.h5", "--quiet", settings=SMALL_SURFACE | {"study.realizations": 200})
    small_surface.set("study.realizations", 200)
    part = stylobate.run(small_surface, "python.h5", threads=1, progress=lambda news: False)
    assert not part.complete and part.count < 1200
    whole = stylobate.run(small_surface, "python.h5")
    assert whole.complete and whole.count == 1200
    assert pathlib.Path("python.h5").read_bytes() == pathlib.Path("program.h5").read_bytes()


def test_ctrl_c_keeps_what_has_ended(folder, small_surface):
    small_surface.set("study.realizations", 400)
    calls = []

    def interrupt(news):
        calls.append(news)
        os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        stylobate.run(small_surface, "python.h5", progress=interrupt)
    assert len(calls) == 1
    part = stylobate.Result("python.h5")
    assert not part.complete and part.count < part.study.realizations


def test_what_progress_raises_comes_out(small_surface):
    def fail(news):
        assert news.total == 18
        raise ZeroDivisionError("of the caller")

    with pytest.raises(ZeroDivisionError, match="of the caller"):
        stylobate.run(small_surface, progress=fail)


def test_other_threads_go_on(small_surface):
    small_surface.set("study.realizations", 20)
    ticks, ended = [], threading.Event()

    def tick():
        while not ended.wait(0.001):
            ticks.append(None)

    thread = threading.Thread(target=tick)
    thread.start()
    before = len(ticks)
    stylobate.run(small_surface, threads=1)
    during = len(ticks) - before
    ended.set()
    thread.join()
    assert during > 1


def test_realizations_are_those_of_the_exported_table(folder, small_surface):
    result = stylobate.run(small_surface, "a.h5")
    program("export", "a.h5", "--to", "csv", "-o", "tables", "--quiet")
    with open("tables/realizations.csv") as file:
        rows = list(csv.DictReader(file))
    frame = result.realizations()
    assert len(frame) == len(rows) == 18
    frame = frame.reset_index()
    units = result.realizations().attrs["units"]
    for name in rows[0]:
        column = name if name in frame else next(
            c for c in frame if c.startswith("input_") and name.startswith(c.split("[")[0])
            and (c.partition("[")[2] == name.partition("[")[2]))
        for row, value in zip(rows, frame[column]):
            if isinstance(value, str):
                assert row[name] == value
            elif numpy.isnan(value):
                assert row[name] in ("", "nan")
            else:
                assert float(row[name]) == value, name
    assert len(frame.columns) == len(rows[0])
    assert units["collapse_time_s"] == "s" and units["input_normal_stiffness"] == "N/m2"


def test_surface_is_that_of_the_file(folder, small_surface):
    result = stylobate.run(small_surface, "a.h5")
    pytest.importorskip("h5netcdf")
    surface = result.surface()
    with xarray.open_dataset("a.h5", group="surface", engine="h5netcdf") as file:
        for name in ("probability", "lower", "upper", "trials"):
            assert (surface[name].values == file[name].values).all()
        assert (surface.reached.values == file.collapses.values).all()
        assert (surface.pga_m_s2.values == file.pga_m_s2.values).all()
    assert surface.probability.dims == ("frequency_hz", "pga_m_s2")
    assert surface.frequency_hz.attrs["units"] == "Hz" and surface.pga_m_s2.attrs["units"] == "m/s2"
    assert int(result.surface("slid").trials.sum()) == 18
    in_memory = stylobate.run(small_surface)
    assert in_memory.path is None and in_memory.surface().equals(surface)
    assert in_memory.realizations().equals(result.realizations())
    share = result.share()
    assert share.count == (result.realizations().state == "collapsed").sum() and share.trials == 18


def test_fragility_is_that_of_the_file(folder):
    h5py = pytest.importorskip("h5py")
    result = stylobate.run(stylobate.Study.from_toml(INPUTS / "fragility_column.toml", SMALL_FRAGILITY), "a.h5")
    fragility = result.fragility()
    with h5py.File("a.h5") as file:
        stored = file["fragility"]
        for name, of in (("probability", "curve"), ("share", "share"), ("median", "median"), ("dispersion", "dispersion")):
            for end in ("", "_lower", "_upper"):
                numpy.testing.assert_array_equal(fragility[name + end].values, stored[of + end][()])
        numpy.testing.assert_array_equal(fragility.intensity.values, stored["grid"][()])
        assert [name.decode() for name in stored["states"][()]] == list(fragility.limit_state.values)
    assert fragility.intensity.attrs["units"] == "m/s" and fragility.attrs["measure"] == "pgv_m_s"
    with pytest.raises(stylobate.InputError, match="not a fragility study|has no surface"):
        result.surface()


def test_replay_has_the_bits_of_the_ensemble_and_of_the_program(folder, small_surface):
    h5py = pytest.importorskip("h5py")
    result = stylobate.run(small_surface, "a.h5")
    index = int(result.realizations().query("state == 'collapsed'").index[0])
    program("replay", "a.h5", "--realization", index, "-o", "fall.h5", "--quiet")
    replay = result.replay(index)
    with h5py.File("fall.h5") as file:
        stored = file[f"trajectories/{index}"]
        for name in ("time_s", "x_m", "y_m", "theta_rad", "base_x_m", "rest_x_m", "rest_y_m", "half_width_m",
                     "half_height_m"):
            numpy.testing.assert_array_equal(getattr(replay, name), stored[name][()])
            assert not getattr(replay, name).flags.writeable
    assert replay.x_m.shape == (len(replay.time_s), 7)
    for name, values in result.arrays().items():
        if name not in ("state", "invalid_reason"):
            numpy.testing.assert_equal(replay.outcome[name], values[index], name)  # NaN where it still moves
    assert replay.outcome["state"] == "collapsed"
    corners = replay.corners()
    assert corners.shape == (*replay.x_m.shape, 4, 2)
    numpy.testing.assert_allclose(corners.mean(axis=2)[..., 0], replay.x_m, atol=1e-12)
    width = numpy.hypot(*(corners[:, :, 1] - corners[:, :, 0]).transpose(2, 0, 1))
    numpy.testing.assert_allclose(width, numpy.broadcast_to(2 * replay.half_width_m, width.shape), rtol=1e-12)
    assert replay.to_xarray().x_m.attrs["units"] == "m"
    with pytest.raises(stylobate.InputError, match="the study has realizations 0 to 17"):
        result.replay(18)
    for index in (-1, "first"):
        with pytest.raises(stylobate.InputError, match="index = .* is not a whole number"):
            result.replay(index)
    assert result.replay(numpy.int64(2)).outcome["index"] == 2


def test_a_structure_in_space(folder):
    h5py = pytest.importorskip("h5py")
    study = stylobate.Study.from_toml(INPUTS / "round_column.toml", {
        "study.realizations": 2, "surface.frequency_hz": {"from": 0.5, "to": 1.0, "count": 2},
        "surface.pga_m_s2": {"from": 2.0, "to": 8.0, "count": 2}})
    result = stylobate.run(study, "a.h5")
    assert result.dimensions == 3
    columns = set(result.realizations().columns)
    assert {"residual_top_z_m", "max_twist_rad", "fall_azimuth_rad"} <= columns
    assert not {"top_path_m", "sliding_path_m", "rocking_path_rad"} & columns
    program("replay", "a.h5", "--realization", 3, "-o", "one.h5", "--quiet")
    replay = result.replay(3)
    lists = ("time_s", "x_m", "y_m", "z_m", "q_w", "q_x", "q_y", "q_z", "base_x_m", "base_y_m", "base_z_m", "rest_x_m",
             "rest_y_m", "rest_z_m", "half_height_m", "bottom_half_x_m", "bottom_half_z_m", "top_half_x_m",
             "top_half_z_m", "round")
    with h5py.File("one.h5") as file:
        assert file.attrs["format_version"] == 6 and file.attrs["dimensions"] == 3
        for name in lists:
            numpy.testing.assert_array_equal(getattr(replay, name), file[f"trajectories/3/{name}"][()])
    assert replay.dimensions == 3 and not hasattr(replay, "half_width_m")
    assert set(replay.to_xarray().variables) == {*lists, "block"}
    for name, values in result.arrays().items():
        if name not in ("state", "invalid_reason"):
            numpy.testing.assert_equal(replay.outcome[name], values[3], name)
    corners, turns = replay.corners(), replay.rotations()
    assert corners.shape == (*replay.x_m.shape, 8, 3) and turns.shape == (*replay.x_m.shape, 3, 3)
    numpy.testing.assert_allclose(turns @ turns.swapaxes(-1, -2), numpy.broadcast_to(numpy.eye(3), turns.shape),
                                  atol=1e-12)
    middle = numpy.stack([replay.x_m, replay.y_m, replay.z_m], axis=-1)
    numpy.testing.assert_allclose(corners.mean(axis=2), middle, atol=1e-12)
    heights = numpy.linalg.norm(corners[:, :, 4:].mean(axis=2) - corners[:, :, :4].mean(axis=2), axis=-1)
    numpy.testing.assert_allclose(heights, numpy.broadcast_to(2 * replay.half_height_m, heights.shape), rtol=1e-12)
    pytest.importorskip("matplotlib")
    result.animate(3, seconds=0.2).save("fall.gif", writer="pillow")
    assert pathlib.Path("fall.gif").read_bytes().startswith(b"GIF8")


def test_arrays_share_memory_are_read_only_and_keep_their_owner(small_surface):
    result = stylobate.run(small_surface)
    arrays = result.arrays()
    assert numpy.shares_memory(arrays["end_time_s"], result.arrays()["end_time_s"])
    with pytest.raises(ValueError):
        arrays["end_time_s"][0] = 1
    want = {name: values.copy() for name, values in arrays.items()}
    probability = result.surface().probability.values
    assert not probability.flags.writeable
    del result
    gc.collect()
    for _ in range(3):  # memory that was freed would be taken
        stylobate.run(small_surface)
    for name, values in arrays.items():
        numpy.testing.assert_array_equal(values, want[name])


def test_a_result_whose_file_has_gone(folder, small_surface):
    result = stylobate.run(small_surface, "a.h5")
    pathlib.Path("a.h5").rename("b.h5")
    with pytest.raises(stylobate.ResultGone, match="is not there any more"):
        result.surface()
    with pytest.raises(FileNotFoundError):
        result.replay(0)
    pathlib.Path("a.h5").write_text("another one")
    with pytest.raises(stylobate.ResultGone, match="has changed since it was read"):
        result.realizations()
    with pytest.raises(stylobate.InputError, match="not a results file"):
        stylobate.Result("a.h5")
    assert stylobate.Result("b.h5").count == 18


def test_bad_input_has_the_message_of_the_program(folder, small_surface):
    with pytest.raises(stylobate.InputError, match="no such folder"):
        stylobate.run(small_surface, "nowhere/a.h5")
    stylobate.run(small_surface, "a.h5")
    said = program("run", COLUMN, "-o", "a.h5", settings=SMALL_SURFACE | {"study.seed": 2}, status=2)
    small_surface.set("study.seed", 2)
    with pytest.raises(stylobate.InputError) as error:
        stylobate.run(small_surface, "a.h5")
    assert f"stylobate: {error.value}\n" == said
    for threads in (-1, 1.5, "two"):
        with pytest.raises(stylobate.InputError, match="threads = .* is not a whole number, from 0 on"):
            stylobate.run(small_surface, threads=threads)
    with pytest.raises(stylobate.InputError, match="record is a str"):
        stylobate.run(small_surface, record="a.AT2")


def test_too_many_invalid_realizations(folder):
    settings = SMALL_SURFACE | {"run.step_s": 2e-3, "run.allow_step_above_bound": True, "run.max_invalid_fraction": 0.0}
    said = program("run", COLUMN, "-o", "program.h5", "--quiet", settings=settings, status=3)
    with pytest.raises(stylobate.TooManyInvalid) as error:
        stylobate.run(stylobate.Study.from_toml(COLUMN, settings), "program.h5")
    assert said.endswith(f"{str(error.value).replace(str(folder) + '/', '')}\n")
    assert error.value.result.complete and error.value.result.invalid > 0


def test_a_record_of_samples_shakes_the_base(folder):
    time = numpy.arange(600) * 0.005
    record = stylobate.Record.from_samples(numpy.sin(2 * numpy.pi * 2 * time) * 6, 0.005)
    with pytest.raises(stylobate.InputError, match="perturbation.phase"):
        stylobate.run(stylobate.Study.from_toml(COLUMN, SMALL_SURFACE), record=record)
    tables = tomllib.loads(COLUMN.read_text())
    del tables["perturbation"]["phase"]
    study = stylobate.Study(tables)
    for key, value in SMALL_SURFACE.items():
        study.set(key, value)
    result = stylobate.run(study, record=record)
    assert result.complete and result.count == 18
    assert "kind = \"record\"" in result.study.text


def test_pictures(folder, small_surface):
    pytest.importorskip("matplotlib")
    result = stylobate.run(small_surface)
    axes = result.plot()
    assert axes.get_xlabel() == "frequency [Hz]" and axes.get_ylabel().endswith("[m/s²]")
    numpy.testing.assert_array_equal(axes.collections[0].get_array().reshape(2, 3), result.surface().probability.T)
    animation = result.animate(17, seconds=0.2)
    animation.save("fall.gif", writer="pillow")
    assert pathlib.Path("fall.gif").read_bytes().startswith(b"GIF8")
    single = stylobate.run(INPUTS / "free_rocking.toml")
    with pytest.raises(stylobate.InputError, match="has no surface"):
        single.plot()


def long_single():
    """One realization of 25 million steps."""
    tables = tomllib.loads(COLUMN.read_text())
    del tables["surface"], tables["perturbation"]
    tables["study"] = {"kind": "single", "realizations": 1}
    tables["excitation"] |= {"frequency_hz": 1.0, "pga_m_s2": 1.0, "cycles": 1000}
    return stylobate.Study(tables)


def test_ctrl_c_within_a_realization(folder):
    calls = []

    def interrupt(news):
        calls.append(news)
        os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        stylobate.run(long_single(), "a.h5", progress=interrupt)
    part = stylobate.Result("a.h5")
    assert len(calls) == 1 and part.count == 0 and not part.complete
    with pytest.raises(KeyboardInterrupt):
        signal.signal(signal.SIGALRM, lambda number, frame: os.kill(os.getpid(), signal.SIGINT))
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        part.replay(0)
