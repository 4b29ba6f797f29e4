"""The simulator of pymodbus: cells with the words of defaults, blocks that do not meet, and what may be written."""

import json
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.losses import Exported

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
Made = Callable[..., dict[str, Any]]


@pytest.fixture
def made(exported_text: Text, small: Small) -> Made:
    """The device of the JSON that is made of these registers."""

    def device(*registers: str, with_: str = "", **more: str) -> dict[str, Any]:
        text = exported_text("pymodbus-simulator", small(*registers, **more), with_=with_)
        return dict(json.loads(text)["device_list"]["device"])

    return device


@pytest.fixture
def words(made: Made) -> Callable[..., dict[int, int]]:
    """The words that lists of words hold, by the address in the JSON."""

    def found(*registers: str, **more: str) -> dict[int, int]:
        entries = made(*registers, **more)["uint16"]
        return {at: one["value"] for one in entries for at in range(one["addr"][0], one["addr"][1] + 1)}

    return found


def test_a_default_is_held_as_the_word_that_its_scale_makes(words: Callable[..., Any]) -> None:
    assert words("at: 9, name: A, decimals: 1, default: 25.1") == {9: 251}


def test_a_stated_value_is_held_instead_of_the_default(words: Callable[..., Any]) -> None:
    assert words("at: 9, name: A, decimals: 1, default: 25.1", with_="a=-0.5") == {9: 0xFFFB}


def test_signed_numbers_are_words_as_the_list_int16_packs_a_float(made: Made) -> None:
    found = made("at: 9, name: A, default: -2")
    assert "int16" not in found
    assert found["uint16"] == [{"addr": [9, 9], "value": 0xFFFE}]


def test_trap_int32_and_64_bit_integers_are_refused_as_lists_so_they_are_words(made: Made) -> None:
    found = made("at: 0, name: A, type: int32, default: -1", "at: 2, name: B, type: uint64, default: 65536")
    assert not found.keys() & {"int32", "int64", "uint64"}
    assert found["uint16"] == [
        {"addr": [0, 1], "value": 0xFFFF},
        {"addr": [2, 3], "value": 0},
        {"addr": [4, 4], "value": 1},
        {"addr": [5, 5], "value": 0},
    ]


def test_usual_orders_are_said_by_type_and_others_by_words(made: Made) -> None:
    found = made(
        "at: 0, name: A, type: uint32, default: 65537",
        "at: 2, name: B, type: float32, default: -1234.5",
        "at: 4, name: C, type: float32, word_order: little, default: -1234.5",
        "at: 6, name: D, type: string, length: 2, default: ab",
    )
    assert found["uint32"] == [{"addr": [0, 1], "value": 65537}]
    assert found["float32"] == [{"addr": [2, 3], "value": -1234.5}]
    assert found["uint16"] == [{"addr": [4, 4], "value": 0x5000}, {"addr": [5, 5], "value": 0xC49A}]
    assert found["string"] == [{"addr": [6, 7], "value": "ab  "}]


def test_holding_registers_alone_have_their_wire_addresses(made: Made) -> None:
    setup = made("at: 9, name: A, default: 1")["setup"]
    assert (setup["co size"], setup["di size"], setup["ir size"]) == (0, 0, 0)
    assert setup["hr size"] == 10 + 125
    assert setup["shared blocks"] is False


def test_trap_9_spaces_follow_each_other_and_do_not_collide(made: Made) -> None:
    found = made(
        "at: 0, name: H, default: 3",
        "at: 0, name: I, space: input, access: r, default: 4",
        "at: 17, name: C, space: coil, default: 1",
        "at: 3, name: D, space: discrete, access: r, default: 1",
    )
    assert found["bits"] == [{"addr": [1, 1], "value": 2}, {"addr": [4096, 4096], "value": 8}]
    assert found["uint16"] == [{"addr": [8192, 8192], "value": 4}, {"addr": [8192 + 65536] * 2, "value": 3}]
    setup = found["setup"]
    assert [setup[key] for key in ("co size", "di size", "ir size", "hr size")] == [4096, 4096, 65536, 126]


def test_every_range_that_may_be_written_is_defined(made: Made) -> None:
    found = made("at: 0, name: A", "at: 1, name: B", "at: 2, name: C, access: r", "at: 9, name: D, type: int32")
    assert found["write"] == [[0, 1], [9, 10]]
    defined = {at for one in found["uint16"] for at in range(one["addr"][0], one["addr"][1] + 1)}
    assert {0, 1, 9, 10} <= defined


def test_two_bytes_of_a_word_are_held_together(words: Callable[..., Any]) -> None:
    found = words(
        "at: 0, name: L, type: uint8, byte: low, access: r, default: 1",
        "at: 0, name: H, type: uint8, byte: high, access: r, default: 2",
    )
    assert found == {0: 0x0201}


def test_without_a_default_zeros_are_held_and_that_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("pymodbus-simulator", small("at: 0, name: A", "at: 1, name: B, default: 1"))
    assert {one for one in lost(made) if one[1] == "default"} == {("a", "default", "COSMETIC")}


def test_coils_are_written_sixteen_at_a_time_which_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("pymodbus-simulator", small("at: 0, name: C, space: coil"))
    assert ("c", "write", "LOST") in lost(made)


def test_views_and_aliases_hold_words_of_their_own_which_is_told(
    export: Export, small: Small, lost: Lost, words: Callable[..., Any]
) -> None:
    register = "at: 0, name: A, default: 5, aliases: [100]"
    assert words(register) == {0: 5, 100: 5}
    assert ("a", "alias", "LOST") in lost(export("pymodbus-simulator", small(register)))


def test_the_server_answers_one_unit_on_loopback_or_where_it_is_said(exported_text: Text, small: Small) -> None:
    text = small("at: 0, name: A")
    usual = json.loads(exported_text("pymodbus-simulator", text))["server_list"]["server"]
    assert (usual["comm"], usual["host"], usual["port"], usual["device_id"]) == ("tcp", "127.0.0.1", 5020, 1)
    serial = json.loads(exported_text("pymodbus-simulator", text, at="/dev/ttyS0", unit="7"))["server_list"]["server"]
    assert (serial["comm"], serial["port"], serial["baudrate"], serial["device_id"]) == (
        "serial",
        "/dev/ttyS0",
        9600,
        7,
    )


def test_a_register_that_a_read_clears_is_held_as_well(words: Callable[..., Any]) -> None:
    assert words("at: 0, name: A, access: r, reading: clears, default: 7") == {0: 7}


def test_a_second_view_in_an_order_that_nothing_sets_holds_zeros(words: Callable[..., Any]) -> None:
    top = """
views:
  both:
    base: {type: int16}
    ieee: {type: float32, offset: 1000, stride: 2, word_order: {register: order, codes: {0: big, 1: little}}}
"""
    found = words("at: 0, name: Order, type: uint16, access: r", "at: 1, name: A, views: both, default: 5", top=top)
    assert found == {0: 0, 1: 5, 1002: 0, 1003: 0}


def test_a_view_that_is_clipped_holds_what_the_device_would_send(words: Callable[..., Any]) -> None:
    top = """
views:
  both:
    base: {type: float32}
    whole: {type: int16, offset: 1000, rounding: half_up, saturates: true}
"""
    found = words("at: 0, name: A, views: both, default: 40000", top=top)
    assert found[1000] == 0x7FFF
