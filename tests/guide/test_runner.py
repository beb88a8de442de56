"""Tests of the runner of the guide: it fails for a wrong command, a wrong output, a wrong exit status, and for a page
that breaks the convention."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from guide_page import PageError, difference, read_page  # noqa: E402


def run(text, *options, pictures=()):
    """Exit status and output of the runner for one page."""
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "page.md")
        page.write_text(text)
        for name, size in pictures:
            (page.parent / "images").mkdir(exist_ok=True)
            (page.parent / "images" / name).write_bytes(b"x" * size)
        done = subprocess.run([sys.executable, HERE / "check_guide.py", "--path", "/usr/bin", *options, page],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout


def console(text):
    return f"Text.\n\n```console\n{text}\n```\n"


class Runner(unittest.TestCase):
    def test_passes_what_is_as_stated(self):
        status, output = run(console("$ echo one; echo two >&2\none\ntwo\n$ printf 'a b' \\\n    | wc -c\n3"))
        self.assertEqual(status, 0, output)
        self.assertIn("2 commands, as stated", output)

    def test_fails_for_a_wrong_command(self):
        status, output = run(console("$ no_such_command"))
        self.assertEqual(status, 1)
        self.assertIn("line 4: no_such_command\nexit status 127 instead of 0", output)

    def test_fails_for_a_wrong_output(self):
        status, output = run(console("$ echo 2048 realizations, 752 collapsed\n2048 realizations, 753 collapsed"))
        self.assertEqual(status, 1)
        self.assertIn("752 collapsed", output)

    def test_fails_for_a_missing_and_for_a_further_line(self):
        self.assertEqual(run(console("$ echo one\none\ntwo"))[0], 1)
        self.assertEqual(run(console("$ echo one; echo two\none"))[0], 1)

    def test_fails_for_a_wrong_exit_status(self):
        self.assertEqual(run(console("$ exit 2    # exit status 2"))[0], 0)
        self.assertEqual(run(console("$ exit 3    # exit status 2"))[0], 1)
        self.assertEqual(run(console("$ true    # exit status 2"))[0], 1)

    def test_writes_files_and_goes_on_in_one_folder(self):
        text = '```toml title="a.toml"\nx = 1\n```\n' + console("$ cat a.toml > b\n$ cat b\nx = 1")
        self.assertEqual(run(text)[0], 0)

    def test_runs_long_blocks_only_when_asked(self):
        text = console("$ true") + "\n<!-- long -->\n\n" + console("$ false").split("\n\n", 1)[1] + console("$ echo fast\nfast")
        self.assertEqual(run(text)[0], 0)
        self.assertEqual(run(text, "--long")[0], 1)

    def test_asks_for_pictures_that_are_made_stored_and_small(self):
        made = console("$ touch p.png") + "\n![A picture](images/p.png)\n"
        self.assertEqual(run(made, pictures=[("p.png", 150_000)])[0], 0)
        self.assertIn("is missing", run(made)[1])
        self.assertIn("more than 150000", run(made, pictures=[("p.png", 150_001)])[1])
        self.assertIn("is made by no command",
                      run(console("$ true") + "\n![A picture](images/p.png)\n", pictures=[("p.png", 9)])[1])

    def test_skips_a_page_whose_packages_are_missing(self):
        status, output = run('```python title="a.py"\nimport no_such_package\n```\n')
        self.assertEqual(status, 77)
        self.assertIn("no_such_package", output)


class Convention(unittest.TestCase):
    def test_refuses_blocks_that_nobody_runs(self):
        for block in ("```sh\nstylobate\n```", "```\nstylobate\n```", "```console\nstylobate\n```", "```console\n$ a",
                      "```python\nimport stylobate\n```"):
            with self.assertRaises(PageError, msg=block):
                read_page(block)
        self.assertEqual(read_page("<!-- not run: a reason -->\n\n```sh\nx\n```").steps, [])

    def test_compares_lines(self):
        self.assertIsNone(difference(["a ... c", "...", "z"], ["a b c", "x", "y", "z"]))
        self.assertIsNone(difference(["a", "...", "z"], ["a", "z"]))
        self.assertIsNone(difference(["a"], ["7 of 9 realizations, 3/s, 1 s left", "a  ", ""]))
        self.assertIsNotNone(difference(["a.c"], ["abc"]))  # no regular expression
        self.assertIsNotNone(difference(["a ... c"], ["a b d"]))
        self.assertIsNotNone(difference(["...", "z"], ["z", "a"]))


if __name__ == "__main__":
    unittest.main()
