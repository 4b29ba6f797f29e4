"""What a declared thing is, in a few words and in Markdown: as it stands in the map, without compiling it."""

from collections.abc import Iterator

from regscribe.compose.tree import members, text
from regscribe.emit.markdown.escape import escape
from regscribe.emit.words import one_line
from regscribe.language_server.files import MapText
from regscribe.language_server.names import Declaration, Names
from regscribe.model.identifiers import label_id
from regscribe.model.units import KNOWN_UNITS
from regscribe.source import SourceNode, shorten
from regscribe.visible import safe

LINES = 14
"""Lines of the map that are shown of a declaration."""


def summary(one: Declaration) -> str:
    """What a thing is, in a few words."""
    node = one.node
    label = text(node.child("name")) or text(node.child("title")) or text(node.child("description"))
    at = f" at {text(node.child('at'))}" if node.child("at") else ""
    return shorten(f"{one_line(label)}{at}" or one.kind, 80)


def label_of(member: SourceNode) -> str:
    """What a code is called."""
    return text(member.child("label")) if member.members is not None else text(member)


def members_of(node: SourceNode, names: Names) -> Iterator[tuple[str, str, str]]:
    """The codes of a register's enum, each with the name that a condition calls it by, and its label."""
    enum = node.child("enum")
    if enum is not None and enum.members is None:
        found = names.find("enum", text(enum))
        enum = found.node if found else None
    for code, member in members(enum).items():
        if code.lstrip("-").isdigit():
            label = label_of(member)
            yield code, (text(member.child("id")) or label_id(label)).lower(), one_line(label)


def meaning(one: Declaration, file: MapText) -> str:
    """What a declared thing means: its codes, or the lines of the map that say it."""
    head = f"**{escape(one.name)}** ({escape(one.kind)})"
    about = text(one.node.child("description"))
    if one.kind == "unit" and one.name in KNOWN_UNITS:
        about = about or "a known unit"
    parts = [head, escape(one_line(about)) if about else "", source(one, file)]
    return "\n\n".join(filter(None, parts))


def source(one: Declaration, file: MapText) -> str:
    """The lines of the map that declare a thing, as a block of code."""
    first, last = one.spot.place.line, max(one.spot.place.end_line, one.node.place.end_line)
    lines = file.text.split("\n")[first : last + 1]
    cut = lines[:LINES] + (["..."] if len(lines) > LINES else [])
    depth = min((len(line) - len(line.lstrip()) for line in cut if line.strip()), default=0)
    body = "\n".join(safe(line[depth:]).replace("```", "'''") for line in cut)
    return f"```yaml\n{body}\n```"
