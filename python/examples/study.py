"""Reads a study, changes a key and describes it:  python3 study.py column.toml"""

import sys

import stylobate

study = stylobate.Study.from_toml(sys.argv[1])
study.set("contact.friction", 0.7)
print(study.describe())
