"""Completion as it is typed: a bash with a terminal, in which Tab is pressed. check_completion.py PROGRAM.

What bash does with the replies (blanks in names, the rest after `=`, the / of a folder) is seen here only.
"""

import os
import pty
import select
import shutil
import subprocess
import sys
import tempfile
import time

if not shutil.which("bash"):
    print("skipped: there is no bash")
    sys.exit(77)

CASES = [  # typed, and what stands in the line after Tab
    ("ru", "run "),
    ("run --thr", "run --threads "),
    ("run s", "run study.toml "),
    ("run a", "run a\\ column.toml "),
    ("run m", "run more/"),
    ("report ", "report "),  # two: nothing more than they have in common
    ("report x", "report x.h5 "),
    ("export x.h5 --to pn", "export x.h5 --to png "),
    ("run --simd=avx5", "run --simd=avx512 "),
    ("diagnose --study=s", "diagnose --study=study.toml "),
    ("run study.toml --set contact.fo", "run study.toml --set contact.form="),
    ("run study.toml --set contact.form=ri", "run study.toml --set contact.form=rigid "),
]


def read_until(terminal, text, seconds=30):
    """What bash shows until `text` is there and nothing more comes for a moment."""
    shown, end = "", time.monotonic() + seconds
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.3)[0]:
            shown += os.read(terminal, 65536).decode(errors="replace")
        elif text in shown:
            break
    return shown


with tempfile.TemporaryDirectory() as folder:
    with open(os.path.join(folder, "completion"), "w") as out:
        subprocess.run([sys.argv[1], "--bash-completion"], stdout=out, check=True)
    for name in ("a column.toml", "study.toml", "x.h5", "y.h5"):
        open(os.path.join(folder, name), "w").close()
    os.mkdir(os.path.join(folder, "more"))
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(folder)
        os.environ.update(TERM="dumb", INPUTRC="/dev/null")
        os.execvp("bash", ["bash", "--norc", "--noprofile", "-i"])
    os.write(terminal, b"PS1='> '; bind 'set bell-style none'; bind 'set enable-bracketed-paste off'; source completion\n")
    os.write(terminal, b"echo rea''dy\n")
    read_until(terminal, "ready")
    failures = []
    for typed, wanted in CASES:
        os.write(terminal, f"stylobate {typed}\t#".encode())
        shown = read_until(terminal, "#").split("> ")[-1]
        if shown != f"stylobate {wanted}#":
            failures.append(f"'{typed}' gave {shown!r}, not {wanted!r}")
        os.write(terminal, b"\x15\n")  # the line is removed
        read_until(terminal, "> ")
    os.write(terminal, b"exit\n")
    os.waitpid(process, 0)
print("\n".join(failures) or f"{len(CASES)} lines were completed")
sys.exit(1 if failures else 0)
