"""Compares a study with its variants:  python3 compare.py column.toml comparison.png"""

import sys

import stylobate

found = stylobate.compare(sys.argv[1], progress=lambda line: print(line, file=sys.stderr))
rows = found.to_pandas()
print(rows[rows.place == "all"][["variant", "limit_state", "difference", "difference_lower", "difference_upper", "verdict"]])
found.plot().figure.savefig(sys.argv[2])
found.write("comparison.h5")  # for `stylobate.report` and `stylobate.risk`
