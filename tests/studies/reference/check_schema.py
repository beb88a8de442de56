#!/usr/bin/env python3
"""The JSON Schema of the study file, tried by another program's validator on studies that stylobate reads or refuses.

    check_schema.py STYLOBATE INPUTS      exit 77 where jsonschema (python3-jsonschema) is not installed
"""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

try:
    import jsonschema
except ImportError:
    print("jsonschema is not installed: skipped")
    sys.exit(77)

program, inputs = sys.argv[1], pathlib.Path(sys.argv[2])
schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
failures = []


def errors(study):
    return [f"{list(error.absolute_path)}: {error.message}" for error in validator.iter_errors(study)]


def accept(name, study):
    if found := errors(study):
        failures.append(f"{name} is refused: {found[0]}")


def changed(study, path, value):
    """A copy with a value at the path; None takes the key away."""
    result = copy.deepcopy(study)
    *above, key = path
    table = result
    for name in above:
        table = table.setdefault(name, {})
    if value is None:
        table.pop(key)
    else:
        table[key] = value
    return result


def refuse(study, path, value):
    if not errors(changed(study, path, value)):
        failures.append(f"{'.'.join(path)} = {value} is accepted")


studies = {file.name: tomllib.loads(file.read_text()) for file in sorted(inputs.glob("*.toml"))}
studies.pop("record.toml")  # its file is named on the command line
for name, study in studies.items():
    accept(name, study)
with tempfile.TemporaryDirectory() as folder:
    for kind in ("single", "surface", "fragility", "sensitivity", "rare"):
        for structure in ("column", "colonnade"):
            for dimensions in ("2", "3"):
                file = pathlib.Path(folder) / f"{kind}_{structure}_{dimensions}.toml"
                made = ["new", kind, "--structure", structure, "--dimensions", dimensions, "-o", file, "--quiet"]
                subprocess.run([program, *made], check=True)
                accept(file.name, tomllib.loads(file.read_text()))

column = studies["small_scale_column.toml"]
for path, value in [
    (("contact", "frictoin"), 0.5),  # unknown
    (("contact", "friction"), "rough"),  # of another type
    (("contact", "friction"), 11),  # out of range
    (("contact", "friction"), 0),  # its lower end is open
    (("contact", "friction"), None),  # needed
    (("contact", "form"), "round"),  # no such word
    (("study", "realizations"), 1.5),
    (("study", "kind"), "single"),  # then [surface] is not used
    (("excitation", "frequency_hz"), 2.0),  # the axes of the surface give it
    (("excitation", "gamma"), 2.0),  # of a pulse
    (("excitation", "kind"), None),
    (("structure", "columns"), 2),  # of a colonnade
    (("surface", "pga_m_s2", "count"), None),
    (("surface", "pga_m_s2", "to"), -1),
    (("perturbation", "friction", "distribution"), "cauchy"),
    (("perturbation", "tilt", "cov"), 0.1),  # it may have either sign
    (("twins", "moves_m"), []),
    (("mechanisms", "stribeck"), {"dynamic_friction": 0.5}),  # without the velocity
    (("no_such_table",), {}),
]:
    refuse(column, path, value)
fragility = studies["fragility_column.toml"]
for path, value in [
    (("fragility", "scale"), 2.0),  # of a cloud
    (("fragility", "folder"), "records"),  # of records
    (("fragility", "motions"), None),
    (("fragility",), None),
]:
    refuse(fragility, path, value)

spatial = studies["round_column.toml"]
for path, value in [
    (("structure", "depth_m"), 1.0),  # of the plane
    (("structure", "shape"), "hexagon"),
    (("structure", "dimensions"), 2),  # then it needs depth_m, and the keys of space are not used
    (("structure", "dimensions"), None),
    (("contact", "normal_stiffness_n_m2"), 3e9),
    (("contact", "normal_stiffness_n_m3"), None),
    (("run", "precision"), "single"),
    (("twins",), {}),
    (("surface", "direction_deg"), {"from": 0.0, "to": 90.0, "count": 3}),  # in the place of frequency_hz
    (("surface", "frequency_hz"), None),
]:
    refuse(spatial, path, value)
turning = changed(spatial, ("surface", "direction_deg"), {"from": -45.0, "to": 90.0, "count": 3})
turning = changed(changed(turning, ("surface", "frequency_hz"), None), ("perturbation", "direction"), None)
turning = changed(turning, ("excitation", "frequency_hz"), 1.0)
accept("a surface over directions", turning)
for path, value in [
    (("excitation", "direction_deg"), 10.0),  # the axis gives it
    (("perturbation", "direction"), {"distribution": "uniform"}),
    (("surface", "direction_deg", "to"), 400.0),
    (("structure", "dimensions"), None),
]:
    refuse(turning, path, value)
refuse(column, ("structure", "depth_m"), None)

for failure in failures:
    print(failure)
print(f"{len(studies)} ready studies, {len(failures)} failures")
sys.exit(1 if failures else 0)
