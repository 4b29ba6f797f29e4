"""A case at other places: the same words and values in arrays, in a second view, and as input registers."""

from collections.abc import Iterator, Mapping
from typing import Any

Json = dict[str, Any]

WIRE_KEYS = ("type", "word_order", "byte_order", "byte", "functions")
CHAIN, BLOCK = 30000, 7
"""Where a chain begins, and the id of its blocks."""
INNER, OUTER, VIEW = 100, 250, 600
"""The distance of elements of an array, of an array around it, and of a second view from the first."""


def _last(at: int | list[int]) -> int:
    return at if isinstance(at, int) else max(at)


def places_of(case: Json) -> Iterator[tuple[str, Json]]:
    """A case as its file has it, and its like at each other place where it has a meaning."""
    yield "", case
    if "rows" not in case:
        return
    for name, move in MOVES.items():
        if name in case.get("places", MOVES) and (moved := move(case)):
            yield name, moved


def _spaces(case: Json) -> set[str]:
    return {one.get("space", "holding") for one in case["map"]["registers"]}


def _has_arrays(case: Json) -> bool:
    return any("registers" in one for one in case["map"]["registers"])


def _in_array(case: Json) -> Json | None:
    if _has_arrays(case) or _spaces(case) & {"status", "queue", "identification"}:
        return None
    registers = [{"id": "items", "name": "Item", "repeat": "1..2", "stride": INNER, "registers": _registers(case)}]
    return _moved(case, registers, "items[2]", (0,), INNER)


def _in_nested_array(case: Json) -> Json | None:
    if _has_arrays(case) or _spaces(case) & {"status", "queue", "identification"}:
        return None
    inner = {"id": "items", "name": "Item", "repeat": "1..2", "stride": INNER, "registers": _registers(case)}
    registers = [{"id": "parts", "name": "Part", "repeat": "1..2", "stride": OUTER, "registers": [inner]}]
    return _moved(case, registers, "parts[2].items[2]", (0, INNER, OUTER), INNER + OUTER)


def _registers(case: Json) -> list[Json]:
    registers: list[Json] = case["map"]["registers"]
    assert all(_last(one["at"]) < INNER for one in registers), f"{case['name']}: a register too far up for an array"
    return registers


def _moved(case: Json, registers: list[Json], path: str, others: tuple[int, ...], distance: int) -> Json:
    """The case with its registers in an element; the other elements hold other words than the one that is asked."""
    return {
        **case,
        "map": {**case["map"], "registers": registers},
        "holds": _shifted(case.get("holds", {}), others, distance),
        "rows": [
            {
                **row,
                "register": f"{path}.{row['register']}",
                "holds": _shifted(row.get("holds", {}), others, distance),
            }
            for row in case["rows"]
        ],
    }


def _shifted(holds: Mapping[str, Mapping[int, str]], others: tuple[int, ...], distance: int) -> Json:
    moved: Json = {}
    for space, cells in holds.items():
        moved[space] = {int(at) + distance: words for at, words in cells.items()}
        moved[space] |= {int(at) + other: _inverted(words) for at, words in cells.items() for other in others}
    return moved


def _inverted(words: str) -> str:
    """Other words of the same length."""
    if len(words) == 1:
        return str(1 - int(words))
    return " ".join(f"{int(byte, 16) ^ 0xFF:02X}" for byte in words.split())


def _in_second_view(case: Json) -> Json | None:
    asked = {row["register"] for row in case["rows"]}
    if _has_arrays(case) or "views" in case["map"] or _spaces(case) & {"status", "queue", "identification"}:
        return None
    views, registers = {}, []
    for one in case["map"]["registers"]:
        name = one.get("id", one["name"].lower().replace(" ", "_"))
        if name not in asked or "aliases" in one:
            registers.append(one)
            continue
        bits = one.get("space") in {"coil", "discrete"}
        type_ = one.get("type", "bit" if bits else "uint16")
        second = {"offset": VIEW, "type": type_} | {key: one[key] for key in WIRE_KEYS if key in one}
        views[f"of_{name}"] = {"base": {"type": type_}, "second": second}
        registers.append({key: value for key, value in one.items() if key not in WIRE_KEYS} | {"views": f"of_{name}"})
    rows = [row | {"view": "second"} for row in case["rows"]]
    return {**case, "map": {**case["map"], "registers": registers, "views": views}, "rows": rows}


def _in_block(case: Json) -> Json | None:
    """Behind the header of the second block of an id, which follows the first, empty one, in a chain."""
    parts = block_of(case["map"])
    if parts is None:
        return None
    headers = {CHAIN: f"53 75 6E 53 00 {BLOCK:02X} 00 00 00 {BLOCK:02X} 10 00", CHAIN + 6 + 0x1000: "FF FF 00 00"}
    held = _shifted(case.get("holds", {}), (), CHAIN + 6)
    return {
        **case,
        "map": parts,
        "holds": {**held, "holding": headers | held.get("holding", {})},
        "rows": [row | {"holds": _shifted(row.get("holds", {}), (), CHAIN + 6)} for row in case["rows"]],
    }


def block_of(parts: Json) -> Json | None:
    """Parts of a map with the registers in the second block of an id in a chain; None where they cannot stand there."""
    tables = parts.keys() & {"views", "commands", "process", "reserved", "unused", "identify"}
    if tables or {one.get("space", "holding") for one in parts["registers"]} != {"holding"}:
        return None
    return {
        **parts,
        "registers": [_behind_header(one) for one in parts["registers"]],
        "chains": {"chain": {"at": CHAIN, "marker": [0x5375, 0x6E53]}},
        "blocks": {"block": {"chain": "chain", "id": BLOCK, "index": 2}},
        "block": "block",
    }


def _behind_header(one: Any) -> Any:
    """A register or array two addresses further: addresses in a block count from its header."""
    if not isinstance(one, dict):
        return one
    moved = {
        key: [_behind_header(each) for each in value] if key == "registers" else value for key, value in one.items()
    }
    for key in moved.keys() & {"at", "write_at", "aliases"}:
        value = moved[key]
        moved[key] = [each + 2 for each in value] if isinstance(value, list) else value + 2
    if isinstance(one.get("write"), dict):
        moved["write"] = _behind_header(one["write"])
    return moved


def _as_inputs(case: Json) -> Json | None:
    rows = [row for row in case["rows"] if "words" in row and row.get("only") != "write"]
    if _has_arrays(case) or _spaces(case) != {"holding"} or not rows:
        return None
    registers = [
        {key: value for key, value in one.items() if key != "writable"} | {"space": "input", "access": "r"}
        for one in case["map"]["registers"]
    ]

    def moved(holds: Json) -> Json:
        return {"input": holds["holding"]} if holds else {}

    return {
        **case,
        "map": {**case["map"], "registers": registers},
        "holds": moved(case.get("holds", {})),
        "rows": [row | {"holds": moved(row.get("holds", {}))} for row in rows],
    }


MOVES = {
    "array": _in_array,
    "nested": _in_nested_array,
    "view": _in_second_view,
    "input": _as_inputs,
    "block": _in_block,
}
"""What makes the like of a case at each other place, or nothing where there is none."""
