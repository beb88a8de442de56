"""Recipe for Spack. Untested: see packaging/README.md.

In a repository of one's own: `spack repo create REPO; mkdir -p REPO/packages/stylobate`, this file into it,
`spack repo add REPO; spack dev-build stylobate@main` in the root of the sources.
"""

from spack.package import *


class Stylobate(CMakePackage):
    """Probability that an ancient multi-drum column or colonnade collapses under given base shaking: ensembles of
    slightly different realizations, several at a time in SIMD lockstep."""

    version("main")  # the sources lie where `spack dev-build` is called; a release adds its address and checksum

    license("Apache-2.0")

    variant("python", default=False, description="Build the Python module")
    variant("cuda", default=False, description="Build the GPU backend")
    variant("mpi", default=True, description="Processes that share a run (run --mpi)")

    depends_on("cxx", type="build")
    depends_on("c", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("git", type="build")  # gives the version its commit

    depends_on("xsimd@8.1", type="build")
    depends_on("random123", type="build")
    depends_on("cli11@2.1:", type="build")
    depends_on("tomlplusplus@3:", type="build")
    depends_on("boost@1.74:", type="build")  # headers alone
    depends_on("eigen@3.4")
    depends_on("fmt@9:")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("pugixml")
    depends_on("tbb")
    depends_on("zlib-api")
    depends_on("librsvg", type=("build", "run"))

    depends_on("cuda@12:", when="+cuda")
    depends_on("mpi", when="+mpi")
    extends("python", when="+python")
    depends_on("python@3.9:", type=("build", "run"), when="+python")
    depends_on("py-pybind11@2.10:", type="build", when="+python")
    depends_on("py-numpy@:1", type="run", when="+python")

    generator("ninja")

    def cmake_args(self):
        args = [
            self.define("STYLOBATE_TESTS", False),
            self.define("STYLOBATE_BENCH", False),
            self.define("STYLOBATE_PYTHON", "ON" if self.spec.satisfies("+python") else "OFF"),
            self.define("STYLOBATE_MPI", "ON" if self.spec.satisfies("+mpi") else "OFF"),
            self.define("STYLOBATE_CUDA", "ON" if self.spec.satisfies("+cuda") else "OFF"),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("Python_EXECUTABLE", self.spec["python"].command.path))
            args.append(self.define("STYLOBATE_PYTHON_DIR", python_platlib))
        return args

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        Executable(join_path(self.prefix.bin, "stylobate"))("info")
