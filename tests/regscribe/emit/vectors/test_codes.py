from collections.abc import Callable
from typing import Any

Vectors = Callable[..., Any]


def test_each_member_of_an_enum_is_tried_and_codes_that_are_none(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: kind, name: Kind, enum: {7: probe, 9: line, 12: {invalid: says the manual}}}")
    decoded = {one["words"][0]: one for one in found.vectors("kind", "decode")}
    assert (decoded[7]["member"], decoded[9]["member"]) == ("PROBE", "LINE")
    assert all(decoded[code]["unknown"] for code in (0, 12, 13))
    assert found.words("kind") == {"7": [7], "9": [9]}
    assert {"0", "12", "13", "-1"} <= {value for value, why in found.reasons("kind").items() if why == "member"}


def test_labels_of_members_stand_in_the_set(vectors_of: Vectors) -> None:
    members = vectors_of("- {at: 1, id: kind, name: Kind, enum: {1: on/off}}").set_of("kind")["members"]
    assert members == [{"code": 1, "id": "ON_OFF", "label": "on/off"}]


def test_each_bit_alone_is_tried_and_bits_without_a_name_are_refused(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: lamps, name: Lamps, type: uint16, flags: {0: red, 7: blue}}")
    decoded = {one["words"][0]: one["flags"] for one in found.vectors("lamps", "decode")}
    alone = {word: flags for word, flags in decoded.items() if word.bit_count() == 1}
    assert len(alone) == 16
    assert (alone[1], alone[128], alone[2]) == (["red"], ["blue"], [])
    assert found.words("lamps") == {"0": [0], "1": [1], "128": [128]}
    assert found.reasons("lamps")["2"] == "bits"


def test_a_word_of_bits_has_no_sign(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: lamps, name: Lamps, type: int16, flags: {0: red, 15: blue}}")
    assert found.values("lamps")[32768,] == "32768"
    assert found.words("lamps")["32768"] == [32768]


def test_codes_that_are_faults_are_decoded_so_and_refused(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: lamps, name: Lamps, type: uint16, flags: {0: red, 15: blue}, sentinels: {32769: none}}
    - {at: 2, id: parts, name: Parts, type: int16, fields: {all: {bits: 0..15, label: all}}, sentinels: {-1: none}}
    - {at: 3, id: version, name: Version, type: uint16, version: n.n, sentinels: {99: none}}
    """
    found = vectors_of(lines)
    assert (found.values("lamps")[32769,], found.reasons("lamps")["32769"]) == ("NONE", "sentinel")
    assert (found.values("parts")[65535,], found.reasons("parts")["65535"]) == ("NONE", "sentinel")
    assert (found.values("version")[99,], found.reasons("version")["9.9"]) == ("NONE", "sentinel")


def test_each_field_is_taken_from_its_bits(vectors_of: Vectors) -> None:
    lines = """
    - at: 1
      id: mode
      name: Mode
      type: uint16
      fields: {phase: {bits: 8..11, label: phase, enum: {0: idle, 2: heating}}, alarm: {bit: 0, label: alarm}}
    """
    fields = {one["words"][0]: one["fields"] for one in vectors_of(lines).vectors("mode", "decode")}
    assert fields[0x0200] == {"phase": "2", "alarm": "0"}
    assert fields[0x0100] == {"phase": "1", "alarm": "0"}
    assert fields[0x0001] == {"phase": "0", "alarm": "1"}


def test_registers_that_agree_share_one_set_and_those_that_differ_do_not(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: one, name: One, range: 0..9}
    - {at: 2, id: two, name: Two, range: 0..9, aliases: [77]}
    - {at: 3, id: three, name: Three, range: 0..9, variants: [{models: [B2], range: 0..8}]}
    """
    found = vectors_of(lines)
    places = found.set_of("one")["registers"]
    assert [place["path"] for place in places] == ["one", "two", "three"]
    assert places[1] == {"path": "two", "models": ["A1", "B2"], "addresses": {"base": 2}, "aliases": [77]}
    assert places[2]["models"] == ["A1"]
    assert found.set_of("three", "B2")["cases"][0]["domain"] == [{"low": "0", "high": "8", "step": "1"}]


def test_bytes_beyond_256_are_tried_by_counting_on_from_0(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: blob, name: Blob, type: bytes, length: 129}")
    first = found.vectors("blob", "encode")[0]["words"]
    assert (first[0], first[127], first[128]) == (0x0102, 0xFF00, 0x0102)
