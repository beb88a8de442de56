"""Prints and draws a surface:  python3 surface.py column.h5 surface.png"""

import sys

import stylobate

result = stylobate.Result(sys.argv[1])
print(result.surface().probability.to_pandas())
result.plot().figure.savefig(sys.argv[2])
