"""Facts read in the manuals, each as a sentence."""

from fractions import Fraction

import pytest

from regscribe.model import SILENCE, Later, Open, Ref, RegisterMap
from regscribe.reference import Meaning, Surroundings, decode, limits

LINEAR = Fraction(14)
J_THERMOCOUPLE = Fraction(3)


def _athena_state(input_type: Fraction, decimals: int) -> Surroundings:
    return Surroundings(values={"input_type": input_type, "linear_decimal_position": Fraction(decimals)})


def _codes(register_map: RegisterMap, model: str, path: str) -> set[int]:
    enum = register_map.model(model).register(path).enum
    assert enum is not None
    return {member.code for member in enum.members}


def test_an_output_can_announce_alarms_on_the_compact_models_only(athena: RegisterMap) -> None:
    codes = {model.name: _codes(athena, model.name, "output_1_type") for model in athena.models}
    assert codes == {"1ZC": {1, 2, 4, 5}, "16C": {1, 2, 4, 5}, "18C": {1, 2, 4}, "25C": {1, 2, 4}}


def test_code_3_is_an_invalid_output_type_and_on_large_models_5_is_too(athena: RegisterMap) -> None:
    small, large = (athena.model(name).register("output_2_type").enum for name in ("16C", "25C"))
    assert small is not None
    assert large is not None
    assert [code for code, _ in small.invalid] == [3]
    assert [code for code, _ in large.invalid] == [3, 5]


@pytest.mark.parametrize(
    ("decimals", "low", "high"),
    [(0, "-1999", "9999"), (1, "-199.9", "999.9"), (2, "-19.99", "99.99"), (3, "-1.999", "9.999")],
)
def test_a_linear_input_narrows_ranges_by_its_decimal_position(
    athena: RegisterMap, decimals: int, low: str, high: str
) -> None:
    known = _athena_state(LINEAR, decimals)
    cases = athena.model("16C").register("remote_analog_setpoint_high").range
    first = cases[0].then
    assert limits(first, known) == ((Fraction(low), Fraction(high)),)


def test_the_rate_never_has_more_than_one_decimal(athena: RegisterMap) -> None:
    first = athena.model("16C").register("rate").range[0].then
    assert limits(first, _athena_state(LINEAR, 3))[1] == (Fraction("0.1"), Fraction(240))


def test_sensor_limits_are_left_open_for_temperature_and_are_the_scaling_limits_for_linear_inputs(
    athena: RegisterMap,
) -> None:
    linear, other = (case.then.intervals[0] for case in athena.model("1ZC").register("setpoint_low_limit").range)
    assert linear.low == Ref("linear_input_scaling_low_limit")
    assert linear.high == Ref("linear_input_scaling_high_limit")
    assert isinstance(other.low, Open)
    assert isinstance(other.high, Open)


def test_the_recipe_setpoint_stands_at_8012_and_8013_in_the_ieee_region(athena: RegisterMap) -> None:
    register = athena.model("18C").register("recipe_setpoint")
    view, at = register.preferred, register.at
    assert (view.name, view.address(at), view.last(at), view.functions) == ("ieee", 8012, 8013, (3, 16))


def test_the_process_value_reports_both_sensor_errors(athena: RegisterMap) -> None:
    value = athena.model("16C").register("process_value")
    readings = [decode(value, value.base, (word,), _athena_state(LINEAR, 0)) for word in (0x8000, 0x7FFF)]
    assert [reading.fault for reading in readings] == ["LOW_ERROR", "HIGH_ERROR"]


def test_a_clipped_10x_reading_is_no_number(athena: RegisterMap) -> None:
    setpoint = athena.model("16C").register("alarm_1_process_setpoint")
    x10 = next(view for view in setpoint.views if view.name == "x10")
    assert decode(setpoint, x10, (0x7FFF,), _athena_state(LINEAR, 3)).meaning is Meaning.SATURATED


def test_the_span_of_100_mv_is_calibrated_on_the_1zc_only(athena: RegisterMap) -> None:
    defaults = {model.name: model.register("span_100_mv").default for model in athena.models}
    assert defaults == {name: Fraction(int(name == "1ZC")) for name in ("1ZC", "16C", "18C", "25C")}


def test_the_controller_is_silent_to_long_requests_and_unknown_functions(athena: RegisterMap) -> None:
    protocol = athena.protocol
    assert (protocol.read_words, protocol.write_words) == (24, 24)
    faults = athena.faults
    assert faults.quantity == faults.function == faults.misaligned_count == SILENCE
    assert (faults.later_read, faults.later_write) == (Later.GARBAGE, Later.STOP)


def test_the_unit_of_measure_is_written_before_the_input_type(athena: RegisterMap) -> None:
    order = {group.id: group.order for group in athena.model("16C").groups}
    unit, inputs = order["unit_of_measure"], order["input"]
    assert unit is not None
    assert inputs is not None
    assert unit < inputs


@pytest.mark.parametrize(
    ("state", "linear", "expected"),
    [
        ({"inpt": 0, "dp": 0}, set(), ("-1999.9", "4553.6")),
        ({"inpt": 0, "dp": 0}, {0}, ("-19999", "45536")),
        ({"inpt": 0, "dp": 1}, {0}, ("-1999.9", "4553.6")),
        ({"inpt": 0, "dp": 2}, {0}, ("-199.99", "455.36")),
        ({"inpt": 0, "dp": 3}, {0}, ("-19.999", "45.536")),
    ],
)
def test_the_ends_of_a_process_value_depend_on_input_and_decimal_point(
    fdc: RegisterMap, state: dict[str, int], linear: set[int], expected: tuple[str, str]
) -> None:
    value = fdc.model("C91").register("pv")
    known = Surroundings(
        values={path: Fraction(code) for path, code in state.items()},
        codes={"linear_inputs": frozenset(Fraction(code) for code in linear)},
    )
    ends = tuple(decode(value, value.base, (word,), known).value for word in (0, 65535))
    assert ends == tuple(Fraction(end) for end in expected)


def test_set_point_2_is_a_timer_only_on_c21_and_c91(fdc: RegisterMap) -> None:
    timer = {model.name for model in fdc.models if "out2" in _deciders(fdc, model.name, "sp2")}
    assert timer == {"C21", "C91"}
    assert all("alfn" in _deciders(fdc, model.name, "sp3") for model in fdc.models)


def _deciders(register_map: RegisterMap, model: str, path: str) -> set[str]:
    return {name for case in register_map.model(model).register(path).scale for name in case.when.registers}


def test_process_values_stand_at_64_and_128_and_the_program_code_at_71_and_140(fdc: RegisterMap) -> None:
    aliases = {register.id: register.aliases for register in fdc.model("BTC-4100").registers if register.aliases}
    assert aliases == {"pv": (128,), "sv": (129,), "mv1": (130,), "mv2": (131,), "prog": (140,)}


def test_outputs_can_be_written_in_manual_control_only(fdc: RegisterMap) -> None:
    writable = fdc.model("BTC-9100").register("mv1").writable
    assert writable is not None
    (test,) = writable.when.tests
    assert (test.subject, test.codes[0][0]) == ("mode.operation", Fraction(3))


def test_c21_and_c91_show_no_alarm_in_mode(fdc: RegisterMap) -> None:
    alarm = {model.name for model in fdc.models if any(bits.id == "alarm" for bits in model.register("mode").fields)}
    assert alarm == {"BTC-9100", "BTC-8100", "BTC-4100", "BTC-7100"}


def test_calibration_coefficients_need_the_unlocking_command(fdc: RegisterMap) -> None:
    locked = [register.id for register in fdc.model("C91").registers if register.unlock]
    assert locked == ["adlo", "adhi", "rtdl", "rtdh", "cjlo", "cjhi"]
    (step,) = next(command for command in fdc.model("C91").commands if command.id == "unlock_calibration").steps
    assert (step.address, step.words) == (72, (26669,))


def test_limits_of_numbers_are_exact(fdc: RegisterMap) -> None:
    (case,) = fdc.model("C21").register("cjct").range
    (interval,) = case.then.intervals
    assert (interval.low, interval.high) == (Fraction("-199.99"), Fraction("455.36"))
