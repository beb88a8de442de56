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


# Texts that are shown: how many, and those whose letters are smaller than 11 px on the screen.
LETTERS = """(() => {
    const small = [];
    let texts = 0;
    for (const element of document.querySelectorAll("body *")) {
      const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
      if (!own || !element.checkVisibility({visibilityProperty: true}) || element.matches(".spoken, option, title")) continue;
      ++texts;
      const matrix = element.ownerSVGElement ? element.getScreenCTM() : null, scale = matrix ? Math.hypot(matrix.a, matrix.b) : 1;
      const size = parseFloat(getComputedStyle(element).fontSize) * scale;
      if (size < 10.99) small.push([element.tagName, element.textContent.slice(0, 40), size]);
    }
    return {texts, small};
})()"""

# Shares with intervals: "61 % (58 to 64)", "58.1 to 64.0 %"; those that go over the end of a line.
BROKEN = """(() => {
    const broken = [];
    let intervals = 0;
    const walk = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
    for (let node; (node = walk.nextNode());) {
      if (!node.parentElement.checkVisibility() || node.parentElement.closest(".spoken, pre, option")) continue;
      for (const found of node.textContent.matchAll(/[\\d.]+\\s%\\s\\([\\d.]+\\sto\\s[\\d.]+\\)|[\\d.]+(\\s%)?\\sto\\s[\\d.]+\\s%/g)) {
        ++intervals;
        const range = document.createRange();
        range.setStart(node, found.index);
        range.setEnd(node, found.index + found[0].length);
        if (new Set([...range.getClientRects()].map((box) => Math.round(box.top))).size > 1) broken.push(found[0]);
      }
    }
    return {intervals, broken};
})()"""


def settings(**values):
    return [word for key, value in values.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]


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
