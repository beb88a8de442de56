"""No command of README.md or of the guide writes into files of the project: a fresh clone runs them all.
check_commands.py SOURCE_FOLDER. A command that would replace a file of the tree is refused there ("exists already"), or
changes the tree."""

import pathlib
import re
import shlex
import sys

root = pathlib.Path(sys.argv[1]).resolve()
failures = []
outputs = 0


def commands(text):
    """Lines of code blocks that are run: all of `sh` blocks, those after "$ " of `console` blocks."""
    for language, block in re.findall(r"^```(sh|bash|console)\n(.*?)^```", text, re.M | re.S):
        for line in re.sub(r"\\\n", " ", block).splitlines():
            if language != "console":
                yield line
            elif line.startswith("$ "):
                yield line[2:]


def written(words):
    """Paths that a command names as its outputs: after -o, --output and --out, and after a redirection."""
    for k, word in enumerate(words):
        if word in ("-o", "--output", "--out", ">", ">>") and k + 1 < len(words):
            yield words[k + 1]
        elif found := re.match(r"(?:--output=|--out=|>>?)(.+)", word):
            yield found.group(1)


ignored = [line.strip("/") for line in (root / ".gitignore").read_text().split() if line.startswith("/")]
for page in [root / "README.md", *sorted((root / "docs/guide").glob("*.md"))]:
    for command in commands(page.read_text()):
        for path in written(shlex.split(command, comments=True)):
            outputs += 1
            target = root / path
            first = pathlib.PurePath(path).parts[0]
            if pathlib.PurePath(path).is_absolute() or first in ignored:
                continue
            if target.exists() or (len(pathlib.PurePath(path).parts) > 1 and (root / first).exists()):
                failures.append(f"{page.relative_to(root)}: '{command}' writes {path}, in the project's own folders")

if outputs < 5:
    failures.append(f"only {outputs} outputs were found in the commands: are they still read rightly?")
print("\n".join(failures) or f"{outputs} outputs of commands, none of them a file of the project")
sys.exit(1 if failures else 0)
