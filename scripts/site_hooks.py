"""What mkdocs (mkdocs.yml) does beyond its own for the site of docs/.

Pages link to files outside docs/: texts, headers, studies. Each of them becomes a page or a file of the site, under
source/ and its place in the repository; so do the files that these link to. A link whose words are the name of its file
(`report.md`) is named by the title of the page instead. Texts become pages, other files pages with
their content, pictures are copied, and a folder is its README. The links follow. A link to a file that does not exist
stays as it is, and mkdocs reports it.

Where scripts/web.sh has built the page of the browser, it becomes web/index.html of the site, and docs/browser.md links
to it.
"""

import pathlib
import posixpath
import re
import tempfile

from mkdocs.structure.files import File

LINK = re.compile(r"\[([^\[\]]*)(\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
IMAGE = re.compile(r"(<img [^>]*?src=\")([^\"]+)(\")")  # pictures side by side are HTML
FENCE = re.compile(r"^\s*(```|~~~)")
PICTURES = {".png", ".svg", ".gif", ".jpg"}
LANGUAGES = {".hpp": "cpp", ".cpp": "cpp", ".cu": "cpp", ".cuh": "cpp", ".py": "python", ".sh": "bash", ".toml": "toml"}

WEB_PAGE = "build/web/index.html"
WEB_LINK = "<!-- link to the page -->"

_staged = None  # the folder of what is added to docs/, for as long as mkdocs runs
_root = None


def github_slug(text, separator):
    """The anchor that the pages' links use: letters, digits, '-' and '_' stay, each blank becomes a separator."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", separator)


def target_of(link, page):
    """The file in the repository that a link leads to from `page` (both relative to the root), or None."""
    if re.match(r"[a-z]+:", link):
        return None
    path = posixpath.normpath(posixpath.join(posixpath.dirname(page), link))
    if (_root / path).is_dir():
        path = posixpath.normpath(posixpath.join(path, "README.md"))
    return path if not path.startswith("..") and (_root / path).is_file() else None


def place_of(path):
    """Where a file of the repository is in the site's sources."""
    if path.startswith("docs/"):
        return path[len("docs/"):]
    suffix = posixpath.splitext(path)[1]
    return "source/" + path + ("" if suffix == ".md" or suffix in PICTURES else ".md")


def title_of(path):
    """The first heading of a text of the repository."""
    heading = re.search(r"^# (.+)$", (_root / path).read_text(), re.MULTILINE)
    return heading[1] if heading else path


def links_followed(text, page):
    """The text with its links as the site needs them, and the files that they lead to. Code blocks stay as they are."""
    targets, lines, fenced = [], [], False

    def follow(match):
        words, middle, link, end = match.groups()
        target = target_of(link, page)
        if target is None:
            return match[0]
        targets.append(target)
        if words.endswith(".md") and target.endswith(words.lstrip("./")):
            words = title_of(target)
        return "[" + words + middle + posixpath.relpath(place_of(target), posixpath.dirname(place_of(page))) + end

    def show(match):
        before, link, after = match.groups()
        target = target_of(link, page)
        if target is None:
            return match[0]
        targets.append(target)
        # the browser resolves it against the page of the site, which has the folder of its source
        return before + posixpath.relpath(place_of(target), posixpath.dirname(place_of(page))) + after

    for line in text.split("\n"):
        if FENCE.match(line):
            fenced = not fenced
        lines.append(line if fenced else IMAGE.sub(show, LINK.sub(follow, line)))
    return "\n".join(lines), targets


def page_of(path, text):
    """A file that is no text for readers, as a page with its content."""
    language = LANGUAGES.get(posixpath.splitext(path)[1], "text")
    return f"# {posixpath.basename(path)}\n\n`{path}`\n\n````{language}\n{text}\n````\n"


def on_config(config):
    global _root, _staged
    _root = pathlib.Path(config["config_file_path"]).resolve().parent
    _staged = tempfile.TemporaryDirectory(prefix="stylobate-site-")
    config["mdx_configs"].setdefault("toc", {})["slugify"] = github_slug
    return config


def on_files(files, config):
    waiting = ["docs/" + file.src_uri for file in files if file.src_uri.endswith(".md")]
    seen = set(waiting)
    waiting += ["CHANGELOG.md"]
    while waiting:
        path = waiting.pop()
        text = path.endswith(".md") and (_root / path).read_text()
        targets = links_followed(text, path)[1] if text else []
        waiting += [target for target in targets if target not in seen]
        seen.update(targets)
        if path.startswith("docs/"):
            continue
        place = pathlib.Path(_staged.name, place_of(path))
        place.parent.mkdir(parents=True, exist_ok=True)
        if text:
            place.write_text(links_followed(text, path)[0])
        elif place.suffix == ".md":
            place.write_text(page_of(path, (_root / path).read_text()))
        else:
            place.write_bytes((_root / path).read_bytes())
        if not files.get_file_from_path(place_of(path)):
            files.append(File(place_of(path), _staged.name, config["site_dir"], config["use_directory_urls"]))
    if (_root / WEB_PAGE).is_file():
        files.append(File("web/index.html", str(_root / "build"), config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_markdown(markdown, page, config, files):
    if page.file.src_uri.startswith("source/"):
        return markdown
    if (_root / WEB_PAGE).is_file():
        markdown = markdown.replace(WEB_LINK, "[Open the page](web/index.html)")
    return links_followed(markdown, "docs/" + page.file.src_uri)[0]


def on_post_build(config):
    _staged.cleanup()
