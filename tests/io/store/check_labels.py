#!/usr/bin/env python3
"""Result files as programs read them that do not know Stylobate: h5py, and xarray through h5netcdf.

    check_labels.py STYLOBATE INPUTS      exit 77 where python3-xarray or python3-h5netcdf is not installed
"""
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

try:
    import h5netcdf  # noqa: F401  the engine of xarray
    import h5py
    import numpy
    import xarray
except ImportError as missing:
    print(f"{missing}: skipped")
    sys.exit(77)

program, inputs = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []


def expect(condition, text):
    if not condition:
        failures.append(text)


axes = ['surface.frequency_hz={from=1.0,to=4.0,count=3,spacing="log"}',
        'surface.pga_m_s2={from=4.0,to=12.0,count=2,spacing="linear"}', "study.realizations=2"]
counts_only = axes + ['output.realizations="none"']
# a file of each kind of study: name, study, settings, groups that must be there
files = {
    "surface": ("small_scale_column", axes, {"surface", "realizations/outcome", "realizations/input"}),
    "counted": ("small_scale_column", counts_only, {"surface", "tally", "tally/collapse_time"}),
    "adaptive": ("small_scale_column_adaptive",
                 axes[:2] + ["surface.adaptive={budget=60,minimum=4,half_width=0.05,borrow=true}"], {"surface"}),
    "fragility": ("fragility_column",
                  ["study.realizations=6", "fragility.motions=8",
                   'fragility.intensity={measure="pgv",from=0.5,to=3.0,count=3,spacing="log"}'],
                  {"fragility", "motions"}),
    "sensitivity": ("sensitivity_column",
                    ["sensitivity.samples=6", "sensitivity.inner=2", "excitation.pga_m_s2=7"], {"sensitivity"}),
    "rare": ("rare_collapse", ["rare.samples=200", "rare.repeats=5"], {"rare"}),
    "twins": ("twins_column", axes + ["twins.followed=1", "run.max_invalid_fraction=1"], {"twins"}),
    "single": ("free_rocking", [], {"trajectories/0"}),
    "spatial": ("round_column", axes, {"surface", "realizations/outcome"}),
}
# their numbers have units that differ from one to the next
several_units = {"motions/value", "sensitivity/mean", "sensitivity/mean_lower", "sensitivity/mean_upper"}
units_in_name = {"_s": "s", "_hz": "Hz", "_s2": "m/s2", "_m": "m", "_rad": "rad", "_j": "J", "_per_s": "1/s"}


def check_file(name, file, wanted):
    groups = set()

    def visit(path, thing):
        if isinstance(thing, h5py.Group):
            groups.add(path)
            return
        where = f"{name}: {path}"
        expect("long_name" in thing.attrs, f"{where} has no long_name")
        if thing.dtype.kind in "iuf" and path not in several_units:
            expect("units" in thing.attrs, f"{where} has no units")
        if "unit" in thing.attrs:
            expect(thing.attrs["unit"] == thing.attrs["units"], f"{where}: unit and units differ")
        endings = [ending for ending in units_in_name if path.endswith(ending)]
        if endings:
            unit = units_in_name[max(endings, key=len)]
            expect(thing.attrs.get("units") == unit, f"{where} is in {thing.attrs.get('units')}, not {unit}")
        for i, dim in enumerate(thing.dims):
            if h5py.h5ds.is_scale(thing.id):
                continue
            expect(len(dim) == 1, f"{where}: dimension {i} has no scale")
            if len(dim) == 1:
                expect(dim[0].shape == (thing.shape[i],), f"{where}: the scale of dimension {i} has another length")
                expect(h5py.h5ds.is_attached(thing.id, dim[0].id, i), f"{where}: dimension {i} is attached half")

    with h5py.File(file) as opened:
        opened.visititems(visit)
    expect(wanted <= groups, f"{name}: the file has no {wanted - groups}")
    for group in groups:
        with xarray.open_dataset(file, group=group, engine="h5netcdf") as data:
            data.load()
            phony = [dim for dim in data.dims if dim.startswith("phony")]
            expect(not phony, f"{name}: {group} has dimensions without a name")


with tempfile.TemporaryDirectory() as folder:
    for name, (study, settings, wanted) in files.items():
        file = f"{folder}/{name}.h5"
        words = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([program, "run", inputs / f"{study}.toml", "-o", file, "--quiet", *words], check=True)
        check_file(name, file, wanted)

    with xarray.open_dataset(f"{folder}/surface.h5", group="surface", engine="h5netcdf") as surface:
        probability = surface.probability
        expect(probability.dims == ("frequency_hz", "pga_m_s2"), f"the surface is over {probability.dims}")
        expect(numpy.allclose(surface.frequency_hz, [1, 2, 4], rtol=1e-12), "the frequencies are others")
        expect(numpy.allclose(surface.pga_m_s2, [4, 12], rtol=1e-12), "the PGAs are others")
        expect(surface.frequency_hz.attrs["units"] == "Hz", "the frequency has no unit")
        expect(surface.pga_m_s2.attrs["units"] == "m/s2", "the PGA has no unit")
        expect(probability.attrs["long_name"] == "probability of collapse", "the probability has no name")
        expect(int(surface.trials.sum()) == 12, "the surface does not count 12 realizations")
    with xarray.open_dataset(f"{folder}/surface.h5", group="realizations/outcome", engine="h5netcdf") as outcome:
        expect(list(outcome.block.values) == [f"drum {i + 1}" for i in range(7)], f"the blocks are {outcome.block.values}")
        expect(outcome.fall_time_s.dims == ("index", "block"), "the times of the falls are not by block")
    with xarray.open_dataset(f"{folder}/fragility.h5", group="fragility", engine="h5netcdf") as fragility:
        expect(fragility.curve.dims == ("states", "grid"), "the curves are not over the intensity")
        expect(fragility.grid.attrs["units"] == "m/s", "the intensity is not in the unit of its measure")

def check_unfinished(folder):
    """A run that was interrupted has its axes."""
    file = pathlib.Path(folder, "unfinished.h5")
    words = [word for setting in axes[:2] + ["study.realizations=100000"] for word in ("--set", setting)]
    running = subprocess.Popen([program, "run", inputs / "small_scale_column.toml", "-o", file, "--quiet", *words])
    while not file.exists() and running.poll() is None:
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    expect(running.wait() == 130, "the run was not interrupted")
    with xarray.open_dataset(file, group="surface", engine="h5netcdf") as surface:
        expect(list(surface.coords) == ["frequency_hz", "pga_m_s2"], f"the unfinished file has {surface}")
        expect(surface.pga_m_s2.attrs["units"] == "m/s2", "the unfinished file has no units")


with tempfile.TemporaryDirectory() as folder:
    check_unfinished(folder)

for failure in failures:
    print(failure)
print(f"{len(files)} files, {len(failures)} failures")
sys.exit(1 if failures else 0)
