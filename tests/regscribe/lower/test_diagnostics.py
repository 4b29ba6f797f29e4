"""What a diagnostic of the phase says, and that none is lost or said twice."""

from collections.abc import Callable

import pytest

from regscribe.model import Diagnostic, RegisterMap

Tried = Callable[[str], tuple[RegisterMap | None, list[Diagnostic]]]

LINES = """
        groups:
          - id: main
            name: Main
            each: {access: r, type: int16}
            registers:
"""


def test_all_mistakes_are_found_in_one_run_in_the_order_of_the_file(tried: Tried) -> None:
    found, mistakes = tried(
        """
        conditions:
          unused: {nothing: 1}
    """
        + LINES
        + """
              - {at: 0, name: First, enum: actoin, unit: parsec}
              - {at: 1, name: Second, range: 9..1, apply: sav}
              - {at: 2, name: Third, except: [A1, B-2]}
    """
    )
    assert found is None
    assert [each.rule for each in mistakes] == ["RS0301", "RS0304", "RS0311", "RS0315", "RS0313", "RS0321"]


def test_a_mistake_in_a_thing_that_many_use_is_told_once(tried: Tried) -> None:
    _, mistakes = tried(
        "        conditions:\n          wrong: {nothing: 1}\n"
        + LINES
        + """
              - id: parts
                name: Part
                repeat: 1..9
                stride: 1
                registers: [{at: 0, name: Level, range: [{when: wrong, is: 0..1}]}]
    """
    )
    assert [(each.rule, each.message) for each in mistakes] == [("RS0301", "there is no register `nothing`")]


def test_an_unknown_name_gets_the_nearest_and_those_that_exist(tried: Tried) -> None:
    _, mistakes = tried(LINES + "              - {at: 0, name: Level, range: {from: levle, to: 5}}\n")
    assert mistakes[0].help == "did you mean `level`? there are: level"


def test_a_register_of_another_model_is_told_with_where_it_is_and_what_needs_it(tried: Tried) -> None:
    _, mistakes = tried(
        LINES
        + """
              - {at: 0, name: Limit, models: [B-2]}
              - {at: 1, name: Level, range: {from: 0, to: limit}}
    """
    )
    assert [each.message for each in mistakes] == ["`limit` is not on A1, where `level` needs it, only on B-2"]
    assert [(each.message, str(each.span)) for each in mistakes[0].related] == [
        ("needed by `level`", "maps/example/controller.yaml:13:23")
    ]


def test_a_named_thing_that_only_one_model_can_use_is_no_mistake_while_none_uses_it(tried: Tried) -> None:
    _, mistakes = tried(
        "        conditions:\n          limited: {limit: 1}\n"
        + LINES
        + "              - {at: 0, name: Limit, models: [B-2]}\n"
    )
    assert mistakes == []


def test_a_text_of_the_map_cannot_break_the_line_of_a_message(tried: Tried) -> None:
    _, mistakes = tried(LINES + '              - {at: 0, name: Level, unit: "one\\ntwo"}\n')
    assert mistakes[0].message == "there is no unit `one two`"


@pytest.mark.parametrize(
    ("register", "value"),
    [
        ("type: int16", "70000"),
        ("type: int16, multiply: 0", "1"),
        ("type: int16, decimals: 1", "1.25"),
        ("type: uint32, word_order: {register: order, codes: {0: big, 1: little}}", "70000"),
        ("type: string, length: 1", "longer"),
    ],
)
def test_a_step_whose_words_are_not_certain_is_refused(tried: Tried, register: str, value: str) -> None:
    _, mistakes = tried(
        LINES
        + f"""
              - {{at: 0, name: Order, range: 0..1}}
              - {{at: 1, name: Level, {register}}}
        commands: {{go: {{name: Go, steps: [{{register: level, value: {value}}}]}}}}
    """
    )
    assert [each.rule for each in mistakes] == ["RS0326"]
    assert "`level`" in mistakes[0].message


@pytest.mark.parametrize("key", ["multiply: ct", "when: {ct: 1}"])
def test_a_given_named_like_a_register_is_told_with_the_way_to_write_it(tried: Tried, key: str) -> None:
    givens = "        givens:\n          ct: {type: number, description: ratio, reason: it is a setting}\n"
    _, mistakes = tried(f"{givens}{LINES}              - {{at: 0, name: Load, {key}}}\n")
    assert [(each.rule, each.message) for each in mistakes] == [("RS0301", "there is no register `ct`, but a given")]
    assert "`{given: ct}`" in mistakes[0].help
