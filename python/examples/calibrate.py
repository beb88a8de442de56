"""Fits contact parameters to measured data:  python3 calibrate.py campaign.h5
of a table of outcomes, which needs a study:  python3 calibrate.py tests.csv column.toml"""

import sys

import stylobate

found = stylobate.calibrate(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None, progress=print)
for key, parameter in found.parameters.items():
    kind = "determined" if parameter.determined else "effective" if parameter.effective else "not determined"
    print(f"{key}: {parameter.value:.4g} ({parameter.lower:.4g} to {parameter.upper:.4g}), {kind}")
found.write("calibration.h5")  # for `stylobate report`
