"""What a register is called, what its codes and bits mean, whether it can be written."""

from collections.abc import Mapping
from typing import Any

from regscribe.files import OneLine
from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.access import AccessCell, parse_access
from regscribe.importers.table.cells.enums import Codes, parse_codes
from regscribe.importers.table.cells.limits import Limits
from regscribe.importers.table.cells.scales import PLAIN
from regscribe.importers.table.cells.units import is_of_a_number
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.making import Making
from regscribe.importers.table.whole import Whole
from regscribe.model import Access
from regscribe.model.identifiers import label_id
from regscribe.visible import INVISIBLE

LONGEST_NAME = 120
LONGEST_TEXT = 900
TAKEN = frozenset({"MRO", "NAME", "VALUE"})
"""Names of members that Python's enums use themselves."""


def clean(text: str) -> str:
    """A text of a cell on one line, without invisible characters and blanks in a row."""
    return " ".join(INVISIBLE.sub(lambda found: " " if found[0].isspace() else "", text).split())


def name_of(making: Making) -> str:
    """The name of a register: of its column, else its short code, else its description, else by its address."""
    item = making.item
    for role in ("name", "symbol", "description"):
        text = clean(item[role].split("\n")[0] if role == "description" else item[role])
        if text:
            if role != "name":
                making.tell("name-missing", f"no name stands there: it is called by its {role}")
            return text
    making.tell("name-missing", "no name stands there: it is called by its address")
    return f"{str(making.space).title()} {making.at}"


def codes_of(making: Making, whole: Whole, index: int) -> Codes | None:
    """The codes or bits that the row says, in a column of their own, else in place of a unit or a range."""
    item, flags, width = making.item, making.type.kind == "flags" or None, 16 * max(making.words, 1)
    for role, bits in (("values", flags), ("bits", True)):
        found = parse_codes(item[role], flags=bits, width=width) if item[role] else None
        if isinstance(found, Codes):
            return found
        if found is not None:
            making.ask(f"{role}-unclear", found)
    return _misplaced(making, whole, index)


def _misplaced(making: Making, whole: Whole, index: int) -> Codes | None:
    """Codes that stand under range or unit; in a description only where nothing says that the register is a number."""
    item, limits = making.item, whole.limits[index]
    number = any(item[role] for role in ("decimals", "offset")) or is_of_a_number(item["unit"])
    number = number or whole.scales.cells[index] not in {None, PLAIN}
    for role in ("range", "unit", *(() if number else ("description",))):
        flags = making.type.kind == "flags" or None
        found = parse_codes(item[role], flags=flags, width=16 * max(making.words, 1)) if item[role] else None
        if isinstance(found, Codes) and len(found.labels) > 1 and (role != "description" or _all(found, limits)):
            making.tell("codes-read", f"its codes stand under {role}")
            item.cells[role] = found.lead if role == "description" else ""
            return found
    return None


def _all(codes: Codes, limits: Limits | Unclear | None) -> bool:
    """Whether codes are all numbers of a range, so that they are no remarks on some of them."""
    if not isinstance(limits, Limits):
        return limits is None
    return limits.low == min(codes.labels) and limits.high == max(codes.labels)


def add_codes(making: Making, codes: Codes) -> None:
    """Set enum or flags; labels that say the same get ids that differ."""
    if codes.flags and codes.ranges:
        making.set({"fields": OneLine(_parts(codes))})
        if codes.none:
            making.lose("codes-none", f"`{codes.none[:40]}` stands for no bit, which parts of a word cannot say")
        return
    labels: dict[Any, Any] = unlike({code: clean(label) for code, label in codes.labels.items()})
    if codes.flags and codes.none:
        labels["none"] = clean(codes.none)
    if codes.other and not codes.flags:
        labels["other"] = clean(codes.other)
    making.set({"flags" if codes.flags else "enum": OneLine(labels)})
    for low, high, label in codes.ranges:
        making.lose(
            "codes-range", f"the codes {low}..{high} (`{label[:40]}`) are not in the map: an enum names single ones"
        )


def _parts(codes: Codes) -> dict[str, Any]:
    """The parts of a word of which some have several bits."""
    every = [(bit, bit, label) for bit, label in codes.labels.items()] + list(codes.ranges)
    found: dict[str, Any] = {}
    for low, high, label in sorted(every):
        own = label_id(label) or f"bit_{low}"
        place = {"bit": low} if low == high else {"bits": f"{low}..{high}"}
        found[own if own not in found else f"{own}_{low}"] = OneLine(**place, label=clean(label))
    return found


def unlike(labels: Mapping[int, str]) -> dict[int, Any]:
    """Labels, each with an id of its own where its text alone gives none, or one that another has."""
    ids: set[str] = set()
    found: dict[int, Any] = {}
    for code, label in labels.items():
        plain = label_id(label)
        free = plain and plain not in ids and plain.upper() not in TAKEN
        own = plain if free else f"{plain or 'code'}_{code}".replace("-", "minus_")
        ids.add(own)
        found[code] = label if own == plain else OneLine(label=label or f"code {code}", id=own)
    return found


READS, WRITES = frozenset({1, 2, 3, 4, 23}), frozenset({5, 6, 15, 16, 22, 23})
"""Functions that read, and functions that write."""


def _by_functions(whole: Whole, index: int) -> Access | None:
    """The access that the functions of a row say, in a table that names functions which write."""
    functions = set(whole.functions[index])
    if not functions or not any(WRITES & set(each) for each in whole.functions):
        return None
    if functions & WRITES:
        return Access.READ_WRITE if functions & READS else Access.WRITE
    return Access.READ


def add_access(making: Making, whole: Whole, index: int, choices: Choices) -> None:
    """Set the access; where it is not stated, a register is read only, and a person is asked."""
    text = making.item["access"]
    found = parse_access(text, whole.headings.get("access", ""), making.space)
    if isinstance(found, AccessCell):
        making.set({"access": str(found.access)})
        if found.remark:
            making.lose("access-remark", f"access `{text[:40]}`: {found.remark}")
        return
    if found is None and (by_functions := _by_functions(whole, index)):
        making.set({"access": str(by_functions)})
        return
    given = choices.access
    if given is not None and not (making.space.write_functions or given is Access.READ):
        given = Access.READ
    making.set({"access": str(given or Access.READ)})
    if isinstance(found, Unclear):
        making.ask("access-unclear", f"{found.message}; it is read only here")
    elif given is None and making.space.write_functions and "access" in whole.headings:
        making.ask("access-missing", "no cell says whether it can be written; it is read only here")


def add_texts(making: Making) -> None:
    """Set short code, description and section."""
    item = making.item
    if (symbol := clean(item["symbol"])) and symbol != making.keys.get("name"):
        making.set({"symbol": symbol[:LONGEST_NAME]})
    if (description := clean(item["description"])) and description != making.keys.get("name"):
        making.set({"description": description[:LONGEST_TEXT]})
        if len(description) > LONGEST_TEXT:
            making.lose(
                "description-cut", f"its description has {len(description)} characters; {LONGEST_TEXT} are kept"
            )
    if section := clean(item["section"]):
        making.set({"source": section[:LONGEST_NAME]})
