"""What a page of docs/guide asks its reader to do, read from its code blocks.

    ```console                      lines that begin with `$ ` are commands, `\\` at the end continues them; the lines below
                                    one are what it prints (both streams). `...` stands for anything within a line, a
                                    line of `...` alone for any number of lines. A command without lines below it
                                    may print anything
    $ COMMAND    # exit status 2    must end with this status instead of 0
    ```toml title="NAME"            (any language): the reader writes this file
    <!-- long -->                   above a block: minutes; run with --long only
    <!-- not run: REASON -->        above a block: it is not run
    <!-- picture NAME.png: figure N of PAGE.html -->    the N-th figure (from 1) of a page that the commands have made

Any other code block is an error: no command of the guide is unproved.
"""

import dataclasses
import re

FENCE = re.compile(r"^```\s*(?P<language>\w*)\s*(?P<rest>.*)$")
TITLE = re.compile(r'^title="(?P<name>[\w.-]+)"$')
STATUS = re.compile(r"\s+# exit status (?P<status>\d+)$")
PICTURE = re.compile(r"!\[(?P<alt>[^\]]*)\]\(images/(?P<name>[\w.-]+)\)")
FIGURE = re.compile(r"^<!-- picture (?P<name>[\w.-]+): figure (?P<number>\d+) of (?P<page>[\w.-]+) -->$", re.M)
PROGRESS = re.compile(r"^\d+( of( about)? \d+)? realizations(,.*)?$")


class PageError(Exception):
    """The page breaks the convention."""


@dataclasses.dataclass
class Command:
    line: int  # of the page, from 1
    text: str
    status: int
    expected: list  # lines; empty: any
    long: bool


@dataclasses.dataclass
class File:
    line: int
    name: str
    text: str
    long: bool


@dataclasses.dataclass
class Page:
    steps: list
    pictures: list  # names, in order
    figures: list  # (name of the picture, number of the figure, name of the HTML page)
    has_long: bool


def commands_of(first, lines, long):
    """The commands of a console block whose first line has the number `first`."""
    found = []
    for number, line in enumerate(lines, first):
        if found and found[-1].text.endswith("\\") and not found[-1].expected:
            found[-1].text = found[-1].text[:-1] + line.strip()
        elif line.startswith("$ "):
            found.append(Command(number, line[2:], 0, [], long))
        elif found:
            found[-1].expected.append(line.rstrip())
        else:
            raise PageError(f"line {number}: the block does not begin with a command (`$ ...`)")
    for command in found:
        status = STATUS.search(command.text)
        if status:
            command.status = int(status["status"])
            command.text = command.text[:status.start()]
    return found


def read_page(text):
    steps, mark, inside = [], None, None
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if inside is None and fence:
            inside = (number, fence["language"], fence["rest"].strip(), [])
        elif inside is None:
            mark = (line if line.startswith("<!--") else None) if line.strip() else mark
        elif line.rstrip() != "```":
            inside[3].append(line)
        else:
            first, language, rest, lines = inside
            inside = None
            long = mark == "<!-- long -->"
            title = TITLE.match(rest)
            if mark and mark.startswith("<!-- not run: "):
                pass
            elif title:
                steps.append(File(first, title["name"], "\n".join(lines) + "\n", long))
            elif language == "console" and not rest:
                steps += commands_of(first + 1, lines, long)
            else:
                raise PageError(f"line {first}: the block `{language} {rest}` is neither `console` nor a file "
                                '(title="NAME"); a block that is not run has <!-- not run: REASON --> above it')
            mark = None
    if inside:
        raise PageError(f"line {inside[0]}: the block does not end")
    return Page(steps, [m["name"] for m in PICTURE.finditer(text)],
                [(m["name"], int(m["number"]), m["page"]) for m in FIGURE.finditer(text)],
                any(step.long for step in steps))


def difference(expected, printed):
    """None if the lines agree; else what is wrong, in words."""
    printed = [line.rstrip() for line in printed if not PROGRESS.match(line)]
    while printed and not printed[-1]:
        printed.pop()
    if not expected:
        return None
    parts = []
    for line in expected:
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*?")
        else:
            parts.append(".*".join(re.escape(part) for part in line.split("...")) + r"\n")
    if re.fullmatch("".join(parts), "".join(line + "\n" for line in printed)):
        return None
    return "stated:\n" + "".join(f"    {x}\n" for x in expected) + "printed:\n" + "".join(f"    {x}\n" for x in printed)
