from collections.abc import Callable
from fractions import Fraction

from regscribe.model import (
    SILENCE,
    CommandStep,
    Erratum,
    ExceptionCode,
    Faults,
    FrameExample,
    GivenKind,
    Latency,
    Later,
    Manual,
    Notation,
    Outcome,
    RegisterMap,
    SerialDefaults,
    Space,
    TimingExample,
    ValueExample,
)

Lowered = Callable[[str], RegisterMap]

MAIN = """
        groups:
          - id: main
            name: Main
            each: {access: rw, type: int16}
            registers:
              - {at: 0, name: Kind, id: kind, enum: {0: J type, 1: linear}}
              - {at: 2, name: Level, decimals: 1, sentinels: {-32768: sensor low}}
              - {at: 4, name: Total, type: uint32, word_order: little}
              - {at: 6, name: Ratio, type: float32}
              - {at: 8, name: Word, type: uint16, flags: {0: alarm, 3: sensor fault}}
              - {at: 9, name: Relay, space: coil, type: bit}
              - {at: 20, name: Fan, models: [B-2]}
"""


def test_the_map_tells_its_models_in_their_order_and_their_classes(lowered: Lowered) -> None:
    found = lowered(MAIN)
    assert [(model.name, model.class_name) for model in found.models] == [("A1", "ExampleA1"), ("B-2", "ExampleB2")]
    assert (found.id, found.title, found.maker, found.manual) == (
        "example/controller",
        "Controller",
        "Example",
        Manual("Controller Manual", number="EX-1"),
    )
    assert found.source == "maps/example/controller.yaml"


def test_the_protocol_is_as_told_and_as_modbus_has_it_where_not(lowered: Lowered) -> None:
    told = lowered(
        """
        protocol:
          source: 7-1
          functions: [3, 6]
          broadcast: [6]
          unit_ids: 1..31
          limits: {read_words: 24}
          read_holes: true
          faults: {quantity: silence, value: 9, later_read: garbage, later_write: stop}
          exceptions: {9: {name: bad value, meaning: The value is out of range.}}
          latency: {3: {per_word: 5..100}, 6: {fixed: 25..180.5, per_word: 1..2}}
          serial: {modes: [rtu], baud: [2400, 9600], formats: [8N1], default: 9600 8N1, gap_characters: 4}
    """
        + MAIN
    )
    assert (told.protocol_notes.section, told.default_unit, told.protocol.absent) == ("7-1", None, 2)
    assert told.faults == Faults(quantity=SILENCE, value=9, later_read=Later.GARBAGE, later_write=Later.STOP)
    found = told.protocol
    assert (found.functions, found.broadcast, found.unit_ids) == ((3, 6), (6,), (1, 31))
    assert (found.read_words, found.write_words, found.read_holes) == (24, 123, True)
    assert found.exceptions == (ExceptionCode(9, "bad value", "The value is out of range."),)
    assert found.latencies == (
        Latency(3, minimum_per_word=Fraction(5), maximum_per_word=Fraction(100)),
        Latency(6, Fraction(25), Fraction(361, 2), Fraction(1), Fraction(2)),
    )
    assert found.serial == SerialDefaults(bauds=(2400, 9600), formats=("8N1",), baud=9600, format="8N1", gap=4)


def test_the_tables_about_the_manual_are_carried_over(lowered: Lowered) -> None:
    found = lowered(
        """
        notations: [{name: absolute, space: holding, offset: 40001}]
        givens: {linear: {type: codes, register: kind, description: Linear codes., reason: Another manual.}}
        units: {lamps: {description: How many.}}
        reserved: [{at: 77..79}, {at: 5, space: input}]
        identify: [{when: {kind: linear}, models: [B-2]}]
        errata: [{where: "1.2", printed: five, read: six, why: The table says so.}]
        waivers: [{rule: RS0423, at: level, reason: It is so.}]
        notes: [Nothing more.]
    """
        + MAIN
    )
    assert found.notations == (Notation("absolute", Space.HOLDING, 40001),)
    assert (found.givens[0].id, found.givens[0].kind, found.givens[0].register) == ("linear", GivenKind.CODES, "kind")
    assert found.unit_symbols == ("lamps",)
    assert found.unit_notes == (("lamps", "How many."),)
    assert found.reserved == ((Space.HOLDING, 77, 79), (Space.INPUT, 5, 5))
    assert found.identity[0].models == ("B-2",)
    assert found.identity[0].identity.when.tests[0].codes[0][0] == 1
    assert found.errata == (Erratum("1.2", "five", "six", "The table says so."),)
    assert (found.waivers[0].rule, found.waivers[0].at, found.notes) == ("RS0423", "level", ("Nothing more.",))


def test_the_steps_of_a_command_become_words(lowered: Lowered) -> None:
    found = lowered(
        MAIN
        + """
        commands:
          reset:
            name: Reset
            danger: All settings are lost.
            steps:
              - {at: 7000, words: [85, -1]}
              - {at: 7000, words: [85]}
              - {register: kind, value: linear}
              - {register: level, value: 12.5}
              - {register: total, value: 65538}
              - {register: ratio, value: 3.1415}
              - {register: relay, words: [1]}
              - {at: 120, words: [1], function: 16}
              - {wait: 2000}
          fan: {name: Fan, models: [B-2], steps: [{register: fan, words: [1]}]}
    """
    )
    reset = found.model("A1").commands[0]
    assert (reset.id, reset.name, reset.danger) == ("reset", "Reset", "All settings are lost.")
    assert reset.steps == (
        CommandStep(16, 7000, (85, 65535)),
        CommandStep(6, 7000, (85,)),
        CommandStep(6, 0, (1,)),
        CommandStep(6, 2, (125,)),
        CommandStep(16, 4, (2, 1)),
        CommandStep(16, 6, (0x4049, 0x0E56)),
        CommandStep(15, 9, (1,)),
        CommandStep(16, 120, (1,)),
        CommandStep(0, 0, (), 2000),
    )
    assert reset.step_registers == ("", "", "kind", "level", "total", "ratio", "relay", "", "")
    assert reset.steps[6].space is Space.COIL
    assert [command.id for command in found.model("A1").commands] == ["reset"]
    assert [command.id for command in found.model("B-2").commands] == ["reset", "fan"]


def test_the_value_of_a_step_is_rounded_as_its_view_rounds_whatever_the_range_depends_on(lowered: Lowered) -> None:
    found = lowered("""
        views:
          fraction:
            base: {type: int16, rounding: half_up}
            x10: {offset: 1000, type: int16, factor: 10, rounding: half_up}
        groups:
          - id: main
            name: Main
            each: {access: rw, views: fraction}
            registers:
              - {at: 1, name: Limit}
              - {at: 2, name: Level, kind: number, range: {from: 0, to: limit}}
        commands:
          go: {name: Go, steps: [{register: level, value: 12.5}, {register: level, value: 12.5, view: x10}]}
    """)
    assert found.models[0].commands[0].steps == (
        CommandStep(6, 2, (13,)),
        CommandStep(6, 1002, (125,)),
    )


def test_one_word_is_written_by_function_16_where_the_device_has_no_other(lowered: Lowered) -> None:
    command = "commands: {go: {name: Go, steps: [{at: 1, words: [1]}]}}\n"
    found = lowered(f"protocol: {{functions: [3, 16]}}\n{command}groups: [{{id: a, name: A, registers: []}}]\n")
    assert found.models[0].commands[0].steps == (CommandStep(16, 1, (1,)),)


def test_value_examples_resolve_names_and_signs(lowered: Lowered) -> None:
    found = lowered(
        MAIN
        + """
        examples:
          - source: "3.1"
            register: level
            with: {kind: linear, word.alarm: 1}
            stored: 120.5
            words: [-1]
            saturated: true
          - {source: "3.2", register: level, words: [125], value: 12.5, lossy: true}
          - {source: "3.3", register: level, words: [-32768], fault: sensor_low}
          - {source: "3.4", register: kind, words: [1], value: linear}
          - {source: "3.5", register: word, words: [9], value: [alarm, sensor_fault]}
          - {source: "3.6", register: fan, words: [7], value: 7}
    """
    ).examples
    shared = {"model": "A1", "view": "base"}
    assert found == (
        ValueExample(
            source="3.1",
            register="level",
            words=(65535,),
            state=(("kind", Fraction(1)), ("word.alarm", Fraction(1))),
            stored=Fraction("120.5"),
            outcome=Outcome.SATURATED,
            span=found[0].span,
            **shared,
        ),
        ValueExample(
            source="3.2",
            register="level",
            words=(125,),
            value=Fraction(25, 2),
            lossy=True,
            span=found[1].span,
            **shared,
        ),
        ValueExample(
            source="3.3",
            register="level",
            words=(32768,),
            value="SENSOR_LOW",
            outcome=Outcome.FAULT,
            span=found[2].span,
            **shared,
        ),
        ValueExample(source="3.4", register="kind", words=(1,), value=Fraction(1), span=found[3].span, **shared),
        ValueExample(
            source="3.5", register="word", words=(9,), flags=("alarm", "sensor_fault"), span=found[4].span, **shared
        ),
        ValueExample(
            source="3.6", register="fan", words=(7,), value=Fraction(7), model="B-2", view="base", span=found[5].span
        ),
    )


def test_an_example_may_name_the_codes_of_a_given(lowered: Lowered) -> None:
    found = lowered(
        """
        givens:
          linear_kinds: {type: codes, register: kind, description: Linear codes., reason: Another manual.}
          cooled: {type: boolean, description: Cooled., reason: Another manual.}
    """
        + MAIN
        + """
        examples:
          - {source: "3.1", register: level, with: {linear_kinds: linear}, words: [10], value: 1}
          - {source: "3.1", register: level, with: {linear_kinds: 7, cooled: 1}, words: [10], value: 1}
    """
    ).examples
    assert [example.state for example in found if isinstance(example, ValueExample)] == [
        (("linear_kinds", Fraction(1)),),
        (("linear_kinds", Fraction(7)), ("cooled", Fraction(1))),
    ]


def test_frames_and_times_are_carried_over(lowered: Lowered) -> None:
    found = lowered(
        MAIN
        + """
        examples:
          - {source: "2.3", frame: 9C 06 0002 00 7D, crc: false, address: 2, words: [125], writes: {level: 12.5}}
          - source: "2.4"
            timing: {baud: 9600, format: 8N1, function: 3, words: 2}
            gap: 4.17
            earliest: 14.17
            latest: 204
    """
    ).examples
    assert found[0] == FrameExample(
        source="2.3",
        model="A1",
        frame=bytes([0x9C, 6, 0, 2, 0, 0x7D]),
        crc=False,
        answer=False,
        unit=156,
        function=6,
        address=2,
        words=(125,),
        writes=(("level", Fraction(25, 2)),),
        span=found[0].span,
    )
    assert found[1] == TimingExample(
        source="2.4",
        baud=9600,
        format="8N1",
        function=3,
        words=2,
        gap=Fraction("4.17"),
        earliest=Fraction("14.17"),
        latest=Fraction(204),
        span=found[1].span,
    )
