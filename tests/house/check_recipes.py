"""The recipes of packaging/, and what repeats the version, agree with the project: check_recipes.py SOURCE_FOLDER.

Nothing that would run them is here. Spack's is parsed as Python, conda's as YAML after its templates have been filled in;
the options of CMake that they set exist, and so do the targets and files that they name.
"""

import ast
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
failures = []


def check(holds, what):
    if not holds:
        failures.append(what)


cmake = "\n".join(file.read_text() for file in [root / "CMakeLists.txt", *root.glob("cmake/*.cmake"),
                                                *root.glob("*/CMakeLists.txt")])


def check_options(text, of):
    options = set(re.findall(r"(?:-D|\")(STYLOBATE_[A-Z_]+|RANDOM123_INCLUDE_DIR)\b", text))
    check(len(options) >= 4, f"{of}: sets {options}")
    for option in options:
        declared = re.search(rf"(option|set|find_path)\({option}\b", cmake)
        check(declared, f"{of}: {option} is no option of the project")


spack = (root / "packaging/spack/package.py").read_text()
classes = [node for node in ast.parse(spack).body if isinstance(node, ast.ClassDef)]
check([node.name for node in classes] == ["Stylobate"], "spack: one class, Stylobate")
calls = [node for node in ast.walk(classes[0]) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)]
spack_packages = {re.match(r"[a-z0-9-]+", call.args[0].value).group() for call in calls if call.func.id == "depends_on"}
check_options(spack, "spack")

conda_text = (root / "packaging/conda/meta.yaml").read_text()
pattern = re.search(r'regex_pattern="(.*?)"', conda_text).group(1).replace("\\\\", "\\")
version = re.search(pattern, (root / "CMakeLists.txt").read_text())
check(version and re.fullmatch(r"\d+\.\d+\.\d+", version.group(1)), "conda: the version is not found in CMakeLists.txt")
check_options(conda_text, "conda")
for target in re.search(r"--target ([a-z_ ]+)", conda_text).group(1).split():
    check(re.search(rf"(add_executable|add_library|pybind11_add_module)\({target}\b", cmake), f"conda: no target {target}")
conda_packages = set()
try:
    import jinja2
    import yaml
except ImportError:
    print("the templates of conda's recipe were not filled in: python3-jinja2 or python3-yaml is not installed")
else:
    filled = jinja2.Template(conda_text).render(
        compiler=lambda language: f"compiler-{language}", stdlib=lambda language: f"stdlib-{language}",
        load_file_regex=lambda **_: version)
    recipe = yaml.safe_load(re.sub(r"# \[not linux\]", "", filled))
    check(recipe["package"]["version"] == version.group(1), "conda: version")
    check((root / recipe["about"]["license_file"]).exists(), "conda: license file")
    conda_packages = {line.split()[0] for line in recipe["requirements"]["host"]}

# the version has one home, which these repeat
major_minor = version.group(1).rpartition(".")[0]
for file, line in (("CITATION.cff", f"version: {version.group(1)}"),
                   ("python/pyproject.toml", f'version = "{version.group(1)}"'),
                   ("examples/CMakeLists.txt", f"find_package(stylobate {major_minor} REQUIRED)"),
                   ("docs/library.md", f"find_package(stylobate {major_minor} REQUIRED)")):
    check(line in (root / file).read_text(), f"{file}: not '{line}'")

# the changes since the last release are those of this version
sections = re.findall(r"^## (\S+)", (root / "CHANGELOG.md").read_text(), re.M)
check(sections and sections[0] == version.group(1),
      f"CHANGELOG.md: the top section is {sections[:1]}, and CMakeLists.txt has {version.group(1)}")
check(len(sections) == len(set(sections)), "CHANGELOG.md: two sections have one version")

# every library that the project cannot do without is a dependency of both
looked_for = {name.lower() for name in re.findall(r"^find_package\((\w+) REQUIRED", (root / "CMakeLists.txt").read_text(), re.M)}
looked_for |= {"eigen3", "xsimd", "tomlplusplus"}
names = {"tbb": {"tbb", "tbb-devel"}, "eigen3": {"eigen"}, "boost": {"boost", "libboost-headers"},
         "zlib": {"zlib", "zlib-api"}}
check(len(looked_for) >= 9, f"found only {looked_for} in CMakeLists.txt")
for library in looked_for:
    for packages, of in ((spack_packages, "spack"), (conda_packages, "conda")):
        check(not packages or names.get(library, {library}) & packages, f"{of}: {library} is missing")

docker = (root / "packaging/Dockerfile").read_text()
for script in re.findall(r"\bscripts/\S+", docker):
    check((root / script).exists(), f"Dockerfile: no {script}")
check(docker.count("FROM debian:12-slim") == 2, "Dockerfile: from Debian 12")

print("\n".join(failures) or "the recipes agree with the project")
sys.exit(1 if failures else 0)
