"""Things and items for openHAB: what the binding's documentation says of each key, and files of the DSL's own grammar.

openHAB itself does not run here. The grammar is that of its Xtext files, as far as an export uses it.
"""

import json
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from regscribe.export.openhab.units import DIMENSIONS
from regscribe.losses import Exported
from regscribe.model.units import KNOWN_UNITS

Export = Callable[..., Exported]
Small = Callable[..., str]
Lost = Callable[[Exported], set[tuple[str, str, str]]]

AT = "10.0.0.7:1502"
TOKEN = re.compile(
    r"""\s*(?://[^\n]*\n)*\s*(?:(?P<string>"(?:\\[btnfru"'\\]|[^\\"])*")|(?P<id>\^?[A-Za-z0-9_-]+)|(?P<sign>[][{},=:.]))"""
)
KEYWORDS = {"Thing", "Bridge", "true", "false"}


class Reader:
    """Reads the files by openHAB's grammar; whatever is not of it raises."""

    def __init__(self, text: str) -> None:
        self._tokens = list(self._split(text.rstrip()))
        self._at = 0

    def _split(self, text: str) -> Iterator[str]:
        place = 0
        while place < len(text):
            found = TOKEN.match(text, place)
            assert found, text[place : place + 40]
            yield found[found.lastgroup or ""]
            place = found.end()

    def take(self, *wanted: str) -> str:
        token = self._tokens[self._at]
        assert not wanted or token in wanted, (token, wanted)
        self._at += 1
        return token

    def sees(self, token: str) -> bool:
        return self._at < len(self._tokens) and self._tokens[self._at] == token

    @property
    def more(self) -> bool:
        return self._at < len(self._tokens)

    def id(self) -> str:
        token = self.take()
        assert re.fullmatch(r"[A-Za-z0-9_-]+", token), token
        assert token not in KEYWORDS, token
        return token

    def text(self) -> str:
        token = self.take()
        assert token.startswith('"'), token
        return json.loads(token)

    def value(self) -> Any:
        if self._tokens[self._at].startswith('"'):
            return self.text()
        word = self.take()
        return word == "true" if word in {"true", "false"} else int(word)

    def settings(self) -> dict[str, Any]:
        found: dict[str, Any] = {}
        self.take("[")
        while not self.sees("]"):
            key = self.id()
            self.take("=")
            found[key] = self.value()
            assert self.sees("]") or self.take(",")
        self.take("]")
        return found

    def thing(self) -> dict[str, Any]:
        """A thing or a bridge with what is in it; the first has its whole identifier."""
        kind = self.take("Bridge", "Thing")
        parts = [self.id()]
        while self.sees(":"):
            self.take(":")
            parts.append(self.id())
        if len(parts) == 1:
            parts.append(self.id())
        found = {"kind": kind, "id": parts, "label": self.text() if self._tokens[self._at].startswith('"') else ""}
        found |= {"settings": self.settings(), "inside": []}
        if self.sees("{"):
            self.take("{")
            while not self.sees("}"):
                found["inside"].append(self.thing())
            self.take("}")
        return found

    def item(self) -> dict[str, Any]:
        parts = [self.id()]
        while self.sees(":"):
            self.take(":")
            parts.append(self.id())
        found: dict[str, Any] = {"type": ":".join(parts), "name": self.id(), "label": self.text()}
        self.take("{")
        while not self.sees("}"):
            key = self.id()
            self.take("=")
            found[key] = self.text()
            if self.sees("["):
                found[f"{key} settings"] = self.settings()
            assert self.sees("}") or self.take(",")
        self.take("}")
        return found


class Files:
    """The bridge, the data things by their identifiers, the items by their names without the device's."""

    def __init__(self, made: Exported) -> None:
        (things,) = (str(text) for path, text in made.texts.items() if path.startswith("things/"))
        (items,) = (str(text) for path, text in made.texts.items() if path.startswith("items/"))
        self.things, self.items = things, items
        reader = Reader(things)
        self.bridge = reader.thing()
        assert not reader.more
        self.data: dict[str, Any] = {}
        self.pollers = [one for one in self.bridge["inside"] if one["kind"] == "Bridge"]
        for one in [self.bridge, *self.pollers]:
            self.data |= {each["id"][-1]: each["settings"] for each in one["inside"] if each["kind"] == "Thing"}
        reader = Reader(items)
        self.item: dict[str, Any] = {}
        while reader.more:
            found = reader.item()
            self.item[found["name"].removeprefix("ExampleA1_1_")] = found


@pytest.fixture
def files(export: Export, small: Small) -> Callable[..., Files]:
    """Both files of a small map, read by the grammar."""

    def made(*registers: str, top: str = "", at: str = AT, **options: str) -> Files:
        return Files(export("openhab", small(*registers, top=top), at=at, **options))

    return made


@pytest.fixture
def one(files: Callable[..., Files]) -> Callable[..., tuple[Any, Any]]:
    """Data thing and item of the register `x` at 7."""

    def made(register: str, **more: str) -> tuple[Any, Any]:
        found = files(f"at: 7, name: X, {register}", **more)
        return found.data["x"], found.item["x"]

    return made


# -- things -----------------------------------------------------------------------------------------------------------


def test_the_bridge_says_where_the_device_answers(files: Callable[..., Files]) -> None:
    found = files("at: 0, name: A", unit="9").bridge
    assert found["id"] == ["modbus", "tcp", "examplea1-9"]
    assert {key: found["settings"][key] for key in ("host", "port", "id")} == {
        "host": "10.0.0.7",
        "port": 1502,
        "id": 9,
    }


def test_a_serial_line_has_its_character_format(files: Callable[..., Files]) -> None:
    top = 'protocol: {source: "1", serial: {modes: [rtu], baud: [19200], formats: ["8E1"], default: 19200 8E1}}'
    found = files("at: 0, name: A", top=top, at="/dev/ttyUSB0").bridge
    assert found["id"][1] == "serial"
    wanted = {
        "port": "/dev/ttyUSB0",
        "baud": 19200,
        "dataBits": "8",
        "parity": "even",
        "stopBits": "1.0",
        "encoding": "rtu",
    }
    assert wanted.items() <= found["settings"].items()


def test_one_poller_reads_each_request_of_the_plan(files: Callable[..., Files]) -> None:
    found = files("at: 0, name: A", "at: 1, name: B, type: uint32", "at: 300, name: C", every="5")
    assert [one["settings"] for one in found.pollers] == [
        {"start": 0, "length": 3, "refresh": 5000, "type": "holding"},
        {"start": 300, "length": 1, "refresh": 5000, "type": "holding"},
    ]


def test_the_pause_of_the_device_is_kept(files: Callable[..., Files]) -> None:
    settings = files("at: 0, name: A", top='protocol: {source: "1", pause: 200}').bridge["settings"]
    assert settings["timeBetweenTransactionsMillis"] == 200


@pytest.mark.parametrize(
    ("register", "kind", "written"),
    [
        ("type: int16", "int16", "int16"),
        ("type: uint16", "uint16", "int16"),  # trap: the binding writes no uint16; the bits are the same
        ("type: uint32", "uint32", "int32"),
        ("type: int32, word_order: little", "int32_swap", "int32_swap"),
        ("type: float32", "float32", "float32"),
        ("type: float32, word_order: little", "float32_swap", "float32_swap"),
        ("type: uint64", "uint64", "int64"),
        ("type: int64, word_order: little", "int64_swap", "int64_swap"),
    ],
)
def test_each_type_is_read_and_written(one: Callable[..., Any], register: str, kind: str, written: str) -> None:
    data, _ = one(register)
    assert data == {
        "readStart": "7",
        "readValueType": kind,
        "writeStart": "7",
        "writeType": "holding",
        "writeValueType": written,
    }


@pytest.mark.parametrize(("register", "start"), [("type: uint8", "7.0"), ("type: int8, byte: high", "7.1")])
def test_a_byte_is_low_or_high(one: Callable[..., Any], register: str, start: str) -> None:
    data, _ = one(f"access: r, {register}")
    assert (data["readStart"], data["readValueType"]) == (start, register.split()[1].rstrip(","))


def test_coils_are_bits_that_are_written_as_coils(one: Callable[..., Any]) -> None:
    data, item = one("space: coil, type: bit", top='protocol: {source: "1", functions: [1, 5, 3]}')
    assert data == {"readStart": "7", "readValueType": "bit", "writeStart": "7", "writeType": "coil"}
    assert (item["type"], item["channel"]) == ("Switch", "modbus:data:examplea1-1:coil_7:x:switch")


def test_a_bit_that_is_a_number_is_a_number(one: Callable[..., Any]) -> None:
    data, item = one(
        "space: coil, type: bit, kind: number, multiply: 2", top='protocol: {source: "1", functions: [1, 5, 3]}'
    )
    assert (data["readValueType"], item["type"]) == ("bit", "Number")
    assert item["channel settings"]["gain"] == "2"


def test_named_bits_are_register_and_bit(files: Callable[..., Files]) -> None:
    found = files("at: 7, name: X, access: r, type: uint32, flags: {0: run, 31: trip}")
    # the first register has the higher bits
    assert {name: one["readStart"] for name, one in found.data.items()} == {"x_run": "8.0", "x_trip": "7.15"}
    found = files("at: 7, name: X, access: r, type: uint32, word_order: little, flags: {0: run, 31: trip}")
    assert {name: one["readStart"] for name, one in found.data.items()} == {"x_run": "7.0", "x_trip": "8.15"}
    assert found.item["x_run"]["type"] == "Switch"


def test_a_device_without_function_6_is_written_by_function_16(one: Callable[..., Any]) -> None:
    data, _ = one("type: int16", top='protocol: {source: "1", functions: [3, 16]}')
    assert data["writeMultipleEvenWithSingleRegisterOrCoil"] is True


def test_what_is_only_written_stands_below_the_device(files: Callable[..., Files]) -> None:
    found = files("at: 0, name: A, access: r", "at: 7, name: X, access: w")
    assert found.data["x"] == {"writeStart": "7", "writeType": "holding", "writeValueType": "int16"}
    assert found.item["x"]["channel"] == "modbus:data:examplea1-1:x:number"
    assert [one["id"] for one in found.bridge["inside"]][-1] == ["data", "x"]


# -- items ------------------------------------------------------------------------------------------------------------


def test_the_gain_has_the_unit_and_the_offset_comes_before_it(one: Callable[..., Any]) -> None:
    # trap: (raw + pre-gain-offset) * gain, so -40 °C behind 0.1 is -400 before it
    _, item = one("access: r, multiply: 0.1, add: -40, unit: °C")
    assert item["channel settings"] == {"profile": "modbus:gainOffset", "gain": "0.1 °C", "pre-gain-offset": "-400"}
    assert (item["type"], item["unit"]) == ("Number:Temperature", "°C")
    assert item["stateDescription settings"] == {"pattern": "%.1f %unit%", "readOnly": True}


def test_a_plain_number_needs_no_profile(one: Callable[..., Any]) -> None:
    _, item = one("access: r")
    assert (item["type"], item.get("channel settings")) == ("Number", None)


def test_a_unit_that_openhab_does_not_know_is_shown_behind_the_number(export: Export, small: Small) -> None:
    made = export("openhab", small("at: 7, name: X, access: r, decimals: 1, unit: pH"), at=AT)
    item = Files(made).item["x"]
    assert (item["type"], item["stateDescription settings"]["pattern"]) == ("Number", "%.1f pH")
    assert item["channel settings"]["gain"] == "0.1"
    assert [one.done for one in made.losses if one.fact == "unit"] == [
        "shown behind the number: openHAB has no unit pH"
    ]


def test_every_unit_with_a_dimension_is_one_that_maps_have() -> None:
    assert set(DIMENSIONS) <= set(KNOWN_UNITS)


def test_codes_are_options(one: Callable[..., Any]) -> None:
    _, item = one("enum: {0: off, 3: 'slow, very = 1'}")
    assert item["stateDescription settings"]["options"] == "0=off,3=slow; very : 1"


def test_limits_and_step_are_offered(one: Callable[..., Any]) -> None:
    _, item = one('decimals: 1, range: 1..50, special: {0: "off"}')
    assert item["stateDescription settings"] == {
        "pattern": "%.1f",
        "min": "0",
        "max": "50",
        "step": "0.1",
        "readOnly": False,
    }
    assert item["autoupdate"] == "false"


def test_a_step_of_the_map_is_offered(one: Callable[..., Any]) -> None:
    _, item = one("decimals: 1, step: 0.5")
    assert item["stateDescription settings"]["step"] == "0.5"


def test_brackets_in_a_label_are_no_form_of_the_value(files: Callable[..., Files]) -> None:
    found = files('at: 7, id: x, name: "Level [%d] of \\"A\\""')
    assert found.item["x"]["label"] == 'Level (%d) of "A"'


def test_hostile_names_stay_texts(files: Callable[..., Files]) -> None:
    hostile = 'x" ] } { channel="evil" // /* ${y} {{z}} \\'
    found = files(f"at: 7, id: x, name: {json.dumps(hostile)}, enum: {{0: {json.dumps(hostile)}}}")
    assert found.data.keys() == {"x"}
    assert found.item["x"]["channel"] == "modbus:data:examplea1-1:holding_7:x:number"


def test_names_of_the_dsl_are_no_identifiers(files: Callable[..., Files]) -> None:
    found = files("at: 7, id: a, name: A", name="Thing.true")
    assert found.bridge["id"] == ["modbus", "tcp", "thing_true"]


def test_both_files_say_what_they_were_made_of(files: Callable[..., Files]) -> None:
    found = files("at: 7, name: X")
    for text in (found.things, found.items):
        assert text.startswith("// Controller, model A1, map example/controller\n")
        assert "// openhab: not verified with the real program\n" in text


# -- losses -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("register", "loss"),
    [
        ("access: r, divide: 3", ("x", "scale-rounded", "COSMETIC")),
        ("range: 1..5", ("x", "range", "LOST")),
        ("range: [1..5, 7..9]", ("x", "range-union", "LOST")),
        ('range: 1..5, special: {0: "off"}', ("x", "special-value", "LOST")),
        ("decimals: 1", ("x", "step", "LOST")),
        ("enum: {0: 'a,b'}", ("x", "label-changed", "COSMETIC")),
        ("access: r, sentinels: {-1: broken}", ("x", "sentinel", "WRONG")),
        ("type: uint16, kind: boolean", ("x", "truth-of-words", "LOST")),
        ("type: uint16, version: n.n", ("x", "version", "LOST")),
        ("access: r, type: uint16, fields: {low: {bits: 0..3}}", ("x", "fields", "LOST")),
    ],
)
def test_what_is_lost_is_told(
    export: Export, small: Small, lost: Lost, register: str, loss: tuple[str, str, str]
) -> None:
    assert loss in lost(export("openhab", small(f"at: 7, name: X, {register}"), at=AT))


@pytest.mark.parametrize(
    ("register", "why"),
    [
        ("divide: 3", "its scale has no finite decimal"),
        ("multiply: 0.3", "dividing by its scale has no finite decimal, at which the profile fails"),
        ("type: uint16, flags: {0: run}", "the items do not write a value of the kind flags"),
        ("type: uint8", "the binding does not write single bytes"),
        ("danger: the oven gets hot", "a write is dangerous"),
    ],
)
def test_what_the_binding_would_write_wrongly_is_read_only(
    export: Export, small: Small, register: str, why: str
) -> None:
    made = export("openhab", small(f"at: 7, name: X, {register}"), at=AT)
    assert [one.done for one in made.losses if one.fact == "write"] == [f"read only: {why}"]
    assert all("writeStart" not in one for one in Files(made).data.values())


@pytest.mark.parametrize(
    "register", ["type: float64", "type: string, length: 2", "type: uint16, byte_order: little", "type: bcd16"]
)
def test_what_the_binding_does_not_read_is_left_out(export: Export, small: Small, register: str) -> None:
    made = export("openhab", small("at: 0, name: A", f"at: 7, name: X, {register}"), at=AT)
    assert [one.register for one in made.losses if one.fact == "register"] == ["x"]
