"""Translates the body of a kernel or of a function of PTX: names, operands, statements and calls. The instructions are
in ptx_instructions.py."""

import functools
import re

C_TYPES = {"pred": "bool", "f32": "float", "f64": "double"}
for bits in (8, 16, 32, 64):
    C_TYPES[f"s{bits}"] = f"std::int{bits}_t"
    C_TYPES[f"u{bits}"] = C_TYPES[f"b{bits}"] = f"std::uint{bits}_t"
SPECIAL = {f"%{name}.{axis}": f"lane.{name}" if axis == "x" else "1u" if name.startswith("n") else "0u"
           for name in ("tid", "ntid", "ctaid", "nctaid") for axis in "xyz"} | {"%laneid": "lane.number"}
INTEGERS = r"[sub](?:16|32|64)"

SHARED = re.compile(r"(?P<extern>\.extern )?(?:\.weak |\.visible )?\.shared(?: \.align (?P<align>\d+))? "
                    r"\.(?P<kind>\w+) (?P<name>[$\w]+)(?:\[(?P<count>\d*)\])?")


class Unknown(Exception):
    pass


def width(kind):
    return 8 if kind == "pred" else int(kind[1:])


def is_float(kind):
    return kind[0] == "f"


def as_unsigned(kind):
    return f"u{width(kind)}"


def cast(kind, expression):
    return f"static_cast<{C_TYPES[kind]}>({expression})"


def identifier(name):
    """A name of C++, which no name of the including file or of the language is. Blocks of inline assembly have
    registers without %, whose names may be those of others."""
    return ("r_" if name.startswith("%") else "v_") + re.sub(r"\W", "_", name.lstrip("%"))


def split_operands(text):
    """At the commas outside of brackets."""
    parts, depth, start = [], 0, 0
    for i, letter in enumerate(text):
        depth += (letter in "{[(") - (letter in "}])")
        if letter == "," and depth == 0:
            parts.append(text[start:i].strip())
            start = i + 1
    last = text[start:].strip()
    return parts + [last] if last else parts


def statements(text, line):
    """(line, kind, text) of each: kind is "{", "}", "label" or "statement". Braces inside a statement are its own."""
    place = 0
    pattern = re.compile(r"\s*(?:([{}])|([\w$]+):(?!:)|([^;{}\s][^;]*);)")
    while place < len(text):
        match = pattern.match(text, place)
        if not match:
            if text[place:].strip():
                raise Unknown(line, f"cannot be read: {text[place:].strip()[:80]}")
            return
        begin = line + text.count("\n", place, match.start(match.lastindex))
        line += text.count("\n", place, match.end())
        place = match.end()
        brace, label, statement = match.groups()
        if brace:
            yield begin, brace, brace
        elif label:
            yield begin, "label", label
        else:
            yield begin, "statement", " ".join(statement.split())


class Memory:
    """A name of PTX that is a place in memory. `place` is C++: a pointer, or an offset in shared memory."""

    def __init__(self, space, place):
        self.space, self.place = space, place


class Register:
    def __init__(self, name, kind):
        self.name, self.kind = name, kind


RULES = []


def rule(pattern):
    """Of the instructions that the pattern matches completely. The function is given the body that is translated, the
    groups of the pattern and the operands; it returns C++."""
    def add(function):
        RULES.append((re.compile(pattern), function))
        return function
    return add


@functools.lru_cache(maxsize=None)
def rule_for(instruction):
    for pattern, function in RULES:
        match = pattern.fullmatch(instruction)
        if match:
            return function, match.groups()
    raise Unknown(None, f"unknown instruction {instruction}")


class Body:
    """Translates the body of a kernel or of a function."""

    def __init__(self, module, names, result_of_call=None, is_entry=True):
        self.module = module
        self.scopes = [dict(module.memory) | names]
        self.result, self.is_entry = result_of_call, is_entry
        self.used = set()
        self.called = set()
        self.line = 0

    # ---- names and operands -----------------------------------------------------------------------------------------

    def find(self, name):
        for scope in reversed(self.scopes):
            if name in scope:
                return scope[name]
        raise Unknown(self.line, f"unknown name {name}")

    def register(self, name):
        found = self.find(name)
        if not isinstance(found, Register):
            raise Unknown(self.line, f"{name} is no register")
        self.used.add(found.name)
        return found

    def value(self, text, kind):
        """An operand as C++ of that type."""
        text = text.strip()
        if text in SPECIAL:
            return self.converted(SPECIAL[text], "b32", kind)
        if match := re.fullmatch(r"0[dD]([0-9a-fA-F]{16})|0[fF]([0-9a-fA-F]{8})", text):
            if match[1]:
                return self.converted(f"std::bit_cast<double>(std::uint64_t{{0x{match[1]}u}})", "f64", kind)
            return self.converted(f"std::bit_cast<float>(std::uint32_t{{0x{match[2]}u}})", "f32", kind)
        if match := re.fullmatch(r"-?(0x[0-9a-fA-F]+|\d+)U?", text):
            number = int(text.rstrip("U"), 0)
            if kind == "pred":
                return "true" if number else "false"
            if is_float(kind):
                raise Unknown(self.line, f"a whole number as {kind}: {text}")
            return cast(kind, f"{number % 2 ** width(kind):#x}u")
        if kind == "pred" and text.startswith("!"):
            return f"!{self.value(text[1:], kind)}"
        found = self.find(text)
        if isinstance(found, Memory):
            return cast(kind, found.place if found.space == "shared" else f"ptx::address({found.place})")
        register = self.register(text)
        return self.converted(register.name, register.kind, kind)

    def converted(self, expression, of, to):
        """The bits of a register (whose type is pred, b or f), as an instruction of another type reads them."""
        if of == to or (not is_float(of) and to == as_unsigned(of)) or (not is_float(of) and to == "b" + of[1:]):
            return expression
        if "pred" in (of, to) or width(of) < width(to) or (width(of) > width(to) and (is_float(of) or is_float(to))):
            raise Unknown(self.line, f"{expression}, which is {of}, as {to}")
        if is_float(of) or is_float(to):
            return f"std::bit_cast<{C_TYPES[to]}>({expression})"
        return cast(to, expression)

    def assigned(self, name, expression, kind):
        """Assigns an expression of C++ of type `kind`; a wider register is filled with its sign, or with zeros."""
        name = name.strip()
        if name == "_":
            return f"static_cast<void>({expression});"
        register = self.register(name)
        of, to = kind, register.kind
        if "pred" in (of, to):
            if of != to:
                raise Unknown(self.line, f"{of} into {name}, which is {to}")
        elif width(of) > width(to) or (width(of) < width(to) and (is_float(of) or is_float(to))):
            raise Unknown(self.line, f"{of} into {name}, which is {to}")
        elif is_float(of) != is_float(to):
            expression = f"std::bit_cast<{C_TYPES[to]}>({expression})"
        elif width(of) < width(to) or width(of) < 32:
            expression = cast(to, cast(of, expression))
        return f"{register.name} = {expression};"

    def place(self, text, space, count):
        """A pointer of C++ to so many bytes at an address: [name+offset]."""
        match = re.fullmatch(r"\[\s*([%$\w.]+)\s*(?:\+\s*(-?\w+))?\s*\]", text)
        if not match:
            raise Unknown(self.line, f"unknown address {text}")
        name, offset = match[1], int(match[2] or "0", 0)
        if space == "shared":
            return f"lane.shared({self.value(name, 'u32')} + {offset % 2 ** 32:#x}u, {count})"
        if re.fullmatch(r"\d.*", name):
            raise Unknown(self.line, f"unknown address {text}")
        found = self.find(name)
        if isinstance(found, Memory):
            if found.space == "shared":
                raise Unknown(self.line, f"{name} lies in shared memory")
            return f"({found.place} + {offset})"
        return f"ptx::at({self.value(name, 'u64')} + {offset % 2 ** 64:#x}u, {count})"

    # ---- statements -------------------------------------------------------------------------------------------------

    def translate(self, text, line):
        """Lines of C++, without the registers of the body itself (`declarations`)."""
        out = []
        for self.line, kind, words in statements(text, line):
            if kind == "{":
                self.scopes.append({})
                out.append("{")
            elif kind == "}":
                self.scopes.pop()
                out.append("}")
            elif kind == "label":
                out.append(f"{identifier(words)}:;")
            else:
                try:
                    out.append(self.statement(words))
                except Unknown as unknown:
                    raise Unknown(self.line, unknown.args[1]) from None
        return [text for text in out if text]

    def statement(self, text):
        if text.startswith("."):
            return self.directive(text)
        match = re.fullmatch(r"(?:@(!?%?[\w$]+)\s+)?([a-z][\w.:]*)\s*(.*)", text)
        if not match:
            raise Unknown(self.line, f"cannot be read: {text}")
        guard, instruction, operands = match.groups()
        if instruction in ("call", "call.uni"):
            done = self.call(operands)
        elif instruction in ("bra", "bra.uni"):
            done = f"goto {identifier(operands)};"
        elif instruction == "ret" or (instruction == "exit" and self.is_entry):
            done = "return;"
        else:
            function, groups = rule_for(instruction)
            try:
                done = function(self, *groups, *split_operands(operands))
            except TypeError:
                raise Unknown(self.line, f"{instruction} has other operands than are known: {operands}") from None
        return f"if ({self.value(guard, 'pred')}) {{ {done} }}" if guard else done

    def directive(self, text):
        if text.startswith(".pragma"):
            return None
        if match := re.fullmatch(r"\.reg \.(\w+) (.*)", text):
            kind = match[1]
            if kind != "pred":
                kind = ("f" if kind[0] == "f" else "b") + kind[1:]
            if kind not in C_TYPES:
                raise Unknown(self.line, f"unknown type: {text}")
            return self.registers(kind, split_operands(match[2]))
        if match := re.fullmatch(r"\.(local|param)(?: \.align (\d+))? \.(\w+) ([$\w]+)(?:\[(\d+)\])?", text):
            space, align, kind, name, count = match.groups()
            count = int(count or 1) * width(kind) // 8
            self.scopes[-1][name] = Memory(space, identifier(name))
            return f"alignas({max(int(align or 1), width(kind) // 8)}) char {identifier(name)}[{count}];"
        if match := SHARED.fullmatch(text):
            self.scopes[-1][match["name"]] = Memory("shared", self.module.place_shared(match))
            return None
        raise Unknown(self.line, f"unknown directive: {text}")

    def registers(self, kind, names):
        """Those of an inner block are declared there, as others may have the same names."""
        out = []
        for name in names:
            match = re.fullmatch(r"([%$\w]+)<(\d+)>", name)
            for each in [f"{match[1]}{i}" for i in range(int(match[2]))] if match else [name]:
                self.scopes[-1][each] = Register(identifier(each), kind)
                out.append(f"{C_TYPES[kind]} {identifier(each)} = ptx::unwritten<{C_TYPES[kind]}>;")
        return " ".join(out) if len(self.scopes) > 1 else None

    def declarations(self):
        """Of the registers that are used. They stand before all labels, past which no jump may go."""
        by_kind = {}
        for found in self.scopes[0].values():
            if isinstance(found, Register) and found.name in self.used:
                by_kind.setdefault(found.kind, []).append(found.name)
        return [f"{C_TYPES[kind]} " + ", ".join(f"{name} = ptx::unwritten<{C_TYPES[kind]}>" for name in names) + ";"
                for kind, names in by_kind.items()]

    def call(self, operands):
        match = re.fullmatch(r"(?:\(\s*(?P<result>[\w$]+)\s*\),\s*)?(?P<name>[\w$]+)(?:,\s*\((?P<given>[^()]*)\))?",
                             operands)
        if not match or match["name"] not in self.module.functions:
            raise Unknown(self.line, f"cannot call {operands}")
        self.called.add(match["name"])
        arguments = [match["result"]] if match["result"] else []
        arguments += split_operands(match["given"] or "")
        return f"{identifier(match['name'])}({', '.join(['lane'] + [self.find(name).place for name in arguments])});"
