"""The importer of SunSpec's models in JSON: a model is a block of a chain, its points are registers.

Value = number x 10^sf, where sf names a point or is a constant. A group is repeated as often as a point says, or, with
a count of 0, to the end of the block.
"""

from collections import Counter
from collections.abc import Mapping

from regscribe.draft import Draft, Entry
from regscribe.files import OneLine
from regscribe.importers.shared.document import has, reads, text_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.read_json import read_json
from regscribe.importers.shared.tree import Node, TreeError, walk
from regscribe.importers.sunspec.groups import Scope, laid_out
from regscribe.model import Diagnostic, Severity, Span
from regscribe.plugins import Likeness, Option, OptionError

name = "sunspec"
summary = "a SunSpec model in JSON, as a block of a device's chain"
options = (Option("most", "most elements of a repeated group that a device may have.", default="10", metavar="N"),)

MAKER = "SunSpec Alliance"
CHAIN = "sunspec"
MARKER = [0x5375, 0x6E53]
"""`SunS`, which stands before the first header."""
STARTS = [40000, 0, 50000]
MOST_ELEMENTS = 9999
LAST_ID = 65534
SHOWN = ("standards", "comments", "detail", "notes")


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by an id, a group and points with types of SunSpec."""
    found = has(data, r'"id"\s*:\s*\d+|"ID"', r'"group"\s*:', r'"points"\s*:', r'"type"\s*:\s*"(uint16|group|sunssf)"')
    return Likeness.SURE if found else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of a model. Raises OptionError for a --most that is no number of elements."""
    most = whole(options.get("most", ""))
    if most is None or not 0 < most <= MOST_ELEMENTS:
        message = f"--most {options.get('most', '')}: write a whole number from 1 to {MOST_ELEMENTS}"
        raise OptionError(message)
    root, doubled = read_json(text_of(data))
    group, number = root.get("group"), whole(root.word("id"))
    if group is None or number is None or not 0 < number <= LAST_ID:
        message = "there is no `group` with a model's `id`"
        raise TreeError(root.line, message, "is this one of SunSpec's models in JSON?")
    block = f"m{number}"
    title = group.word("label") or group.word("name") or f"Model {number}"
    scope = Scope(file=name, group=f"{title} ({number})", most=most)
    entries = laid_out(group, scope)
    findings = [_doubled(name, line, key) for line, key in doubled]
    return Draft(
        entries=entries,
        head={
            "chains": OneLine({CHAIN: {"at": STARTS, "marker": MARKER}}),
            "blocks": OneLine({block: {"chain": CHAIN, "id": number}}),
        },
        groups={scope.group: _of_group(group, block, number)},
        title=title,
        maker=MAKER,
        stated=tuple(_stated(root, entries, most)),
        findings=(*findings, *scope.findings),
    )


def _of_group(group: Node, block: str, number: int) -> dict[str, str]:
    described = " ".join(group.word("desc").split())
    return {"source": f"model {number}", **({"description": described} if described else {}), "block": block}


def _doubled(file: str, line: int, key: str) -> Diagnostic:
    message = f"the key `{key}` stands twice in one mapping: the last one counts"
    return Diagnostic("import", message, Span(file, line, 1, line, 1), severity=Severity.WARNING)


def _stated(root: Node, entries: tuple[Entry, ...], most: int) -> list[str]:
    """What is concluded of the whole model."""
    stated = [f"a device's chain begins at {', '.join(map(str, STARTS))}; the first that has the marker counts"]
    if any(entry.members for entry in entries):
        told = f"repeated groups have at most {most} elements here (--most); a device tells how many it has"
        stated.append(told)
    counted = Counter(key for node in walk(root) for key in node.members or {} if key in SHOWN)
    if counted:
        listed = ", ".join(f"{key} ({count})" for key, count in counted.most_common())
        stated.append(f"for readers only, not in the map: {listed}")
    return stated
