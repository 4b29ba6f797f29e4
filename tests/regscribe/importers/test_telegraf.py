"""Telegraf's input plug-in modbus in its three styles; expected values follow from its documentation, by hand."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe import plugins
from regscribe.importers.telegraf import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import

METRIC = """\
[[inputs.modbus]]
  name = "meter"
  controller = "tcp://localhost:502"
  configuration_type = "metric"
  [[inputs.modbus.metric]]
    slave_id = 7
    byte_order = "CDAB"
    measurement = "power"
    fields = [
      { register = "holding", address = 10, name = "total", type = "FLOAT32", scale = 0.1 },
      { register = "input", address = 12, name = "plain", type = "INT16", scale = 0.0 },
      { address = 13, name = "alarm", type = "BIT", bit = 5 },
      { address = 13, name = "run", type = "BIT", bit = 0 },
      { register = "coil", address = 3, name = "valve" },
      { address = 14, name = "low", type = "UINT8L" },
      { address = 14, name = "high", type = "INT8H" },
      { address = 20, name = "odd", type = "FLOAT80" },
      { address = 30, name = "over", type = "UINT32" },
      { address = 31, name = "lap", type = "UINT16" },
    ]
    [inputs.modbus.metric.tags]
      unit = "kW"
      site = "north"
  [[inputs.modbus.metric]]
    slave_id = 7
    fields = [ { address = 40, name = "serial", type = "STRING", length = 2 } ]
  [inputs.modbus.workarounds]
    max_word_registers_per_request = 50
"""
OLD = """\
[[inputs.modbus]]
  name = "old"
  slave_id = 1
  discrete_inputs = [ { name = "start", address = [0] } ]
  holding_registers = [
    { name = "current", byte_order = "AB", data_type = "FIXED", scale = 0.01, address = [5] },
    { name = "energy", byte_order = "CDAB", data_type = "UFIXED", scale = 0.001, address = [6, 7] },
    { name = "float", byte_order = "ABCD", data_type = "FLOAT32-IEEE", scale = 1.0, address = [8, 9] },
    { name = "apart", byte_order = "ABCD", data_type = "UINT32", scale = 1.0, address = [10, 12] },
    { name = "short", byte_order = "ABCD", data_type = "UINT32", scale = 1.0, address = [14] },
  ]
[[inputs.modbus]]
  name = "asked"
  configuration_type = "request"
  [[inputs.modbus.request]]
    slave_id = 2
    register = "input"
    byte_order = "DCBA"
    fields = [
      { address = 1, name = "power", type = "INT32", scale = 10.0, measurement = "ac" },
      { address = 3, name = "gap", type = "INT16", omit = true },
    ]
"""


def test_the_style_metric(imported: Import) -> None:
    found = imported("telegraf", METRIC)
    assert found.value("total", 0, 0x4148) == Fraction("1.25")  # 12.5 x 0.1
    assert found.register("total").unit[0].then == "kW"
    assert found.value("plain", 0xFFFE) == -2  # a scale of 0 is none
    assert found.bits("word_holding_13") == {"alarm": (5, 5), "run": (0, 0)}
    assert found.register("valve").base.space == "coil"
    assert (found.value("low", 0xFE05), found.value("high", 0xFE05)) == (5, -2)
    assert found.value("serial", 0x4142, 0x4344) == "ABCD"
    assert found.map.protocol.read_words == 50
    assert found.map.default_unit == 7


def test_an_overlap_is_a_finding_with_both_places(imported: Import) -> None:
    found = imported("telegraf", METRIC)
    assert {*found.left_out} == {"odd", "lap"}
    (finding,) = found.draft.findings
    assert (finding.span.line, finding.related[0].span.line) == (19, 18)


def test_the_styles_register_and_request(imported: Import) -> None:
    found = imported("telegraf", OLD, device="old")
    assert found.value("current", 0xFFFF) == Fraction("-0.01")
    assert found.value("energy", 2, 1) == Fraction("65.538")
    assert found.value("float", 0x4148, 0) == Fraction("12.5")
    assert found.register("start").base.space == "discrete"
    assert "do not follow each other" in found.left_out["apart"]
    assert "has 2 words, and 1 addresses" in found.left_out["short"]
    asked = imported("telegraf", OLD, device="asked")
    assert asked.value("power", 0x0100, 0x0000) == 10  # DCBA: the low byte first
    assert {*asked.outcomes} == {"power"}


def test_numbers_never_go_through_a_float(imported: Import) -> None:
    text = METRIC.replace("scale = 0.1 ", "scale = 0.1000000000000000055 ")
    assert imported("telegraf", text).value("total", 0, 0x3F80) == Fraction("0.1000000000000000055")


def test_of_several_inputs_one_must_be_said() -> None:
    with pytest.raises(OptionError, match="say by --device which input, of old, asked"):
        plugins.read("telegraf", OLD.encode(), "x", {"device": "", "unit": ""})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[inputs.cpu]]\n", "there is no [[inputs.modbus]]"),
        ("[[inputs.modbus]]\nname = 'a'\n", "the input has no field"),
        ("[[inputs.modbus]\n", "1: no TOML"),
        ("a = " + "[" * 5000, "nested too deep"),
    ],
)
def test_what_is_no_such_configuration_is_one_message(refusal: Callable[..., str], text: str, said: str) -> None:
    assert said in refusal("telegraf", text)


def test_it_is_recognised() -> None:
    assert likeness(METRIC.encode(), "x.conf") is Likeness.SURE
    assert likeness(b"[[inputs.cpu]]\n", "x.conf") is Likeness.NO
