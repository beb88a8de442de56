"""Makes C++ of the PTX of CUDA kernels, which `ptx_warp.hpp` runs on the processor: every arithmetic instruction
becomes one operation of the same rounding, every register a variable, every label a label.

    ptx_to_cpp.py FILE.ptx REGEX [-o KERNELS.inc]

of all kernels in whose mangled names the regular expression is found, and of the functions that they call. The output
(a file is written as a whole or not at all) has a `table` of the kernels (`ptx::Kernel`). It is included inside a
namespace, after `ptx_warp.hpp`. Compile it with -ffp-contract=off.

An instruction, a modifier or a directive that is not known here stops the script, with its line and exit status 1.
"""

import argparse
import re
import sys

import ptx_instructions  # noqa: F401  (the rules)
from ptx_body import Body, C_TYPES, Memory, SHARED, Unknown, identifier, split_operands, width

TABLE = re.compile(r"(?:\.visible |\.weak )?\.(?:global|const)(?: \.align (?P<align>\d+))? \.(?P<kind>\w+) "
                   r"(?P<name>[$\w]+)(?:\[(?P<count>\d+)\])?(?: ?= ?(?P<values>.*))?")
HEAD = re.compile(r"(?:\.visible |\.weak |\.extern )*\.(?P<what>entry|func)\s*(?:\((?P<result>[^()]*)\)\s*)?"
                  r"(?P<name>[\w$]+)\s*(?:\((?P<given>[^()]*)\))?\s*(?P<rest>[^{;]*)")
PARAMETER = re.compile(r"\.param(?: \.align (?P<align>\d+))? \.(?P<kind>\w+)(?: \.ptr[^,]*?)? (?P<name>[\w$]+)"
                       r"(?:\[(?P<count>\d+)\])?")


class Function:
    def __init__(self, match, body, line):
        self.is_entry, self.name = match["what"] == "entry", match["name"]
        self.results, self.parameters = [self.read(match[part], line) for part in ("result", "given")]
        self.body, self.line = body, line

    @staticmethod
    def read(text, line):
        """[(name, bytes, alignment)]"""
        found = []
        for part in split_operands(" ".join((text or "").split())):
            match = PARAMETER.fullmatch(part)
            if not match:
                raise Unknown(line, f"unknown parameter {part}")
            size = width(match["kind"]) // 8
            found.append((match["name"], size * int(match["count"] or 1), max(int(match["align"] or 1), size)))
        return found

    def signature(self):
        if self.is_entry:
            return f"inline void {identifier(self.name)}(ptx::Lane& lane)"
        places = [f"char* {identifier(name)}" for name, _, _ in self.results + self.parameters]
        return f"[[gnu::noinline]] inline void {identifier(self.name)}({', '.join(['ptx::Lane& lane'] + places)})"


class Module:
    def __init__(self, text):
        self.functions, self.memory, self.tables = {}, {}, []
        self.shared_bytes, self.dynamic_alignment = 0, 16
        text = re.sub(r"//[^\n]*", "", text)
        text = re.sub(r"/\*.*?\*/", lambda match: "\n" * match[0].count("\n"), text, flags=re.S)
        # these have no semicolon at their end
        text = re.sub(r"^[ \t]*\.(version|target|address_size|file|loc)\b[^\n]*", "", text, flags=re.M)
        place, line = 0, 1
        while place < len(text):
            head = re.compile(r"\s*([^;{]*)").match(text, place)
            begin = line + text.count("\n", place, head.start(1))
            if head.end() == len(text):
                if head[1].strip():
                    raise Unknown(begin, f"cannot be read: {head[1][:80]}")
                return
            function = HEAD.fullmatch(head[1])
            if "=" in head[1] or text[head.end()] == ";":
                end = text.index(";", head.end())
                if not function:
                    self.variable(" ".join(text[head.start(1):end].split()), begin)
            elif not function:
                raise Unknown(begin, f"unknown: {head[1][:80]}")
            else:
                end = self.closing(text, head.end(), begin)
                self.functions[function["name"]] = Function(function, text[head.end() + 1:end],
                                                            line + text.count("\n", place, head.end()))
            line += text.count("\n", place, end + 1)
            place = end + 1

    @staticmethod
    def closing(text, place, line):
        depth = 0
        for match in re.compile(r"[{}]").finditer(text, place):
            depth += 1 if match[0] == "{" else -1
            if depth == 0:
                return match.start()
        raise Unknown(line, "a brace that is not closed")

    def variable(self, text, line):
        if match := SHARED.fullmatch(text):
            self.memory[match["name"]] = Memory("shared", self.place_shared(match))
            return
        match = TABLE.fullmatch(text)
        if not match or match["kind"] not in C_TYPES:
            raise Unknown(line, f"unknown: {text}")
        # (a table with addresses is left out, and stops the script where it is used)
        values = in_braces(match["values"]) if (match["values"] or "").startswith("{") else [match["values"] or "0"]
        if all(re.fullmatch(r"-?\d+|0[dDfF]?[xX]?[0-9a-fA-F]+", value) for value in values):
            self.tables.append((match, values))
            self.memory[match["name"]] = Memory("global", f"reinterpret_cast<char*>({identifier(match['name'])})")

    def place_shared(self, match):
        """Fixed arrays stand one after another, those of all kernels of the file; then what the launch adds."""
        size = width(match["kind"]) // 8
        align = max(int(match["align"] or 1), size)
        if match["extern"]:
            self.dynamic_alignment = max(align, self.dynamic_alignment)
            return "dynamic_shared"
        place = -(-self.shared_bytes // align) * align
        self.shared_bytes = place + size * int(match["count"] or 1)
        return f"{place}u"

    def table(self, match, values):
        kind, body = match["kind"], Body(self, {})
        numbers = ", ".join(body.value(value, kind) for value in values)
        count = int(match["count"] or 1)
        name = f"alignas({int(match['align'] or 8)}) inline {C_TYPES[kind]} {identifier(match['name'])}"
        return f"{name}[{count}] = {{{numbers}}};"

    def function(self, function):
        """C++ of a function, and the names of those that it calls."""
        place, names = 0, {}
        for name, size, align in function.parameters:
            if function.is_entry:
                place = -(-place // align) * align
                names[name] = Memory("param", f"(lane.parameters + {place})")
                place += size
            else:
                names[name] = Memory("param", identifier(name))
        for name, _, _ in function.results:
            names[name] = Memory("param", identifier(name))
        body = Body(self, names, is_entry=function.is_entry)
        lines = body.translate(function.body, function.line)
        return "\n    ".join([function.signature() + "\n{", *body.declarations(), *lines]) + "\n}\n", body.called, place


def translated(text, pattern):
    module = Module(text)
    entries = [f for f in module.functions.values() if f.is_entry and re.search(pattern, f.name)]
    if not entries:
        raise Unknown(1, f"no kernel's name has {pattern}; there are: " +
                      ", ".join(f.name for f in module.functions.values() if f.is_entry))
    code, rows, done, waiting = [], [], set(), []
    for entry in entries:
        text, called, size = module.function(entry)
        code.append(text)
        rows.append((entry.name, size))
        waiting += called
    declared = []
    while waiting:
        name = waiting.pop()
        if name in done:
            continue
        done.add(name)
        text, called, _ = module.function(module.functions[name])
        declared.append(module.functions[name].signature() + ";")
        code.append(text)
        waiting += called
    fixed = -(-module.shared_bytes // module.dynamic_alignment) * module.dynamic_alignment
    table = [f'    {{"{name}", &{identifier(name)}, {size}, {fixed}}},' for name, size in rows]
    return "\n".join(["// made by ptx_to_cpp.py",
                      "#pragma GCC system_header // it is not to be read, and not to be warned of",
                      f"constexpr unsigned dynamic_shared = {fixed};",
                      *[module.table(*table) for table in module.tables], *sorted(declared), *code,
                      "inline constexpr ptx::Kernel table[] = {", *table, "};"])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ptx")
    parser.add_argument("regex")
    parser.add_argument("-o", dest="output")
    given = parser.parse_args()
    with open(given.ptx) as file:
        source = file.read()
    try:
        code = translated(source, given.regex)
    except Unknown as unknown:
        sys.exit(f"{given.ptx}:{unknown.args[0]}: {unknown.args[1]}")
    if given.output:
        with open(given.output, "w") as file:
            file.write(code + "\n")
    else:
        print(code)
