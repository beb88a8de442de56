"""The tables of docs/reliability.md, between their markers."""

import re


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" + "---:|" * (len(head) - 1)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def of_kills(rows):
    cells = [[r["study"], r["kills"], r["before the file"], r["runs"], len(r["faults"])] for r in rows]
    cells.append(["all"] + [sum(c[i] for c in cells) for i in range(1, 5)])
    return table(["study", "kills", "before there was a file", "runs that were finished and compared", "faults"], cells)


def of_cases(rows):
    cells = [[r["case"], r["runs"], r["refused"], r["whole all the same"], len(r["faults"])] for r in rows]
    return table(["disturbed", "runs", "ended with a message", "ended whole all the same", "faults"], cells)


def write(path, found, version, simd, seed):
    """Replaces what stands between `<!-- NAME -->` and `<!-- end of NAME -->`, for each part that was run."""
    text = path.read_text(encoding="utf-8")
    makers = {"kills": of_kills, "disks": of_cases, "machines": of_cases}
    for name, rows in found.items():
        made = f"({version}, {simd}, seed {seed}.)\n\n{makers[name](rows)}"
        pattern = re.compile(f"(<!-- {name} -->\n).*?(\n<!-- end of {name} -->)", re.S)
        if not pattern.search(text):
            raise SystemExit(f"{path}: has no place for the table of {name}")
        text = pattern.sub(lambda m: m.group(1) + made + m.group(2), text)
    path.write_text(text, encoding="utf-8")
