#!/usr/bin/env python3
"""The parts of scripts/mutants.sh: check, list, copy, programs, run. Lists: tests/mutants/*.txt (see its README.md)."""

import collections
import concurrent.futures
import csv
import dataclasses
import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LISTS = ROOT / "tests/mutants"
RESULTS = LISTS / "results.csv"
PAGE = LISTS / "README.md"
HEADER = '#include "tests/mutants/mutant.hpp"\n#line 1\n'
WANTED = 0.9  # of the mutants
STRONGEST = 100  # precedence of what needs no brackets
OPERATORS = {"*": 80, "/": 80, "%": 80, "+": 70, "-": 70, "<<": 60, ">>": 60, "<": 50, "<=": 50, ">": 50, ">=": 50,
             "==": 45, "!=": 45, "&": 40, "^": 39, "|": 38, "&&": 30, "||": 25, "?": 20, ":": 20, "=": 20, "+=": 20,
             "-=": 20, "*=": 20, "/=": 20, ",": 10}


@dataclasses.dataclass
class Mutant:
    """One mistake: the expression between two @ of a text that occurs once in a file, and what replaces it."""
    number: int
    room: str
    file: str
    text: str  # with both @
    replacement: str
    mistake: str
    reason: str  # why it may survive; "equivalent: ...": it is not counted
    tests: list  # (program, filter) of its file
    suites: tuple  # (program, filter) of its room
    line: int = 0
    begin: int = 0  # of the expression in the file
    end: int = 0

    @property
    def expression(self):
        return self.text.split("@")[1]

    @property
    def key(self):
        return (self.file, self.text, self.replacement)

    @property
    def equivalent(self):
        return self.reason.startswith("equivalent")

    def described(self):
        return f"{self.file}:{self.line}: {self.mistake}: {self.expression} -> {self.replacement}"


def read_lists():
    """All mutants, numbered from 1 in the order of the lists."""
    mutants = []
    for path in sorted(LISTS.glob("*.txt")):
        room = program = suites = file = ""
        tests = []
        for number, line in enumerate(path.read_text().splitlines(), 1):
            word, _, rest = line.strip().partition(" ")
            if not word or word.startswith("#"):
                continue
            if " ==> " in line:
                text, _, made = line.partition(" ==> ")
                replacement, *notes = [part.strip() for part in made.split(" ## ")]
                if text.count("@") != 2 or not notes or not file:
                    sys.exit(f"{path}:{number}: is not TEXT with @EXPRESSION@ ==> REPLACEMENT ## MISTAKE [## REASON]")
                reason = notes[1] if len(notes) > 1 else ""
                mutants.append(Mutant(len(mutants) + 1, room, file, text.strip(), replacement, notes[0], reason, tests,
                                      (program, suites)))
            elif word == "room":
                room = rest
            elif word == "program":
                program = rest
            elif word == "suites":
                suites = rest
            elif word == "file":
                file, tests = rest, []
            elif word == "tests":
                tests.append(tuple(rest.split()) if " " in rest else (program, rest))
            else:
                sys.exit(f"{path}:{number}: '{word}' is none of room, program, suites, file, tests, nor a mutant")
    return mutants


def top_level(code):
    """The characters of an expression outside of brackets and strings, others blank; None where brackets do not match."""
    kept, closing = [], []
    quote = ""
    for at, c in enumerate(code):
        if quote:
            quote = "" if c == quote and code[at - 1] != "\\" else quote
            kept.append(" ")
        elif c in "\"'" and not (c == "'" and at > 0 and code[at - 1].isdigit()):
            quote = c
            kept.append("x")
        elif c in "([{":
            closing.append({"(": ")", "[": "]", "{": "}"}[c])
            kept.append(c if len(closing) == 1 else " ")
        elif c in ")]}":
            if not closing or closing.pop() != c:
                return None
            kept.append(c if not closing else " ")
        else:
            kept.append(c if not closing else " ")
    return None if closing or quote else "".join(kept)


def binary_operators(code):
    """Binary operators of an expression outside of brackets; < and > with blanks around them, or they are templates'."""
    flat = top_level(code)
    pattern = r"(?<=[\w)\]}] )(<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%<>&|^?:=])(?= )"
    return re.findall(pattern, flat) + ([","] if "," in flat else [])


def weakest(code):
    found = [OPERATORS[o] for o in binary_operators(code)]
    return min(found, default=90 if re.match(r"[-!*&+]", code) else STRONGEST)


def parse_error(code, begin, end, replacement):
    """Why the expression could not be replaced by one in brackets; empty: it can."""
    line_begin = code.rfind("\n", 0, begin) + 1
    before, expression = code[line_begin:begin], code[begin:end]
    for name, part in (("expression", expression), ("replacement", replacement)):
        if not part.strip() or top_level(part) is None or ";" in part:
            return f"the {name} is no expression: {part}"
    if "//" in before or before.count('"') % 2:
        return "the expression is in a comment or a text"
    loose = weakest(expression)
    left = code[max(0, begin - 200):begin].rstrip()
    right = code[end:end + 200].lstrip()
    word = re.search(r"[\w)\]]+$", left)
    if word and word.group() != "return":
        return f"the expression begins within another one, after {word.group()}"
    operator = re.search(r"(<<|>>|<=|>=|==|!=|&&|\|\||[-+*/]=|->|::|[-+*/%<>&|^.!])$", left)
    if operator:
        unary = re.search(r"([(\[{,;=?:<>&|+*/%-]|return)$", left[:operator.start()].rstrip()) is not None
        strength = 90 if unary else OPERATORS.get(operator.group(), STRONGEST)
        if strength >= loose and strength > 20:
            return f"{operator.group()} before it binds more tightly"
    operator = re.match(r"(<<|>>|<=|>=|==|!=|&&|\|\||->|[-+*/%<>&|^?.(\[]|\w+)", right)
    if operator:
        strength = OPERATORS.get(operator.group(), STRONGEST)
        if strength > loose or operator.group() == "?" and loose <= 20:
            return f"{operator.group()} after it binds more tightly"
    return ""


def locate(mutants):
    """Finds the place of each mutant; ends with all errors where there are any."""
    errors = []
    by_file = collections.defaultdict(list)
    for m in mutants:
        by_file[m.file].append(m)
    for file, own in by_file.items():
        path = ROOT / file
        code = path.read_text() if path.is_file() else ""
        for m in own:
            plain = m.text.replace("@", "")
            count = code.count(plain)
            if count != 1:
                errors.append(f"{file}: occurs {count} times: {plain}")
                continue
            m.begin = code.index(plain) + m.text.index("@")
            m.end = m.begin + len(m.expression)
            m.line = code.count("\n", 0, m.begin) + 1
            why = parse_error(code, m.begin, m.end, m.replacement)
            if why:
                errors.append(f"{file}:{m.line}: {why}: {m.text}")
        placed = sorted((m for m in own if m.line), key=lambda m: m.begin)
        errors += [f"{file}:{b.line}: two mutants overlap" for a, b in zip(placed, placed[1:]) if b.begin < a.end]
        names = [m.key for m in own]
        errors += [f"{file}: is listed twice: {key[1]}" for key in set(names) if names.count(key) > 1]
    if errors:
        sys.exit("\n".join(errors))


def mutated(code, mutants):
    for m in sorted(mutants, key=lambda m: -m.begin):
        code = f"{code[:m.begin]}(::stylobate::mutant({m.number}) ? ({m.replacement}) : ({m.expression})){code[m.end:]}"
    return HEADER + code


def chosen(mutants, regex):
    found = [m for m in mutants if re.search(regex, m.described())]
    if not found:
        sys.exit(f"mutants.sh: no mutant matches '{regex}'")
    return found


def copy(mutants, tree, regex):
    """Writes the tree with the mutants of the files of those that are chosen. Equal files are left as they are."""
    by_file = collections.defaultdict(list)
    for m in mutants:
        by_file[m.file].append(m)
    wanted = {m.file for m in chosen(mutants, regex)}
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    for name in names:
        source, target = ROOT / name, tree / name
        if not source.is_file():
            continue
        plain = source.read_bytes()
        known = target.read_bytes() if target.is_file() else None
        with_mutants = mutated(plain.decode(), by_file[name]).encode() if name in by_file else plain
        if known == with_mutants or (known == plain and name not in wanted):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        if name in wanted:
            target.write_bytes(with_mutants)
        else:
            shutil.copy2(source, target)


def programs_of(mutants):
    return sorted({program for m in mutants for program, _ in m.tests + [m.suites]})


class Programs:
    """The test programs, and how long their tests take without a mutant."""

    def __init__(self, build, names):
        self.folder = build / "tests"
        self.tests = {name: self.listed(name) for name in names}
        self.seconds = {}

    def listed(self, name):
        text = subprocess.run([self.folder / name, "--gtest_list_tests"], check=True, text=True,
                              stdout=subprocess.PIPE).stdout
        tests, suite = [], ""
        for line in text.splitlines():
            if line.startswith("  "):
                tests.append(suite + line.split()[0])
            elif re.match(r"\S+\.(\s|$)", line):
                suite = line.split()[0]
        return [t for t in tests if not re.search(r"Long\.|^Long/|Long$|PinnedOutcomes", t)]

    def matching(self, name, pattern, statistics):
        """Tests of a filter: statistical ones, or all others and those that it names as such."""
        return [t for t in self.tests[name]
                if any(fnmatch.fnmatchcase(t, p if p.endswith("*") else p + "*") and
                       ("Statistics" in t) == (statistics or "Statistics" in p) for p in pattern.split(":"))]

    def own(self, m):
        """(program, quick tests) of the file."""
        return [(p, tests) for p, f in m.tests if (tests := self.matching(p, f, False))]

    def stages(self, m, quick):
        """Those of the file, then those of the room, then the statistical ones of the file."""
        own = self.own(m)
        known = {(p, t) for p, tests in own for t in tests}
        program, suites = m.suites
        room = (program, [t for t in self.matching(program, suites, False) if (program, t) not in known])
        late = [] if quick else [(p, self.matching(p, re.sub(r"\.[^:]*", "*", f), True)) for p, f in m.tests]
        return own + [(p, tests) for p, tests in [room] + late if tests]

    def run(self, number, program, tests, limit):
        """The first test that fails with a mutant; empty: all pass."""
        with tempfile.TemporaryDirectory() as folder:
            environment = dict(os.environ, STYLOBATE_MUTANT=str(number), TMPDIR=folder)
            try:
                done = subprocess.run([self.folder / program, "--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)],
                                      cwd=folder, env=environment, text=True, errors="replace", timeout=limit,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            except subprocess.TimeoutExpired as late:
                begun = re.findall(r"\[ RUN +\] (\S+)", (late.stdout or b"").decode(errors="replace"))
                return f"{begun[-1] if begun else tests[0]} (time limit)"
        if done.returncode == 0:
            return ""
        failed = re.search(r"\[  FAILED  \] ([\w/]+\.[\w/]+)", done.stdout)
        begun = re.findall(r"\[ RUN +\] (\S+)", done.stdout)
        return failed.group(1) if failed else f"{begun[-1] if begun else program} (crash)"

    def limit(self, program, tests):
        """Ten times what these tests take without a mutant; they must pass."""
        key = (program, tuple(tests))
        if key not in self.seconds:
            begin = time.monotonic()
            failed = self.run(0, program, tests, 3600)
            if failed:
                raise RuntimeError(f"{program}: {failed} fails without a mutant")
            self.seconds[key] = time.monotonic() - begin
        return 60 + 10 * self.seconds[key]

    def killer(self, m, quick):
        for program, tests in self.stages(m, quick):
            failed = self.run(m.number, program, tests, self.limit(program, tests))
            if failed:
                return failed
        return ""


def run(mutants, build, jobs, regex, quick):
    wanted = [m for m in chosen(mutants, regex) if not m.equivalent]
    programs = Programs(build, programs_of(wanted))
    try:  # the tests of the rooms follow when they are needed
        for program, tests in dict.fromkeys((p, tuple(t)) for m in wanted for p, t in programs.own(m)):
            programs.limit(program, list(tests))
    except RuntimeError as error:
        sys.exit(f"mutants.sh: {error}")
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, check=True, text=True,
                            stdout=subprocess.PIPE).stdout.strip()
    results = read_results()
    killed = 0
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        pending = {pool.submit(programs.killer, m, quick): m for m in wanted}
        for done in concurrent.futures.as_completed(pending):
            m, test = pending[done], done.result()
            killed += test != ""
            results[m.key] = (test, commit)
            print(f"{m.number:3d} {test or 'SURVIVED':60s} {m.described()}", flush=True)
            write_results(mutants, results)
    write_page(mutants, results)
    print(f"{killed} of {len(wanted)} mutants are noticed by the tests ({100 * killed / len(wanted):.1f} %)")
    return 0 if killed >= WANTED * len(wanted) else 1


def read_results():
    if not RESULTS.is_file():
        return {}
    with RESULTS.open(newline="") as file:
        return {(r["file"], r["text"], r["replacement"]): (r["test"], r["commit"]) for r in csv.DictReader(file)}


def write_results(mutants, results):
    """One row for each mutant that has been run: an empty test means that it survived."""
    with RESULTS.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["file", "text", "replacement", "test", "commit"])
        table.writerows([*m.key, *results[m.key]] for m in mutants if m.key in results)


def cell(code):
    return "`" + code.replace("|", "\\|") + "`"


def write_page(mutants, results):
    counted = [m for m in mutants if not m.equivalent]
    rooms = list(dict.fromkeys(m.room for m in mutants))
    page = [
        "# tests/mutants/", "",
        "Single mistakes that the tests must notice. Each one replaces one expression of a source: n for n - 1, a wrong "
        "tail, a missing term. `../../scripts/mutants.sh` makes them one by one in a copy of the tree, runs the tests, "
        "and writes this page and `results.csv`. A mutant is killed when a test fails; the tests of checksums "
        "(`PinnedOutcomes`) are not run.", "",
        "Each list `*.txt` has the lines `room`, `program` and `suites` (of the room's tests), then for each source "
        "`file` and `tests [PROGRAM] FILTER` (the tests that are run first), then its mutants:", "",
        "```", "TEXT with @EXPRESSION@ ==> REPLACEMENT ## MISTAKE [## REASON why it may survive]", "```", "",
        "The text without both `@` occurs once in the file. A mutant whose reason begins with `equivalent` makes no "
        "difference to any result; it is neither run nor counted.", "",
        "| room | mutants | run | killed | survived |", "|---|---:|---:|---:|---:|"]
    sums = [0, 0, 0]
    for room in rooms:
        own = [m for m in counted if m.room == room]
        ran = [m for m in own if m.key in results]
        killed = sum(results[m.key][0] != "" for m in ran)
        page.append(f"| {room} | {len(own)} | {len(ran)} | {killed} | {len(ran) - killed} |")
        sums = [a + b for a, b in zip(sums, (len(own), len(ran), killed))]
    page.append(f"| all | {sums[0]} | {sums[1]} | {sums[2]} | {sums[1] - sums[2]} |")
    for room in rooms:
        page += ["", f"## {room}", "", "| file | mistake | expression | replacement | killed by |", "|---|---|---|---|---|"]
        for m in (m for m in mutants if m.room == room):
            test = results[m.key][0] if m.key in results else None
            by = (m.reason if m.equivalent else "not run" if test is None else
                  test or "**survived**" + (f": {m.reason}" if m.reason else ""))
            page.append(f"| `{m.file[len(room) + 1:]}:{m.line}` | {m.mistake} | {cell(m.expression)} "
                        f"| {cell(m.replacement)} | {by} |")
    PAGE.write_text("\n".join(page) + "\n")


def main():
    action, *words = sys.argv[1:]
    mutants = read_lists()
    locate(mutants)
    if action == "check":
        print(f"{len(mutants)} mutants in {len({m.file for m in mutants})} files")
    elif action == "list":
        for m in chosen(mutants, words[0]):
            print(f"{m.number:3d} {m.described()}")
    elif action == "copy":
        copy(mutants, pathlib.Path(words[0]), words[1])
    elif action == "programs":
        print("\n".join(programs_of(chosen(mutants, words[0]))))
    elif action == "run":
        return run(mutants, pathlib.Path(words[0]).resolve(), int(words[1]), words[2], "quick" in words[3:])
    elif action == "page":
        write_page(mutants, read_results())
    return 0


if __name__ == "__main__":
    sys.exit(main())
