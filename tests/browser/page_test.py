"""What the tests of pages in a real browser share."""

import os
import subprocess
import sys
import tempfile
import unittest

from browser import Browser, find_chromium

try:
    import h5py
except ImportError:
    h5py = None


class Given:
    """The paths of the command line."""
    program = ""


def stylobate(*words):
    subprocess.run([Given.program, *map(str, words), "--quiet"], check=True, stdout=subprocess.DEVNULL)


class Page(unittest.TestCase):
    """A browser for all tests of a class; after each one it has asked for the page alone and complained of nothing."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="stylobate-page-")
        cls.make()
        cls.browser = Browser(find_chromium())

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.folder.cleanup()

    @classmethod
    def at(cls, name):
        return os.path.join(cls.folder.name, name)

    def open(self, name):
        self.browser.open(self.at(name))
        self.page = self.at(name.split("#")[0])

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])
        self.assertEqual(self.browser.requests, ["file://" + self.page])

    def tip(self):
        """The readings beside the pointer, by their names; None where there are none."""
        rows = self.browser.js("""(() => {
            const tip = [...document.querySelectorAll(".tip")].find((one) => !one.hidden);
            return tip ? [["title", tip.querySelector("b").textContent],
                          ...[...tip.querySelectorAll("tr")].map((row) => [...row.cells].map((c) => c.textContent))]
                       : null;
        })()""")
        return None if rows is None else dict(rows)


def main(names, usage):
    """Runs the tests of the script. Exit status 77, with a reason, where the browser or h5py is not installed.

    @param names of the paths that the command line begins with, as `Given` is to have them; tests may follow
    """
    if len(sys.argv) <= len(names):
        sys.exit(usage)
    for name, path in zip(names, sys.argv[1:]):
        setattr(Given, name, os.path.abspath(path))
    if not find_chromium():
        print("skipped: Chromium is not installed (Debian: chromium)")
        sys.exit(77)
    if h5py is None:
        print("skipped: h5py is not installed (Debian: python3-h5py)")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1 + len(names):]])
