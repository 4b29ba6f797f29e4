"""Who is held against a row: each tells what it makes of words, or what words it makes of a value."""

import math
import re
import struct
from collections.abc import Callable, Iterator, Mapping
from datetime import date, datetime, time
from decimal import Decimal
from fractions import Fraction
from ipaddress import IPv4Address, IPv6Address
from typing import Any

from regscribe.emit.vectors import document
from regscribe.model import BitField, Kind, Register, Sentinel, View
from regscribe.model import exact as exact_number
from regscribe.reference import (
    Meaning,
    RefusedError,
    Surroundings,
    UnknownValueError,
    decode,
    encode,
    existing_members,
    holds,
    part_value,
    special_value,
    surroundings_of,
)
from regscribe.simulate.device import codec as simulated_codec
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.testing.driver_checks import DriverUnderTest
from regscribe.testing.vectors import Vectors
from regscribe.tools.live.decode import Decoder
from regscribe_runtime import NotPresent, OutOfRange, SensorFault, ValueNotDecodable, ValueRefused
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.wire.capture import CapturedFrame

from .suite import Built, Json, address_of, words_of
from .wire import LONG

READ_FUNCTIONS = {
    "coil": 1,
    "discrete": 2,
    "holding": 3,
    "input": 4,
    "status": 7,
    "file": 20,
    "queue": 24,
    "identification": 43,
    "enron": 3,
}
_ELEMENT = re.compile(r"(\w+)\[(\d+)\]")

NO_NUMBERS = ("nan", "inf", "-inf")
"""How a row spells floats that are no numbers."""

FAR = {"snan": Decimal("sNaN"), "huge": Decimal("1E+5000"), "tiny": Decimal("1E-5000"), "long": 10**5000}
"""How it spells numbers that must not even be compared, or worked with."""

UNSENT = (ValueRefused, ValueNotDecodable)
"""How drivers refuse a value: for its own sake, or as what decides its words has no value."""

REFUSED = "refused"
"""What a judge says of a value that it does not take."""


def register_of(built: Built, row: Json, *, writes: bool = False) -> tuple[Register, View]:
    """The register of a row, and the view that it names, or that a driver takes to read or to write."""
    register = built.map.models[0].register(row["register"])
    usual = register.write_view if writes else register.read_view
    return register, next(one for one in register.views if one.name == row.get("view", usual.name))


def attribute(device: Any, path: str) -> Any:
    """An attribute of a driver by its path: `channels[2].value`."""
    for part in path.split("."):
        match = _ELEMENT.fullmatch(part)
        device = getattr(device, match[1])[int(match[2])] if match else getattr(device, part)
    return device


OCTETS = (datetime, date, time, bytes, IPv4Address, IPv6Address)
"""Python's types of values that are bytes."""


def spelled(found: Any) -> str:
    """A value that is bytes in the words of rows."""
    return found.hex() if isinstance(found, bytes) else str(getattr(found, "isoformat", found.__str__)())


def said_of_part(value: Any) -> object:
    """A part of a word: an exact number, or the id of the fault that it reports."""
    if isinstance(value, SensorFault | Sentinel):
        return value.fault if isinstance(value, SensorFault) else value.id
    return value if isinstance(value, str) else exact_number(value) if isinstance(value, float) else Fraction(value)


def said_by_driver(found: Any) -> object:  # noqa: PLR0911 (as many kinds of values)
    """A value of a driver in the words of rows."""
    if isinstance(found, bool | str):
        return found
    if isinstance(found, OCTETS):
        return spelled(found)
    if getattr(found, "known", None) is False:
        return {"unknown": int(found)}
    if hasattr(type(found), "named"):  # flags
        rest = int(found) & ~int(type(found).named())
        names = {one.name.lower() for one in type(found) if one in found}
        return {"flags": names} | ({"unnamed": rest} if rest else {})
    if hasattr(found, "parts"):
        return {
            "fields": {
                name: said_of_part(part) for name, part in found if not isinstance(part, NotPresent | OutOfRange)
            }
        }
    if hasattr(found, "label"):
        return {"name": found.name}
    return found


def expected_of(row: Json) -> object:
    """What a row says of its words, in the same form."""
    if "value" in row:
        return row["value"]
    if "no_value" in row:
        return {"no value": True}
    if "flags" in row:
        return {"flags": set(row["flags"])} | ({"unnamed": row["unnamed"]} if "unnamed" in row else {})
    if "member" in row or "special" in row:
        return {"name": row.get("member", row.get("special")).rpartition(".")[2]}
    if "fields" in row:
        return {"fields": {name: said_of_part(part) for name, part in row["fields"].items()}}
    return {key: row[key] for key in ("unknown", "fault") if key in row}


def read_by_driver(read: Any, path: str) -> object:
    """What reading a register gives, an error in the words of rows."""
    try:
        return said_by_driver(read())
    except ValueNotDecodable as error:
        return said_by_error(error, path)


def said_by_error(error: ValueNotDecodable, path: str) -> object:
    """Why a read gave no value, in the words of rows; the fault of a register that decides is no fault of this one."""
    own = isinstance(error, SensorFault) and error.register == path
    return {"fault": error.fault} if own else {"no value": True}


def value_for(built: Built, row: Json) -> Any:  # noqa: PLR0911 (as many kinds of values)
    """The value of a row as a program hands it to the driver."""
    register, _ = register_of(built, row)
    declared = built.module.CaseA.registers[row["register"]]
    if "member" in row:
        place, _, name = row["member"].rpartition(".")
        return declared.value_type.classes[int(place or 1) - 1][name]
    if "special" in row:
        return declared.value_type.special[row["special"]]
    if "flags" in row:
        return declared.value_type.make(sum(1 << one.low for one in register.fields if one.id in row["flags"]))
    if "fields" in row:
        return _word(register, declared.value_type.make, row["fields"])
    value = row["value"] if "value" in row else row["refuses"]
    if isinstance(declared.value_type, OctetType) and isinstance(value, str):
        return declared.value_type.parse(value)
    if register.kind is not Kind.VERSION and value in {*NO_NUMBERS, *FAR}:
        return FAR[value] if value in FAR else float(value)
    return _as_float(value) if isinstance(value, Decimal) else value


def _word(register: Register, make: Any, parts: Json) -> Any:
    """A word whose parts are numbers, or report the faults of these ids."""
    numbers = {name: part for name, part in parts.items() if not isinstance(part, str)}
    ends = [(one, fault.ends) for one in register.fields for fault in one.sentinels if fault.id == parts.get(one.id)]
    faults = sum(int(found[0]) % (1 << one.width) << one.low for one, found in ends if found)
    return make(int(make(0).replace(**numbers)) | faults)


def _as_float(value: Decimal) -> float | Decimal:
    """The float nearest to a decimal; the decimal itself where there is none."""
    near = float(value)
    return near if math.isfinite(near) and bool(near) is bool(value) else value


class Present(Mapping[str, Fraction]):
    """Values of use of all registers, as the reference decodes them from what the addresses hold."""

    def __init__(self, built: Built, memory: Any) -> None:
        self._model, self._memory = built.map.models[0], memory
        self._given = surroundings_of(built.map, {})

    @property
    def known(self) -> Surroundings:
        """The values, and what is given by default."""
        given = self._given
        return Surroundings(self, given.codes, given.facts, given.numbers, Texts(self, given.texts))

    def __getitem__(self, path: str) -> Fraction:
        try:
            value, field = self.reading(path)
        except UnknownValueError:  # what it depends on has no value
            value, field = None, None
        if not isinstance(value, Fraction):
            raise KeyError(path)
        return value if field is None else Fraction(int(value) >> field.low & (1 << field.width) - 1)

    def reading(self, path: str) -> tuple[Fraction | str | None, BitField | None]:
        """What a register holds, and the field of it that a path names."""
        try:
            register, field = self._model.register(path), None
        except KeyError:
            owner, _, name = path.rpartition(".")
            register = self._model.register(owner)
            field = next(one for one in register.fields if one.id == name)
        if not holds(register.when, self.known):
            return None, field
        view = register.preferred
        words = self._memory.get(view.space.value, view.address(register.at), view.words)
        value = decode(register, view, tuple(words), self.known).value
        if isinstance(value, str) and register.kind is Kind.VERSION:
            value = Fraction(value.replace(".", ""))
        return value, field

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0

    def __contains__(self, path: object) -> bool:
        try:
            self[str(path)]
        except KeyError:
            return False
        return True


class Texts(dict[str, str]):
    """Texts of registers, and choices that are given."""

    def __init__(self, present: Present, given: Mapping[str, str]) -> None:
        super().__init__(given)
        self._present = present

    def __missing__(self, path: str) -> str:
        value, _ = self._present.reading(path)
        if not isinstance(value, str):
            raise KeyError(path)
        return value

    def __contains__(self, path: object) -> bool:
        try:
            self[str(path)]
        except KeyError:
            return False
        return True


def read_by_reference(built: Built, memory: Any, row: Json) -> object:
    """What the reference makes of the words of a row."""
    register, view = register_of(built, row)
    try:
        reading = decode(register, view, tuple(words_of(row["words"])), Present(built, memory).known)
    except UnknownValueError:
        return {"no value": True}
    if reading.meaning is Meaning.FAULT:
        return {"fault": reading.fault}
    if reading.meaning is Meaning.UNKNOWN_MEMBER:
        return {"unknown": int(reading.value or 0)}
    if reading.meaning is not Meaning.VALUE or reading.value is None:
        return {"no value": True}
    return _said_by_reference(register, reading.value, row, Present(built, memory).known)


def _said_by_reference(register: Register, value: Fraction | str, row: Json, known: Surroundings) -> object:
    if isinstance(value, str):
        return value
    if "member" in row and register.enum:
        return {"name": next(one.id for one in existing_members(register, known) if one.code == value)}
    if "special" in row:  # the reference gives its number: which name that has is the vectors' matter
        return expected_of(row)
    if "flags" in row:
        named = sum(1 << one.low for one in register.fields)
        names = {one.id for one in register.fields if int(value) >> one.low & 1}
        return {"flags": names} | ({"unnamed": int(value) & ~named} if int(value) & ~named else {})
    if "fields" in row:
        every = [(one, part_value(one, int(value))) for one in register.fields if holds(one.when, known)]
        parts = {one.id: part for one, part in every if isinstance(part, Sentinel) or one.reads(part)}
        return {"fields": {name: said_of_part(part) for name, part in parts.items()}}
    return value


def same(found: object, expected: object) -> bool:
    """Whether a judge says what a row says; a number may be exact, or the float nearest to it."""
    if isinstance(expected, bool) or isinstance(found, bool):
        return bool(found) is expected and found in (0, 1)
    if isinstance(expected, int | Decimal) and isinstance(found, Fraction):
        return found == Fraction(expected)
    if isinstance(expected, Decimal) and isinstance(found, float):
        return found == float(expected)
    return found == expected


def of_another_sort(built: Built, row: Json) -> bool:
    """Whether a row offers a text for a number, or the like: nothing that the reference can be asked."""
    value, kind = row.get("refuses"), register_of(built, row)[0].kind
    textual = kind in {Kind.STRING, Kind.VERSION}
    return "refuses" in row and (isinstance(value, str) is not textual or isinstance(value, bool))


def written_by_reference(built: Built, memory: Any, row: Json) -> object:
    """The words that the reference makes of the value of a row."""
    register, view = register_of(built, row, writes=True)
    value, known = value_for(built, row), Present(built, memory).known
    if register.writable and not holds(register.writable.when, known):
        return REFUSED
    if isinstance(value, Decimal) or row.get("refuses") in {*NO_NUMBERS, *FAR}:
        return REFUSED  # the reference takes exact numbers only, of a size that a device may have
    value = spelled(value) if isinstance(value, OCTETS) else value
    number = value if isinstance(value, str) else _exact(register, value, row, Present(built, memory))
    try:
        return list(encode(register, view, number, known, rounded=row.get("rounded", False)))
    except (RefusedError, UnknownValueError):
        return REFUSED


def _exact(register: Register, value: Any, row: Json, present: Present) -> Fraction:
    if "special" not in row:
        return Fraction(int(value)) if isinstance(value, int) else exact_number(value)
    special = next(one for one in register.specials if one.id == row["special"])
    number = special_value(register, special, present.known)
    assert number is not None
    return number


def written(write: Any, memory: Any, space: str, address: int, count: int) -> object:
    """What stands at the address after a write by a driver; whether it was refused before anything was written."""
    try:
        write()
    except UNSENT:
        sent = [pdu for pdu in memory.log if pdu[0] in {5, 6, 15, 16, 21}]
        return REFUSED if not sent else f"refused after {[pdu.hex(' ') for pdu in sent]}"
    return memory.get(space, address, count)


def simulated(built: Built, held: Mapping[str, Mapping[int, str]]) -> SimulatedDevice:
    """A simulated device that holds some words."""
    device = SimulatedDevice(built.map, "A", unit=1)
    for space, cells in held.items():
        for address, text in cells.items():
            prime(device, space, address_of(address), words_of(text))
    return device


def prime(device: SimulatedDevice, space: str, address: int, words: list[int]) -> None:
    """Let a device hold words at the base address of a register, whatever it would take from a master."""
    address += LONG + address if space == "enron" and address < LONG else 0
    for register in device.model.registers:
        for view in register.views:
            if (view.space.value, view.address(register.at)) == (space, address) and view.words <= len(words):
                stored = simulated_codec.decode(device.state.seen(view), words[: view.words], device.state.order(view))
                if stored is not None:
                    device.state.store(register.path, stored)
                return


def ask(device: SimulatedDevice, register: Register, view: View, unit: int = 1) -> list[int]:
    """The words that a simulated device answers at a view, as this unit."""
    function = READ_FUNCTIONS[view.space.value]
    if function == 7:
        return [device.handle(b"\x07")[1]]  # type: ignore[index] # it answers
    address, most = view.address(register.at), device.register_map.protocol.most_read(view.space)
    portions = [(address + start, min(most, view.words - start)) for start in range(0, view.words, most)]
    return [word for portion in portions for word in _answered(device, unit, function, view, *portion)]


def _answered(device: SimulatedDevice, unit: int, function: int, view: View, *portion: int) -> list[int]:
    answer, address = device.handle(_asked(function, *portion), unit=unit), portion[0]
    assert answer is not None
    assert answer[0] == function, answer.hex(" ")
    if function in (1, 2):
        return [answer[2] & 1]
    data = answer[{20: 4, 24: 3, 43: 9}.get(function, 2) :]
    data += bytes(2 * view.words - len(data)) if function == 43 else b""
    words = [int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data), 2)]
    return words[address & 63 :][: view.words] if function == 24 else words


def _asked(function: int, address: int, count: int) -> bytes:
    """The request that reads words (or bits) from an address on."""
    if function == 20:  # byte count, 6, file, record, number of words
        return struct.pack(">BBBHHH", 20, 7, 6, address >> 16, address & 0xFFFF, count)
    if function == 43:
        return bytes((43, 14, 4, address >> 8))
    if function == 24:
        return struct.pack(">BH", 24, address >> 6)
    if address >= LONG:
        address, count = (address - LONG) // 2, count // 2
    return struct.pack(">BHH", function, address & 0xFFFF, count)


def decoded_by_tool(
    built: Built, memory: Any, row: Json, selecting: Callable[[int], tuple[int, list[bytes]]] = lambda _: (1, [])
) -> str:
    """What `decode` prints of a value in a captured answer, after it saw what the value depends on.

    `selecting` tells the unit that answers at an address, and what was written before to select its page.
    """
    driver = built.module.CaseA
    decoder = Decoder(driver, bases=built.bases)
    text = ""
    for register, view in [*_others(built, memory, row), register_of(built, row)]:
        own = register.path == row["register"]
        words = words_of(row["words"]) if own else memory.get(view.space.value, view.address(register.at), view.words)
        unit, selected = selecting(view.address(register.at))
        for pdu in selected:
            decoder.feed(CapturedFrame("tcp", 1, pdu, pdu), "sent")
            decoder.feed(CapturedFrame("tcp", 1, pdu[:5], pdu[:5]), "received")
        request, answer = _frames(register, view, words)
        decoder.feed(CapturedFrame("tcp", unit, request, request), "sent")
        for item in decoder.feed(CapturedFrame("tcp", unit, answer, answer), "received").items:
            if (item.name, item.view) == (register.path, view.name):
                text = f"problem: {item.problem}" if item.problem else item.text
    return text


def _others(built: Built, memory: Any, row: Json) -> list[tuple[Register, View]]:
    """What else the device was told to hold, twice: one may depend on the other."""
    others = [(one, one.preferred) for one in built.map.models[0].registers if one.path != row["register"]]
    return [(one, view) for one, view in others if view.address(one.at) in memory.cells[view.space.value]] * 2


def _frames(register: Register, view: View, words: list[int]) -> tuple[bytes, bytes]:
    function = READ_FUNCTIONS[view.space.value]
    if function == 7:
        return b"\x07", bytes([7, words[0]])
    data = bytes([words[0]]) if function in (1, 2) else b"".join(word.to_bytes(2, "big") for word in words)
    head = bytes([function, len(data)])
    if function == 20:
        head = bytes([20, len(data) + 2, len(data) + 1, 6])
    if function == 43:
        data = data.partition(b"\0")[0]
        head = bytes((43, 14, 4, 0x83, 0, 0, 1, view.address(register.at) >> 8, len(data)))
    if function == 24:  # the count, and values up to the one that is asked for
        before = view.address(register.at) & 63
        count = before + len(words) - 1 if before else words[0]
        data = struct.pack(f">H{before}x{before}x", count)[: 2 * before or None] + data if before else data
        data += bytes(2 * (1 + count) - len(data))
        head = struct.pack(">BH", 24, len(data))
    return _asked(READ_FUNCTIONS[view.space.value], view.address(register.at), view.words), head + data


def bench_of(built: Built) -> DriverUnderTest:
    """The driver beside the vectors of its map."""
    found = document(built.written or built.map)
    vectors = Vectors(
        found["map"],
        tuple(found["models"]),
        tuple(found["sets"]),
        tuple(found["examples"]),
        found["protocol"],
        tuple(found["commands"]),
        tuple(found.get("computed", ())),
    )
    return DriverUnderTest(built.module.CaseA, vectors)
