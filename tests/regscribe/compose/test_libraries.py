"""Libraries: their names, sets, commands, errata and notes in the maps that use them."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.emit.python import render
from regscribe.model import Diagnostic, RegisterMap
from regscribe.pipeline import compile_map

User = Callable[..., Path]
Found = Callable[[Path], RegisterMap]

ALL = "{set: control}"


def test_a_set_puts_its_registers_and_arrays_into_a_group(user: User, found: Found) -> None:
    model = found(user(ALL)).model("A")
    assert [(one.path, one.address, one.section) for one in model.registers] == [
        ("setpoint", 0, "4.1"),
        ("timer_action", 1, "1.1"),
        ("segments[1].ramp_time", 20, "4.1"),
        ("segments[1].soak", 21, "4.1"),
        ("segments[2].ramp_time", 24, "4.1"),
        ("segments[2].soak", 25, "4.1"),
    ]


def test_a_shift_is_added_to_all_addresses_and_aliases(user: User, found: Found) -> None:
    model = found(user("{set: control, shift: 1000}")).model("A")
    assert [one.address for one in model.registers] == [1000, 1001, 1020, 1021, 1024, 1025]
    assert model.register("timer_action").aliases == (1300,)


def test_ids_can_be_left_out(user: User, found: Found) -> None:
    model = found(user("{set: control, except_ids: [segments, timer_action]}")).model("A")
    assert [one.path for one in model.registers] == ["setpoint"]


def test_keys_for_each_register_of_a_set_count_over_its_own(user: User, found: Found) -> None:
    item = "{set: control, set_each: {source: '9.9', access: r, range: null, unit: °C, enum: null, kind: null}}"
    model = found(user(item)).model("A")
    assert {one.section for one in model.registers} == {"9.9"}
    assert {one.access for one in model.registers} == {"r"}
    assert (model.register("setpoint").range, model.register("setpoint").unit[0].then) == ((), "°C")
    assert model.register("timer_action").enum is None


def test_a_set_can_be_on_some_models_only(user: User, found: Found) -> None:
    map_ = found(user("{at: 99, name: Own, access: r}", "{set: control, models: [B]}"))
    assert [one.path for one in map_.model("A").registers] == ["own"]
    assert len(map_.model("B").registers) == 7


def test_a_set_can_stand_in_an_array(user: User, found: Found) -> None:
    array = "{id: loops, name: Loop, repeat: 1..2, stride: 100, registers: [{set: segment}]}"
    model = found(user(array)).model("A")
    assert [(one.path, one.address) for one in model.registers] == [
        ("loops[1].ramp_time", 0),
        ("loops[1].soak", 1),
        ("loops[2].ramp_time", 100),
        ("loops[2].soak", 101),
    ]


def test_a_map_can_have_sets_of_its_own_beside(user: User, found: Found) -> None:
    map_ = found(user("{set: own, shift: 5}", top="sets: {own: [{at: 1, name: One, access: r, enum: launch}]}"))
    assert map_.model("B").register("one").address == 6


def test_each_element_is_named_with_its_index_or_where_the_mark_stands(user: User, found: Found) -> None:
    model = found(user(ALL)).model("A")
    names = [(one.name, one.symbol, one.printed) for one in model.registers]
    assert names == [
        ("Setpoint", "S.P.", "5.P."),
        ("Timer Action", "", ""),
        ("Ramp 1 Time", "rt1", ""),
        ("Soak 1", "so", ""),
        ("Ramp 2 Time", "rt2", ""),
        ("Soak 2", "so", ""),
    ]


def test_protocol_is_merged_key_by_key_and_the_map_wins(user: User, found: Found) -> None:
    top = "protocol: {limits: {read_words: 20}, faults: {read_only: 4}, source: '2', functions: [3, 4, 6, 16, 8]}"
    map_ = found(user(ALL, top=top))
    protocol = map_.protocol
    assert (protocol.read_words, protocol.write_words, map_.protocol_notes.section) == (20, 8, "2")
    assert (map_.faults.read_only, map_.faults.value) == (4, 3)
    assert (protocol.functions, map_.alike) == ((3, 4, 6, 16, 8), ((3, 4),))


def test_commands_errata_notes_and_notations_come_along(user: User, found: Found) -> None:
    top = """
        commands: {own: {name: Own, source: "1", steps: [{at: 99, words: [1]}]}}
        notes: [of the map]
        notations: [{name: JBUS, space: input, offset: 1}]
    """
    map_ = found(user(ALL, top=top))
    assert [command.id for command in map_.model("A").commands] == ["apply", "save", "own"]
    assert (map_.notes, [erratum.where for erratum in map_.errata]) == (("of the library", "of the map"), ["1.1"])
    assert [(one.name, one.space) for one in map_.notations] == [("JBUS", "holding"), ("JBUS", "input")]
    assert map_.uses == ("acme/common",)


def test_a_command_of_the_library_can_be_left_out(user: User, found: Found) -> None:
    map_ = found(user(ALL, top="commands: {save: null}"))
    assert [command.id for command in map_.model("A").commands] == ["apply"]


def test_names_that_a_map_does_not_need_may_be_about_registers_of_others(user: User, found: Found) -> None:
    assert "register_of_another_map" not in str(found(user(ALL)).models)


def test_two_maps_use_one_library(user: User, found: Found) -> None:
    first, second = found(user(ALL)), found(user("{set: segment}", name="acme/other"))
    assert (first.id, second.id) == ("acme/user", "acme/other")
    assert first.model("A").register("setpoint").span.file.endswith("common.library.yaml")
    assert [one.path for one in second.model("A").registers] == ["ramp_time", "soak"]


def test_columns_and_cells_make_labels_and_ids(user: User, found: Found) -> None:
    enum = found(user(ALL)).model("A").register("timer_action").enum
    assert enum is not None
    assert enum.columns == ("launch", "op3_status")
    assert [(one.code, one.label, one.id, one.cells) for one in enum.members] == [
        (0, "output, ON", "OUTPUT_ON", ("output", "ON")),
        (1, "input, OFF", "INPUT_OFF", ("input", "OFF")),
    ]


def library(user: User, *edits: tuple[str, str]) -> tuple[Path, tuple[Diagnostic, ...]]:
    """The library alone, changed: its path and what is wrong with it."""
    path = user(ALL).parent / "common.library.yaml"
    text = path.read_text()
    for old, new in edits:
        assert old in text
        text = text.replace(old, new)
    path.write_text(text)
    compiled = compile_map(path)
    assert compiled.map is None
    return path, compiled.diagnostics


def test_a_library_alone_has_nothing_wrong_with_it(user: User) -> None:
    assert library(user)[1] == ()


@pytest.mark.parametrize(
    ("old", "new", "rule"),
    [
        ("enum: launch", "enum: lanch", "RS0304"),
        ("set: segment,", "set: segmnt,", "RS0333"),
        ("range: 0..400", "range: 400..0", "RS0315"),
        ("range: 0..400", "unit: furlong", "RS0311"),
        ("title: Common", "titel: Common", "RS0201"),
        ("sets:", "groups: []\nsets:", "RS0207"),
        ("id: acme/common", "id: acme/commons", "RS0504"),
        ("- {at: 1, name: Soak", "- {set: control}\n    - {at: 1, name: Soak", "RS0334"),
    ],
)
def test_a_library_is_checked_for_shape_and_references(user: User, old: str, new: str, rule: str) -> None:
    path, found = library(user, (old, new))
    assert rule in {one.rule for one in found}
    assert {one.span.file for one in found} == {str(path)}


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("range: 0..400", "range: {from: 0, to: limit_of_the_map}"),
        ("symbol: S.P., printed: 5.P., access: rw", "symbol: S.P."),
        ("range: 0..400", "models: [M5000]"),
        ("register_of_another_map: 3", "given: of_the_map"),
    ],
)
def test_what_maps_add_is_no_mistake_of_a_library(user: User, old: str, new: str) -> None:
    assert library(user, (old, new))[1] == ()


def test_a_mistake_in_a_library_names_the_map_that_met_it(user: User) -> None:
    path, _ = library(user, ("range: 0..400", "range: {from: 0, to: limit_of_the_map}"))
    (found,) = compile_map(path.with_name("user.yaml")).diagnostics
    assert (found.rule, found.span.file) == ("RS0301", str(path))
    assert found.related[-1].span.file == str(path.with_name("user.yaml"))


def test_a_long_chain_of_sets_is_refused(user: User) -> None:
    chain = "".join(f"\n  s{n}: [{{set: s{n + 1}}}]" for n in range(2000))
    found = compile_map(user("{set: s0}", top=f"sets:{chain}\n")).diagnostics
    assert "RS0331" in {one.rule for one in found}


def test_sets_in_sets_without_end_are_refused_soon(user: User) -> None:
    doubled = "".join(f"\n  s{n}: [{{set: s{n + 1}}}, {{set: s{n + 1}}}, {{set: s{n + 1}}}]" for n in range(40))
    top = f"sets:{doubled}\n  s40: [{{at: 0, name: End, access: r}}]\n"
    found = compile_map(user("{set: s0}", top=top)).diagnostics
    assert "RS0331" in {one.rule for one in found}


def test_cells_go_into_the_descriptions_of_the_driver(user: User, found: Found) -> None:
    files = render(found(user(ALL)))
    assert any('"launch: input; op3_status: OFF"' in text for text in files.values())
