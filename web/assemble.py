#!/usr/bin/env python3
"""Writes the page: style, scripts and the packed engine in one file, which needs nothing beside it.

    assemble.py ENGINE_JS ENGINE_WASM FUSED_WASM VERSION OUTPUT
"""

import base64
import gzip
import pathlib
import sys

WEB = pathlib.Path(__file__).resolve().parent
PAGE = WEB.parent / "studies" / "report" / "page"  # the look and the player of the pages of reports
STYLES = [PAGE / "page.css", WEB / "web.css"]
SCRIPTS = [PAGE / "base.js", PAGE / "player.js", PAGE / "solid.js", PAGE / "space.js",
           WEB / "study.js", WEB / "engine.js", WEB / "page.js"]
MOST_BYTES = 3_000_000


def joined(files):
    return "\n".join(file.read_text() for file in files)


def packed(wasm):
    return base64.b64encode(gzip.compress(pathlib.Path(wasm).read_bytes(), 9, mtime=0)).decode()


def main(glue, wasm, fused, version, output):
    parts = {
        "STYLE": joined(STYLES),
        "ENGINE": packed(wasm),
        "FUSED": packed(fused),
        "GLUE": pathlib.Path(glue).read_text(),
        "WORKER": (WEB / "worker.js").read_text(),
        "SCRIPTS": joined(SCRIPTS),
        "VERSION": f"Stylobate {version}",
    }
    page = (WEB / "index.html").read_text()
    for name, text in parts.items():
        if "</script" in text:
            sys.exit(f"assemble.py: {name} contains '</script', which would end its block of the page")
        before, after = page.split(f"@{name}@")
        page = before + text + after
    size = len(page.encode())
    if size >= MOST_BYTES:
        sys.exit(f"assemble.py: the page has {size} bytes, and may have {MOST_BYTES}")
    pathlib.Path(output).write_text(page)
    print(f"{output}: {size / 1e6:.2f} MB, of which {len(parts['ENGINE']) / 1e6:.2f} MB are the engine "
          f"({pathlib.Path(wasm).stat().st_size / 1e6:.2f} MB before it was packed)")


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    main(*sys.argv[1:])
