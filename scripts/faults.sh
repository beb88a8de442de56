#!/usr/bin/env bash
# Kills runs, fills disks and breaks calls of the system under them, and writes what became of them into
# docs/reliability.md. Exit status 1 where a fault is found. Tens of minutes; as root a small file system is
# filled, too.
#
#   scripts/faults.sh [OPTION...]     options of tests/faults/faults.py: --only PART, --kills N, --seed N
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build build/release --target stylobate failing_calls --parallel "$(nproc)"
exec /usr/bin/python3 tests/faults/faults.py build/release/studies/stylobate \
    --library build/release/tests/libfailing_calls.so --kills 1000 --thorough --page docs/reliability.md "$@"
