"""The version of a build counts up with every commit, for apt and for Python: check_version.py CMAKE SOURCE_FOLDER."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

cmake, root = sys.argv[1], pathlib.Path(sys.argv[2])
if not shutil.which("git"):
    print("skipped: git is not installed")
    sys.exit(0)
failures = []


def check(holds, what):
    if not holds:
        failures.append(what)


def git(folder, *words):
    identity = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
    return subprocess.run(["git", *identity, *words], cwd=folder, check=True, capture_output=True, text=True).stdout


def version_of(folder, number):
    out = folder.parent / "version.cpp"
    subprocess.run([cmake, f"-DVERSION={number}", "-DBUILD=none", f"-DSOURCE_DIR={folder}", f"-DOUTPUT={out}", "-P",
                    root / "cmake/version.cmake"], check=True)
    return re.search(r'code_version\(\)\s*{\s*return "(.*)"', out.read_text()).group(1)


def set_number(folder, number):
    (folder / "CMakeLists.txt").write_text(f"project(stylobate VERSION {number} LANGUAGES CXX)\n")


with tempfile.TemporaryDirectory() as temporary:
    plain = pathlib.Path(temporary) / "plain"
    plain.mkdir()
    set_number(plain, "0.3.0")
    check(version_of(plain, "0.3.0") == "0.3.0", "without git: " + version_of(plain, "0.3.0"))

    folder = pathlib.Path(temporary) / "clone"
    folder.mkdir()
    git(folder, "init", "-q")
    versions = []
    for number, more in (("0.2.0", 2), ("0.3.0", 11), ("0.10.0", 1)):
        set_number(folder, number)
        git(folder, "add", "-A")
        git(folder, "commit", "-qm", number)
        versions.append(version_of(folder, number))
        for k in range(more):
            git(folder, "commit", "-q", "--allow-empty", "-m", f"change {k}")
            versions.append(version_of(folder, number))
            commit = git(folder, "rev-parse", "--short=10", "HEAD").strip()
            check(versions[-1] == f"{number}+{k + 1}.{commit}", f"change {k + 1} of {number} is {versions[-1]}")
    for version in versions:
        check(re.fullmatch(r"\d+\.\d+\.\d+\+\d+\.[0-9a-f]{10}", version), f"{version} is not of the form of all")
    if shutil.which("dpkg"):
        for old, new in zip(versions, versions[1:]):
            newer = subprocess.run(["dpkg", "--compare-versions", f"{old}-1", "lt", f"{new}-1"]).returncode == 0
            check(newer, f"for apt {new} is not newer than {old}")
    key = [tuple(int(part) for part in re.findall(r"\d+", version.rpartition(".")[0])) for version in versions]
    check(key == sorted(key) and len(set(key)) == len(key), f"for Python they do not increase: {versions}")

    (folder / "CMakeLists.txt").open("a").write("# changed\n")
    check(version_of(folder, "0.10.0") == versions[-1] + ".dirty", "a changed tree: " + version_of(folder, "0.10.0"))
    set_number(folder, "0.11.0")
    check(re.fullmatch(r"0\.11\.0\+0\.[0-9a-f]{10}\.dirty", version_of(folder, "0.11.0")),
          "before the commit of a number: " + version_of(folder, "0.11.0"))

    git(folder, "checkout", "-q", ".")
    shallow = pathlib.Path(temporary) / "shallow"
    git(temporary, "clone", "-q", "--depth", "1", folder.as_uri(), "shallow")
    check(re.fullmatch(r"0\.10\.0\+[0-9a-f]{10}", version_of(shallow, "0.10.0")),
          "of a shallow clone: " + version_of(shallow, "0.10.0"))

print("\n".join(failures) or "the version counts up")
sys.exit(1 if failures else 0)
