"""A map on the basis of another: renamed, renumbered, dropped, overridden and added to."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.model import Override, RegisterMap
from regscribe.pipeline import compile_map

Extension = Callable[..., Path]
Found = Callable[[Path], RegisterMap]


def paths(found: RegisterMap, model: str) -> list[str]:
    return [register.path for register in found.model(model).registers]


def test_an_extension_has_the_models_under_their_new_names(extension: Extension, found: Found) -> None:
    map_ = found(extension())
    assert [(model.name, model.class_name) for model in map_.models] == [("X1", "OmegaX1"), ("X2", "OmegaX2")]
    assert (map_.id, map_.maker, map_.extends, map_.description) == (
        "omega/x",
        "Omega",
        "acme/series-c",
        "the first family",
    )


def test_a_model_inherits_its_description_unless_it_gives_one(extension: Extension, found: Found) -> None:
    map_ = found(extension(models="{X1: {from: 16C, description: tiny}, X2: {from: 18C}}"))
    assert [model.description for model in map_.models] == ["tiny", "large"]


def test_what_only_dropped_models_have_is_gone(extension: Extension, found: Found) -> None:
    map_ = found(extension())
    elements = [f"segments[{i}].{name}" for i in (1, 2, 3) for name in ("ramp_time", "soak_event")]
    assert paths(map_, "X1") == ["setpoint", "alarm_action", "rate", *elements]
    assert [group.id for group in map_.model("X1").groups] == ["control"]
    assert [command.id for command in map_.model("X1").commands] == ["clear"]
    assert [getattr(example, "register", "") for example in map_.examples] == ["setpoint", "segments[2].ramp_time"]
    assert [identity.models for identity in map_.identity] == [("X1", "X2")]
    assert map_.model("X1").groups[0].order == 1


def test_only_what_a_dropped_model_has_is_left_when_it_alone_is_named(extension: Extension, found: Found) -> None:
    map_ = found(extension(models="{Z: {from: 1ZC}}"))
    assert paths(map_, "Z")[:4] == ["setpoint", "alarm_action", "watchdog", "card"]
    assert [member.code for member in map_.model("Z").register("alarm_action").enum.members] == [1, 2, 4]


def test_models_of_enum_members_flags_variants_and_examples_are_renamed(extension: Extension, found: Found) -> None:
    map_ = found(extension(models="{X1: {from: 16C}, X2: {from: 18C}, X3: {from: 16C}}"))
    enum = map_.model("X2").register("alarm_action").enum
    assert enum is not None
    assert ([member.code for member in enum.members], enum.invalid) == ([1, 2, 3], ((4, "no"),))
    assert [int(map_.model(name).register("rate").default or 0) for name in ("X1", "X2", "X3")] == [5, 6, 5]
    assert [field.id for field in map_.model("X1").register("segments[1].soak_event").fields] == ["first"]
    assert map_.examples[1].model == "X2"


def test_sections_are_renumbered_by_their_first_number(extension: Extension, found: Found) -> None:
    map_ = found(extension('renumber: {"4": "5", "7": "8", "3": "4"}'))
    model = map_.model("X1")
    assert [model.register(path).section for path in ("setpoint", "segments[1].ramp_time")] == ["5.7.2", "5.9"]
    assert (model.groups[0].section, model.commands[0].section) == ("5.7.2", "8.4")
    assert [example.source for example in map_.examples] == ["4.1", "4.3"]
    assert [erratum.where for erratum in map_.errata] == ["5.7", "9.1"]
    assert map_.protocol_notes.section == "2.1"


def test_what_is_dropped_is_gone_with_its_reason_on_record(extension: Extension, found: Found) -> None:
    map_ = found(
        extension("""
            drop:
              registers: [{id: setpoint, reason: not printed}, {id: segments.soak_event, reason: nor this}]
              commands: [{id: clear, reason: nor that}]
              errata: [9.1]
              examples: [3.3]
              notes: all
        """)
    )
    assert paths(map_, "X1") == ["alarm_action", "rate", *(f"segments[{i}].ramp_time" for i in (1, 2, 3))]
    assert (map_.model("X1").commands, map_.notes, map_.examples) == ((), (), ())
    assert [erratum.where for erratum in map_.errata] == ["4.7"]
    assert [(one.what, one.id, one.reason, one.changed) for one in map_.overrides] == [
        ("register", "setpoint", "not printed", ()),
        ("register", "segments.soak_event", "nor this", ()),
        ("command", "clear", "nor that", ()),
        ("errata", "9.1", "", ()),
        ("examples", "3.3", "", ()),
        ("notes", "all", "", ()),
    ]


def test_a_group_is_dropped_with_its_registers(extension: Extension, found: Found) -> None:
    body = "drop: {groups: [{id: control, reason: another chapter}]}\n"
    group = 'groups: [{id: own, name: Own, source: "1", registers: [{at: 1, name: One, access: r}]}]\n'
    map_ = found(extension(body + group + "identify: []\nexamples: []\n"))
    assert [group.id for group in map_.model("X1").groups] == ["own"]
    assert map_.examples == ()


def test_an_override_changes_the_keys_it_sets_and_keeps_the_others(extension: Extension, found: Found) -> None:
    map_ = found(
        extension("""
            override:
              - {register: setpoint, reason: printed so, set: {default: 80, range: null, symbol: SP}}
              - {enum: action, reason: two names, set: {2: {label: plain}, 3: null}}
              - {group: control, reason: another title, set: {name: Control Parameters, each: {type: uint16}}}
              - {command: clear, reason: dangerous here, set: {danger: clears all}}
              - {register: segments, reason: two only, set: {repeat: 1..2}}
              - {register: segments.ramp_time, reason: seconds, set: {unit: s}}
        """)
    )
    model = map_.model("X2")
    setpoint, action = model.register("setpoint"), model.register("alarm_action").enum
    assert (setpoint.default, setpoint.range, setpoint.symbol, setpoint.name) == (80, (), "SP", "Setpoint")
    assert action is not None
    assert [(member.code, member.label) for member in action.members] == [(1, "off"), (2, "plain")]
    assert (model.groups[0].name, setpoint.base.type, setpoint.access) == ("Control Parameters", "uint16", "rw")
    assert model.commands[0].danger == "clears all"
    assert model.register("segments[2].ramp_time").unit[0].then == "s"
    assert not any(path.startswith("segments[3]") for path in paths(map_, "X2"))
    assert map_.overrides[0] == Override(
        "register",
        "setpoint",
        "printed so",
        ("default: 77 -> 80", "range: 0..400 -> nothing", "symbol: nothing -> SP"),
        map_.overrides[0].span,
    )
    assert map_.overrides[1].changed == (
        "2: normal -> {label: plain}",
        "3: {label: latched, models: [X1, X2]} -> nothing",
    )


def test_protocol_is_merged_key_by_key_and_lists_are_added_to(extension: Extension, found: Found) -> None:
    map_ = found(
        extension("""
            protocol: {limits: {read_words: 20}, latency: {3: {fixed: 1..2}}, broadcast: [6]}
            errata: [{where: 1.1, printed: x, read: y, why: z}]
            notes: [the second note]
            examples: [{source: 1.2, register: rate, value: 2, words: [2]}]
            manual: {title: X Manual, number: X-1}
        """)
    )
    protocol = map_.protocol
    assert (protocol.read_words, protocol.write_words, protocol.broadcast) == (20, 24, (6,))
    assert map_.protocol_notes.section == "2.1"
    assert {one.function: (one.maximum, one.maximum_per_word) for one in protocol.latencies} == {3: (2, 0), 6: (180, 0)}
    assert [erratum.where for erratum in map_.errata] == ["4.7", "9.1", "1.1"]
    assert (map_.notes, map_.manual.title) == (("the first note", "the second note"), "X Manual")
    assert [getattr(example, "register", "") for example in map_.examples][-1] == "rate"


def test_registers_are_added_to_groups_of_the_base_and_in_new_ones(extension: Extension, found: Found) -> None:
    map_ = found(
        extension("""
            enums: {mode: {0: a, 1: b}}
            groups:
              - {id: control, registers: [{at: 50, name: Mode, enum: mode, models: [X2]}]}
              - {id: more, name: More, source: "9", each: {access: r}, registers: [{at: 60, name: Extra}]}
        """)
    )
    mode = map_.model("X2").register("mode")
    assert (mode.group, mode.section, mode.access) == ("control", "4.7.2", "rw")
    assert "mode" not in paths(map_, "X1")
    assert map_.model("X1").register("extra").section == "9"


def test_places_of_inherited_things_are_in_the_base(extension: Extension, found: Found) -> None:
    path = extension("override: [{register: setpoint, reason: printed so, set: {default: 80}}]")
    map_ = found(path)
    assert Path(map_.model("X1").register("rate").span.file).name == "series-c.yaml"
    assert map_.model("X1").register("setpoint").span.line == 23
    assert Path(map_.overrides[0].span.file) == path
    assert Path(map_.model("X1").span.file) == path
    assert map_.source == map_.span.file == str(path)


def test_a_waiver_goes_with_the_register_that_it_is_about(extension: Extension, found: Found) -> None:
    path = extension()
    base = path.parents[1] / "acme" / "series-c.yaml"
    text = base.read_text().replace("name: Watchdog,", "name: Watchdog, range: 0..1, default: 9,")
    base.write_text(text + "waivers: [{rule: RS0423, at: watchdog, reason: printed so}]\n")
    assert len(found(base).waivers) == 1
    assert found(path).waivers == ()


def test_an_extension_can_be_extended(maps: Callable[..., Path], extension: Extension, found: Found) -> None:
    extension("override: [{register: setpoint, reason: printed so, set: {default: 80}}]")
    head = "format: 1\nmap: {id: third/y, title: Y, maker: Third, class_prefix: Third}\nextends: omega/x\n"
    map_ = found(maps("third/y", f"{head}models: {{Y: {{from: X2}}}}\n"))
    assert (map_.model("Y").register("setpoint").default, map_.model("Y").register("rate").default) == (80, 6)
    assert (map_.extends, map_.overrides) == ("omega/x", ())


def test_the_content_hash_is_of_all_files(extension: Extension, found: Found) -> None:
    path = extension()
    before = found(path).content_hash
    assert found(path).content_hash == before
    base = path.parents[1] / "acme" / "series-c.yaml"
    base.write_text(base.read_text() + "# a remark\n")
    assert found(path).content_hash != before


def test_the_files_of_a_map_are_told_with_its_own_first(extension: Extension) -> None:
    path = extension("uses: [acme/common]\nprotocol: {limits: {write_words: 9}}")
    compiled = compile_map(path)
    assert compiled.diagnostics == ()
    assert [file.name for file, _ in compiled.files] == ["x.yaml", "series-c.yaml", "common.library.yaml"]
    assert len({known for _, known in compiled.files}) == 3


def test_names_of_base_models_in_conditions_are_no_models(maps: Callable[..., Path], found: Found) -> None:
    head = "format: 1\nmap: {id: acme/odd, title: O, maker: Acme, class_prefix: Odd}\nmanual: {title: M, number: '1'}\n"
    registers = "{at: 0, name: Models, id: models, enum: {1: a1, 2: b}, default: 1}, {at: 1, name: Source, range: 0..9}"
    when = "{at: 2, name: Third, writable: {when: {models: [a1], source: 4}, reason: so}}"
    group = f"groups: [{{id: g, name: G, source: '4', each: {{access: rw}}, registers: [{registers}, {when}]}}]\n"
    maps("acme/odd", f"{head}models: {{a1: {{}}, b: {{}}}}\n{group}")
    head = "format: 1\nmap: {id: acme/new, title: N, maker: Acme, class_prefix: New}\nextends: acme/odd\n"
    map_ = found(maps("acme/new", f"{head}models: {{c: {{from: a1}}}}\nrenumber: {{'4': '5'}}\n"))
    writable = map_.model("c").register("third").writable
    assert writable is not None
    assert [test.codes[0][0] for test in writable.when.tests] == [1, 4]


@pytest.mark.parametrize("where", [".", "maps", "maps/omega"])
def test_the_base_is_found_from_any_working_directory(
    extension: Extension, monkeypatch: pytest.MonkeyPatch, where: str
) -> None:
    path = extension()
    monkeypatch.chdir(path.parents[2] / where)
    relative = path.relative_to(path.parents[2] / where)
    compiled = compile_map(relative)
    assert compiled.diagnostics == ()
    assert compiled.map is not None
