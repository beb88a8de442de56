"""Runs of the program that are disturbed, and what is seen of them."""

import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

SURFACE = {
    "structure.blocks": "4",
    "contact.normal_stiffness_n_m2": "4e6",
    "contact.tangential_stiffness_n_m": "2e5",
    "excitation.cycles": "4",
    "surface.frequency_hz": "{from=4.0,to=8.0,count=4}",
    "surface.pga_m_s2": "{from=4.0,to=25.0,count=4}",
}

# What is run of each kind of study: a second or so of one thread.
STUDIES = {
    "surface, rows": ("small_scale_column.toml", {**SURFACE, "study.realizations": "40"}),
    "surface, counts": (
        "small_scale_column.toml",
        {**SURFACE, "study.realizations": "40", "output.realizations": "none"},
    ),
    "surface, adaptive": (
        "small_scale_column_adaptive.toml",
        {**SURFACE, "study.realizations": "64", "surface.frequency_hz": "{from=4.0,to=8.0,count=3}"},
    ),
    "single": ("free_rocking.toml", {"study.realizations": "24"}),
    "twins": (
        "twins_column.toml",
        {
            "study.realizations": "4",
            "twins.followed": "2",
            "surface.frequency_hz": "{from=2.0,to=4.0,count=2}",
            "surface.pga_m_s2": "{from=2.0,to=9.0,count=2}",
        },
    ),
    "fragility": (
        "fragility_column.toml",
        {"study.realizations": "2", "fragility.motions": "8", "fragility.contacts": "1"},
    ),
    "sensitivity": ("sensitivity_column.toml", {"sensitivity.samples": "16"}),
    "rare": ("rare_collapse.toml", {"rare.samples": "200"}),
    "rigid blocks": ("rigid_column.toml", {"study.realizations": "2"}),
}

WITHOUT_RANKS = ["single"]  # what `--mpi` refuses


class Ended:
    """How a run ended. `status` is negative where a signal ended it."""

    def __init__(self, status, out, err, seconds):
        self.status, self.out, self.err, self.seconds = status, out, err, seconds

    def __str__(self):
        return f"status {self.status}: {(self.err or self.out).strip()[-300:]}"


class Laboratory:
    """The program under test, in a folder of its own."""

    def __init__(self, program, inputs, folder):
        self.program, self.inputs = str(program), pathlib.Path(inputs)
        self.folder = pathlib.Path(folder)
        self.simd = json.loads(self.call(["info", "--json"]).out)["simd"]

    def words(self, study, results, more=()):
        name, settings = STUDIES[study]
        words = ["run", str(self.inputs / name), "-o", str(results), "--quiet", *more]
        for key, value in settings.items():
            words += ["--set", f"{key}={value}"]
        return words

    def start(self, words, environment=None, before=None, **streams):
        return subprocess.Popen(
            [self.program, *words],
            cwd=self.folder,
            env={**os.environ, **(environment or {})},
            preexec_fn=before,
            stdin=subprocess.DEVNULL,
            stdout=streams.get("stdout", subprocess.PIPE),
            stderr=streams.get("stderr", subprocess.PIPE),
            text=True,
            errors="replace",
        )

    def call(self, words, environment=None, before=None, patience_s=300, **streams):
        """Runs the program to its end; one that hangs is killed, and its status is None."""
        begin = time.monotonic()
        process = self.start(words, environment, before, **streams)
        try:
            out, err = process.communicate(timeout=patience_s)
            status = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            out, err = process.communicate()
            status = None
        return Ended(status, out or "", err or "", time.monotonic() - begin)

    def killed(self, words, after_s):
        """Starts it and kills it after a time. @returns whether it was killed, and had not ended before."""
        process = self.start(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(timeout=after_s)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        return process.wait() == -signal.SIGKILL

    def has_ranks(self):
        told = self.call(["info"]).out
        return "MPI: none" not in told and shutil.which("mpirun") is not None

    def killed_ranks(self, ranks, words, after_s, random):
        """The same by several processes, of which one or all are killed; with one of them `mpirun` ends the others."""
        process = subprocess.Popen(
            ["mpirun", "--oversubscribe", "-n", str(ranks), self.program, *words, "--mpi"],
            cwd=self.folder,
            env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        killed = False
        try:
            process.wait(timeout=after_s)
        except subprocess.TimeoutExpired:
            children = children_of(process.pid)
            for child in children if random.random() < 0.5 else random.sample(children, min(1, len(children))):
                try:
                    os.kill(int(child), signal.SIGKILL)
                    killed = True
                except ProcessLookupError:
                    pass
        try:
            return process.wait(timeout=120) != 0 and killed
        except subprocess.TimeoutExpired:
            # Open MPI 4.1.4 sometimes does not notice that all ranks have ended before they met
            left = [child for child in children_of(process.pid) if state_of(child) != "Z"]
            process.kill()
            process.wait()
            if left:
                raise RuntimeError(f"{len(left)} of {ranks} ranks go on 120 s after others were killed: {words}") from None
            return killed

    def path(self, name):
        return self.folder / name

    def remove(self, *names):
        for name in names:
            path = self.path(name)
            shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)


def children_of(pid):
    return pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()


def state_of(pid):
    """As `ps` has it: "Z" of one that has ended."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return "Z"


def digest(path):
    path = pathlib.Path(path)
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else None
