"""How findings become diagnostics: waived, told once, with the models; and the details of single rules."""

from collections.abc import Callable

import pytest

from regscribe.model import Diagnostic

Diagnose = Callable[[str], list[Diagnostic]]
Small = Callable[..., str]

OUTSIDE = "at: 0, name: Setpoint, range: 0..400, default: 500"


def rules_of(found: list[Diagnostic]) -> list[str]:
    return [one.rule for one in found]


def test_a_sound_map_has_no_findings(diagnose: Diagnose, small: Small) -> None:
    assert diagnose(small("at: 0, name: Setpoint")) == []


def test_a_waiver_with_a_reason_removes_the_finding(diagnose: Diagnose, small: Small) -> None:
    waiver = "waivers:\n  - {rule: RS0423, at: setpoint, reason: the manual prints it so}\n"
    assert diagnose(small(OUTSIDE, tail=waiver)) == []


def test_a_waiver_at_another_register_removes_nothing(diagnose: Diagnose, small: Small) -> None:
    waiver = "waivers:\n  - {rule: RS0423, at: mode, reason: the manual prints it so}\n"
    assert set(rules_of(diagnose(small(OUTSIDE, tail=waiver)))) == {"RS0423", "RS0467"}


def test_a_waiver_without_a_reason_does_not_count(diagnose: Diagnose, small: Small) -> None:
    waiver = 'waivers:\n  - {rule: RS0423, at: setpoint, reason: " "}\n'
    assert set(rules_of(diagnose(small(OUTSIDE, tail=waiver)))) == {"RS0423", "RS0469"}


def test_a_finding_of_two_models_is_told_once_and_names_them(diagnose: Diagnose, small: Small) -> None:
    (found,) = diagnose(small(f"{OUTSIDE}, except: [C3]", "at: 1, name: Mode", models="A1: {}, B2: {}, C3: {}"))
    assert "A1, B2" in found.message
    assert "C3" not in found.message


def test_a_finding_of_every_model_says_so(diagnose: Diagnose, small: Small) -> None:
    (found,) = diagnose(small(OUTSIDE, models="A1: {}, B2: {}"))
    assert found.message.endswith("(on every model)")


def test_array_elements_of_one_place_are_one_finding(diagnose: Diagnose, small: Small) -> None:
    level = "{at: 10, name: Level, default: 9, range: 0..4}"
    array = f"id: segments, name: Segment, repeat: 1..8, stride: 3, registers: [{level}]"
    (found,) = diagnose(small(array))
    assert found.rule == "RS0423"
    assert "7 more" in found.message


def test_a_stride_shorter_than_an_element_overlaps(diagnose: Diagnose, small: Small) -> None:
    array = "id: segments, name: Segment, repeat: 1..2, stride: 1, registers: [{at: 10, name: Level, type: int32}]"
    assert rules_of(diagnose(small(array))) == ["RS0401"]


def test_an_alias_may_not_run_into_another_register(diagnose: Diagnose, small: Small) -> None:
    (found,) = diagnose(small("at: 0, name: Process Value, aliases: [128]", "at: 128, name: Setpoint"))
    assert found.rule == "RS0401"
    assert [str(one.span) for one in found.related] == ["map.yaml:12:23"]


def test_the_same_address_in_two_spaces_is_no_overlap(diagnose: Diagnose, small: Small) -> None:
    top = "protocol: {functions: [3, 4, 6, 16]}"
    text = small("at: 0, name: Setpoint", "at: 0, name: Process Value, space: input, access: r", top=top)
    assert diagnose(text) == []


def test_registers_of_different_models_may_share_an_address(diagnose: Diagnose, small: Small) -> None:
    text = small("at: 0, name: Relay, models: [A1]", "at: 0, name: Triac, models: [B2]", models="A1: {}, B2: {}")
    assert diagnose(text) == []


def test_a_view_of_one_word_where_two_must_be_asked_for_is_misaligned(diagnose: Diagnose, small: Small) -> None:
    views = "views: {pairs: {base: {type: int16, align: 2}}}"
    text = small("at: 2, name: Setpoint, views: pairs", top=views)
    assert rules_of(diagnose(text)) == ["RS0456"]


def test_a_default_is_judged_with_the_defaults_of_the_registers_that_decide(diagnose: Diagnose, small: Small) -> None:
    unit = "at: 0, name: Unit Code, default: {}, range: 1..2"
    bias = "at: 1, name: Bias, default: -800, range: [{{when: {{unit_code: 1}}, is: -1000..1000}}, {{is: -556..556}}]"
    assert diagnose(small(unit.format(1), bias.replace("{{", "{").replace("}}", "}"))) == []
    assert rules_of(diagnose(small(unit.format(2), bias.replace("{{", "{").replace("}}", "}")))) == ["RS0423"]


def test_a_default_is_not_judged_when_a_limit_is_not_known(diagnose: Diagnose, small: Small) -> None:
    text = small("at: 0, name: High Limit", "at: 1, name: Setpoint, default: 500, range: {from: 0, to: high_limit}")
    assert diagnose(text) == []


def test_a_code_of_one_model_makes_a_condition_possible(diagnose: Diagnose, small: Small) -> None:
    enum = "at: 0, name: Output Type, enum: {1: relay, 5: {label: alarm, models: [B2]}}"
    level = "at: 1, name: Level, writable: {when: {output_type: alarm}, reason: for alarms only}"
    assert diagnose(small(enum, level, models="A1: {}, B2: {}")) == []


def test_contradictory_tests_can_never_hold(diagnose: Diagnose, small: Small) -> None:
    top = "conditions:\n  low: {input_type: 0..3}\n  high: {input_type: 4..9}"
    level = "at: 1, name: Level, writable: {when: [low, high], reason: for both}"
    assert rules_of(diagnose(small("at: 0, name: Input Type, range: 0..9", level, top=top))) == ["RS0470"]


def test_a_case_hidden_by_two_earlier_ones_together_is_found(diagnose: Diagnose, small: Small) -> None:
    cases = "{when: {dp: 0}, decimals: 0}, {when: {dp: 1}, decimals: 1}, {decimals: 2}"
    found = diagnose(
        small(
            "at: 0, id: dp, name: Digits, range: 0..1", "at: 1, name: Level, scale: s", top=f"scales: {{s: [{cases}]}}"
        )
    )
    assert rules_of(found) == ["RS0471"]


def test_a_given_and_its_contrary_cover_everything(diagnose: Diagnose, small: Small) -> None:
    top = (
        "givens: {linear: {type: codes, register: input_type, description: linear inputs, reason: in another manual}}\n"
        "scales: {s: [{when: {input_type: {in: linear}}, decimals: 0},"
        " {when: {input_type: {not_in: linear}}, decimals: 1}]}"
    )
    assert diagnose(small("at: 0, name: Input Type", "at: 1, name: Level, scale: s", top=top)) == []


def test_a_long_chain_of_needs_is_no_circle(diagnose: Diagnose, small: Small) -> None:
    count = 1500
    rules = ", ".join(f"d{n}: {{register: r{n + 1}}}" for n in range(count))
    registers = [f"at: {n}, id: r{n}, name: R {n}, kind: integer, decimals: d{n}" for n in range(count)]
    text = small(*registers, f"at: {count}, id: r{count}, name: Last, range: 0..3", top=f"decimals: {{{rules}}}")
    assert "RS0462" not in rules_of(diagnose(text))


@pytest.mark.parametrize(("latest", "expected"), [("14.12", []), ("11.00", ["RS0449"])])
def test_a_worked_time_counts_the_characters_of_a_latency(
    diagnose: Diagnose, small: Small, latest: str, expected: list[str]
) -> None:
    top = "protocol: {serial: {gap_characters: 3.5}, latency: {3: {fixed: 5..6, characters: 4.3}}}"
    times = f"gap: 3.65, earliest: 13.12, latest: {latest}"
    example = "{source: '1', timing: {baud: 9600, format: 8N1, function: 3, words: 2}, " + times + "}"
    assert rules_of(diagnose(small("at: 0, name: Setpoint", top=top, tail=f"examples: [{example}]\n"))) == expected


@pytest.mark.parametrize(
    ("keys", "rule", "message"),
    [
        ("enum: {1: one}, delivered: 2", "RS0443", "delivered value 2"),
        ("range: 0..9, delivered: 10", "RS0423", "delivered value 10"),
        ("delivered: 65536", "RS0420", "delivered value 65536"),
        ("delivered: 1.5", "RS0432", "1.5"),
        ("enum: {1: one}, delivered: two", "RS0322", "two"),
    ],
)
def test_what_is_delivered_is_judged_as_the_default_is(
    diagnose: Diagnose, small: Small, keys: str, rule: str, message: str
) -> None:
    (found,) = diagnose(small(f"at: 0, name: Value, {keys}"))
    assert (found.rule, message in found.message) == (rule, True)


FAULTY = "at: 0, name: Mode, type: uint16, sentinels: {65535: none}"
VALUE = "at: 1, name: Value, scale: by_mode"


@pytest.mark.parametrize(
    ("cases", "said"),
    [
        ("[{when: {mode: 0..65534}, decimals: 1}]", []),
        ("[{when: {mode: 0..65533}, decimals: 1}]", ["RS0472"]),
        ("[{when: {mode: 65535}, decimals: 1}, {decimals: 0}]", ["RS0470"]),
    ],
)
def test_a_fault_is_no_state_that_a_condition_could_ask_for(
    diagnose: Diagnose, small: Small, cases: str, said: list[str]
) -> None:
    assert rules_of(diagnose(small(FAULTY, VALUE, top=f"scales: {{by_mode: {cases}}}"))) == said


@pytest.mark.parametrize("scale", ["multiply: 1.0e-400", "multiply: 1.0e+400", "type: float64, multiply: 1.0e-330"])
def test_a_scale_that_no_float_of_a_program_follows_is_an_error(diagnose: Diagnose, small: Small, scale: str) -> None:
    assert "RS0604" in rules_of(diagnose(small(f"at: 0, name: Level, {scale}")))


@pytest.mark.parametrize(
    ("keys", "rule", "help_text"),
    [
        ("type: int16, sentinels: {0x8000: none}", "RS0422", "write -32768 for 32768: the same bits as int16"),
        ("type: int16, special: {0xFFFF: none}", "RS0421", "write -1 for 65535: the same bits as int16"),
        ("type: int32, default: 0xFFFFFFFF", "RS0420", "write -1 for 4294967295: the same bits as int32"),
        (
            "type: int16, enum: {0x8000: off, 0xFFFF: on}",
            "RS0440",
            "write -32768 for 32768, -1 for 65535: the same bits as int16",
        ),
        ("type: int16, sentinels: {65536: none}", "RS0422", "correct the sentinel or the type"),
        ("type: uint16, sentinels: {65536: none}", "RS0422", "correct the sentinel or the type"),
        ("special: {9: none}, sentinels: {9: none}", "RS0439", "remove one of them: `sentinels` if it says that"),
        ("access: r, special: {32767: none}", "RS0670", "`sentinels` if it says that there is no value"),
        ("access: r, type: uint16, special: {65535: none}", "RS0670", "`sentinels` if it says that"),
        ("danger: all is lost", "RS0671", "give it `stays: operation` if it makes the device act"),
    ],
)
def test_a_mistake_of_a_beginner_is_told_what_to_write_instead(
    diagnose: Diagnose, small: Small, keys: str, rule: str, help_text: str
) -> None:
    (found,) = diagnose(small(f"at: 0, name: Setpoint, {keys}"))

    assert (found.rule, found.span.line, found.span.column) == (rule, 12, 23)
    assert found.help.startswith(help_text)


@pytest.mark.parametrize(
    "keys",
    [
        "access: r, special: {32766: none}",
        "access: r, type: uint16, special: {0: none}",
        "special: {32767: none}",
        "danger: all is lost, stays: calibration",
    ],
)
def test_what_looks_like_a_mistake_of_a_beginner_and_is_none_is_not_told(
    diagnose: Diagnose, small: Small, keys: str
) -> None:
    assert diagnose(small(f"at: 0, name: Setpoint, {keys}")) == []


def test_a_given_in_place_of_a_condition_is_told_how_it_is_asked(diagnose: Diagnose, small: Small) -> None:
    given = "givens: {battery: {type: boolean, description: it has one, reason: an option}}"
    (found,) = diagnose(small("at: 0, name: Current, when: battery", top=given))

    assert (found.rule, found.span.line, found.span.column) == ("RS0307", 12, 38)
    assert found.help == "write {given: battery}"
