"""What is wrong between files is said at its place, with the place in the other file."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.model import Diagnostic

Extension = Callable[..., Path]
User = Callable[..., Path]
Mistakes = Callable[[Path], tuple[Diagnostic, ...]]


def places(found: tuple[Diagnostic, ...]) -> list[str]:
    """Rule, place and other place of each: `RS0506 x.yaml:5:1 series-c.yaml:20:7`."""
    spans = [(one.rule, one.span, *(other.span for other in one.related)) for one in found]
    return [
        " ".join([rule, *(f"{Path(span.file).name}:{span.line}:{span.column}" for span in others)])
        for rule, *others in spans
    ]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("override: [{register: setpoint, reason: r, set: {default: 77}}]", ["RS0506 x.yaml:5:50 series-c.yaml:23:48"]),
        ("override: [{register: setpoint, reason: r, set: {unit: null}}]", ["RS0506 x.yaml:5:50 series-c.yaml:23:9"]),
        ("override: [{register: setpoint, reason: r, set: {access: rw}}]", ["RS0506 x.yaml:5:50 series-c.yaml:21:12"]),
        ("override: [{register: setpoint, reason: r, set: {type: null}}]", ["RS0506 x.yaml:5:50 series-c.yaml:21:24"]),
        (
            "override: [{enum: action, reason: r, set: {3: {label: latched}}}]",
            ["RS0506 x.yaml:5:48 series-c.yaml:16:37"],
        ),
        ("override: [{register: setpiont, reason: r, set: {unit: s}}]", ["RS0507 x.yaml:5:23 series-c.yaml:2:11"]),
        ("override: [{register: watchdog, reason: r, set: {unit: s}}]", ["RS0507 x.yaml:5:23 series-c.yaml:2:11"]),
        ("override: [{group: zone, reason: r, set: {name: Z}}]", ["RS0507 x.yaml:5:20 series-c.yaml:2:11"]),
        ("override: [{command: zero, reason: r, set: {name: Z}}]", ["RS0507 x.yaml:5:22 series-c.yaml:2:11"]),
        ("override: [{register: setpoint, reason: ' ', set: {unit: s}}]", ["RS0509 x.yaml:5:41"]),
        ("override: [{register: setpoint, set: {unit: s}}]", ["RS0202 x.yaml:5:12"]),
        ("override: [{reason: r, set: {unit: s}}]", ["RS0202 x.yaml:5:12"]),
        ("drop: {registers: [{id: watchdog, reason: r}]}", ["RS0508 x.yaml:5:25 series-c.yaml:2:11"]),
        ("drop: {registers: [{id: rate}]}", ["RS0202 x.yaml:5:20"]),
        ("drop: {registers: [{id: rate, reason: '  '}]}", ["RS0509 x.yaml:5:39"]),
        ("drop: {errata: ['4.8']}", ["RS0508 x.yaml:5:17 series-c.yaml:2:11"]),
        ("drop: {waivers: all}", ["RS0508 x.yaml:5:17 series-c.yaml:2:11"]),
        ("renumber: {8: '9'}", ["RS0511 x.yaml:5:12 series-c.yaml:2:11"]),
        ("enums: {action: {0: a}}", ["RS0510 x.yaml:5:9 series-c.yaml:16:3"]),
        ("groups: [{id: control, name: N, registers: []}]", ["RS0513 x.yaml:5:24 series-c.yaml:18:5"]),
        ("commands: {clear: null}", ["RS0512 x.yaml:5:12"]),
        ("override: [{register: setpoint, reason: r, set: {nmae: s}}]", ["RS0201 x.yaml:5:50"]),
        ("override: [{register: setpoint, reason: r, set: {name: null}}]", ["RS0202 series-c.yaml:23:9"]),
        (
            "override: [{register: setpoint, reason: r, set: {default: 500}}]",
            ["RS0423 series-c.yaml:23:23 x.yaml:2:11"],
        ),
    ],
)
def test_a_mistake_of_an_extension_shows_both_places(
    extension: Extension, mistakes: Mistakes, body: str, expected: list[str]
) -> None:
    assert places(mistakes(extension(body))) == expected


@pytest.mark.parametrize(
    ("models", "expected"),
    [
        ("{X1: {from: 16c}}", "RS0505 x.yaml:4:21 series-c.yaml:5:1"),
        ("{X1: {from: X}, X2: {from: 18C}}", "RS0505 x.yaml:4:21 series-c.yaml:5:1"),
        ("{X1: {}}", "RS0202 x.yaml:4:10"),
    ],
)
def test_a_renamed_model_must_exist(extension: Extension, mistakes: Mistakes, models: str, expected: str) -> None:
    assert places(mistakes(extension(models=models)))[0] == expected


def test_a_guess_is_made_of_the_name_that_was_meant(extension: Extension, mistakes: Mistakes) -> None:
    (found,) = mistakes(extension("override: [{register: setpiont, reason: r, set: {unit: s}}]"))
    assert "did you mean `setpoint`?" in found.help
    (found,) = mistakes(extension(models="{X1: {from: 16c}}"))
    assert "16C" in found.help


def test_all_mistakes_between_files_are_found_in_one_run(extension: Extension, mistakes: Mistakes) -> None:
    body = """
        drop: {registers: [{id: nothing, reason: r}]}
        override: [{register: setpoint, reason: ' ', set: {default: 77}}]
        enums: {action: {0: a}}
    """
    assert [one.rule for one in mistakes(extension(body))] == ["RS0508", "RS0509", "RS0506", "RS0510"]


@pytest.mark.parametrize("key", ["renumber: {4: '5'}", "drop: {notes: all}", "override: []"])
def test_a_map_that_stands_alone_has_nothing_to_override(
    maps: Callable[..., Path], mistakes: Mistakes, key: str
) -> None:
    path = maps("acme/series-c", "").parent
    base = (path / "series-c.yaml").parent
    text = f"format: 1\nmap: {{id: acme/a, title: A, maker: A, class_prefix: A}}\nmodels: {{A: {{}}}}\n{key}\n"
    (base / "a.yaml").write_text(text + "groups: [{id: g, name: G, registers: []}]\n")
    assert places(mistakes(base / "a.yaml")) == ["RS0207 a.yaml:4:1"]


def test_a_base_that_is_not_there_is_named_with_those_that_are(maps: Callable[..., Path], mistakes: Mistakes) -> None:
    head = "format: 1\nmap: {id: omega/x, title: X, maker: Omega, class_prefix: Omega}\n"
    (found,) = mistakes(maps("omega/x", f"{head}extends: acme/series-d\nmodels: {{X: {{from: Y}}}}\n"))
    assert places((found,)) == ["RS0501 x.yaml:3:10"]
    assert "did you mean `acme/series-c`?" in found.help


def test_a_map_of_an_odd_file_name_looks_for_its_base_beside_itself(extension: Extension, mistakes: Mistakes) -> None:
    path = extension()
    hidden = path.rename(path.with_name(".yaml"))
    assert places(mistakes(hidden)) == ["RS0501 .yaml:3:10"]


def test_a_mistake_in_the_shape_of_a_base_is_told_in_the_base(extension: Extension, mistakes: Mistakes) -> None:
    path = extension()
    base = path.parents[1] / "acme" / "series-c.yaml"
    base.write_text(base.read_text().replace("class: LargeOne", "clas: LargeOne"))
    assert places(mistakes(path)) == ["RS0201 series-c.yaml:7:29"]


def test_a_base_that_is_no_yaml_is_told_in_the_base(extension: Extension, mistakes: Mistakes) -> None:
    path = extension()
    (path.parents[1] / "acme" / "series-c.yaml").write_text("a: [1\n")
    assert [one.partition(" ")[2].split(":")[0] for one in places(mistakes(path))] == ["series-c.yaml"]


@pytest.mark.parametrize(
    ("top", "expected"),
    [
        ("enums: {launch: {0: a}}", "RS0510 user.yaml:6:9 common.library.yaml:6:3"),
        ("sets: {segment: []}", "RS0510 user.yaml:6:8 common.library.yaml:22:3"),
        (
            "commands: {apply: {name: A, steps: [{at: 1, words: [1]}]}}",
            "RS0510 user.yaml:6:12 common.library.yaml:26:3",
        ),
        ("notations: [{name: JBUS, space: holding, offset: 2}]", "RS0510 user.yaml:6:13 common.library.yaml:4:13"),
        ("commands: {aply: null}", "RS0512 user.yaml:6:12"),
    ],
)
def test_a_name_of_a_library_is_not_shadowed(user: User, mistakes: Mistakes, top: str, expected: str) -> None:
    assert places(mistakes(user("{set: control}", top=top))) == [expected]


def test_two_libraries_may_not_share_a_name(user: User, mistakes: Mistakes) -> None:
    path = user("{set: control}")
    second = "format: 1\nlibrary: {id: acme/second, title: S}\nenums: {launch: {0: a}}\n"
    (path.parent / "second.library.yaml").write_text(second)
    path.write_text(path.read_text().replace("uses: [acme/common]", "uses: [acme/common, acme/second]"))
    assert places(mistakes(path)) == ["RS0510 second.library.yaml:3:9 common.library.yaml:6:3"]


@pytest.mark.parametrize(
    ("item", "expected"),
    [
        ("{set: contrl}", "RS0333 user.yaml:12:15"),
        ("{set: control, except_ids: [segment]}", "RS0301 user.yaml:12:37"),
        ("{set: control, models: [C]}", "RS0321 user.yaml:12:32"),
        ("{set: control, shift: x}", "RS0203 user.yaml:12:31"),
        ("{set: control, at: 5}", "RS0201 user.yaml:12:24"),
        ("{set: control, set_each: {at: 5}}", "RS0201 user.yaml:12:35"),
    ],
)
def test_a_mistake_in_the_use_of_a_set_is_told_there(user: User, mistakes: Mistakes, item: str, expected: str) -> None:
    assert places(mistakes(user(item)))[0] == expected


def test_a_library_is_not_extended_and_a_map_not_used(extension: Extension, user: User, mistakes: Mistakes) -> None:
    path = extension()
    path.write_text(path.read_text().replace("extends: acme/series-c", "extends: acme/common.library"))
    assert [one.rule for one in mistakes(path)] == ["RS0205"]
    path = user("{set: control}")
    (path.parent / "common.library.yaml").write_text((path.parent / "series-c.yaml").read_text())
    assert places(mistakes(path)) == ["RS0503 user.yaml:5:8 common.library.yaml:2:1"]


def test_maps_that_extend_each_other_are_refused(
    extension: Extension, maps: Callable[..., Path], mistakes: Mistakes
) -> None:
    extension()
    head = "format: 1\nmap: {id: acme/series-c, title: C, maker: Acme, class_prefix: Acme}\nextends: omega/x\n"
    path = maps("acme/series-c", f"{head}models: {{16C: {{from: X1}}, 18C: {{from: X2}}}}\n")
    assert places(mistakes(path)) == ["RS0502 series-c.yaml:3:10 x.yaml:3:10"]


def test_a_long_chain_of_maps_is_refused(maps: Callable[..., Path], mistakes: Mistakes) -> None:
    for n in range(60):
        head = f"format: 1\nmap: {{id: acme/m{n}, title: C, maker: Acme, class_prefix: Acme}}\nextends: acme/m{n + 1}\n"
        maps(f"acme/m{n}", f"{head}models: {{A: {{from: A}}}}\n")
    assert places(mistakes(maps("acme/m0", (maps("acme/x", "").parent / "m0.yaml").read_text())))[0].startswith("RS05")


def test_a_map_that_extends_itself_is_refused(maps: Callable[..., Path], mistakes: Mistakes) -> None:
    head = "format: 1\nmap: {id: acme/loop, title: C, maker: Acme, class_prefix: Acme}\nextends: acme/loop\n"
    assert places(mistakes(maps("acme/loop", f"{head}models: {{A: {{from: A}}}}\n"))) == ["RS0502 loop.yaml:3:10"]
