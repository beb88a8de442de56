"""Writes an animation of one realization:  python3 animate.py column.h5 17 fall.gif"""

import sys

import stylobate

stylobate.Result(sys.argv[1]).animate(int(sys.argv[2]), seconds=2).save(sys.argv[3], writer="pillow")
print(sys.argv[3])
