"""The recipes of packaging/, and what repeats the version, agree with the project: check_recipes.py SOURCE_FOLDER.

Debian has neither Spack nor conda-build. Spack's recipe is parsed as Python, conda's as YAML after its templates have been
filled in; they have no words that Spack and conda-build do not know, the options of CMake that they set exist, and so do
the targets and files that they name; their dependencies are those of scripts/install_packages.sh, and the versions of
these are those of CMake's files.
"""

import ast
import builtins
import pathlib
import re
import sys
import tomllib

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
spack_tree = ast.parse(spack)
classes = [node for node in spack_tree.body if isinstance(node, ast.ClassDef)]
check([node.name for node in classes] == ["Stylobate"], "spack: one class, Stylobate")
check([ast.unparse(base) for base in classes[0].bases] == ["CMakePackage"], "spack: a CMakePackage")
check(ast.get_docstring(classes[0]), "spack: a docstring, which is the description")

# What spack.package gives to a recipe, and the keywords that its directives have.
SPACK_DIRECTIVES = {
    "version": {"sha256", "url", "git", "tag", "commit", "branch", "preferred", "deprecated"},
    "license": {"checked_by", "when"},
    "variant": {"default", "description", "values", "multi", "when", "sticky"},
    "depends_on": {"type", "when", "patches"},
    "extends": {"type", "when", "patches"},
    "generator": {"default"},
    "conflicts": {"when", "msg"},
    "maintainers": set(),
    "run_after": {"when"},
    "on_package_attributes": {"run_tests"},
}
SPACK_NAMES = {"CMakePackage", "Executable", "join_path", "python_platlib", *SPACK_DIRECTIVES}
nodes = list(ast.walk(spack_tree))
made = {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
made |= {node.arg for node in nodes if isinstance(node, ast.arg)}
for node in nodes:
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
        check(node.id in SPACK_NAMES | made | set(dir(builtins)), f"spack: the name {node.id} is unknown")
calls = [node for node in nodes if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)]
for call in calls:
    unknown = {word.arg for word in call.keywords} - SPACK_DIRECTIVES.get(call.func.id, set())
    check(not unknown, f"spack: {call.func.id} has no {unknown}")
variants = {call.args[0].value for call in calls if call.func.id == "variant"}
conditions = {word.value.value for call in calls for word in call.keywords if word.arg == "when"}
conditions |= {node.args[0].value for node in nodes if isinstance(node, ast.Call) and ast.unparse(node.func) == "self.spec.satisfies"}
check(variants and {condition.lstrip("+~") for condition in conditions} == variants,
      f"spack: the variants are {variants}, and those that are asked for {conditions}")
check(any(call.func.id == "version" for call in calls), "spack: no version")

spack_packages = {}  # name: the part of the version
for call in calls:
    if call.func.id == "depends_on":
        parts = re.fullmatch(r"([a-z0-9-]+)(?:@([0-9.:]+))?(?: ?[+~][a-z]+)*", call.args[0].value)
        check(parts, f"spack: depends_on({call.args[0].value!r}) is no specification")
        for word in call.keywords:
            types = {word.value.value} if isinstance(word.value, ast.Constant) else {each.value for each in word.value.elts}
            check(word.arg != "type" or types <= {"build", "link", "run", "test"}, f"spack: a type of {types}")
        if parts:
            spack_packages[parts.group(1)] = parts.group(2) or ""
check_options(spack, "spack")

conda_text = (root / "packaging/conda/meta.yaml").read_text()
pattern = re.search(r'regex_pattern="(.*?)"', conda_text).group(1).replace("\\\\", "\\")
version = re.search(pattern, (root / "CMakeLists.txt").read_text())
check(version and re.fullmatch(r"\d+\.\d+\.\d+", version.group(1)), "conda: the version is not found in CMakeLists.txt")
check_options(conda_text, "conda")
for target in re.search(r"--target ([a-z_ ]+)", conda_text).group(1).split():
    check(re.search(rf"(add_executable|add_library|pybind11_add_module)\({target}\b", cmake), f"conda: no target {target}")
conda_packages = {}
CONDA_KEYS = {
    "package": {"name", "version"},
    "source": {"path", "url", "sha256", "folder", "patches", "git_url", "git_rev", "fn"},
    "build": {"number", "string", "skip", "script", "script_env", "noarch", "entry_points", "run_exports", "ignore_run_exports",
              "ignore_run_exports_from", "missing_dso_whitelist", "rpaths"},
    "requirements": {"build", "host", "run", "run_constrained"},
    "test": {"imports", "commands", "requires", "files", "source_files", "downstreams"},
    "about": {"home", "dev_url", "doc_url", "license", "license_family", "license_file", "summary", "description"},
    "extra": {"recipe-maintainers"},
}
CONDA_NEEDED = {"package": {"name", "version"}, "build": {"number", "script"}, "requirements": {"build", "host", "run"},
                "test": {"imports", "commands"}, "about": {"license", "license_file", "summary"}, "source": set()}
try:
    import jinja2
    import yaml
except ImportError:
    print("the templates of conda's recipe were not filled in: python3-jinja2 or python3-yaml is not installed")
else:
    filled = jinja2.Template(conda_text, undefined=jinja2.StrictUndefined).render(
        compiler=lambda language: f"compiler-{language}", stdlib=lambda language: f"stdlib-{language}",
        load_file_regex=lambda **_: version)

    class Once(yaml.SafeLoader):
        """A key that stands twice hides the first: YAML's reader says nothing."""

        def construct_mapping(self, node, deep=False):
            keys = [key.value for key, _ in node.value]
            check(len(keys) == len(set(keys)), f"conda: a key stands twice in {keys}")
            return super().construct_mapping(node, deep)

    recipe = yaml.load(re.sub(r"# \[not linux\]", "", filled), Once)
    check(not set(recipe) - set(CONDA_KEYS), f"conda: unknown sections {set(recipe) - set(CONDA_KEYS)}")
    for section, known in CONDA_KEYS.items():
        entries = recipe.get(section) or {}
        for entry in entries if isinstance(entries, list) else [entries]:
            check(not set(entry) - known, f"conda: unknown keys of {section}: {set(entry) - known}")
            for key in CONDA_NEEDED.get(section, ()):
                check(entry.get(key) not in (None, "", []), f"conda: {section} has no {key}")
    check(recipe.get("package", {}).get("version") == version.group(1), "conda: version")
    check((root / recipe.get("about", {}).get("license_file", "nowhere")).exists(), "conda: license file")
    for line in [line for lines in recipe.get("requirements", {}).values() for line in lines]:
        parts = re.fullmatch(r"([a-z0-9.-]+)(?: ([<>=]*[0-9.*,]+))?", line)
        check(parts, f"conda: {line!r} is no requirement")
        if parts and not parts.group(1).startswith(("compiler-", "stdlib-")):
            conda_packages[parts.group(1)] = parts.group(2) or conda_packages.get(parts.group(1), "")

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

# The dependencies are those of the one list, under the names that Spack and conda-forge have for them.
listed = (root / "scripts/install_packages.sh").read_text()
build_list, test_list = ({word for line in re.search(rf"^{name}=\((.*?)^\)", listed, re.M | re.S).group(1).splitlines()
                          for word in line.partition("#")[0].split()} for name in ("packages", "for_tests"))
NAMES = {  # Debian: Spack, conda-forge
    "g++": ("cxx", None), "cmake": ("cmake", "cmake"), "ninja-build": ("ninja", "ninja"), "git": ("git", "git"),
    "libxsimd-dev": ("xsimd", "xsimd"), "libtbb-dev": ("tbb", "tbb-devel"), "libeigen3-dev": ("eigen", "eigen"),
    "libboost1.74-dev": ("boost", "libboost-headers"), "librandom123-dev": ("random123", None),  # conda: a second source
    "libhdf5-dev": ("hdf5", "hdf5"), "zlib1g-dev": ("zlib-api", "zlib"),
    "libtomlplusplus-dev": ("tomlplusplus", "tomlplusplus"), "libcli11-dev": ("cli11", "cli11"),
    "libfmt-dev": ("fmt", "fmt"), "libpugixml-dev": ("pugixml", "pugixml"), "librsvg2-dev": ("librsvg", "librsvg"),
    "pkgconf": ("pkgconfig", "pkg-config"),
    "pybind11-dev": ("py-pybind11", "pybind11"), "python3-dev": ("python", "python"),
    "python3-numpy": ("py-numpy", "numpy"), "libopenmpi-dev": ("mpi", None),  # conda: -DSTYLOBATE_MPI=OFF
}
NOT_IN_RECIPES = {"libgtest-dev", "libbenchmark-dev", "python3-jsonschema", "nlohmann-json3-dev",  # tests alone
                  "fonts-dejavu-core"}
unknown = build_list - set(NAMES) - NOT_IN_RECIPES
check(not unknown, f"install_packages.sh has {unknown}, and check_recipes.py no name of it in Spack and conda")
check(len(build_list) >= 18 and set(NAMES) <= build_list | test_list,
      f"install_packages.sh no longer has {set(NAMES) - build_list - test_list}")
for packages, of, column, others in ((spack_packages, "spack", 0, {"c", "cuda"}), (conda_packages, "conda", 1, set())):
    expected = {names[column] for names in NAMES.values() if names[column]} | others
    check(not packages or set(packages) == expected,
          f"{of}: the dependencies differ from install_packages.sh: {set(packages) ^ expected}")

# The oldest versions that CMake takes, in both; and NumPy's newest.
least = {name.lower(): number for name, number in re.findall(r"find_package\((\w+) ([0-9.]+)", cmake)}
least["cmake"] = re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)\)", cmake).group(1)
check({"cmake", "pybind11", "python"} <= set(least), f"only {set(least)} have a version in CMake's files")
for library, number in least.items():
    for packages, of, written in ((spack_packages, "spack", f"{number}:"), (conda_packages, "conda", f">={number}")):
        found = next((packages[name] for name in (library, f"py-{library}") if packages.get(name)), written)
        check(found == written, f"{of}: {library} {found}, and CMake wants {number}")
numpy = tomllib.loads((root / "python/pyproject.toml").read_text())["project"]["dependencies"]
newest = re.fullmatch(r"numpy<(\d+)", numpy[0])
check(len(numpy) == 1 and newest, f"pyproject.toml: {numpy}")
check(spack_packages.get("py-numpy") == f":{int(newest.group(1)) - 1}", "spack: NumPy's version is not that of pyproject.toml")
check(conda_packages.get("numpy", f"<{newest.group(1)}") == f"<{newest.group(1)}",
      "conda: NumPy's version is not that of pyproject.toml")

docker = (root / "packaging/Dockerfile").read_text()
for script in re.findall(r"\bscripts/\S+", docker):
    check((root / script).exists(), f"Dockerfile: no {script}")
check(docker.count("FROM debian:12-slim") == 2, "Dockerfile: from Debian 12")

print("\n".join(failures) or "the recipes agree with the project")
sys.exit(1 if failures else 0)
