"""The site that mkdocs builds of docs/ (mkdocs.yml): it builds without a warning, no link in it is dead, nothing is
loaded from elsewhere, and its navigation has every page of docs/.

    check_site.py ROOT [TEST...]      the root of the sources; some tests: Site.test_...

Exit status 77, with a reason, where mkdocs or its theme is not installed.
"""

import html.parser
import pathlib
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

ROOT = pathlib.Path()
REFERENCES = {"a": "href", "link": "href", "img": "src", "script": "src", "iframe": "src", "source": "src"}


class Reader(html.parser.HTMLParser):
    """The ids and the references of a page."""

    def __init__(self):
        super().__init__()
        self.ids, self.references = set(), []

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids.update(value for key, value in attributes.items() if key in ("id", "name") and value)
        if attributes.get(REFERENCES.get(tag)):
            self.references.append((tag, attributes[REFERENCES[tag]]))


def read_pages(site):
    pages = {}
    for path in sorted(site.rglob("*.html")):
        if path.name != "404.html":  # its links begin at the root of a server
            pages[path] = Reader()
            pages[path].feed(path.read_text())
    return pages


def breaches(site):
    """Dead links, and what is loaded from elsewhere."""
    found, pages = [], read_pages(site)
    for path, page in pages.items():
        for tag, reference in page.references:
            url = urllib.parse.urlsplit(reference)
            place = f"{path.relative_to(site)}: {reference}"
            if url.scheme == "data" or (url.scheme in ("http", "https", "mailto") and tag == "a"):
                continue
            if url.scheme or url.netloc:
                found.append(f"{place}: loaded from elsewhere")
                continue
            target = path
            if url.path:
                target = (path.parent / urllib.parse.unquote(url.path)).resolve()
                target = target / "index.html" if target.is_dir() else target
            if not target.is_file() or not target.is_relative_to(site):
                found.append(f"{place}: no such file")
            elif url.fragment and target in pages and urllib.parse.unquote(url.fragment) not in pages[target].ids:
                found.append(f"{place}: no such place in the page")
    return found


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.site = pathlib.Path(cls.folder.name).resolve() / "site"
        cls.built = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", cls.site], cwd=ROOT,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_builds_without_a_warning(self):
        self.assertEqual(self.built.returncode, 0, self.built.stdout)

    def test_has_no_dead_link_and_loads_nothing_from_elsewhere(self):
        self.assertEqual(breaches(self.site), [])
        self.assertGreater(len(read_pages(self.site)), 40)

    def test_navigation_has_every_page(self):
        listed = (ROOT / "mkdocs.yml").read_text()
        for path in sorted((ROOT / "docs").rglob("*.md")):
            self.assertIn(str(path.relative_to(ROOT / "docs")), listed)

    def test_names_pages_by_their_titles(self):
        text = (self.site / "index.html").read_text()
        self.assertIn(">Studies ready to run</a>", text)
        self.assertNotIn(">../README.md</a>", text)

    def test_shows_files_outside_docs(self):
        self.assertIn("central differences", (self.site / "source/kernels/THEORY.html").read_text())
        text = (self.site / "architecture.html").read_text()
        self.assertIn("source/tests/house/test_includes.cpp.html", text)


class Checker(unittest.TestCase):
    def check(self, text, other="<p id='here'>"):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder).resolve()
            (site / "a").mkdir()
            (site / "index.html").write_text(text)
            (site / "a/index.html").write_text(other)
            return breaches(site)

    def test_passes_living_links(self):
        self.assertEqual(self.check('<a href="a/">, <a href="a/#here">, <a href="#x"><p id="x">'
                                    '<a href="https://example.org/"><img src="data:image/png;base64,AA">'), [])

    def test_finds_dead_links(self):
        for text in ('<a href="b/">', '<a href="a/#there">', '<a href="#x">', '<img src="a.png">', '<a href="../x.md">'):
            self.assertEqual(len(self.check(text)), 1, text)

    def test_finds_what_is_loaded_from_elsewhere(self):
        for text in ('<script src="https://example.org/a.js">', '<link href="//example.org/a.css">'):
            self.assertEqual(len(self.check(text)), 1, text)


if __name__ == "__main__":
    try:
        from mkdocs.utils import get_theme_names
    except ImportError:
        get_theme_names = list
    if "material" not in get_theme_names():
        print("mkdocs or its theme (mkdocs, mkdocs-material) is not installed: skipped")
        sys.exit(77)
    ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
