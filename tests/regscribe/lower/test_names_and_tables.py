"""Names of array elements, columns of enums, unused addresses, functions alike, and latencies in characters."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe.model import Array, Faults, Latency, Register, RegisterMap, Space

Lowered = Callable[[str], RegisterMap]
Registers = Callable[..., dict[str, Register]]
Tried = Callable[[str], tuple[RegisterMap | None, list[object]]]

GROUP = "groups: [{id: g, name: G, source: '1', registers: [{at: 0, name: First, access: r}]}]\n"


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ("name: Soak Level", ("Soak Level 3", "", "")),
        ('name: "Level {i}"', ("Level 3", "", "")),
        ('name: "Level {i} of {i}"', ("Level 3 of 3", "", "")),
        ('name: "Level {j}"', ("Level {j}", "", "")),
        ("name: Level, symbol: SL, printed: 5L", ("Level 3", "SL", "5L")),
        ('name: Level, symbol: "S{i}", printed: "5{i}"', ("Level 3", "S3", "53")),
    ],
)
def test_an_element_has_its_index_in_the_name(registers: Registers, keys: str, expected: tuple[str, str, str]) -> None:
    array = f"- {{id: segments, name: Segment, repeat: 3..4, stride: 1, registers: [{{at: 0, id: level, {keys}}}]}}"
    found = registers(array)["segments[3].level"]
    assert (found.name, found.symbol, found.printed) == expected


@pytest.mark.parametrize(
    ("name", "expected"),
    [("Time", "Time 2.5"), ("{j} of program {i}", "5 of program 2"), ("Time {j}", "Time 5"), ("Time {i}", "Time 2")],
)
def test_an_element_of_an_inner_array_has_both_indexes(registers: Registers, name: str, expected: str) -> None:
    inner = f"{{id: steps, name: Step, repeat: 4..5, stride: 1, registers: [{{at: 0, id: time, name: '{name}'}}]}}"
    array = f"- {{id: programs, name: Program, repeat: 1..2, stride: 10, registers: [{inner}]}}"
    assert registers(array)["programs[2].steps[5].time"].name == expected


def test_outside_of_arrays_a_name_stays_as_it_is(registers: Registers) -> None:
    found = registers('- {at: 0, name: "Level {i}", symbol: "S{i}"}')["level"]
    assert (found.name, found.symbol) == ("Level {i}", "S{i}")


def test_the_mark_is_no_part_of_an_id(registers: Registers) -> None:
    array = '- {id: s, name: S, repeat: 1..2, stride: 1, registers: [{at: 0, name: "Ramp {i} Time"}]}'
    assert list(registers(array)) == ["s[1].ramp_time", "s[2].ramp_time"]


def test_folded_members_have_names_without_an_index(lowered: Lowered) -> None:
    member = '{at: 0, name: Level, symbol: "S{i}"}'
    array = f"{{id: s, name: S, repeat: 1..2, stride: 1, registers: [{member}]}}"
    model = lowered(f"groups: [{{id: g, name: G, each: {{access: r}}, registers: [{array}]}}]\n").models[0]
    folded = model.members[0]
    assert isinstance(folded, Array)
    assert [(one.name, getattr(one, "symbol", "")) for one in folded.members] == [("Level", "S{i}")]


def test_cells_make_the_label_unless_there_is_one(registers: Registers) -> None:
    members = '{columns: [a, b], 0: {cells: [x, "OFF"]}, 1: {cells: [y, 5], label: y five}, 2: {invalid: no}}'
    enum = registers(f"- {{at: 0, name: First, enum: {members}}}")["first"].enum
    assert enum is not None
    assert enum.columns == ("a", "b")
    assert [(one.label, one.id, one.cells) for one in enum.members] == [
        ("x, OFF", "X_OFF", ("x", "OFF")),
        ("y five", "Y_FIVE", ("y", "5")),
    ]
    assert enum.invalid == ((2, "no"),)


def test_conditions_name_members_that_have_cells(registers: Registers) -> None:
    enum = 'enum: {columns: [a, b], 0: {cells: [x, "OFF"]}, 1: {cells: [x, "ON"]}}'
    lines = (
        f"- {{at: 0, name: First, {enum}}}\n- {{at: 1, name: Second, writable: {{when: {{first: x_on}}, reason: r}}}}"
    )
    writable = registers(lines)["second"].writable
    assert writable is not None
    assert writable.when.tests[0].codes[0][0] == 1


def test_unused_addresses_are_those_of_each_model(lowered: Lowered) -> None:
    stretches = "unused: [{at: 16..28}, {at: 5, space: coil, models: [A1]}, {at: 7, space: input, except: [A1]}]\n"
    found = lowered(GROUP + stretches)
    assert found.model("A1").unused == ((Space.HOLDING, 16, 28), (Space.COIL, 5, 5))
    assert found.model("B-2").unused == ((Space.HOLDING, 16, 28), (Space.INPUT, 7, 7))


@pytest.mark.parametrize(
    ("faults", "code"),
    [("", Faults().unused_write), ("address: 4", 4), ("address: silence", 0), ("address: 4, unused_write: 7", 7)],
)
def test_the_answer_to_writing_an_unused_address_is_that_of_any_bad_one(
    lowered: Lowered, faults: str, code: int
) -> None:
    assert lowered(f"protocol: {{faults: {{{faults}}}}}\n{GROUP}").faults.unused_write == code


def test_functions_alike_come_in_groups(lowered: Lowered) -> None:
    assert lowered(f"protocol: {{functions: [1, 2, 3, 4], alike: [[1, 2], [3, 4]]}}\n{GROUP}").alike == (
        (1, 2),
        (3, 4),
    )


def test_a_latency_may_have_characters_and_a_note(lowered: Lowered) -> None:
    found = lowered(f"protocol: {{latency: {{3: {{fixed: 5..6, characters: 3.5, note: so}}}}}}\n{GROUP}")
    assert found.protocol.latencies == (Latency(3, 5, 6, characters=Fraction(7, 2)),)
    assert found.protocol_notes.latencies == ((3, "so"),)
