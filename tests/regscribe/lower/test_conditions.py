from collections.abc import Callable
from fractions import Fraction

from regscribe.model import Condition, Register
from regscribe.model import Is as Asked

Registers = Callable[..., dict[str, Register]]

TYPES = "- {at: 0, name: Input Type, enum: {0: J type, 1: K type, 5: {label: linear, id: LINEAR_INPUT}}}\n"
DIGITS = "- {at: 1, name: Digits, range: 0..3}\n"


def one(number: int) -> tuple[Fraction, Fraction]:
    return Fraction(number), Fraction(number)


def when(registers: Registers, condition: str, **more: str) -> Condition:
    lines = f"{TYPES}{DIGITS}- {{at: 2, name: Limit, writable: {{when: {condition}, reason: it is so}}}}"
    writable = registers(lines, **more)["limit"].writable
    assert writable is not None
    return writable.when


def test_a_number_is_one_code(registers: Registers) -> None:
    assert when(registers, "{digits: 2}") == Condition((Asked("digits", codes=(one(2),)),))


def test_a_list_mixes_numbers_ranges_and_member_ids(registers: Registers) -> None:
    codes = (one(0), (Fraction(1), Fraction(3)), one(5))
    assert when(registers, "{input_type: [0, 1..3, linear_input]}") == Condition((Asked("input_type", codes=codes),))


def test_not_turns_a_matcher_round_and_twice_turns_it_back(registers: Registers) -> None:
    assert when(registers, "{digits: {not: 2}}").tests[0].negated is True
    assert when(registers, "{digits: {not: {not: 2}}}").tests[0].negated is False


def test_a_named_condition_keeps_its_name(registers: Registers) -> None:
    tables = "conditions:\n  linear: {input_type: linear_input}\n"
    expected = Condition((Asked("input_type", codes=(one(5),)),), name="linear")
    assert when(registers, "linear", tables=tables) == expected


def test_a_list_of_conditions_holds_all_their_tests_once(registers: Registers) -> None:
    tables = "conditions:\n  linear: {input_type: 5}\n"
    found = when(registers, "[linear, {digits: 1}, {input_type: 5}]", tables=tables)
    assert found == Condition((Asked("input_type", codes=(one(5),)), Asked("digits", codes=(one(1),))))


def test_codes_of_a_given_are_left_to_the_program(registers: Registers) -> None:
    tables = "givens:\n  linear_types: {type: codes, register: input_type, description: Linear., reason: Elsewhere.}\n"
    assert when(registers, "{input_type: {in: linear_types}}", tables=tables).tests == (
        Asked("input_type", given="linear_types"),
    )
    assert when(registers, "{input_type: {not_in: linear_types}}", tables=tables).tests[0].negated is True
    assert when(registers, "{input_type: {not: {not_in: linear_types}}}", tables=tables).tests[0].negated is False


def test_a_boolean_given_is_a_test_of_its_own(registers: Registers) -> None:
    tables = "givens:\n  cooled: {type: boolean, description: Cooled., reason: Elsewhere.}\n"
    assert when(registers, "{given: cooled}", tables=tables).tests == (Asked("", given="cooled"),)
    assert when(registers, "{given: {not: cooled}}", tables=tables).tests == (Asked("", given="cooled", negated=True),)


def test_a_field_of_a_register_is_asked_by_member_id(registers: Registers) -> None:
    lines = """
        - {at: 3, name: Mode, fields: {operation: {bits: 0..1, enum: {0: automatic, 2: by hand}}, hold: {bit: 7}}}
        - {at: 4, name: Output, writable: {when: {mode.operation: by_hand, mode.hold: 0}, reason: it is so}}
    """
    assert registers(lines)["output"].writable.when.tests == (
        Asked("mode", field="operation", bits=(0, 1), codes=(one(2),)),
        Asked("mode", field="hold", bits=(7, 7), codes=(one(0),)),
    )


def test_a_flag_is_asked_by_its_derived_id(registers: Registers) -> None:
    lines = """
        - {at: 3, name: Options, flags: {4: Option card}}
        - {at: 4, name: Output, writable: {when: {options.option_card: 1}, reason: it is so}}
    """
    asked = Asked("options", field="option_card", bits=(4, 4), codes=(one(1),))
    assert registers(lines)["output"].writable.when.tests == (asked,)


def test_a_member_that_only_another_model_has_can_be_asked_for(registers: Registers) -> None:
    lines = """
        - {at: 0, name: Action, enum: {1: heat, 2: {label: cool, models: [B-2]}}}
        - {at: 1, name: Output, writable: {when: {action: cool}, reason: it is so}}
    """
    assert registers(lines)["output"].writable.when.tests == (Asked("action", codes=(one(2),)),)


def test_a_special_value_can_be_asked_for_by_its_id(registers: Registers) -> None:
    lines = """
        - {at: 0, name: Delay, range: 4..9600, special: {3: "off"}}
        - {at: 1, name: Output, writable: {when: {delay: {not: "off"}}, reason: it is so}}
    """
    assert registers(lines)["output"].writable.when.tests == (Asked("delay", codes=(one(3),), negated=True),)
