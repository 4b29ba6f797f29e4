"""What our exporters write, our importers read back: every difference is a loss that one of the two tells."""

import random
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from regscribe import plugins
from regscribe.dialects.prometheus import BASE_UNITS
from regscribe.draft import Draft, Entry, Outcome
from regscribe.draft.settle import settle
from regscribe.importers import modbus_exporter
from regscribe.losses import Exported
from regscribe.model import Kind, Register, RegisterMap
from regscribe.reference import Meaning, decode

from .strategies import STEADY, maps
from .suite import Json, diagnose, errors_of, whole_map

FORMS = sorted({*plugins.names(plugins.EXPORTERS)} & {*plugins.names(plugins.IMPORTERS)})
HEAD = {
    "format": 1,
    "map": {"id": "test/again", "title": "Again", "maker": "Test", "class_prefix": "Again"},
    "manual": {"title": "Manual", "number": "1"},
}
PLACE = {"at": "10.0.0.7:502", "name": "oven", "unit": "3"}
FEW = 16
STEP = 8
INTEGERS = ("uint16", "int16", "uint32", "int32", "uint64", "int64")
FLOATS = ("float32", "float64")
SCALES: tuple[Json, ...] = (
    *({} for _ in range(3)),
    {"decimals": 1},
    {"decimals": 3},
    {"multiply": 0.1, "add": -40},
    {"multiply": 5},
    {"multiply": 0.25},
    {"divide": 8, "add": 0.5},
    {"add": 7},
)
MEANINGS: tuple[Json, ...] = (
    {"enum": {0: "off", 1: "on", 7: "auto mode"}},
    {"flags": {0: "high", 3: "low", 15: "dead"}},
    {"fields": {"mode": {"bits": "0..2", "label": "mode"}, "level": {"bits": "8..15", "label": "level"}}},
    {"kind": "boolean"},
)


@st.composite
def registers(draw: st.DrawFn, at: int) -> Json:
    """A register by itself: of any type, order and scale that formats have, or with codes, bits or a text."""
    form = draw(st.sampled_from(("number", "number", "number", "meaning", "text", "bit")))
    keys: Json = {"at": at, "name": f"Point {at}"}
    space = draw(st.sampled_from(("holding", "holding", "input")))
    if form == "bit":
        space = draw(st.sampled_from(("coil", "discrete")))
    keys["space"] = space
    keys["access"] = draw(st.sampled_from(("r", "rw"))) if space in {"holding", "coil"} else "r"
    if form == "number":
        wire = draw(st.sampled_from((*INTEGERS, *FLOATS)))
        keys |= {"type": wire, **draw(st.sampled_from(SCALES))}
        keys |= {key: "little" for key in ("word_order", "byte_order") if draw(st.booleans())}
        keys |= {"unit": draw(st.sampled_from(("°C", "kWh", "V", "%")))} if draw(st.booleans()) else {}
        if wire == "int16" and draw(st.booleans()):
            keys["sentinels"] = {-32768: "broken"}
    elif form == "meaning":
        keys |= draw(st.sampled_from(MEANINGS))
    elif form == "text":
        keys |= {"type": "string", "length": draw(st.integers(1, 4))}
    return {key: value for key, value in keys.items() if not (key == "word_order" and _is_word(keys))}


def _is_word(keys: Json) -> bool:
    return keys.get("type", "uint16") in {"uint16", "int16"}


@st.composite
def small_maps(draw: st.DrawFn) -> Json:
    """A few registers side by side."""
    count = draw(st.integers(1, 4))
    return {"registers": [draw(registers(STEP * number)) for number in range(count)]}


class Again(NamedTuple):
    """A map as it came back, its draft, and what the export told."""

    map: RegisterMap
    draft: Draft
    exported: Exported


def there_and_back(form: str, register_map: RegisterMap) -> Again | None:
    """Export a map and import what comes out; None where the form can say nothing of it."""
    asked = {one.name: PLACE.get(one.name, one.default) for one in plugins.exporter(form).options}
    try:
        exported = plugins.export(form, [register_map], asked)
    except plugins.OptionError:
        return None
    (text,) = exported.texts.values()
    options = {one.name: one.default for one in plugins.importer(form).options}
    data = text if isinstance(text, bytes) else text.encode()
    draft = plugins.read(form, data, "export", options)
    assert not draft.failed, (draft.findings, text)
    draft, written, found = settle(draft, HEAD, lambda text: diagnose(text)[1])
    assert errors_of(list(found)) == [], (written.text, text)
    again, _ = diagnose(written.text)
    assert again is not None, written.text
    return Again(again, draft, exported)


def differences(form: str, before: RegisterMap, again: Again, seed: int) -> Iterator[str]:
    """Yield every difference that neither side told."""
    told: defaultdict[str, set[str]] = defaultdict(set)
    for loss in again.exported.losses:
        told[loss.register].add(loss.fact)
    here = again.map.models[0].registers
    chance = random.Random(seed)  # noqa: S311 - found again by its seed
    for register in before.models[0].registers:
        lost = told[register.path] | told[""]
        if "register" in lost:
            continue
        base = register.base
        if any(_is_row_of(entry, register) for entry in again.draft.each if entry.outcome is Outcome.LEFT_OUT):
            continue  # by name, with the reason
        same = [one for one in here if (one.base.space, one.address) == (base.space, register.address)]
        if not same:
            yield f"{register.path}: nothing at {base.space} {register.address} came back"
            continue
        yield from (f"{register.path}: {one}" for one in _differing(form, register, same, lost, chance))


def _is_row_of(entry: Entry, register: Register) -> bool:
    return entry.name == register.name


def _differing(
    form: str, register: Register, same: Sequence[Register], lost: set[str], chance: random.Random
) -> Iterator[str]:
    if register.kind in {Kind.FLAGS, Kind.FIELDS} and not lost & {"flags", "fields"}:
        yield from _parts(register, same)
        return
    base, one = register.base, next((other for other in same if not other.fields), same[0])
    if one.fields and register.kind is Kind.BOOLEAN and not base.space.is_bits:
        return  # the lowest bit of a word that is 0 or 1
    if form in OF_WORDS and (one.base.type, one.base.byte_order) != (base.type, base.byte_order):
        return
    if one.base.words != base.words:
        yield f"it has {one.base.words} words and not {base.words}"
        return
    if one.access != register.access and "write" not in lost and form not in READ_ONLY:
        yield f"access {one.access} and not {register.access}"
    if _codes(one) != _codes(register) and "enum" not in lost and register.kind is not Kind.BOOLEAN:
        yield f"codes {_codes(one)} and not {_codes(register)}"
    if not (form in OF_BASE_UNITS and "offset" in lost):  # else a metric of raw numbers
        yield from _numbers(form, register, one, lost, chance)


def _parts(register: Register, same: Sequence[Register]) -> Iterator[str]:
    bits = {(part.low, part.high) for one in same for part in one.fields}
    missing = [part.id for part in register.fields if (part.low, part.high) not in bits]
    if missing and not any(one.base.words == register.base.words and not one.fields for one in same):
        yield f"its parts {missing} are gone"


def _numbers(form: str, register: Register, one: Register, lost: set[str], chance: random.Random) -> Iterator[str]:
    unit, factor = _base(_unit(register)) if form in OF_BASE_UNITS else (_unit(register), Fraction(1))
    if _unit(one) != unit and "unit" not in lost:
        yield f"unit {_unit(one)!r} and not {unit!r}"
    if not lost & {"scale", "offset", "unit"} and one.kind is not Kind.RAW:  # whose scale is unclear, by a remark
        yield from _values(register, one, factor, chance, faults="sentinel" not in lost)


OF_WORDS = frozenset({"pymodbus-simulator"})
"""Forms that have numbers in other orders as the words that they are."""

OF_BASE_UNITS = frozenset({"modbus-exporter"})
"""Forms whose values are in base units, of which names tell."""

READ_ONLY = frozenset({"telegraf", "modbus-exporter", "pymodbus-simulator"})
"""Forms that only read, or that say of an address alone whether it is written."""


def _base(unit: str) -> tuple[str, Fraction]:
    """The base unit of Prometheus that a unit becomes, and how many of it one is."""
    found = BASE_UNITS.get(unit)
    if found is None:
        return "", Fraction(1)
    return modbus_exporter.UNITS.get(found.suffix, ""), found.factor


def _values(
    register: Register, one: Register, factor: Fraction, chance: random.Random, *, faults: bool
) -> Iterator[str]:
    """Words that mean another number or text than before."""
    bits = 1 if register.base.space.is_bits else 16
    for _ in range(6):
        words = tuple(chance.getrandbits(bits) for _ in range(register.base.words))
        if register.kind is Kind.BOOLEAN:
            words = (chance.getrandbits(1),)
        if register.kind is Kind.STRING:
            words = tuple(0x4100 + 0x100 * chance.randrange(20) + 0x41 + chance.randrange(20) for _ in words)
        ours, theirs = decode(register, register.base, words), decode(one, one.base, words)
        if ours.meaning is Meaning.FAULT and not faults:
            continue
        if Meaning.VALUE not in {ours.meaning, theirs.meaning}:
            continue
        value = ours.value * factor if isinstance(ours.value, Fraction) else ours.value
        if value != theirs.value:
            shown = " ".join(f"{word:04X}" for word in words)
            yield f"{shown} is {theirs.meaning} {theirs.value} and not {ours.meaning} {ours.value}"
            return


def _unit(register: Register) -> str:
    return register.unit[0].then if register.unit else ""


def _codes(register: Register) -> Mapping[int, str]:
    return {one.code: one.label for one in register.enum.members} if register.enum else {}


@pytest.mark.parametrize("form", FORMS)
@settings(STEADY, max_examples=FEW, derandomize=True)
@given(parts=small_maps(), seed=st.integers(0, 2**32))
def test_what_comes_back_differs_only_in_what_is_told(form: str, parts: Json, seed: int) -> None:
    register_map, found = diagnose(whole_map(parts))
    assume(register_map is not None and not errors_of(found))
    assert register_map is not None
    again = there_and_back(form, register_map)
    if again is not None:
        assert [*differences(form, register_map, again, seed)] == [], str(again.exported.texts)
        left = [entry.name for entry in again.draft.each if entry.outcome is Outcome.LEFT_OUT]
        assert left == [] or form == "csv", str(again.exported.texts)


def test_forms_of_both_groups_are_tried() -> None:
    assert {"csv", "home-assistant", "esphome", "telegraf", "modbus-exporter", "edgex", "wiren-board"} <= {*FORMS}


@pytest.mark.parametrize("form", FORMS)
@settings(STEADY, max_examples=FEW, derandomize=True)
@given(parts=maps())
def test_what_depends_on_a_device_comes_back_as_a_sound_map(form: str, parts: Json) -> None:
    register_map, found = diagnose(whole_map(parts))
    assume(register_map is not None and not errors_of(found))
    assert register_map is not None
    again = there_and_back(form, register_map)
    if again is not None and form != "csv":
        left = [(entry.name, entry.remarks) for entry in again.draft.each if entry.outcome is Outcome.LEFT_OUT]
        assert left == [], str(again.exported.texts)
