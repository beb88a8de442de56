"""Runs the commands of pages of the guide, in the order of each page, in a folder that is empty at first, and compares
what they print with what the page states. guide_page.py has the convention.

    check_guide.py [--long] [--write] --path FOLDERS --python FOLDER PAGE.md...

    --long     also the blocks marked long; without it they are left out
    --write    stores the pictures that the commands have made in docs/guide/images: at most 1200 pixels wide, with a
               palette
    --path     folders of `stylobate` and other programs, separated by colons; --python: folder of the Python module

Exit status 77, with a reason, where a package that a page's Python script imports is not installed.
"""

import argparse
import ast
import base64
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from guide_page import Command, File, PageError, difference, read_page  # noqa: E402

TIMEOUT_S = 1800  # ends what hangs; a machine that is ten times as slow passes
MOST_BYTES = 150_000  # of a picture
WIDTH = 1200


def missing_modules(page, python):
    """Names of top-level modules that the scripts of a page import and that this Python lacks."""
    names = set()
    for step in page.steps:
        if isinstance(step, File) and step.name.endswith(".py"):
            for node in ast.walk(ast.parse(step.text)):
                if isinstance(node, ast.Import):
                    names.update(alias.name.split(".")[0] for alias in node.names)
                elif isinstance(node, ast.ImportFrom):
                    names.add(node.module.split(".")[0])
    if "stylobate" in names:  # what its methods import on use
        names.update({"numpy", "pandas", "xarray", "matplotlib"})
        names.remove("stylobate")
        if not list(pathlib.Path(python, "stylobate").glob("_core*")):
            return ["stylobate (the Python module is not built)"]
    return sorted(name for name in names if importlib.util.find_spec(name) is None)


def run_page(page, folder, environment, long):
    """What is wrong, a text for each; the steps that cannot go on after a failed command are not run."""
    for step in page.steps:
        if step.long and not long:
            continue
        if isinstance(step, File):
            pathlib.Path(folder, step.name).write_text(step.text)
            continue
        done = subprocess.run(["bash", "-c", step.text], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=TIMEOUT_S)
        printed = done.stdout.splitlines()
        wrong = difference(step.expected, printed)
        if done.returncode != step.status:
            wrong = f"exit status {done.returncode} instead of {step.status}\n" + (wrong or "\n".join(printed))
        if wrong:
            return [f"line {step.line}: {step.text}\n{wrong}"]
    return []


def check_pictures(page, folder, images, long):
    """Every picture of the page was made by its commands, and is there, readable and small."""
    wrong = []
    for name in page.pictures:
        stored = images / name
        if not stored.exists():
            wrong.append(f"images/{name} is missing: check_guide.py --write")
        elif stored.stat().st_size > MOST_BYTES:
            wrong.append(f"images/{name} has {stored.stat().st_size} bytes, more than {MOST_BYTES}")
        source = {made: html for made, _, html in page.figures}.get(name, name)
        if not pathlib.Path(folder, source).exists() and (long or not page.has_long):
            wrong.append(f"images/{name} is made by no command of the page")
    return wrong


def draw_figures(page, folder):
    """The figures of HTML pages as pictures, in a browser."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "browser"))
    from browser import Browser, find_chromium
    for name, number, html in page.figures:
        if pathlib.Path(folder, html).exists():
            with Browser(find_chromium()) as browser:
                browser.size(1000, 800)
                browser.open(os.path.join(folder, html))
                x, y, width, height = browser.js(
                    f"(() => {{ const r = document.querySelectorAll('figure')[{number - 1}].getBoundingClientRect();"
                    " return [r.x + scrollX, r.y + scrollY, r.width, r.height]; })()")
                clip = {"x": x - 8, "y": y - 8, "width": width + 16, "height": height + 16, "scale": 1}
                answer = browser.send("Page.captureScreenshot",
                                      {"format": "png", "captureBeyondViewport": True, "clip": clip})
                pathlib.Path(folder, name).write_bytes(base64.b64decode(answer["data"]))


def write_pictures(page, folder, images):
    from PIL import Image
    draw_figures(page, folder)
    images.mkdir(exist_ok=True)
    for name in page.pictures:
        made = pathlib.Path(folder, name)
        if made.exists():
            picture = Image.open(made).convert("RGB")
            if picture.width > WIDTH:
                picture = picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)), Image.LANCZOS)
            picture.quantize(256, dither=Image.Dither.NONE).save(images / name, optimize=True)
            print(f"wrote {images / name}: {(images / name).stat().st_size} bytes")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("pages", nargs="+", type=pathlib.Path)
    parser.add_argument("--path", required=True)
    parser.add_argument("--python", default="")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    programs = tempfile.mkdtemp()  # `python3` is the one that runs this
    os.symlink(sys.executable, os.path.join(programs, "python3"))
    environment = {**os.environ, "PATH": ":".join([programs, arguments.path, os.environ["PATH"]]),
                   "PYTHONPATH": arguments.python, "MPLBACKEND": "Agg"}
    try:
        return check_pages(arguments, environment)
    finally:
        shutil.rmtree(programs)


def check_pages(arguments, environment):
    failures = []
    for path in arguments.pages:
        try:
            page = read_page(path.read_text())
        except PageError as error:
            failures.append(f"{path}: {error}")
            continue
        missing = missing_modules(page, arguments.python)
        if missing:
            print(f"{path.name} needs {', '.join(missing)}: skipped")
            return 77
        images = path.parent / "images"
        with tempfile.TemporaryDirectory() as folder:
            wrong = run_page(page, folder, environment, arguments.long)
            if arguments.write and not wrong:
                write_pictures(page, folder, images)
            wrong = wrong or check_pictures(page, folder, images, arguments.long)
        failures += [f"{path}: {text}" for text in wrong]
        run = [step for step in page.steps if isinstance(step, Command) and (arguments.long or not step.long)]
        print(f"{path.name}: {len(run)} commands, {'failed' if wrong else 'as stated'}")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
