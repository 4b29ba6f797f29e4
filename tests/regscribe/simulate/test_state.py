"""One stored value, coherent through every view, alias and order; values of use in and out."""

from fractions import Fraction

import pytest

from regscribe.model import RegisterMap, Space, View, WireType
from regscribe.reference import AS_IS, RefusedError, transmit
from regscribe.simulate import SimulatedDevice, SimulatorError
from regscribe.simulate.device import codec


@pytest.fixture
def device(controller: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(controller, "16C")


def test_a_default_shows_in_every_view(device: SimulatedDevice) -> None:
    assert device.peek("setpoint") == 77
    assert device.peek_words("setpoint") == (77,)
    assert device.peek_words("setpoint", "x10") == (770,)
    assert device.peek_words("setpoint", "ieee") == (0x0000, 0x429A)


def test_the_base_view_rounds_half_up_and_the_mirrors_keep_the_fraction(device: SimulatedDevice) -> None:
    device.poke("setpoint", "120.5")
    assert device.peek_words("setpoint") == (121,)
    assert device.peek_words("setpoint", "x10") == (1205,)
    device.poke("rate", "2.1")
    assert device.peek_words("rate") == (2,)


def test_the_x10_view_clips_where_it_saturates(device: SimulatedDevice) -> None:
    device.poke("input_type", 14)
    device.poke("decimal_position", 3)
    device.poke("setpoint", "7.895")
    assert device.state.stored("setpoint") == 7895
    assert device.peek_words("setpoint", "x10") == (32767,)
    assert device.peek("setpoint") == Fraction("7.895")


def test_decimals_count_only_under_their_condition(device: SimulatedDevice) -> None:
    device.poke("decimal_position", 2)
    device.poke("setpoint", 50)
    assert device.peek_words("setpoint") == (50,)
    device.poke("input_type", 14)
    assert device.peek("setpoint") == Fraction("0.5")


def test_a_step_keeps_whole_digits_of_what_is_poked(device: SimulatedDevice) -> None:
    device.poke("input_type", 14)
    device.poke("decimal_position", 1)
    device.poke("setpoint", "150.56")
    assert device.state.stored("setpoint") == 1506


def test_the_ordering_register_turns_the_words_round(device: SimulatedDevice) -> None:
    device.poke("setpoint", 250)
    assert device.peek_words("setpoint", "ieee") == (0x0000, 0x437A)
    assert device.state.words(Space.HOLDING, 8004, 2) == [0x0000, 0x437A]
    device.poke("ieee_ordering", 0)
    assert device.state.words(Space.HOLDING, 8004, 2) == [0x437A, 0x0000]


def test_a_sentinel_is_poked_and_peeked_by_its_id(device: SimulatedDevice) -> None:
    device.poke("process_value", "SENSOR_LOW")
    assert device.peek("process_value") == "sensor_low"
    assert device.peek_words("process_value") == (0x8000,)


def test_names_of_members_and_special_values_are_values(device: SimulatedDevice) -> None:
    device.poke("alarm_1_action", "normal")
    assert device.peek("alarm_1_action") == 2
    device.poke("rate", "never")
    assert device.peek("rate") == 9999


def test_a_special_value_is_the_number_that_it_stands_for(device: SimulatedDevice) -> None:
    device.poke("rate", "0.2")
    assert device.peek_words("rate") == (9998,)
    assert device.peek("rate") == Fraction("0.2")


def test_without_default_a_register_begins_with_what_it_accepts(device: SimulatedDevice) -> None:
    assert device.peek("alarm_2_action") == 1
    assert device.peek("rate") == 0


def test_what_tells_the_model_is_there_from_the_start(controller: RegisterMap) -> None:
    assert [SimulatedDevice(controller, name).peek("controller_type") for name in ("16C", "25C")] == [2, 3]


@pytest.mark.parametrize("path", ["nothing", "setpoint.nothing", "nothing.nothing", ""])
def test_an_unknown_path_is_named_in_the_error(device: SimulatedDevice, path: str) -> None:
    with pytest.raises(SimulatorError, match="16C has no register or field"):
        device.peek(path)


def test_a_poke_of_no_value_says_so(device: SimulatedDevice) -> None:
    with pytest.raises(SimulatorError, match="'warm' is no value of 'setpoint'"):
        device.poke("setpoint", "warm")


def test_an_unknown_view_is_an_error_with_the_known_ones(device: SimulatedDevice) -> None:
    with pytest.raises(SimulatorError, match="no view 'x100': it has base, x10, ieee"):
        device.peek_words("setpoint", "x100")


def test_an_unknown_model_is_an_error_with_the_known_ones(controller: RegisterMap) -> None:
    with pytest.raises(SimulatorError, match="no model '17C': it has 16C, 25C"):
        SimulatedDevice(controller, "17C")


@pytest.mark.parametrize("unit", [0, 248, -1])
def test_a_unit_that_the_device_cannot_have_is_refused(controller: RegisterMap, unit: int) -> None:
    with pytest.raises(SimulatorError, match=r"outside 1\.\.247"):
        SimulatedDevice(controller, "16C", unit=unit)


def test_an_affine_scale_follows_given_and_decimal_point(affine_controller: RegisterMap) -> None:
    device = SimulatedDevice(affine_controller, "C21", givens={"linear_inputs": {18}})
    assert device.peek_words("sp1") == (0x4F19,)
    device.poke("inpt", 18)
    device.poke("dp", 2)
    assert device.peek("sp1") == Fraction("2.5")
    device.poke("sp1", "-17.8")
    assert device.peek_words("sp1") == (round(Fraction("182.19") * 100),)


def test_a_missing_given_is_an_error_that_describes_it(affine_controller: RegisterMap) -> None:
    with pytest.raises(SimulatorError, match=r"C21 needs the given 'linear_inputs': codes of linear inputs"):
        SimulatedDevice(affine_controller, "C21")


@pytest.mark.parametrize("givens", [{"linear_inputs": True}, {"linear_inputs": {1}, "cooled": True}])
def test_a_given_of_the_wrong_kind_or_name_is_refused(affine_controller: RegisterMap, givens: dict[str, bool]) -> None:
    with pytest.raises(SimulatorError, match="given"):
        SimulatedDevice(affine_controller, "C21", givens=givens)


def test_an_alias_shows_the_same_value(affine_controller: RegisterMap) -> None:
    device = SimulatedDevice(affine_controller, "C21", givens={"linear_inputs": ()})
    device.poke("pv", "100.0")
    assert device.state.words(Space.HOLDING, 128, 1) == device.state.words(Space.HOLDING, 64, 1) == [20999]


def test_fields_are_peeked_and_poked_alone(affine_controller: RegisterMap) -> None:
    device = SimulatedDevice(affine_controller, "C21", givens={"linear_inputs": ()})
    device.poke("mode.alarm", 1)
    device.poke("mode.operation", "manual")
    assert device.peek_words("mode") == (0x0301,)
    assert device.peek("mode.operation") == 3


def test_a_version_is_text(affine_controller: RegisterMap) -> None:
    device = SimulatedDevice(affine_controller, "C21", givens={"linear_inputs": ()})
    assert device.peek("version") == "06.18"
    assert device.peek_words("version") == (618,)


def test_strings_and_wide_integers_keep_their_orders(bit_device: RegisterMap) -> None:
    device = SimulatedDevice(bit_device, "IO")
    device.poke("name", "M3x")
    assert device.peek_words("name") == (0x334D, 0x0078, 0)
    assert device.peek("name") == "M3x"
    device.poke("counter", 0x12345678)
    assert device.peek_words("counter") == (0x5678, 0x1234)
    device.poke("energy", -2)
    assert device.peek_words("energy") == (0xFFFF, 0xFFFF, 0xFFFF, 0xFFFE)


@pytest.mark.parametrize("words", [(0x7F80, 0), (0xFF80, 0), (0x7FC0, 1), (0x7F80, 1)])
def test_infinity_and_not_a_number_are_no_values(words: tuple[int, int]) -> None:
    view = View("v", WireType.FLOAT32, words=2)
    assert codec.decode(view, words, AS_IS) is None


@pytest.mark.parametrize(
    ("kind", "lowest", "highest"),
    [
        (WireType.UINT8, (0,), (0xFF,)),
        (WireType.INT16, (0x8000,), (0x7FFF,)),
        (WireType.UINT32, (0, 0), (0xFFFF, 0xFFFF)),
        (WireType.INT64, (0x8000, 0, 0, 0), (0x7FFF, 0xFFFF, 0xFFFF, 0xFFFF)),
        (WireType.FLOAT32, (0xFF7F, 0xFFFF), (0x7F7F, 0xFFFF)),
        (WireType.FLOAT64, (0xFFEF, 0xFFFF, 0xFFFF, 0xFFFF), (0x7FEF, 0xFFFF, 0xFFFF, 0xFFFF)),
    ],
)
def test_a_number_beyond_the_type_is_clipped(kind: WireType, lowest: tuple[int, ...], highest: tuple[int, ...]) -> None:
    view = View("v", kind, words=kind.words)
    assert codec.encode(view, Fraction(10) ** 400, AS_IS) == highest
    assert codec.encode(view, -(Fraction(10) ** 400), AS_IS) == lowest
    with pytest.raises(RefusedError):
        transmit(view, Fraction(10) ** 400)
