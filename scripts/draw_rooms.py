#!/usr/bin/env python3
"""Draws the rooms of the source tree as docs/images/rooms.svg.

    scripts/draw_rooms.py [OUTPUT.svg]

The graph is that of tests/house/test_includes.cpp, which fails where a file includes what the graph does not have: the
picture is as true as the test. A room stands above the rooms that it includes; arrows that follow from others are left
out, and so are those between floors: every room of a floor may include the floors below it.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLOORS = [  # from the top: name, what it is
    ("library", "library: what other programs use, behind include/stylobate"),
    ("studies/evidence", "studies/evidence: programs that write pages of docs/"),
    ("studies", "studies: what people run"),
    ("io", "io: files (sees plain data of ensemble alone)"),
    ("ensemble", "ensemble: many realizations"),
    ("kernels", "kernels: the physics of one step"),
]
ALONE = {"ensemble": "experiment.hpp", "studies": "version.hpp"}  # files beside the rooms of a floor
BOX, GAP, ROW, PAD = 136, 18, 62, 34


def graph():
    text = (ROOT / "tests/house/test_includes.cpp").read_text()
    table = text[text.index("rooms = {"):text.index("};", text.index("rooms = {"))]
    rooms = {}
    for name, includes in re.findall(r'\{"([\w/]+)",\s*\{([^}]*)\}\}', table):
        rooms[name] = {to for to in re.findall(r'"([\w/]+)"', includes) if to != name}
    return rooms


def levels(rooms):
    level = {}

    def of(room):
        if room not in level:
            level[room] = 1 + max((of(to) for to in rooms[room] if to in rooms), default=-1)
        return level[room]

    for room in rooms:
        of(room)
    return level


def reduced(rooms):
    """Arrows that no longer way replaces."""
    reach = {}

    def of(room):
        if room not in reach:
            reach[room] = set().union(*({to} | of(to) for to in rooms[room] if to in rooms), set())
        return reach[room]

    return [(a, b) for a in rooms for b in rooms[a]
            if b in rooms and not any(b in of(c) for c in rooms[a] if c != b and c in rooms)]


def floor_of(room):
    return next(floor for floor, _ in FLOORS if room == floor or room.startswith(floor + "/"))


def place(rooms, level, top):
    """Centres of the rooms of a floor, row by row, each row in the order of what it includes."""
    rows = {}
    for room in rooms:
        rows.setdefault(level[room], []).append(room)
    widest = max(len(row) for row in rows.values())
    at = {}
    for k in sorted(rows):
        def below(room):
            xs = [at[to][0] for to in rooms[room] if to in at]
            return sum(xs) / len(xs) if xs else 0
        row = sorted(rows[k], key=lambda room: (below(room), room))
        start = (widest - len(row)) / 2
        for i, room in enumerate(row):
            at[room] = ((start + i) * (BOX + GAP), top + (max(rows) - k) * ROW)
    return at, widest * (BOX + GAP), (max(rows) + 1) * ROW


def main():
    output = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images/rooms.svg"
    rooms = graph()
    bands, y = [], PAD
    for floor, title in FLOORS:
        own = {room: {to for to in rooms[room] if floor_of(to) == floor}
               for room in rooms if floor_of(room) == floor}
        at, width, height = place(own, levels(own), y + 40)
        bands.append((floor, title, own, at, width, y, height + 48))
        y += height + 48 + 24
    whole = max(band[4] for band in bands) + 2 * PAD
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {whole:.0f} {y + 6:.0f}" '
           f'font-family="sans-serif" font-size="12">',
           '<title>The rooms of the source tree</title>',
           '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
           'orient="auto"><path d="M0 0L8 4L0 8z" fill="#667"/></marker></defs>',
           f'<rect width="{whole:.0f}" height="{y + 6:.0f}" fill="#fff"/>']
    for floor, title, own, at, width, top, height in bands:
        left = (whole - width) / 2 + GAP / 2
        svg.append(f'<rect x="{PAD / 2}" y="{top}" width="{whole - PAD}" height="{height}" rx="8" fill="#f3f4f7"/>')
        svg.append(f'<text x="{PAD}" y="{top + 20}" font-weight="bold" fill="#223">{title}</text>')
        for a, b in reduced(own):
            (xa, ya), (xb, yb) = at[a], at[b]
            svg.append(f'<line x1="{left + xa + BOX / 2:.0f}" y1="{ya + 30:.0f}" x2="{left + xb + BOX / 2:.0f}" '
                       f'y2="{yb - 1:.0f}" stroke="#99a" marker-end="url(#head)"/>')
        for room, (x, yy) in at.items():
            name = ALONE.get(room, room[len(floor) + 1:] or floor)
            svg.append(f'<rect x="{left + x:.0f}" y="{yy:.0f}" width="{BOX}" height="30" rx="5" fill="#fff" '
                       f'stroke="#557"/>')
            size = ' font-size="10"' if len(name) > 20 else ""
            svg.append(f'<text x="{left + x + BOX / 2:.0f}" y="{yy + 19:.0f}" text-anchor="middle"{size} '
                       f'data-room="{room}">{name}</text>')
    svg.append("</svg>\n")
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text("\n".join(svg))


if __name__ == "__main__":
    main()
