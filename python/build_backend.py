"""Makes a wheel of the module with CMake, for `pip install ./python` (PEP 517). Needs no other Python package.

    pip install ./python --config-settings build-dir=build/release      uses a build that is there
    scripts/package.sh --wheel                                          with all that it needs, for other machines
"""

import base64
import hashlib
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import time
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent

# What every Linux has that a wheel named manylinux may be installed on (PEP 600).
SYSTEM = {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "ld-linux-x86-64.so.2",
          "ld-linux-aarch64.so.1", "libstdc++.so.6", "libgcc_s.so.1", "libz.so.1"}

# The command: the program lies in the package, beside its libraries.
COMMAND = """#!python
import importlib.util
import os
import sys

found = importlib.util.find_spec("stylobate")
program = os.path.join(os.path.dirname(found and found.origin or ""), "_bundled", "stylobate")
if not os.path.exists(program):
    print(f"stylobate: {sys.executable} does not find the package that this command belongs to.\\n"
          "  Install the wheel again there, or add the folder of the package to PYTHONPATH.", file=sys.stderr)
    sys.exit(2)
os.execv(program, [program, *sys.argv[1:]])
"""


def _output(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def _installed(prefix, build, component):
    subprocess.run(["cmake", "--install", build, "--component", component, "--prefix", prefix], check=True,
                   stdout=subprocess.DEVNULL)


def _built(prefix, build, targets):
    """Builds the targets and installs the package below `prefix`; its folder."""
    if not (build / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", HERE.parent, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DSTYLOBATE_PYTHON=ON", "-DSTYLOBATE_TESTS=OFF", "-DSTYLOBATE_BENCH=OFF",
                        f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", *targets], check=True, stdout=sys.stderr)
    _installed(prefix, build, "python")
    (package,) = pathlib.Path(prefix).glob("**/stylobate")
    return package


def _bundle(files, folder):
    """Copies the libraries that `files` are linked with, and those of these, into `folder`, under names that no other
    program has, and makes all of them look there. Returns the Debian packages that the libraries are from."""
    names, packages = {}, set()
    to_do = list(files)
    for file in to_do:  # grows
        needed = [name for name in _output("patchelf", "--print-needed", file).split() if name not in SYSTEM]
        places = dict(re.findall(r"(\S+) => (/\S+)", _output("ldd", file)))
        for name in needed:
            if name not in names:
                source = pathlib.Path(places[name]).resolve()
                stem, _, rest = name.partition(".so")
                names[name] = f"{stem}-stylobate-{hashlib.sha256(source.read_bytes()).hexdigest()[:8]}.so{rest}"
                copy = folder / names[name]
                shutil.copyfile(source, copy)
                packages.add(_output("dpkg", "-S", f"*/{source.name}").partition(":")[0])
                subprocess.run(["patchelf", "--set-soname", copy.name, copy], check=True)
                to_do.append(copy)
    for file in to_do:  # one change a call: patchelf 0.14 mixes up several
        for name in _output("patchelf", "--print-needed", file).split():
            if name in names:
                subprocess.run(["patchelf", "--replace-needed", name, names[name], file], check=True)
        place = pathlib.Path("$ORIGIN", os.path.relpath(folder, file.parent))
        subprocess.run(["patchelf", "--set-rpath", place, file], check=True)
    return packages


def _self_contained(prefix, build, info):
    """The files of the wheel, by their names in it: package, program, ready studies, manual page, notices."""
    package = _built(prefix, build, ["stylobate", "stylobate_python", "stylobate_wheel"])
    _installed(prefix, build, "program")
    (module,) = (build / "wheel").glob("_core*.so")
    bundled = package / "_bundled"
    bundled.mkdir()
    shutil.copy(module, package)
    shutil.copy(build / "wheel" / "stylobate", bundled)
    packages = _bundle([package / module.name, bundled / "stylobate"], bundled) | {"libhdf5-dev", "libaec-dev"}

    notices = pathlib.Path(prefix, "notices")
    subprocess.run(["cmake", f"-DOUTPUT={notices}", f"-DPACKAGES={';'.join(sorted(packages))}",
                    "-P", HERE.parent / "cmake" / "third_party.cmake"], check=True)
    share = pathlib.Path(prefix, "share")
    shutil.rmtree(share / "doc")
    files = _tree(package, "stylobate") | _tree(share, f"{info.removesuffix('.dist-info')}.data/data/share")
    files[f"{info.removesuffix('.dist-info')}.data/scripts/stylobate"] = (COMMAND.encode(), 0o755)
    files[f"{info}/LICENSE"] = ((HERE.parent / "LICENSE").read_bytes(), 0o644)
    files[f"{info}/third_party"] = (notices.read_bytes(), 0o644)
    return files


def _tree(folder, name):
    """All files of a folder: name in the wheel, content and mode."""
    return {f"{name}/{file.relative_to(folder)}": (file.read_bytes(), 0o755 if os.access(file, os.X_OK) else 0o644)
            for file in sorted(folder.rglob("*")) if file.is_file()}


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    version = project["version"]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    system = sysconfig.get_platform()
    with tempfile.TemporaryDirectory() as folder:
        prefix = os.path.join(folder, "prefix")
        build = pathlib.Path(settings.get("build-dir", os.path.join(folder, "build"))).resolve()
        if "self-contained" in settings:
            system = f"manylinux_{platform.libc_ver()[1]}_{platform.machine()}"
            subprocess.run(["cmake", "--build", build, "--target", "stylobate"], check=True, stdout=sys.stderr)
            version = _output(build / "studies" / "stylobate", "--version").strip()
        info = f"{project['name']}-{version}.dist-info"
        if "self-contained" in settings:
            files = _self_contained(prefix, build, info)
        else:
            files = _tree(_built(prefix, build, ["stylobate_python"]), "stylobate")
    tag = f"{python}-{python}-{re.sub('[-.]', '_', system)}"
    files[f"{info}/METADATA"] = ("".join([
        "Metadata-Version: 2.1\n", f"Name: {project['name']}\n", f"Version: {version}\n",
        f"Summary: {project['description']}\n", f"License: {project['license']['text']}\n",
        f"Requires-Python: {project['requires-python']}\n",
        *(f"Requires-Dist: {name}\n" for name in project["dependencies"])]).encode(), 0o644)
    files[f"{info}/WHEEL"] = ("Wheel-Version: 1.0\nGenerator: stylobate\nRoot-Is-Purelib: false\n"
                              f"Tag: {tag}\n".encode(), 0o644)

    def line(name, content):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        return f"{name},sha256={digest},{len(content)}\n"

    record = f"{info}/RECORD"
    files[record] = (("".join(line(name, content) for name, (content, _) in files.items())
                      + f"{record},,\n").encode(), 0o644)
    made = time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())))[:6]
    wheel = f"{project['name']}-{version}-{tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w") as archive:
        for name, (content, mode) in files.items():
            entry = zipfile.ZipInfo(name, made)
            entry.external_attr = (0o100000 | mode) << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED, 9)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the module is built from a checkout of the whole project: pip install ./python")


if __name__ == "__main__":  # FOLDER BUILD: a self-contained wheel of a build that is there
    print(build_wheel(sys.argv[1], {"build-dir": sys.argv[2], "self-contained": "yes"}))
