#!/usr/bin/env python3
"""`export --to vtk` against the trajectory as `export --to csv` writes it, and, by pvpython, as ParaView draws it.

    check_vtk.py STYLOBATE INPUTS              vertices, cell data, refusals
    check_vtk.py STYLOBATE INPUTS PVPYTHON     a picture; exit 77 where pvpython or xvfb-run is missing
"""
import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

program, inputs = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []


def expect(condition, text):
    if not condition:
        failures.append(text)


def run(*words, status=0):
    ended = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    expect(ended.returncode == status, f"{words}: status {ended.returncode}, {ended.stderr}")
    return ended.stderr


def array(root, name):
    (found,) = [each for each in root.iter("DataArray") if each.get("Name") == name]
    values = [float(word) for word in found.text.split()]
    width = int(found.get("NumberOfComponents"))
    return [values[i:i + width] for i in range(0, len(values), width)]


def check_time(row, before, after, file, blocks, where):
    root = xml.parse(file).getroot()
    expect(root.get("type") == "PolyData", f"{where}: no polygons")
    points = array(root, "Points")
    expect(len(points) == 4 * (blocks + 1), f"{where}: {len(points)} points")
    expect(array(root, "offsets") == [[4.0 * i + 4] for i in range(blocks + 1)], f"{where}: wrong offsets")
    expect([i for (i,) in array(root, "connectivity")] == list(range(4 * blocks + 4)), f"{where}: wrong connectivity")
    expect([i for (i,) in array(root, "block_id")] == [*range(blocks), -1], f"{where}: wrong ids")
    rotation, velocity = array(root, "rotation"), array(root, "velocity")
    elapsed = after["time_s"] - before["time_s"]
    base_velocity = (after["base_x_m"] - before["base_x_m"]) / elapsed
    for i in range(blocks):
        x, y, theta = row["base_x_m"] + row[f"x_m[{i}]"], row[f"y_m[{i}]"], row[f"theta_rad[{i}]"]
        reach = math.hypot(row[f"half_width_m[{i}]"], row[f"half_height_m[{i}]"])
        slope = math.atan2(row[f"half_height_m[{i}]"], row[f"half_width_m[{i}]"])
        # corners in polar form, counter-clockwise from the lower left one
        for corner, angle in enumerate((math.pi + slope, -slope, slope, math.pi - slope)):
            want = (x + reach * math.cos(theta + angle), y + reach * math.sin(theta + angle), 0)
            far = max(abs(a - b) for a, b in zip(points[4 * i + corner], want))
            expect(far < 1e-6, f"{where}: corner {corner} of block {i} is {far} m away")
        expect(abs(rotation[i][0] - theta) < 1e-6, f"{where}: block {i} is rotated by {rotation[i][0]}")
        for axis, moved in ((0, base_velocity), (1, 0)):
            name = f"{'xy'[axis]}_m[{i}]"
            want = moved + (after[name] - before[name]) / elapsed
            expect(abs(velocity[i][axis] - want) < 1e-6 * max(1, abs(want)), f"{where}: velocity of block {i}")
    base = points[4 * blocks:]
    expect(max(y for _, y, _ in base) == 0 and min(y for _, y, _ in base) < 0, f"{where}: the base is not below y = 0")
    left, right = min(x for x, _, _ in base), max(x for x, _, _ in base)
    expect(all(left <= x <= right for x, _, _ in points), f"{where}: a block lies beside the base")
    expect(abs(velocity[blocks][0] - base_velocity) < 1e-6 * max(1, abs(base_velocity)), f"{where}: velocity of the base")


def check(name, settings):
    run("run", inputs / f"{name}.toml", "-o", f"{name}.h5", "--quiet", *settings)
    run("replay", f"{name}.h5", "--realization", 0, "-o", f"{name}_fall.h5", "--quiet")
    run("export", f"{name}_fall.h5", "--to", "csv", "-o", f"{name}_csv", "--quiet")
    said = run("export", f"{name}_fall.h5", "--to", "vtk", "-o", f"{name}_vtk")
    expect("Forces and openings of joints" in said, f"{name}: what is left out is not stated")
    # of the results without a trajectory the same realization is run again
    run("export", f"{name}.h5", "--to", "vtk", "--realization", 0, "-o", f"{name}_again", "--quiet")
    with open(f"{name}_csv/trajectory_0.csv") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    blocks = sum(key.startswith("x_m[") for key in rows[0])
    folder = pathlib.Path(f"{name}_vtk")
    listed = xml.parse(folder / "realization_0.pvd").getroot().findall("Collection/DataSet")
    expect(len(listed) == len(rows), f"{name}: {len(listed)} times instead of {len(rows)}")
    expect({each.get("file") for each in listed} | {"realization_0.pvd"} == {each.name for each in folder.iterdir()},
           f"{name}: the folder has other files than the list")
    for k, (row, entry) in enumerate(zip(rows, listed)):
        expect(abs(float(entry.get("timestep")) - row["time_s"]) < 1e-8, f"{name}: time {k}")
        if k % max(1, len(rows) // 40) == 0 or k == len(rows) - 1:
            check_time(row, rows[max(0, k - 1)], rows[min(len(rows) - 1, k + 1)], folder / entry.get("file"), blocks,
                       f"{name}, time {k}")
    for file in folder.iterdir():
        expect(file.read_bytes() == pathlib.Path(f"{name}_again", file.name).read_bytes(), f"{name}: {file} differs")


def check_refusals():
    pathlib.Path("full").mkdir()
    pathlib.Path("full/note.txt").write_text("mine")
    before = sorted(pathlib.Path().iterdir())
    file = "free_rocking_fall.h5"
    expect("holds files already" in run("export", file, "--to", "vtk", "-o", "full", status=2), "full folder")
    expect("nowhere" in run("export", file, "--to", "vtk", "-o", "nowhere/vtk", status=2), "no folder above")
    expect("only --realization" in run("export", file, "--to", "vtk", "--title", "a", status=2), "an option of pictures")
    expect("several files" in run("export", file, "--to", "vtk", "-o", "a.pvd", status=2), "a file for a folder")
    expect("--realization 7" in run("export", file, "--to", "vtk", "--realization", 7, "-o", "a", status=2),
           "a realization that is not there")
    expect(sorted(pathlib.Path().iterdir()) == before, "a refusal left something")
    expect([each.name for each in pathlib.Path("full").iterdir()] == ["note.txt"], "a refusal changed a folder")


RENDER = """
import sys
from paraview.simple import *
reader = PVDReader(FileName=sys.argv[1])
times = reader.TimestepValues
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [400, 400]
view.InteractionMode = "2D"
shown = Show(reader, view)
ColorBy(shown, ("CELLS", "block_id"))
view.ViewTime = times[len(times) // 2]
ResetCamera(view)
SaveScreenshot(sys.argv[2], view)
reader.UpdatePipeline(times[-1])
info = reader.GetDataInformation()
print(len(times), info.GetNumberOfCells(), info.GetNumberOfPoints(), *sorted(reader.CellData.keys()))
"""


def render(pvpython):
    run("run", inputs / "free_rocking.toml", "-o", "a.h5", "--quiet")
    run("export", "a.h5", "--to", "vtk", "-o", "vtk", "--quiet")
    pathlib.Path("render.py").write_text(RENDER)
    times = len(list(pathlib.Path("vtk").glob("*.vtp")))
    command = ["xvfb-run", "-a", pvpython, "render.py", "vtk/realization_0.pvd", "picture.png"]
    ended = subprocess.run(command, capture_output=True, text=True)
    expect(ended.returncode == 0, ended.stderr)
    expect(ended.stdout.split()[-6:] == [str(times), "2", "8", "block_id", "rotation", "velocity"], ended.stdout)
    picture = pathlib.Path("picture.png")
    expect(picture.exists() and picture.read_bytes().startswith(b"\x89PNG"), "no picture")


if len(sys.argv) > 3:
    found = shutil.which(sys.argv[3])
    if not found:
        print("pvpython (paraview, python3-paraview) is not installed: skipped")
        sys.exit(77)
    if not shutil.which("xvfb-run"):
        print("xvfb-run (xvfb, xauth), by which ParaView draws without a screen, is not installed: skipped")
        sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    program = str(pathlib.Path(program).resolve())
    inputs = inputs.resolve()
    os.chdir(folder)
    if len(sys.argv) > 3:
        render(found)
    else:
        check("free_rocking", [])
        check("small_scale_colonnade", ["--set", "study.realizations=1", "--set",
                                        "surface.frequency_hz={from=1.0,to=3.0,count=2}", "--set",
                                        "surface.pga_m_s2={from=16.0,to=17.0,count=2}"])
        check_refusals()
    os.chdir("/")

for failure in failures[:20]:
    print(failure)
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
