"""Rows in the numbers of a manual become wire addresses; messages and docs show both."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.emit.markdown import render
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map

Maps = Callable[..., Path]

HEAD = """\
format: 1
map: {id: acme/one, title: One, maker: Acme, class_prefix: One}
manual: {title: Manual, number: M-1}
models: {A: {}}
protocol: {functions: [1, 2, 3, 4, 5, 6, 15, 16]}
"""


def text(*rows: str, top: str = "written_in: modicon", group: str = "", tail: str = "") -> str:
    lines = "".join(f"      - {row}\n" for row in rows)
    head = f'{HEAD}{top}\ngroups:\n  - id: g\n    name: G\n    source: "1"\n'
    return f"{head}{group}    each: {{access: rw}}\n    registers:\n{lines}{tail}"


@pytest.fixture
def sound(maps: Maps) -> Callable[..., RegisterMap]:
    """The map of a text that has no findings."""

    def compiled(content: str, name: str = "acme/one") -> RegisterMap:
        found = compile_map(maps(name, content))
        assert found.map is not None, found.diagnostics
        return found.map

    return compiled


def addresses(register_map: RegisterMap) -> dict[str, tuple[str, int]]:
    (model,) = register_map.models
    return {one.path: (str(one.base.space), one.address) for one in model.registers}


def test_a_group_may_be_written_as_on_the_wire(sound: Callable[..., RegisterMap]) -> None:
    found = sound(text("{at: 7, name: Seven}", group="    written_in: wire\n"))
    assert addresses(found) == {"seven": ("holding", 7)}


def test_a_group_alone_may_be_written_in_a_notation(sound: Callable[..., RegisterMap]) -> None:
    found = sound(text("{at: 30008, name: Seven, access: r}", top="notes: [none]", group="    written_in: modicon\n"))
    assert addresses(found) == {"seven": ("input", 7)}


def test_the_space_that_a_group_says_holds_for_its_rows(sound: Callable[..., RegisterMap]) -> None:
    content = text("{at: 8, name: Seven}").replace("{access: rw}", "{access: r, space: input}")
    found = sound(
        content.replace("modicon", "list").replace(
            "groups:", "notations: [{name: list, space: input, offset: 1}]\ngroups:"
        )
    )
    assert addresses(found) == {"seven": ("input", 7)}


def test_registers_of_a_block_count_from_its_base(sound: Callable[..., RegisterMap]) -> None:
    chain = "chains: {c: {at: [0], marker: [1, 2]}}\nblocks: {b: {chain: c, id: 7}}\nwritten_in: modicon"
    assert addresses(sound(text("{at: 2, name: Two}", top=chain, group="    block: b\n"))) == {"two": ("holding", 2)}


def test_reserved_and_unused_addresses_and_commands_are_written_so_too(sound: Callable[..., RegisterMap]) -> None:
    tail = """\
reserved: [{at: 30011..30012}]
unused: [{at: 40013}]
commands:
  one: {name: One, source: "1", steps: [{at: 40101, words: [1]}]}
  coil: {name: Coil, source: "1", steps: [{at: 4, words: [1]}]}
  coils: {name: Coils, source: "1", steps: [{at: 4, words: [1, 0]}]}
"""
    found = sound(text("{at: 40001, name: First}", tail=tail))
    (model,) = found.models
    steps = {command.id: command.steps[0] for command in model.commands}

    assert found.reserved == (("input", 10, 11),)
    assert model.unused == (("holding", 12, 12),)
    assert {name: (step.address, step.function) for name, step in steps.items()} == {
        "one": (100, 6),
        "coil": (3, 5),
        "coils": (3, 15),
    }


def test_what_a_worked_example_says_is_what_the_frame_says(sound: Callable[..., RegisterMap]) -> None:
    tail = 'examples: [{source: "1", frame: 01 03 00 00 00 01 84 0A, function: 3, address: 0, count: 1}]\n'
    assert addresses(sound(text("{at: 40001, name: First}", tail=tail))) == {"first": ("holding", 0)}


def test_an_extension_and_its_base_are_each_written_in_their_own_way(
    maps: Maps, sound: Callable[..., RegisterMap]
) -> None:
    maps("acme/base", text("{at: 40001, name: First}", "{at: 40002, name: Second}").replace("acme/one", "acme/base"))
    tail = """\
extends: acme/base
override: [{register: second, reason: it moved, set: {at: 19}}]
"""
    content = text(
        "{at: 11, name: Third}", top="notations: [{name: list, space: holding, offset: 1}]\nwritten_in: list", tail=tail
    )
    found = sound(content.replace("{A: {}}", "{A: {from: A}}").replace("id: g", "id: h"))

    assert addresses(found) == {"first": ("holding", 0), "second": ("holding", 18), "third": ("holding", 10)}


def test_a_library_is_written_in_its_own_way(maps: Maps, sound: Callable[..., RegisterMap]) -> None:
    library = "format: 1\nlibrary: {id: acme/numbers, title: Numbers}\nwritten_in: modicon\n"
    path = maps("acme/numbers.library", f"{library}sets: {{pair: [{{at: 30005, name: Low, access: r}}]}}\n")
    found = sound(text("{set: pair, shift: 2}", "{at: 9, name: Own}", top="uses: [acme/numbers]"))

    assert compile_map(path).diagnostics == ()
    assert addresses(found) == {"low": ("input", 6), "own": ("holding", 9)}


def test_the_docs_show_the_wire_address_and_the_number_of_the_manual(sound: Callable[..., RegisterMap]) -> None:
    page = render(sound(text("{at: 40011, name: Ten}", "{at: 300012, name: Eleven, access: r}")))["docs/acme/one.md"]

    assert "| 10 (0xA) | 40011 | [Ten](#register-ten) |" in page
    assert "| Wire address | 10 (0xA, Modicon 40011) |" in page
    assert "| 11 (0xB) | 300012 | [Eleven](#register-eleven) |" in page


def test_a_manual_that_prints_hexadecimal_addresses_is_shown_so(sound: Callable[..., RegisterMap]) -> None:
    top = "notations: [{name: manual, space: holding, offset: 0, base: 16}]\nwritten_in: manual"
    page = render(sound(text("{at: 0x3100, name: Level}", top=top)))["docs/acme/one.md"]

    assert "| 12544 | 0x3100 | 412545 | [Level](#register-level) |" in page
    assert "| Wire address | 12544 (manual 0x3100, Modicon 412545) |" in page


def test_messages_show_the_number_of_the_manual_and_the_wire_address(maps: Maps) -> None:
    (found,) = compile_map(maps("acme/one", text("{at: 40001, name: First}", "{at: 40001, name: Again}"))).diagnostics

    assert found.rule == "RS0401"
    assert found.message == "`again` (Modicon 40001) takes holding 0, which overlaps holding 0 of `first`"
    assert (found.span.line, found.span.column) == (14, 27)


@pytest.mark.parametrize(
    ("row", "column", "message"),
    [
        ("{at: 50001, name: Far}", 14, "50001 is no number of `modicon`, which it is written in"),
        (
            "{at: 30001, name: A, space: holding}",
            14,
            "30001 is no number in holding of `modicon`, which it is written in",
        ),
        ("{at: 40001, name: A, aliases: [50002]}", 40, "50002 is no number of `modicon`, which it is written in"),
    ],
)
def test_a_number_that_the_notation_does_not_have_is_an_error_at_its_place(
    maps: Maps, row: str, column: int, message: str
) -> None:
    (found,) = compile_map(maps("acme/one", text(row))).diagnostics

    assert (found.rule, found.message) == ("RS0515", message)
    assert (found.span.line, found.span.column) == (13, column)
    assert "40001..49999 (holding)" in found.help


def test_an_unknown_notation_asks_whether_another_was_meant(maps: Maps) -> None:
    (found,) = compile_map(maps("acme/one", text("{at: 1, name: A}", top="written_in: modcon"))).diagnostics

    assert (found.rule, found.span.line, found.span.column) == ("RS0514", 6, 13)
    assert found.help == "did you mean `modicon`? there are: modicon, wire"


def test_rows_that_begin_at_40001_ask_whether_they_are_written_in_a_notation(maps: Maps) -> None:
    found = compile_map(maps("acme/one", text("{at: 40001, name: A}", top="notes: [none]"))).diagnostics

    assert [one.rule for one in found] == ["RS0673"]
    assert "`written_in`" in found[0].help
