"""What programs read by our exports, as their sources have it, from the words of all cases by hand (tests/conformance).

The programs themselves cannot be run by the tests: each is a small model here, written by its source and not by ours.
"""

import re
import struct
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple

import pytest
import yaml

from regscribe import plugins
from regscribe.losses import Exported
from regscribe.model import RegisterMap, WireType
from regscribe.plugins import OptionError

from ...conformance.suite import cases, diagnose, whole_map, words_of  # noqa: TID252 (test folders are no packages)

pytestmark = pytest.mark.slow

Words = Mapping[int, int]
Told = float | str | bool
Reader = Callable[[Mapping[str, Any], str, Words], Told | None]
"""What a program tells of the register of that path in its configuration, from the words at each address."""

NEEDS_MORE = frozenset({"view", "holds", "only", "lossy", "fault", "no_value", "unknown"})
"""Rows in other views or states, of writes alone, of what a double cannot be, and of what is no value."""
LEAST = 1e-37
MEANT_FOR_WRITES = frozenset({"write", "range"})


def swapped(raw: bytes, order: str) -> bytes:
    """The bytes in the usual order: letters say which of each four stand where, of any number of words."""
    words = [raw[at : at + 2] for at in range(0, len(raw), 2)]
    words = words[::-1] if order in {"CDAB", "DCBA"} else words
    return b"".join(word[::-1] if order in {"BADC", "DCBA"} else word for word in words)


def raw_at(words: Words, address: int, count: int) -> bytes:
    return b"".join(words[address + place].to_bytes(2, "big") for place in range(count))


def unpacked(kind: str, raw: bytes) -> float:
    """The number; a whole one as it is, of which the programs make a double where they scale it."""
    codes = {"int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q"}
    floats = {"float16": "e", "float32": "f", "float64": "d"}
    (number,) = struct.unpack(f">{(codes | floats)[kind.lower()]}", raw)
    return number  # type: ignore[no-any-return]  # struct's


WIDTH = {"16": 1, "32": 2, "64": 4}


def telegraf(made: Mapping[str, Any], path: str, words: Words) -> Told | None:
    """Of the plug-in modbus: a scale, then what the processor adds; a text loses one NUL at its end."""
    blocks = [block for one in made["inputs"]["modbus"] for block in one["metric"]]
    located = [
        one.get("workarounds", {}).get("string_register_location", "")
        for one in made["inputs"]["modbus"]
        for _ in one["metric"]
    ]
    for block, location in zip(blocks, located, strict=True):
        for field in block["fields"]:
            if field["name"] == path:
                value = _telegraf(field, block["byte_order"], location, words)
                added = [
                    one
                    for one in made.get("processors", {}).get("scale", [{}])[0].get("scaling", [])
                    if path in one["fields"]
                ]
                return (
                    value * added[0]["factor"] + added[0]["offset"] if added and not isinstance(value, str) else value
                )
    return None


def _telegraf(field: Mapping[str, Any], order: str, location: str, words: Words) -> Told:
    at, kind = field["address"], field.get("type", "")
    if not kind:
        return float(words[at])
    if kind == "STRING":
        raw = swapped(raw_at(words, at, field["length"]), {"CDAB": "ABCD", "DCBA": "BADC"}.get(order, order))
        raw = {"": raw, "upper": raw[::2], "lower": raw[1::2]}[location]
        return raw.removesuffix(b"\0").decode("utf-8", "replace")
    if kind in {"INT8L", "INT8H", "UINT8L", "UINT8H"}:
        byte = raw_at(words, at, 1)[kind.endswith("L")]
        value = float(byte - 256 if kind.startswith("I") and byte > 127 else byte)
    else:
        value = unpacked(kind, swapped(raw_at(words, at, WIDTH[kind[-2:]]), order))
    return value * field.get("scale", 1.0)


ENDIANNESS = {"big": "ABCD", "yolo": "CDAB", "mixed": "BADC", "little": "DCBA"}


def modbus_exporter(made: Mapping[str, Any], path: str, words: Words) -> Told | None:
    """Of modbus_exporter: one word is turned by `little` alone; the help text begins with the manual's name."""
    for one in made["modules"][0]["metrics"]:
        if re.fullmatch(rf"case_{path}(_[a-z_]+)?", one["name"]) and one["dataType"] != "bool":
            if one["name"].endswith("_raw"):
                return None
            kind, order = one["dataType"], ENDIANNESS[one["endianness"]]
            order = "ABCD" if kind.endswith("16") and order != "DCBA" else order
            raw = swapped(raw_at(words, int(str(one["address"])[1:]), WIDTH[kind[-2:]]), order)
            return unpacked(kind, raw) * one.get("factor", 1)
    return None


def edgex(made: Mapping[str, Any], path: str, words: Words) -> Told | None:
    """Of the device service Modbus and its kit: mask, shift, scale, offset; a whole number has a whole scale."""
    found = next((one for one in made["deviceResources"] if one["name"] == path), None)
    if found is None or "R" not in found["properties"]["readWrite"]:
        return None
    said, properties = found["attributes"], found["properties"]
    kind = properties["valueType"]
    at, _, bit = str(said["startingAddress"]).partition(".")
    if kind == "Bool":
        return bool(words[int(at)] >> int(bit or 0) & 1)
    if kind == "String":
        return raw_at(words, int(at), said["stringRegisterSize"]).strip(b"\0").decode("utf-8", "replace")
    raw_kind = said.get("rawType", kind)
    assert (raw_kind == kind) or (kind == "Float64" and raw_kind in {"Int16", "Uint16", "Int32"})
    raw = raw_at(words, int(at), WIDTH[raw_kind[-2:]])
    if raw_kind.endswith("32"):
        raw = swapped(
            raw,
            {(False, False): "ABCD", (False, True): "CDAB", (True, False): "BADC", (True, True): "DCBA"}[
                said.get("isByteSwap", False), said.get("isWordSwap", False)
            ],
        )
    value = unpacked(raw_kind, raw)
    scale, offset = properties.get("scale", 1), properties.get("offset", 0)
    if not kind.startswith("Float"):
        assert (scale % 1, offset % 1) == (0, 0), "a whole number is multiplied by the whole part"
    return value * scale + offset


def telegraf_bit(made: Mapping[str, Any], path: str, part: str, words: Words) -> int | None:
    """Of the plug-in: a bit of one word, whose bytes the order turns."""
    for one in made["inputs"]["modbus"]:
        for block in one["metric"]:
            for field in block["fields"]:
                if field["name"] == f"{path}_{part}":
                    turned = {"CDAB": "ABCD", "DCBA": "BADC"}.get(block["byte_order"], block["byte_order"])
                    word = swapped(raw_at(words, field["address"], 1), turned)
                    return int.from_bytes(word, "big") >> field["bit"] & 1
    return None


def modbus_exporter_bit(made: Mapping[str, Any], path: str, part: str, words: Words) -> int | None:
    """Of modbus_exporter: a bit of one word, whose bytes are never turned."""
    for one in made["modules"][0]["metrics"]:
        if one["name"] == f"case_{path}_{part}":
            return words[int(str(one["address"])[1:])] >> one["bitOffset"] & 1
    return None


def edgex_part(made: Mapping[str, Any], path: str, part: str, words: Words) -> int | None:
    """Of the device service: a bit by its place, or a number masked and then shifted."""
    for one in made["deviceResources"]:
        if one["name"] == f"{path}_{part}":
            at, _, bit = str(one["attributes"]["startingAddress"]).partition(".")
            if one["properties"]["valueType"] == "Bool":
                return words[int(at)] >> int(bit) & 1
            whole = edgex({"deviceResources": [{**one, "name": path}]}, path, words)
            properties = one["properties"]
            assert whole is not None
            return (int(whole) & properties["mask"]) >> properties.get("shift", 0)
    return None


PARTS = {
    "telegraf": (telegraf_bit, tomllib.loads, 40),
    "modbus-exporter": (modbus_exporter_bit, yaml.safe_load, 40),
    "edgex": (edgex_part, yaml.safe_load, 60),
}

READERS: Mapping[str, tuple[Reader, Callable[[str], Any], int]] = {
    "telegraf": (telegraf, tomllib.loads, 300),
    "modbus-exporter": (modbus_exporter, yaml.safe_load, 250),
    "edgex": (edgex, yaml.safe_load, 200),
}
"""The model, what reads the text, and how many rows it judges at least."""


class Case(NamedTuple):
    """A map, and the rows of its case by hand."""

    name: str
    map: RegisterMap
    rows: tuple[dict[str, Any], ...]


@pytest.fixture(scope="module")
def sound() -> list[Case]:
    return list(_sound())


def _sound() -> Iterator[Case]:
    for case in cases():
        if case.rows and not case.refused and not case.place:
            register_map, _ = diagnose(whole_map(case.map))
            if register_map is not None and not register_map.blocks:
                yield Case(case.name, register_map, case.rows)


@pytest.mark.parametrize("form", READERS)
def test_what_is_read_is_the_value_by_hand_or_a_loss_is_told(form: str, sound: list[Case]) -> None:
    reader, parsed, fewest = READERS[form]
    wrong, judged = [], 0
    for case, made in exports(form, sound):
        lost = {
            one.register for one in made.losses if one.grade.name != "COSMETIC" and one.fact not in MEANT_FOR_WRITES
        }
        configuration = parsed(str(made.texts[""]))
        for path, row, words in rows(case):
            if "value" not in row or (path in lost and not isinstance(row["value"], str)):
                continue
            with suppress(KeyError):  # it reads another view, whose words the row does not say
                told = reader(configuration, plain(path), words)
                judged += told is not None
                wrong += [(case.name, row, told)] if told is not None and not agrees(told, row["value"]) else []
    assert wrong == []
    assert judged > fewest


@pytest.mark.parametrize("form", PARTS)
def test_bits_and_parts_of_words_are_those_by_hand(form: str, sound: list[Case]) -> None:
    reader, parsed, fewest = PARTS[form]
    wrong, judged = [], 0
    for case, made in exports(form, sound):
        configuration = parsed(str(made.texts[""]))
        for path, row, words in rows(case):
            register = case.map.models[0].register(path)
            numbers = {one.id: int(one.id in row["flags"]) for one in register.fields} if "flags" in row else {}
            for part, by_hand in (numbers | row.get("fields", {})).items():
                told = reader(configuration, plain(path), part, words)
                judged += told is not None
                known = told is None or not isinstance(by_hand, int) or told == by_hand
                wrong += [] if known else [(case.name, row, part, told)]
    assert wrong == []
    assert judged > fewest


def exports(form: str, sound: list[Case]) -> Iterator[tuple[Case, Exported]]:
    options = {one.name: one.default for one in plugins.exporter(form).options}
    options |= {"at": "h:502"} if "at" in options else {}
    for case in sound:
        with suppress(OptionError):  # it can say nothing of the case
            yield case, plugins.export(form, [case.map], options)


def plain(path: str) -> str:
    return path.replace("[", "_").replace("]", "").replace(".", "_")


def rows(case: Case) -> Iterator[tuple[str, dict[str, Any], Words]]:
    """Rows with words of the base view, and these at their addresses."""
    registers = {one.path: one for one in case.map.models[0].registers}
    for row in case.rows:
        register = registers.get(row.get("register", ""))
        if register is None or NEEDS_MORE & row.keys() or "words" not in row:
            continue
        if register.base.type is not WireType.FLOAT16:  # the driver says its shortest decimal
            words = words_of(row["words"])
            yield register.path, row, {register.address + place: word for place, word in enumerate(words)}


def agrees(told: Told, value: Any) -> bool:
    if isinstance(value, str) and not re.fullmatch(r"-?\d+/\d+", value):
        return isinstance(told, str) and re.split("[\0\ufffd]", told)[0].rstrip() == value  # `padding` is told as lost
    by_hand = float(value if isinstance(value, bool) else Fraction(str(value)))
    return abs(by_hand) < LEAST or float(told) == pytest.approx(by_hand, rel=1e-3 if abs(by_hand) < 1e-4 else 1e-6)
