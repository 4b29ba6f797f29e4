"""What C headers and OPC UA nodesets say of registers decodes the words of all cases to the values by hand.

Nothing is asked of the map but what the description says: of which type they are, in which order, of which scale.
"""

import re
import struct
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import pytest

from regscribe import plugins
from regscribe.losses import Exported, Grade
from regscribe.plugins import OptionError

from .suite import Case, Json, cases, diagnose, whole_map, words_of

SOUND = [case for case in cases() if case.rows and not case.refused and not case.place]
NEEDS_MORE = frozenset({"view", "holds", "shows", "rounded"})
"""Rows in other views or states."""

FLOATS = {"float16": "e", "float32": "f", "float64": "d"}
LEAST = {"float16": Fraction(1, 1 << 24), "float32": Fraction(1, 1 << 149), "float64": Fraction(1, 1 << 1074)}
"""The smallest number of each type; a decimal with few digits is this near."""
FEWEST = 600
"""Rows that either description must decode: fewer would mean that it left registers out."""


class Said(NamedTuple):
    """What a description says of a register: its type, order, scale and offset (None: it has none), and its faults."""

    type: str
    order: str
    scale: Fraction | None
    offset: Fraction | None
    faults: str


def by_header(made: Exported) -> dict[str, Said]:
    """What the constants of a header say, by the name of the register."""
    text = str(made.texts[""])
    known = dict(re.findall(r"^#define CASEA_(\w+) (.+?)(?: /\*.*)?$", text, re.MULTILINE))
    found = {}
    for name in re.findall(r"^#define CASEA_(\w+)_TYPE CASEA", text, re.MULTILINE):
        ratio = [whole(known[f"{name}_{key}"]) for key in RATIO] if f"{name}_SCALE_NUM" in known else []
        scale, offset = (Fraction(ratio[0], ratio[1]), Fraction(ratio[2], ratio[3])) if ratio else (None, None)
        order = known.get(f"{name}_ORDER", "_ABCD").rpartition("_")[2]
        faults = " ".join(key for key in known if key.startswith(f"{name}_FAULT_"))
        kind = known[f"{name}_TYPE"].removeprefix("CASEA_TYPE_").lower()
        found[name.lower()] = Said(kind, order, scale, offset, faults)
    return found


RATIO = ("SCALE_NUM", "SCALE_DEN", "OFFSET_NUM", "OFFSET_DEN")


def whole(constant: str) -> int:
    """The number of a constant of C."""
    plain = re.sub(r"U?INT\d+_C\((\w+)\)", r"\1", constant).replace("u", "").strip("()")
    first, _, less = plain.partition(" - ")
    return int(first, 0) - int(less or 0)


def by_nodeset(made: Exported) -> dict[str, Said]:
    """What the properties of a nodeset say, by the name of the register."""
    space = "{http://opcfoundation.org/UA/2011/03/UANodeSet.xsd}"
    own: dict[str, dict[str, str]] = {}
    root = ET.fromstring(str(made.texts[""]))  # noqa: S314 - our own text
    ids = [node.get("NodeId") for node in root if node.get("NodeId")]
    assert len(ids) == len(set(ids))
    for node in root:
        parent, name = node.get("ParentNodeId", ""), node.get("BrowseName", "").removeprefix("1:")
        value = node.find(f"{space}Value")
        if value is not None:
            own.setdefault(parent.removeprefix("ns=1;s=CaseAType.all."), {})[name] = "".join(value.itertext()).strip()
    return {
        path: Said(
            one["ModbusType"],
            one.get("ModbusOrder", "ABCD"),
            Fraction(one["ModbusScale"]) if re.match(r"[-\d]", one.get("ModbusScale", "")) else None,
            Fraction(one["ModbusOffset"]) if "ModbusOffset" in one else None,
            one.get("ModbusFaults", ""),
        )
        for path, one in own.items()
        if "ModbusType" in one
    }


def decoded(said: Said, words: list[int]) -> Fraction | None:
    """The number that words are, by what was said; None for types that are not decoded here."""
    turned = words[:: -1 if said.order in {"CDAB", "DCBA"} else 1]
    data = b"".join(word.to_bytes(2, "little" if said.order in {"BADC", "DCBA"} else "big") for word in turned)
    if said.type == "bit":
        raw: Any = words[0]
    elif said.type in FLOATS:
        (raw,) = struct.unpack(f">{FLOATS[said.type]}", data)
        if raw != raw or abs(raw) == float("inf"):  # noqa: PLR0124 - NaN alone differs from itself
            return None
    elif kind := re.fullmatch(r"(u?)int(\d+)", said.type):
        bits = int(kind[2])
        raw = int.from_bytes(data, "big") & ((1 << bits) - 1)
        raw -= (1 << bits) * (not kind[1] and raw >> (bits - 1))
    else:
        return None
    return Fraction(raw) * (1 if said.scale is None else said.scale) + (said.offset or 0)


def rows(form: str, said_of: Callable[[Exported], Mapping[str, Said]]) -> Iterator[tuple[Case, Json, Said]]:
    """Rows whose value is a plain number in the state that the export is of, and what was said of their register."""
    options = {one.name: one.default for one in plugins.exporter(form).options}
    for case in SOUND:
        register_map, _ = diagnose(whole_map(case.map))
        if register_map is None or register_map.blocks:
            continue
        try:
            made = plugins.export(form, [register_map], options)
        except OptionError:
            continue
        fixed = {loss.register for loss in made.losses if loss.grade is Grade.WRONG}
        known = said_of(made)
        for row in case.rows:
            read = row.get("only") != "write"
            plain = read and "value" in row and "words" in row and not NEEDS_MORE & set(row)
            if plain and row["register"] in known and row["register"] not in fixed:
                yield case, row, known[row["register"]]


@pytest.mark.parametrize(("form", "said_of"), [("c-header", by_header), ("opcua-nodeset", by_nodeset)])
def test_a_description_decodes_the_words_of_all_cases(
    form: str, said_of: Callable[[Exported], Mapping[str, Said]]
) -> None:
    wrong, count = [], 0
    for case, row, said in rows(form, said_of):
        number = decoded(said, words_of(row["words"]))
        if number is None or isinstance(row["value"], str):
            continue
        count += 1
        expected = Fraction(row["value"])
        near = said.type in FLOATS and abs(number - expected) <= max(abs(expected) / 1000, LEAST[said.type])
        if number != expected and not near:
            wrong.append((case.name, row, said, number))
    assert wrong == []
    assert count > FEWEST
