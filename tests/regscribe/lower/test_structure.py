from collections.abc import Callable
from textwrap import dedent

from regscribe.model import Array, Interval, Range, Ref, Register, RegisterMap

Registers = Callable[..., dict[str, Register]]
Lowered = Callable[[str], RegisterMap]

NESTED = """
    - {at: 0, name: Limit, range: 0..999}
    - id: programs
      name: Program
      repeat: 1..2
      stride: 100
      source: 4.2
      registers:
        - {at: 200, name: Repeats, id: repeats, range: 0..99}
        - id: segments
          name: Segment
          repeat: 3..5
          stride: 4
          each: {unit: min}
          registers:
            - {at: 210, name: Ramp Time, range: 0..99, aliases: [900]}
            - {at: 211, name: Soak Level, range: {from: ramp_time, to: limit}, unit: "%", models: [A1]}
"""


def test_arrays_are_expanded_with_paths_and_addresses(registers: Registers) -> None:
    found = registers(NESTED)
    assert list(found)[:4] == [
        "limit",
        "programs[1].repeats",
        "programs[1].segments[3].ramp_time",
        "programs[1].segments[3].soak_level",
    ]
    assert len(found) == 1 + 2 * (1 + 3 * 2)
    level = found["programs[2].segments[5].soak_level"]
    assert level.address == 211 + 100 + 2 * 4
    assert (level.id, level.array, level.index, level.section) == ("soak_level", "programs.segments", (2, 5), "4.2")
    assert found["programs[2].segments[4].ramp_time"].aliases == (900 + 100 + 4,)


def test_a_name_means_a_sibling_in_the_same_element_first(registers: Registers) -> None:
    limits = registers(NESTED)["programs[2].segments[4].soak_level"].range[0].then
    assert limits == Range((Interval(Ref("programs[2].segments[4].ramp_time"), Ref("limit")),))


def test_the_stride_of_a_view_stretches_the_steps_of_an_array(registers: Registers) -> None:
    tables = "views:\n  both:\n    base: {type: int16}\n    ieee: {offset: 8000, stride: 2, type: float32}\n"
    lines = "- {id: ramps, name: Ramp, repeat: 1..3, stride: 2, registers: [{at: 10, name: Time, aliases: [70]}]}"
    found = registers(lines, tables=tables, each="{access: r, views: both}")["ramps[3].time"]
    assert [view.address(found.at) for view in found.views] == [14, 8028]
    assert found.aliases == (74,)


def test_members_keep_arrays_folded_with_the_first_element(lowered: Lowered) -> None:
    body = "groups:\n  - id: main\n    name: Main\n    each: {access: rw}\n    registers:\n" + "".join(
        f"      {line}\n" for line in dedent(NESTED).strip().splitlines()
    )
    model = lowered(body).model("B-2")
    limit, programs = model.members
    assert isinstance(programs, Array)
    assert (programs.id, programs.first, programs.count, programs.stride) == ("programs", 1, 2, 100)
    repeats, segments = programs.members
    assert isinstance(segments, Array)
    assert (segments.first, segments.count, [member.path for member in segments.members]) == (
        3,
        3,
        ["programs[1].segments[3].ramp_time"],
    )
    assert limit is model.registers[0]
    assert (repeats.path, repeats.name) == (model.registers[1].path, "Repeats")
    assert model.groups[0].members == tuple(register.path for register in model.registers)


def test_a_register_is_only_on_the_models_it_names(registers: Registers) -> None:
    lines = "- {at: 0, name: First, except: [B-2]}\n- {at: 1, name: Second, models: [B-2]}\n- {at: 2, name: Third}"
    assert list(registers(lines)) == ["first", "third"]
    assert list(registers(lines, model="B-2")) == ["second", "third"]


def test_keys_of_the_register_count_before_those_of_its_group(registers: Registers) -> None:
    found = registers("- {at: 0, name: First, access: r, source: '2.2'}\n- {at: 1, name: Second}")
    assert (found["first"].access, found["first"].section) == ("r", "2.2")
    assert (found["second"].access, found["second"].section) == ("rw", "1.1")


def test_a_variant_overrides_and_null_removes(registers: Registers) -> None:
    line = "- {at: 0, name: Level, default: 5, unit: s, variants: [{models: [B-2], default: 7, unit: null}]}"
    here, there = (registers(line, model=model)["level"] for model in ("A1", "B-2"))
    assert (here.default, here.unit[0].then) == (5, "s")
    assert (there.default, there.unit[0].then) == (7, "")


def test_a_variant_of_the_groups_defaults_counts_below_the_registers_own_keys(registers: Registers) -> None:
    lines = "- {at: 0, name: Level}\n- {at: 1, name: Offset, default: 9}"
    each = "{access: rw, default: 1, variants: [{models: [B-2], default: 2}]}"
    assert [found.default for found in registers(lines, each=each).values()] == [1, 9]
    assert [found.default for found in registers(lines, each=each, model="B-2").values()] == [2, 9]


def test_a_scale_of_the_register_replaces_the_decimals_of_the_group(registers: Registers) -> None:
    found = registers("- {at: 0, name: Level, scale: 0..655.35}", each="{access: rw, decimals: 1}")["level"]
    assert str(found.scale[0].then.multiply) == "1/100"


def test_an_enum_takes_away_the_number_that_the_group_makes_of_its_words(registers: Registers) -> None:
    each = "{access: rw, decimals: 1, unit: s, range: 0..9}"
    lines = "- {at: 0, name: Mode, enum: {0: a, 1: b}}\n- {at: 1, name: Delay}"
    found = registers(lines, each=each)["mode"]
    assert (found.kind, found.unit[0].then, found.range, found.scale[0].then.multiply) == ("enum", "", (), 1)


def test_keys_that_start_with_x_are_ignored(registers: Registers) -> None:
    found = registers("- {at: 0, name: Mode, enum: {x-note: no member, 0: a}, x-page: 12}")["mode"]
    assert [member.id for member in found.enum.members] == ["A"]


def test_a_group_that_a_model_has_nothing_of_is_left_out(lowered: Lowered) -> None:
    found = lowered("""
        groups:
          - {id: one, name: One, order: 2, registers: [{at: 0, name: First, access: r}]}
          - {id: two, name: Two, registers: [{at: 1, name: Second, access: r, models: [B-2]}]}
    """)
    assert [group.id for group in found.model("A1").groups] == ["one"]
    assert [(group.id, group.order) for group in found.model("B-2").groups] == [("one", 2), ("two", None)]


def test_an_inline_enum_in_an_array_is_named_after_the_array_too(registers: Registers) -> None:
    sensor = "{at: 0, name: Type, id: sensor, enum: {0: a}}"
    lines = f"- {{id: inputs, name: Input, repeat: 1..2, stride: 1, registers: [{sensor}]}}"
    found = registers(lines)
    assert found["inputs[1].sensor"].enum == found["inputs[2].sensor"].enum
    assert found["inputs[1].sensor"].enum.id == "inputs_sensor"


def test_the_write_order_of_the_map_gives_groups_their_places(lowered: Lowered) -> None:
    found = lowered("""
        groups:
          - {id: one, name: One, registers: [{at: 0, name: First, access: r}]}
          - {id: two, name: Two, registers: [{at: 1, name: Second, access: r}]}
          - {id: three, name: Three, registers: [{at: 2, name: Third, access: r}]}
        write_order: [three, one]
    """)
    assert [(group.id, group.order) for group in found.models[0].groups] == [("one", 2), ("two", None), ("three", 1)]
