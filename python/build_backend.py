"""Makes a wheel of the module with CMake, for `pip install ./python` (PEP 517). Needs no other Python package.

    pip install ./python --config-settings build-dir=build/release      uses a build that is there
"""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent


def _built(prefix, build):
    """Builds and installs the package below `prefix`; its folder."""
    if not (build / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", HERE.parent, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DSTYLOBATE_PYTHON=ON", "-DSTYLOBATE_TESTS=OFF", "-DSTYLOBATE_BENCH=OFF",
                        f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "stylobate_python"], check=True)
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", prefix], check=True)
    (package,) = pathlib.Path(prefix).glob("**/stylobate")
    return package


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"{project['name']}-{project['version']}.dist-info"
    wheel = f"{project['name']}-{project['version']}-{python}-{python}-{platform}.whl"
    with tempfile.TemporaryDirectory() as folder:
        build = (config_settings or {}).get("build-dir", os.path.join(folder, "build"))
        package = _built(os.path.join(folder, "prefix"), pathlib.Path(build).resolve())
        files = {f"stylobate/{file.name}": file.read_bytes() for file in sorted(package.iterdir())}
    files[f"{info}/METADATA"] = "".join([
        "Metadata-Version: 2.1\n", f"Name: {project['name']}\n", f"Version: {project['version']}\n",
        f"Summary: {project['description']}\n", f"Requires-Python: {project['requires-python']}\n",
        *(f"Requires-Dist: {name}\n" for name in project["dependencies"])]).encode()
    files[f"{info}/WHEEL"] = ("Wheel-Version: 1.0\nGenerator: stylobate\nRoot-Is-Purelib: false\n"
                              f"Tag: {python}-{python}-{platform}\n").encode()

    def line(name, content):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        return f"{name},sha256={digest},{len(content)}\n"

    record = f"{info}/RECORD"
    files[record] = ("".join(line(name, content) for name, content in files.items()) + f"{record},,\n").encode()
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("the module is built from a checkout of the whole project: pip install ./python")
