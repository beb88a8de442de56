"""Makes C++ of the PTX of CUDA kernels, which `ptx_warp.hpp` runs on the processor: every arithmetic instruction becomes
one operation of the same rounding, every register a variable, every label a label.

    ptx_to_cpp.py FILE.ptx REGEX [-o KERNELS.inc]

of all kernels whose mangled names the regular expression finds, and of the functions that they call, to standard output
or to a file, which is written as a whole or not at all. It has a `table` of the kernels (`ptx::Kernel`), and is included
inside a namespace, after `ptx_warp.hpp`. Compile it with -ffp-contract=off.

An instruction, a modifier or a directive that is not known here stops the script, with its line and exit status 1.
"""

import argparse
import functools
import re
import sys

C_TYPES = {"pred": "bool", "f32": "float", "f64": "double"}
for bits in (8, 16, 32, 64):
    C_TYPES[f"s{bits}"] = f"std::int{bits}_t"
    C_TYPES[f"u{bits}"] = C_TYPES[f"b{bits}"] = f"std::uint{bits}_t"
SPECIAL = {f"%{name}.{axis}": f"lane.{name}" if axis == "x" else "1u" if name.startswith("n") else "0u"
           for name in ("tid", "ntid", "ctaid", "nctaid") for axis in "xyz"} | {"%laneid": "lane.number"}
INTEGERS = r"[sub](?:16|32|64)"


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
    """A name of C++, which no name of the including file or of the language is."""
    return "v_" + re.sub(r"\W", "_", name.lstrip("%"))


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
    """For all instructions that the pattern matches completely: a function of the translator, its groups and operands."""
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
        """Assigns an expression of C++ whose type is `kind`. A wider register is filled with its sign, or with zeros."""
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
        match = re.fullmatch(r"(?:\(\s*(?P<result>[\w$]+)\s*\),\s*)?(?P<name>[\w$]+)(?:,\s*\((?P<given>[^()]*)\))?", operands)
        if not match or match["name"] not in self.module.functions:
            raise Unknown(self.line, f"cannot call {operands}")
        self.called.add(match["name"])
        arguments = [match["result"]] if match["result"] else []
        arguments += split_operands(match["given"] or "")
        return f"{identifier(match['name'])}({', '.join(['lane'] + [self.find(name).place for name in arguments])});"


# ---- instructions ---------------------------------------------------------------------------------------------------


@rule(r"(add|sub|mul|div)\.rn\.(f32|f64)")
def rounded(body, name, kind, to, a, b):
    sign = {"add": "+", "sub": "-", "mul": "*", "div": "/"}[name]
    return body.assigned(to, f"{body.value(a, kind)} {sign} {body.value(b, kind)}", kind)


@rule(r"fma\.rn\.(f32|f64)")
def fused(body, kind, to, a, b, c):
    return body.assigned(to, f"std::fma({body.value(a, kind)}, {body.value(b, kind)}, {body.value(c, kind)})", kind)


@rule(r"rcp\.rn\.(f32|f64)")
def reciprocal(body, kind, to, a):
    return body.assigned(to, f"1 / {body.value(a, kind)}", kind)


@rule(r"(sqrt\.rn|abs|neg)\.(f32|f64)")
def of_one(body, name, kind, to, a):
    function = {"sqrt.rn": "std::sqrt", "abs": "std::fabs", "neg": "-"}[name]
    return body.assigned(to, f"{function}({body.value(a, kind)})", kind)


@rule(r"copysign\.(f32|f64)")
def sign_copied(body, kind, to, sign, a):
    return body.assigned(to, f"std::copysign({body.value(a, kind)}, {body.value(sign, kind)})", kind)


@rule(rf"(add|sub|mul\.lo)\.({INTEGERS})")
def modular(body, name, kind, to, a, b):
    kind = as_unsigned(kind)
    sign = {"add": "+", "sub": "-", "mul.lo": "*"}[name]
    # (shorter numbers become int)
    start = "1u * " if width(kind) < 32 else ""
    return body.assigned(to, f"{start}{body.value(a, kind)} {sign} {body.value(b, kind)}", kind)


@rule(r"mad\.lo\.([su](?:16|32|64))")
def multiplied_and_added(body, kind, to, a, b, c):
    kind = as_unsigned(kind)
    product = f"1u * {body.value(a, kind)} * {body.value(b, kind)}"
    return body.assigned(to, f"{product} + {body.value(c, kind)}", kind)


@rule(r"(mul|mad)\.wide\.([su])(16|32)")
def wide_product(body, name, sign, bits, to, a, b, c="0"):
    kind, wide = sign + bits, f"{sign}{2 * int(bits)}"
    product = cast(as_unsigned(wide), f"{cast(wide, body.value(a, kind))} * {cast(wide, body.value(b, kind))}")
    return body.assigned(to, f"{product} + {body.value(c, as_unsigned(wide))}" if name == "mad" else product, as_unsigned(wide))


@rule(r"mul\.hi\.([su])32")
def high_product(body, sign, to, a, b):
    wide = f"{sign}64"
    product = f"{cast(wide, body.value(a, sign + '32'))} * {cast(wide, body.value(b, sign + '32'))}"
    return body.assigned(to, cast("u32", f"({product}) >> 32"), "u32")


@rule(r"(div|rem)\.([su](?:32|64))")
def whole_quotient(body, name, kind, to, a, b):
    function = {"div": "quotient", "rem": "remainder"}[name]
    return body.assigned(to, f"ptx::{function}({body.value(a, kind)}, {body.value(b, kind)})", kind)


@rule(r"(neg|abs)\.(s(?:16|32|64))")
def sign_changed(body, name, kind, to, a):
    plain = body.value(a, as_unsigned(kind))
    negated = cast(as_unsigned(kind), f"0u - {plain}")
    return body.assigned(to, negated if name == "neg" else f"{body.value(a, kind)} < 0 ? {negated} : {plain}", as_unsigned(kind))


@rule(r"(min|max)\.([su](?:16|32|64))")
def smaller_or_larger(body, name, kind, to, a, b):
    a, b = body.value(a, kind), body.value(b, kind)
    return body.assigned(to, f"{a} {'<' if name == 'min' else '>'} {b} ? {a} : {b}", kind)


@rule(r"(and|or|xor)\.(pred|b16|b32|b64)")
def bitwise(body, name, kind, to, a, b):
    sign = {"and": "&", "or": "|", "xor": "^"}[name]
    return body.assigned(to, cast(kind, f"{body.value(a, kind)} {sign} {body.value(b, kind)}"), kind)


@rule(r"not\.(pred|b16|b32|b64)")
def inverted(body, kind, to, a):
    return body.assigned(to, cast(kind, f"{'!' if kind == 'pred' else '~'}{body.value(a, kind)}"), kind)


@rule(rf"(shl|shr)\.({INTEGERS})")
def shifted(body, name, kind, to, a, by):
    function = {"shl": "left", "shr": "right"}[name]
    return body.assigned(to, f"ptx::{function}<{C_TYPES[kind]}>({body.value(a, kind)}, {body.value(by, 'u32')})", kind)


@rule(r"(popc|clz|brev)\.(b32|b64)|(bfind)\.shiftamt\.(u32)")
def counted(body, name, kind, name_of_bfind, kind_of_bfind, to, a):
    name, kind = name or name_of_bfind, kind or kind_of_bfind
    function = {"popc": "std::popcount", "clz": "std::countl_zero", "brev": "ptx::reversed", "bfind": "ptx::to_top"}[name]
    result = kind if name == "brev" else "u32"
    return body.assigned(to, cast(result, f"{function}({body.value(a, kind)})"), result)


FLOAT_COMPARISONS = {"eq": "{a} == {b}", "lt": "{a} < {b}", "le": "{a} <= {b}", "gt": "{a} > {b}", "ge": "{a} >= {b}",
                     "ne": "({a} < {b} || {a} > {b})", "num": "({a} == {a} && {b} == {b})",
                     "equ": "!({a} < {b} || {a} > {b})", "neu": "{a} != {b}", "ltu": "!({a} >= {b})",
                     "leu": "!({a} > {b})", "gtu": "!({a} <= {b})", "geu": "!({a} < {b})",
                     "nan": "!({a} == {a} && {b} == {b})"}
COMPARISONS = {"eq": "==", "ne": "!=", "lt": "<", "le": "<=", "gt": ">", "ge": ">=", "lo": "<", "ls": "<=", "hi": ">",
               "hs": ">="}


@rule(rf"setp\.([a-z]+)(?:\.(and|or|xor))?\.({INTEGERS}|f32|f64)")
def compared(body, comparison, combined, kind, to, a, b, with_=None):
    a, b = body.value(a, kind), body.value(b, kind)
    if is_float(kind) and comparison in FLOAT_COMPARISONS:
        holds = FLOAT_COMPARISONS[comparison].format(a=a, b=b)
    elif not is_float(kind) and comparison in COMPARISONS:
        holds = f"{a} {COMPARISONS[comparison]} {b}"
    else:
        raise Unknown(body.line, f"unknown comparison {comparison}")
    if (combined is None) != (with_ is None):
        raise Unknown(body.line, "setp with a predicate too many, or too few")
    other = body.value(with_, "pred") if combined else None
    out = []
    for name, bit in zip(to.split("|"), (f"({holds})", f"!({holds})"), strict=False):
        # (the second is computed first, where the first one is an operand)
        sign = {"and": "&", "or": "|", "xor": "^"}.get(combined)
        out.append((name, cast("pred", f"{bit} {sign} {other}") if combined else bit))
    if len(out) == 1:
        return body.assigned(*out[0], "pred")
    (first, holds), (second, not_holds) = out
    return f"{{ const bool one = {holds}, two = {not_holds}; " + \
        f"{body.assigned(first, 'one', 'pred')} {body.assigned(second, 'two', 'pred')} }}"


@rule(rf"selp\.({INTEGERS}|f32|f64)")
def selected(body, kind, to, a, b, which):
    return body.assigned(to, f"{body.value(which, 'pred')} ? {body.value(a, kind)} : {body.value(b, kind)}", kind)


def in_braces(text):
    return [part.strip() for part in text[1:-1].split(",")]


@rule(rf"mov\.({INTEGERS}|pred|f32|f64)")
def moved(body, kind, to, a):
    if to.startswith("{"):  # a number into its parts, the lowest first
        parts = in_braces(to)
        part = f"u{width(kind) // len(parts)}"
        out = [body.assigned(name, cast(part, f"whole >> {i * width(part)}"), part) for i, name in enumerate(parts)]
        return f"{{ const {C_TYPES[as_unsigned(kind)]} whole = {body.value(a, as_unsigned(kind))}; {' '.join(out)} }}"
    if a.startswith("{"):
        parts, whole = in_braces(a), as_unsigned(kind)
        part = f"u{width(kind) // len(parts)}"
        return body.assigned(to, " | ".join(f"{cast(whole, body.value(p, part))} << {i * width(part)}"
                                            for i, p in enumerate(parts)), whole)
    return body.assigned(to, body.value(a, kind), kind)


@rule(r"cvta(\.to)?\.(global|local|shared|const|param)\.u64")
def to_generic(body, back, space, to, a):
    value = body.value(a, "u64")
    if space == "shared":
        value = f"lane.{'shared_of_generic' if back else 'generic_of_shared'}({value})"
    return body.assigned(to, value, "u64")


@rule(r"cvt\.([sub](?:8|16|32|64))\.([sub](?:8|16|32|64))")
def whole_converted(body, kind, of, to, a):
    return body.assigned(to, cast(kind, body.value(a, of)), kind)


@rule(r"cvt\.rn\.(f32|f64)\.([su](?:16|32|64))|cvt\.(f64)\.(f32)|cvt\.rn\.(f32)\.(f64)")
def float_of(body, kind1, of1, kind2, of2, kind3, of3, to, a):
    kind, of = kind1 or kind2 or kind3, of1 or of2 or of3
    return body.assigned(to, cast(kind, body.value(a, of)), kind)


@rule(r"cvt\.rzi\.([su](?:32|64))\.(f32|f64)")
def whole_of(body, kind, of, to, a):
    return body.assigned(to, f"ptx::whole<{C_TYPES[kind]}>({body.value(a, of)})", kind)


@rule(r"cvt\.(rni|rzi|rmi|rpi)\.(f32|f64)\.(f32|f64)")
def rounded_to_whole(body, how, kind, of, to, a):
    if kind != of:
        raise Unknown(body.line, f"cvt.{how}.{kind}.{of}")
    function = {"rni": "nearbyint", "rzi": "trunc", "rmi": "floor", "rpi": "ceil"}[how]
    return body.assigned(to, f"std::{function}({body.value(a, kind)})", kind)


MEMORY = (r"(?:\.(?:volatile|weak))?(?:\.(param|shared|global|local|const))?(?:\.nc)?(?:\.(?:ca|cg|cs|lu|cv|wb|wt))?"
          r"(?:\.v([24]))?\.([sub](?:8|16|32|64)|f32|f64)")


@rule("ld" + MEMORY)
def loaded(body, space, count, kind, to, address):
    names = in_braces(to) if count else [to]
    if len(names) != int(count or 1):
        raise Unknown(body.line, f"{len(names)} registers for {count} numbers")
    size = width(kind) // 8
    place = body.place(address, space, size * len(names))
    if not count:
        return body.assigned(to, f"ptx::load<{C_TYPES[kind]}>({place})", kind)
    out = [body.assigned(name, f"ptx::load<{C_TYPES[kind]}>(place + {i * size})", kind) for i, name in enumerate(names)]
    return f"{{ const char* const place = {place}; {' '.join(out)} }}"


@rule("st" + MEMORY)
def stored(body, space, count, kind, address, a):
    values = in_braces(a) if count else [a]
    if len(values) != int(count or 1):
        raise Unknown(body.line, f"{len(values)} registers for {count} numbers")
    size = width(kind) // 8
    place = body.place(address, space, size * len(values))
    out = [f"ptx::store<{C_TYPES[kind]}>(place + {i * size}, {body.value(a, kind)});" for i, a in enumerate(values)]
    return f"{{ char* const place = {place}; {' '.join(out)} }}"


@rule(r"bar\.warp\.sync")
def barrier(body, mask):
    return f"lane.meet({body.value(mask, 'u32')}, {body.line});"


@rule(r"shfl\.sync\.(idx|up|down|bfly)\.b32")
def shuffled(body, way, to, a, b, c, mask):
    name, *inside = to.split("|")
    source = f"lane.source(ptx::Shuffle::{way}, {body.value(b, 'u32')}, {body.value(c, 'u32')})"
    answer = f"lane.shuffle({body.value(a, 'b32')}, source.lane, {body.value(mask, 'u32')}, {body.line})"
    out = [body.assigned(name, answer, "b32")] + [body.assigned(p, "source.inside", "pred") for p in inside]
    return f"{{ const ptx::Source source = {source}; {' '.join(out)} }}"


@rule(r"vote\.sync\.(any\.pred|all\.pred|ballot\.b32)")
def voted(body, what, to, a, mask):
    ballot = f"lane.ballot({body.value(a, 'pred')}, {body.value(mask, 'u32')}, {body.line})"
    return body.assigned(to, *{"any.pred": (f"{ballot} != 0", "pred"), "all.pred": (f"{ballot} == 0xffffffffu", "pred"),
                               "ballot.b32": (ballot, "b32")}[what])


# ---- the file -------------------------------------------------------------------------------------------------------

SHARED = re.compile(r"(?P<extern>\.extern )?(?:\.weak |\.visible )?\.shared(?: \.align (?P<align>\d+))? \.(?P<kind>\w+) "
                    r"(?P<name>[$\w]+)(?:\[(?P<count>\d*)\])?")
TABLE = re.compile(r"(?:\.visible |\.weak )?\.(?:global|const)(?: \.align (?P<align>\d+))? \.(?P<kind>\w+) "
                   r"(?P<name>[$\w]+)(?:\[(?P<count>\d+)\])?(?: ?= ?(?P<values>.*))?")
HEAD = re.compile(r"(?:\.visible |\.weak |\.extern )*\.(?P<what>entry|func)\s*(?:\((?P<result>[^()]*)\)\s*)?"
                  r"(?P<name>[\w$]+)\s*(?:\((?P<given>[^()]*)\))?\s*(?P<rest>[^{;]*)")
PARAMETER = re.compile(r"\.param(?: \.align (?P<align>\d+))? \.(?P<kind>\w+)(?: \.ptr[^,]*?)? (?P<name>[\w$]+)(?:\[(?P<count>\d+)\])?")


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
        places = [f"char* {identifier(name)}" for name, _, _ in self.results + self.parameters]
        return f"[[gnu::noinline]] inline void {identifier(self.name)}({', '.join(['ptx::Lane& lane'] + places)})"


class Module:
    def __init__(self, text):
        self.functions, self.memory, self.tables = {}, {}, []
        self.shared_bytes, self.dynamic_alignment = 0, 16
        text = re.sub(r"//[^\n]*", "", text)
        text = re.sub(r"/\*.*?\*/", lambda match: "\n" * match[0].count("\n"), text, flags=re.S)
        # these have no semicolon at their end
        text = re.sub(r"^\s*\.(version|target|address_size|file|loc)\b[^\n]*", "", text, flags=re.M)
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
        return f"alignas({int(match['align'] or 8)}) inline {C_TYPES[kind]} {identifier(match['name'])}[{count}] = {{{numbers}}};"

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
        signature = f"inline void {identifier(function.name)}(ptx::Lane& lane)" if function.is_entry else function.signature()
        return "\n    ".join([signature + "\n{", *body.declarations(), *lines]) + "\n}\n", body.called, place


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
    return "\n".join(["// made by ptx_to_cpp.py", "#pragma GCC system_header // it is not to be read, and not to be warned of",
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
