"""The JSON of pymodbus' simulator; expected addresses follow from its layout of blocks, by hand."""

from collections.abc import Callable

import pytest

from regscribe import plugins
from regscribe.importers.pymodbus_simulator import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import

SHARED = """\
{"server_list": {}, "device_list": {"oven": {
  "setup": {"co size": 100, "di size": 100, "hr size": 100, "ir size": 100, "shared blocks": true},
  "invalid": [1],
  "write": [10, [20, 23]],
  "bits": [5, {"addr": 6, "value": 9}],
  "uint16": [10, {"addr": [11, 13], "value": 17}, {"addr": 14, "value": 3, "action": "increment"}],
  "int16": [],
  "uint32": [{"addr": [20, 23], "value": 617001}],
  "float32": [{"addr": [30, 31], "value": 404.17}, {"addr": [32, 32]}],
  "string": [{"addr": [40, 41], "value": "Brew"}],
  "int32": [50],
  "repeat": [{"addr": [10, 14], "to": [60, 64]}]
}}}
"""


def test_each_address_is_a_register_with_its_value(imported: Import) -> None:
    found = imported("pymodbus-simulator", SHARED)
    assert found.register("uint16_10").access == "rw"
    assert [found.register(f"uint16_11[{i}].value").address for i in (1, 2, 3)] == [11, 12, 13]
    assert found.register("uint16_11[1].value").default == 17
    assert found.register("uint32_20[2].value").address == 22
    assert found.register("float32_30").base.type == "float32"
    assert found.register("string_40").default == "Brew"
    assert found.codes("uint16 14") == ["action-dropped"]


def test_what_no_simulator_reads_is_told(imported: Import) -> None:
    found = imported("pymodbus-simulator", SHARED)
    assert "`int32`" in found.draft.findings[0].message
    assert any("no whole number of float32" in reason for reason in found.left_out.values())
    assert any("copies" in reason for reason in found.left_out.values())


def test_without_shared_blocks_addresses_run_through_the_spaces(imported: Import) -> None:
    text = (
        '{"device_list": {"a": {"setup": {"co size": 2, "di size": 2, "ir size": 10, "hr size": 10, '
        '"shared blocks": false}, "write": [1, 14], "bits": [1, 3], "uint16": [5, 14], "repeat": []}}}'
    )
    found = imported("pymodbus-simulator", text)
    assert found.register("bits_1[1].value").base.space == "coil"
    assert found.register("bits_1[1].value").address == 16  # the second word of coils
    assert found.register("bits_3[16].value").address == 31
    assert (found.register("uint16_5").base.space, found.register("uint16_5").address) == ("input", 1)
    assert (found.register("uint16_14").base.space, found.register("uint16_14").address) == ("holding", 0)
    assert found.register("uint16_14").access == "rw"


def test_of_several_devices_one_must_be_said() -> None:
    with pytest.raises(OptionError, match="--device which device, of a, b"):
        plugins.read("pymodbus-simulator", b'{"device_list": {"a": {}, "b": {}}}', "x", {"device": ""})


@pytest.mark.parametrize(
    ("text", "said"), [("{}", "there is no `device_list`"), ("{", "no JSON"), ('{"a":}', "no JSON")]
)
def test_what_is_no_such_configuration_is_one_message(refusal: Callable[..., str], text: str, said: str) -> None:
    assert said in refusal("pymodbus-simulator", text)


def test_it_is_recognised() -> None:
    assert likeness(SHARED.encode(), "x.json") is Likeness.SURE
    assert likeness(b'{"device_list": {}}', "x.json") is Likeness.NO
