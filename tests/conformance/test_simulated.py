"""What a simulated device makes of numbers that no master could write."""

from fractions import Fraction

import pytest

from regscribe.model import NAN
from regscribe.simulate import SimulatorError
from regscribe.simulate.device.device import SimulatedDevice

from .suite import Json, build, whole_map

WRITE_7_TO_5 = bytes.fromhex("06 0005 0007")


def device_of(*registers: Json, **tables: Json) -> SimulatedDevice:
    return SimulatedDevice(build(whole_map({"registers": list(registers), **tables})).map, "A", unit=1)


def test_any_word_but_0_is_true_for_what_depends_on_it() -> None:
    only_if = {"writable": {"when": {"on": 1}, "reason": "only then"}}
    device = device_of({"at": 0, "name": "On", "kind": "boolean"}, {"at": 5, "name": "Level", **only_if})
    device.poke("on", 2)
    assert device.peek("on") == 1
    assert device.handle(WRITE_7_TO_5) == WRITE_7_TO_5
    device.poke("on", 0)
    assert device.handle(WRITE_7_TO_5) == bytes.fromhex("86 03")


def test_a_number_of_decimals_that_is_none_does_not_keep_the_device_busy() -> None:
    digits = {"digits": {"register": "places"}}
    places = {"at": 0, "name": "Places", "type": "uint32"}
    device = device_of(places, {"at": 5, "name": "Level", "decimals": "digits"}, decimals=digits)
    device.state.store("level", Fraction(7))
    device.poke("places", 2**32 - 1)
    assert device.peek("level") == Fraction(7, 10**9)


def test_what_is_no_number_is_refused_where_a_view_has_whole_numbers_only() -> None:
    views = {"two": {"real": {"type": "float32"}, "whole": {"type": "int16", "offset": 100}}}
    device = device_of(
        {"at": 0, "name": "Level", "views": "two"}, {"at": 4, "name": "Real", "type": "float32"}, views=views
    )
    with pytest.raises(SimulatorError, match="'level' cannot hold nan: view whole"):
        device.poke("level", NAN)
    device.poke("real", NAN)
    assert device.peek_words("real") == (0x7FC0, 0)
