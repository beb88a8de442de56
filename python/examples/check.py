"""Tells before a run what it takes and where the study is weak, and draws the structure:
python3 check.py column.toml column.png"""

import sys

import stylobate

check = stylobate.Study.from_toml(sys.argv[1]).check(trial_seconds=1)
print(f"{check.realizations} realizations in {check.time.range_s[0]:.2g} to {check.time.range_s[1]:.2g} s, "
      f"{check.memory_bytes / 1e6:.0f} MB of memory, a file of {check.file_bytes / 1e6:.2g} MB")
for spot in check.weak_spots:
    print(f"{spot.name}: {spot.text} {spot.remedy}")
check.draw(sys.argv[2])
