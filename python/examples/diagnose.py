"""Diagnoses a measured campaign:  python3 diagnose.py campaign.h5 [SIMULATED CAMPAIGNS]"""

import sys

import stylobate

found = stylobate.diagnose(sys.argv[1], nulls=int(sys.argv[2]) if len(sys.argv) > 2 else 192, progress=print)
print(found.verdict, found.verdict_text)
for cause in found.causes:
    print(cause.mechanism, cause.place, cause.size, cause.unit)
