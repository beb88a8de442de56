#!/usr/bin/env python3
"""Runs the tests of the Python module. Exit status 77 where pytest is not installed."""
import pathlib
import sys

try:
    import pytest
except ImportError:
    print("pytest (python3-pytest) is not installed: skipped")
    sys.exit(77)

sys.exit(pytest.main([str(pathlib.Path(__file__).parent), "-q", "-p", "no:cacheprovider", "-rs", *sys.argv[1:]]))
