"""Runs a study into a results file; run again, it continues or reads it:  python3 run.py column.toml column.h5"""

import sys

import stylobate

result = stylobate.run(sys.argv[1], sys.argv[2], progress=print)
collapse = result.share("collapse")
print(f"{collapse.count} of {collapse.trials} collapsed: {collapse.probability:.3f} "
      f"({collapse.lower:.3f} to {collapse.upper:.3f})")
print(result.realizations().state.value_counts())
