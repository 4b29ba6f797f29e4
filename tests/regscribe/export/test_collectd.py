"""The collectd export polls each number with the type, scale and order of one state of the device, or says why not."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest

from regscribe.export.collectd import TARGET, collectd_text
from regscribe.export.device import Device, Place, Request, device_of
from regscribe.losses import Exported, Grade
from regscribe.model import (
    Access,
    Case,
    Condition,
    Conversion,
    Decimals,
    Kind,
    Layout,
    Order,
    Power,
    Product,
    Ref,
    Register,
    RegisterMap,
    Sentinel,
    Space,
    View,
    WireType,
    always,
    order_from,
)
from regscribe.model import Is as Ask
from regscribe.plugins import OptionError
from regscribe.reference import Surroundings

Only = Callable[[Register], RegisterMap]
Export = Callable[..., Exported]
Small = Callable[..., str]
PLACE = Place(unit=7, host="10.0.0.7", port=1502)
NOTHING = Surroundings()


def register(wire: WireType = WireType.INT16, kind: Kind = Kind.NUMBER, **more: object) -> Register:
    view = View("base", wire, offset=9, words=wire.words)
    settings = {"access": Access.READ, "views": (view,), **more}
    return Register(at=0, id="level", path="level", name="Level", kind=kind, **settings)  # type: ignore[arg-type]  # keywords


def device(register_map: RegisterMap, known: Surroundings = NOTHING, place: Place = PLACE) -> Device:
    (model,) = register_map.models
    asked = {"registers": model.registers, "named": frozenset(), "name": "oven", "unit": 7, "every": 10, "place": place}
    asked |= {"layout": Layout({}, {})}
    return device_of(TARGET, Request(register_map=register_map, model=model, known=known, **asked))  # type: ignore[arg-type]  # keywords


def text(register_map: RegisterMap, known: Surroundings = NOTHING, place: Place = PLACE) -> str:
    return collectd_text(device(register_map, known, place))


def block(register_map: RegisterMap, known: Surroundings = NOTHING) -> list[str]:
    lines = [line.strip() for line in text(register_map, known).splitlines()]
    return lines[lines.index('<Data "oven.level">') : lines.index("</Data>")]


def test_a_number_is_read_at_its_address_with_its_type(only: Only) -> None:
    lines = block(only(register()))
    assert {"RegisterBase 9", "RegisterType Int16", "RegisterCmd ReadHolding", 'Instance "level"'} <= set(lines)
    assert not any(line.startswith(("Scale", "Shift")) for line in lines)


def test_the_device_is_named_once_with_all_that_is_collected(only: Only) -> None:
    lines = [line.strip() for line in text(only(register())).splitlines()]
    assert lines[lines.index('<Host "oven">') :] == [
        '<Host "oven">',
        'Address "10.0.0.7"',
        'Port "1502"',
        "Interval 10",
        "<Slave 7>",
        'Collect "oven.level"',
        "</Slave>",
        "</Host>",
        "</Plugin>",
    ]


def test_a_serial_device_has_a_speed(only: Only) -> None:
    found = text(only(register()), place=Place(unit=7, device='/dev/tty"USB', baud=19200))
    assert 'Device "/dev/tty\\"USB"' in found
    assert "Baudrate 19200" in found
    assert "Address" not in found


@pytest.mark.parametrize(
    ("multiply", "add", "scale", "shift"),
    [
        (Fraction(1, 10), Fraction(0), "Scale 0.1", None),
        (Fraction(1, 10), Fraction(-19999, 10), "Scale 0.1", "Shift -1999.9"),
        (Fraction(1, 3), Fraction(0), "Scale 0.33333333333333333", None),
        (Fraction(1, 10**7), Fraction(0), "Scale 0.0000001", None),
    ],
)
def test_scale_and_shift_are_decimals_without_exponent(
    only: Only, multiply: Fraction, add: Fraction, scale: str, shift: str | None
) -> None:
    lines = block(only(register(scale=always(Conversion(multiply=multiply, add=add)))))
    assert scale in lines
    assert [line for line in lines if line.startswith("Shift")] == ([shift] if shift else [])


def test_decimals_of_another_register_are_those_of_the_state(only: Only) -> None:
    shared = only(register(scale=always(Conversion(decimals=Decimals("dp")))))
    assert "Scale 0.01" in block(shared, Surroundings({"dp": Fraction(2)}))
    assert "left out: level - its scale depends on dp, which has no default" in text(shared)


def test_a_state_without_a_scale_is_left_out(only: Only) -> None:
    when = Condition((Ask("mode", codes=((Fraction(1), Fraction(1)),)),))
    shared = only(register(scale=(Case(when, Conversion()),)))
    assert "left out: level - no scale is stated for this state" in text(shared, Surroundings({"mode": Fraction(2)}))


def test_the_word_order_is_that_of_the_state(only: Only) -> None:
    ordering = order_from("order", ((0, Order.BIG), (1, Order.LITTLE)))
    view = View("ieee", WireType.FLOAT32, offset=4, words=2, order=ordering, space=Space.INPUT)
    shared = only(register(views=(view,)))
    assert "RegisterType Float" in block(shared, Surroundings({"order": Fraction(0)}))
    assert {"RegisterType FloatLE", "RegisterCmd ReadInput"} <= set(block(shared, Surroundings({"order": Fraction(1)})))
    assert "left out: level - its order depends on order" in text(shared)


def test_the_preferred_view_counts_with_its_factor(only: Only) -> None:
    base = View("base", WireType.INT16, offset=9)
    tenfold = View("x10", WireType.INT16, offset=1009, factor=Fraction(10), preferred=True)
    assert {"RegisterBase 1009", "Scale 0.1"} <= set(block(only(register(views=(base, tenfold)))))


def test_a_type_that_the_plugin_does_not_read_is_left_out_with_the_reason(only: Only) -> None:
    double = register(WireType.FLOAT64)
    assert "left out: level - the format does not read float64 in the holding space" in text(only(double))
    view = register(WireType.INT64).base._replace(order=Order.LITTLE)
    swapped = register(WireType.INT64, Kind.INTEGER, views=(view,))
    assert "not read int64 in the holding space with the least significant word first" in text(only(swapped))


def test_texts_are_no_numbers_and_faults_are_remarked(only: Only) -> None:
    left_out = "  # left out: level - it is a string, which the format does not have"
    assert left_out in text(only(register(WireType.STRING, Kind.STRING))).splitlines()
    faulty = register(sentinels=(Sentinel(Fraction(-32768), "LOW", "sensor\nlow"),))
    assert any(line.startswith("# no value") and "sensor low" in line for line in block(only(faulty)))


def test_a_scale_whose_numbers_stand_in_registers_is_worked_out_for_one_state(only: Only) -> None:
    scale = always(Conversion(multiply=Product((Power(Ref("sf")), Ref("ratio")))))
    lines = block(only(register(scale=scale)), Surroundings({"sf": Fraction(-2), "ratio": Fraction(40)}))
    assert "Scale 0.4" in lines


def test_a_view_whose_factor_nobody_knows_is_left_out(only: Only) -> None:
    view = View("base", WireType.INT16, offset=9, times=Power(Ref("places")))
    assert "its scale depends on places" in text(only(register(views=(view,))))
    assert "Scale 0.1" in block(only(register(views=(view,))), Surroundings({"places": Fraction(1)}))


def losses(found: Device) -> dict[str, tuple[Grade, str]]:
    collectd_text(found)
    return {loss.fact: (loss.grade, loss.done) for loss in found.losses}


def test_a_fault_word_that_is_taken_for_a_number_is_wrong(only: Only) -> None:
    faulty = register(sentinels=(Sentinel(Fraction(-32768), "LOW", "sensor low"),))
    assert losses(device(only(faulty)))["sentinel"] == (Grade.WRONG, "left out: fault words: -32768 = sensor low")


def test_a_scale_without_a_finite_decimal_is_told_to_be_rounded(only: Only) -> None:
    third = register(scale=always(Conversion(multiply=Fraction(1, 3))))
    assert losses(device(only(third)))["scale-rounded"][0] is Grade.COSMETIC
    quarter = register(scale=always(Conversion(multiply=Fraction(1, 4))))
    assert "scale-rounded" not in losses(device(only(quarter)))


def test_a_line_that_the_plugin_does_not_speak_is_told(only: Only) -> None:
    found = losses(device(only(register()), place=Place(unit=7, device="/dev/ttyUSB0", format="8E1")))
    assert found["serial-line"][0] is Grade.WRONG
    assert "8N1 only, and the line of the map is 8E1" in found["serial-line"][1]
    assert "serial-line" not in losses(device(only(register())))


def test_a_name_longer_than_collectd_keeps_is_left_out(only: Only) -> None:
    name = "l" * 123
    longest = replace(register(), id=name, path=name)  # oven. and 122 letters are 127
    assert f"left out: {name} - its name has more than 127 characters" in text(only(longest))
    assert f'<Data "oven.{name[1:]}">' in text(only(replace(longest, id=name[1:], path=name[1:])))


TWO_BLOCKS = """
blocks: {near: {base: {given: start}}, far: {base: {given: end}}}
givens:
  start: {type: number, description: where it begins, reason: a switch}
  end: {type: number, description: where the other begins, reason: a switch}
"""
IN_BLOCKS = """
  - {id: near, name: Near, source: "3", block: near, registers: [{at: 2, name: Here, access: r}]}
  - {id: far, name: Far, source: "3", block: far, registers: [{at: 2, name: There, access: r}]}
"""


def test_a_register_of_a_block_that_nobody_placed_is_told_as_left_out(export: Export, small: Small) -> None:
    text = small("at: 0, name: Level, access: r", top=TWO_BLOCKS, tail=IN_BLOCKS)
    made = export("collectd", text, at="h:502", base="near=40")
    assert [one.done for one in made.losses if (one.register, one.fact) == ("there", "register")] == [
        "left out: nobody stated where its block `far` begins: say it by --base far=ADDRESS"
    ]
    assert "RegisterBase 42" in str(made.texts[""])


def test_a_register_of_such_a_block_asked_for_by_name_is_there_but_has_no_place(export: Export, small: Small) -> None:
    text = small("at: 0, name: Level, access: r", top=TWO_BLOCKS, tail=IN_BLOCKS)
    with pytest.raises(OptionError, match=r"say it by --base far=ADDRESS"):
        export("collectd", text, at="h:502", base="near=40", register="there")
