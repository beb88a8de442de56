"""Runs one realization again and follows its top block:  python3 replay.py column.h5 17"""

import sys

import stylobate

replay = stylobate.Result(sys.argv[1]).replay(int(sys.argv[2]))
top = replay.x_m[:, -1] - replay.rest_x_m[-1]
print(f"{replay}; {replay.blocks[-1]} moves by {abs(top).max():.4f} m at most")
