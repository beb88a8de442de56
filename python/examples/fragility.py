"""Prints and draws fragility curves:  python3 fragility.py fragility.h5 fragility.png"""

import sys

import stylobate

result = stylobate.Result(sys.argv[1])
print(result.fragility()[["median", "median_lower", "median_upper", "dispersion"]].to_dataframe())
result.plot().figure.savefig(sys.argv[2])
