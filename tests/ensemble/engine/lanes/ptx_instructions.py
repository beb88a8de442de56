"""The instructions of PTX that ptx_to_cpp.py knows: a rule for each, whose pattern has all its modifiers."""

from ptx_body import C_TYPES, INTEGERS, Unknown, as_unsigned, cast, is_float, rule, width


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
    if name == "mad":
        product += f" + {body.value(c, as_unsigned(wide))}"
    return body.assigned(to, product, as_unsigned(wide))


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
    changed = cast(as_unsigned(kind), f"0u - {plain}")
    if name == "abs":
        changed = f"{body.value(a, kind)} < 0 ? {changed} : {plain}"
    return body.assigned(to, changed, as_unsigned(kind))


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
    function = {"popc": "std::popcount", "clz": "std::countl_zero", "brev": "ptx::reversed",
                "bfind": "ptx::to_top"}[name]
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
