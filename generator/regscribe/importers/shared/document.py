"""A configuration as a draft: what is common to all that stand in one document with many points."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import wraps
from typing import Any

from regscribe.draft import Draft, Entry, refused
from regscribe.importers.shared.collect import Item, collected
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, LeftOutError
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.model import Diagnostic, Severity, Span
from regscribe.plugins import OptionError

Tree = tuple[Node, list[tuple[int, str]]]
LOOK = 200_000
"""Bytes that a look at a file sees."""
MOST_DEVICES = 40
"""Devices that a message lists."""
MARKS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16", b"\xef\xbb\xbf": "utf-8-sig"}


def reads(function: Callable[[bytes, str, Mapping[str, str]], Draft]) -> Callable[..., Draft]:
    """Make an importer's function one that returns a refusal with its line where the document cannot be read."""

    @wraps(function)
    def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
        try:
            return function(data, name, options)
        except TreeError as error:
            return refused(name, error.message, line=error.line, help_text=error.help_text)

    return read


def text_of(data: bytes) -> str:
    """Return the text of a document. Raises TreeError where it is none."""
    coding = next((one for mark, one in MARKS.items() if data.startswith(mark)), "utf-8")
    try:
        text = data.decode(coding)
    except UnicodeDecodeError as error:
        message = f"the byte 0x{data[error.start]:02X} is no {coding}"
        raise TreeError(data.count(b"\n", 0, error.start) + 1, message, "save the file as UTF-8") from None
    if "\0" in text:
        raise TreeError(text.count("\n", 0, text.index("\0")) + 1, "there is a NUL in it: it is no text")
    return text.replace("\r\n", "\n")


def has(data: bytes, *patterns: str) -> bool:
    """Whether the beginning of a file has each of these patterns, which count from the beginnings of lines."""
    text = data[:LOOK].decode("utf-8", errors="replace")
    return all(re.search(pattern, text, re.MULTILINE) for pattern in patterns)


@dataclass(slots=True)
class Collecting:
    """Points of one document as they are found; `shown` are keys that only matter to a display."""

    file: str
    shown: frozenset[str] = frozenset()
    items: list[Item] = field(default_factory=list)
    counted: Counter[str] = field(default_factory=Counter)
    stated: list[str] = field(default_factory=list)
    findings: list[Diagnostic] = field(default_factory=list)

    def place(self, node: Node) -> Span:
        """The place of a value."""
        return Span(self.file, node.line, 1, node.line, 1)

    def add(
        self,
        name: str,
        node: Node,
        make: Callable[[Keys], Point | None],
        *,
        group: str = "",
        outer: Mapping[str, Node] | None = None,
    ) -> None:
        """Add the point that a mapping is; where it cannot be taken, that it is left out, and why.

        `outer` has what counts where the mapping itself says nothing.
        """
        keys = Keys(node, outer=outer or {})
        try:
            point = make(keys)
        except LeftOutError as why:
            self.left_out(name, node, why, group or "Registers")
            return
        if point is None:
            return
        self.counted.update(key for key in node.members or {} if key in self.shown and key not in keys.taken)
        remarks = (*point.remarks, *keys.remarks, *keys.rest(self.shown))
        self.items.append(replace(point, remarks=remarks, group=group or point.group))

    def left_out(self, name: str, node: Node, why: LeftOutError, group: str = "Registers") -> None:
        """Add a row that is left out."""
        self.items.append(Entry(name=name, place=self.place(node), remarks=(why.remark,), group=group))

    def warn(self, node: Node, message: str) -> None:
        """Add a fault of the source."""
        self.findings.append(Diagnostic("import", message, self.place(node), severity=Severity.WARNING))

    def doubled(self, keys: Iterable[tuple[int, str]]) -> None:
        """Add findings on keys that stand twice in one mapping."""
        for line, key in keys:
            message = f"the key `{key}` stands twice in one mapping: the last one counts"
            self.findings.append(
                Diagnostic("import", message, Span(self.file, line, 1, line, 1), severity=Severity.WARNING)
            )

    def draft(self, *, title: str = "", maker: str = "", head: Mapping[str, Any] | None = None) -> Draft:
        """Return the draft of all that was found."""
        entries, found = collected(self.items)
        if self.counted:
            listed = ", ".join(f"{key} ({count})" for key, count in self.counted.most_common())
            self.stated.append(f"for displays only, not in the map: {listed}")
        return Draft(
            entries=entries,
            head=head or {},
            title=title,
            maker=maker,
            stated=tuple(self.stated),
            findings=(*self.findings, *found),
        )


def chosen(option: str, wanted: str, every: Sequence[str], what: str) -> str:
    """Return the one of several devices that an option names, or the only one. Raises OptionError."""
    if wanted and wanted in every:
        return wanted
    if not wanted and len(every) == 1:
        return every[0]
    listed = ", ".join(every[:MOST_DEVICES]) or "none"
    wrong = f"--{option} {wanted}: there is no such {what}"
    message = f"{wrong if wanted else f'there are several: say by --{option} which {what}'}, of {listed}"
    raise OptionError(message)
