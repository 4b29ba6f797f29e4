"""Expected values below are worked out by hand or by struct, never by the reference that the vectors come from."""

import struct
from collections.abc import Callable
from typing import Any

Vectors = Callable[..., Any]

MIRRORS = """\
    views:
      fraction:
        base: {offset: 0, type: int16, rounding: half_up, region: 0..99}
        x10: {offset: 1000, type: int16, factor: 10, rounding: half_up, saturates: true, region: 1000..1099}
        ieee: {offset: 8000, stride: 2, type: float32, word_order: {register: order, codes: {0: big, 1: little}},
               functions: [3, 16], align: 2, region: 8000..8199, preferred: true}
    """
ORDER = "- {at: 90, id: order, name: Order, enum: {0: high, 1: low}}\n"


def test_both_sides_of_each_limit_are_tried(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: level, name: Level, range: -5..100}")
    assert found.words("level").items() >= {"-5": [65531], "-4": [65532], "99": [99], "100": [100]}.items()
    assert found.reasons("level").items() >= {"-6": "range", "101": "range"}.items()


def test_a_union_of_ranges_has_the_gap_refused_and_the_special_value_allowed(vectors_of: Vectors) -> None:
    found = vectors_of('- {at: 1, id: level, name: Level, range: [10..20, 40..50], special: {0: "off"}}')
    assert found.words("level")["0"] == [0]
    assert {"9", "21", "39", "51"} <= set(found.reasons("level"))
    assert {one.get("special") for one in found.vectors("level", "decode") if one["words"] == [0]} == {"OFF"}


def test_the_ends_of_the_type_and_the_sign_are_decoded(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: level, name: Level}\n- {at: 2, id: count, name: Count, type: uint16}")
    ends = {(0,): "0", (1,): "1", (65535,): "-1", (32767,): "32767", (32768,): "-32768"}
    assert found.values("level").items() >= ends.items()
    assert found.values("count").items() >= {(65535,): "65535", (32768,): "32768"}.items()


def test_a_type_of_two_words_is_tried_with_words_that_differ(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: energy, name: Energy, type: uint32, word_order: little}")
    both = [(words, int(value)) for words, value in found.values("energy").items() if words[0] != words[1]]
    assert both
    assert all(value == words[1] * 65536 + words[0] for words, value in both)


def test_a_scale_over_the_whole_type_is_exact_at_both_ends_and_inside(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: pv, name: PV, type: uint16, scale: -1999.9..4553.6}")
    assert found.values("pv").items() >= {(0,): "-1999.9", (65535,): "4553.6", (1,): "-1999.8"}.items()
    assert found.words("pv")["0"] == [19999]
    assert found.reasons("pv").items() >= {"4553.7": "range", "-2000": "range"}.items()
    assert "resolution" in found.reasons("pv").values()


def test_values_between_two_steps_are_rounded_as_the_view_says(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    rounded = [one for one in found.vectors("sp", "encode") if one.get("rounded")]
    halves = [one for one in rounded if one["value"].endswith(".5")]
    assert {one["value"].startswith("-") for one in halves} == {True, False}
    for one in halves:
        signed = struct.unpack(">h", struct.pack(">H", *one["words"]))[0]
        assert signed == float(one["value"]) + 0.5  # half up: towards plus infinity, below zero too


def test_a_view_that_clips_reports_its_ends_and_refuses_to_send_them(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    clipped = {(32767,): "saturated", (32768,): "saturated", (32766,): "3276.6"}
    assert found.values("sp", view="x10").items() >= clipped.items()
    assert found.words("sp", view="x10")["3276.6"] == [32766]
    assert found.reasons("sp", view="x10")["3276.7"] == "type"


def test_a_device_rounds_and_clips_what_it_sends(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    sent = {
        one["view"]["name"]: {send["stored"]: send["words"] for send in one["sends"]}
        for one in found.document["transmissions"]
    }
    assert sent["base"].items() >= {"120.5": [121], "120.49": [120], "-0.5": [0]}.items()
    assert sent["x10"].items() >= {"3276.7": [32767], "3376.7": [32767], "-3376.8": [32768]}.items()


def test_an_ieee_view_is_tried_in_each_word_order(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    assert found.values("sp", view="ieee", order="0")[0x437A, 0x6666] == "250.4"
    assert found.values("sp", view="ieee", order="1")[0x6666, 0x437A] == "250.4"


def test_an_order_that_the_manual_does_not_list_makes_words_undecodable(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    assert set(found.values("sp", view="ieee", order="2").values()) == {"not_decodable"}
    assert set(found.reasons("sp", view="ieee", order="2").values()) == {"condition"}


def test_ieee_words_are_those_of_the_machine_and_values_the_shortest_that_read_back(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    finite = {words: value for words, value in found.values("sp", view="ieee", order="0").items() if value[0] != "n"}
    assert {"0", "0.1", "0.123456724", "16777216"} <= set(finite.values())
    for words, value in finite.items():
        assert struct.pack(">2H", *words) == struct.pack(">f", float(value))
    assert "not_decodable" in found.values("sp", view="ieee", order="0").values()


def test_what_a_float32_cannot_tell_apart_is_refused(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, views: fraction}\n" + ORDER, tables=MIRRORS)
    reasons = found.reasons("sp", view="ieee", order="0")
    assert reasons["16777217"] == "resolution"
    assert reasons["1" + 39 * "0"] == "type"


def test_faults_are_decoded_as_faults_and_refused_as_values(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: pv, name: PV, sentinels: {-32768: low, 32767: high}}")
    faults = {(32768,): "LOW", (32767,): "HIGH", (32769,): "-32767", (32766,): "32766"}
    assert found.values("pv").items() >= faults.items()
    assert found.reasons("pv")["32767"] == "sentinel"


def test_both_sides_of_a_special_value_are_tried(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: level, name: Level, decimals: 1, range: 0..50, special: {99.9: disabled}}")
    named = {tuple(one["words"]): one.get("special") for one in found.vectors("level", "decode")}
    assert (named[998,], named[999,], named[1000,]) == (None, "DISABLED", None)
    assert found.words("level")["99.9"] == [999]
    assert found.reasons("level").items() >= {"99.8": "range", "100": "range"}.items()


def test_every_pattern_that_is_no_number_is_a_fault(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: pv, name: PV, type: float32, sentinels: {nan: none}}")
    faults = {words for words, value in found.values("pv").items() if value == "NONE"}
    assert faults >= {(0x7FC0, 0), (0xFF80, 1)}


def test_a_code_that_stands_for_another_number_goes_both_ways(vectors_of: Vectors) -> None:
    lines = "- {at: 1, id: cycle, name: Cycle, range: 1..60, special: {0: {label: fast, means: 0.2}}}"
    found = vectors_of(lines)
    assert found.values("cycle")[0,] == "0.2"
    assert found.words("cycle")["0.2"] == [0]


def test_a_read_only_register_has_nothing_to_encode(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: pv, name: PV, access: r}")
    assert not found.words("pv")
    assert set(found.reasons("pv").values()) == {"read_only"}


def test_texts_and_versions_have_vectors_too(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: serial, name: Serial, type: string, length: 2, byte_order: little}
    - {at: 9, id: version, name: Version, type: uint16, version: nn.nn.nn}
    """
    found = vectors_of(lines)
    assert found.words("serial")["ABCD"] == [0x4241, 0x4443]
    assert found.values("version")[1,] == "00.00.01"
    assert found.values("version")[65535,] == "06.55.35"
