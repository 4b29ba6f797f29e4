"""The pages of a site: those made of maps, a project's own, and the reference of the runtime's public names."""

import ast
import re
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path, PurePosixPath

from regscribe.emit import docs_index, load_emitters
from regscribe.evidence.index_row import card
from regscribe.model import RegisterMap
from regscribe.site.nav import REGISTERS
from regscribe.site.staging import Page

REFERENCES = "generated/docs"
"""Where `regscribe generate` writes references: a project's pages link to them there."""

PICTURES = {".svg", ".png", ".jpg", ".jpeg", ".gif", ".webp"}
GUIDES = "Guides"
SECTIONS = {"": GUIDES, "adr": "Decisions"}
"""Titles of folders below docs/ whose names are no words."""

RUNTIME = "regscribe_runtime.public"
SOURCES = {"source", "source code", "repository", "github"}


def map_pages(maps: Sequence[RegisterMap], folder: str) -> tuple[list[Page], dict[str, bytes]]:
    """Return the references of maps with their index, below a folder, and their pictures by path."""
    place = f"{folder}/" if folder else ""
    texts = docs_index.render_index(map(card, maps))
    (index,) = texts.values()
    pages = [Page(f"{place}README.md", "All devices", index, (REGISTERS,) if folder else (), reference=True)]
    files: dict[str, bytes] = {}
    emitters = load_emitters()
    for one in sorted(maps, key=lambda one: (one.maker.lower(), one.id)):
        (text,) = emitters["markdown"].render(one).values()
        pages.append(Page(f"{place}{one.id}.md", one.title, text, (REGISTERS, one.maker or "Others"), reference=True))
        drawn = emitters["pictures"].render(one).items()
        files |= {f"{place}{path.removeprefix('docs/')}": content.encode() for path, content in drawn}
    return pages, files


def project_pages(root: Path) -> tuple[list[Page], dict[str, bytes]]:
    """Return a project's own pages (at its root and below docs/, first those that the README names), and pictures."""
    readme = _text(root / "README.md")
    own = [root / "README.md", *_ordered(root, readme), *sorted(root.glob("*.md"))]
    pages = [_own_page(path.relative_to(root), _text(path)) for path in dict.fromkeys(own) if path.is_file()]
    found = (path for path in sorted(root.glob("docs/**/*")) if path.suffix in PICTURES and path.is_file())
    return pages, {path.relative_to(root).as_posix(): path.read_bytes() for path in found}


def _ordered(root: Path, readme: str) -> list[Path]:
    """Return the pages below docs/ with those first that the README links to, in its order."""
    named = [root / target for target in re.findall(r"\]\((docs/[^)#\s]+\.md)", readme)]
    return [*named, *sorted(root.glob("docs/*.md")), *sorted(root.glob("docs/**/*.md"))]


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def _own_page(path: Path, text: str) -> Page:
    found = re.search(r"^# +(.+?)\s*$", text, re.MULTILINE)
    title = re.sub(r"\\([^\w\s])|[`*]", r"\1", found[1]) if found else path.stem.replace("-", " ").capitalize()
    if path.parts == ("README.md",):
        return Page(path.as_posix(), "Home", text)
    if path.parts[0] != "docs":
        return Page(path.as_posix(), title, text, ("Project",))
    folder = "" if len(path.parts) == 2 else path.parts[1]  # noqa: PLR2004 (docs/ and the name)
    return Page(path.as_posix(), title, text, (SECTIONS.get(folder, folder.replace("-", " ").capitalize()),))


def public_address(root: Path) -> str:
    """Return the address of the repository that pyproject.toml names; empty if it names none."""
    try:
        urls = tomllib.loads(_text(root / "pyproject.toml")).get("project", {}).get("urls", {})
    except tomllib.TOMLDecodeError:
        return ""
    found = (str(url).rstrip("/") for name, url in urls.items() if str(name).lower() in SOURCES)
    return next(found, "")


def runtime_pages() -> list[Page]:
    """Return the reference of what `regscribe_runtime` exports, a page for each of its rooms."""
    spec = find_spec(RUNTIME)
    source = Path(str(spec and spec.origin)).read_text(encoding="utf-8")
    rooms: dict[str, list[str]] = defaultdict(list)
    for node in ast.parse(source).body:
        if isinstance(node, ast.ImportFrom) and node.module:
            room = node.module.split(".")[1]
            rooms[room] += [f"{node.module}.{alias.name}" for alias in node.names]
    return [_room(room, names) for room, names in sorted(rooms.items())]


def _room(room: str, names: Iterable[str]) -> Page:
    """Return a page of names, which mkdocstrings fills in."""
    title = f"regscribe_runtime: {room}"
    listed = [f"::: {name}\n" for name in sorted(names, key=lambda name: name.rpartition(".")[2].lower())]
    text = "\n".join([f"# {title}\n", "All of it is imported from `regscribe_runtime` itself.\n", *listed])
    return Page(str(PurePosixPath("api", f"{room}.md")), room.capitalize(), text, ("Python",), ready=True)
