"""Random arrays in arrays: each name means the register that a reader of the map would look for, from inside out."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from regscribe_runtime.values.views import scale_needs

HEAD = """\
format: 1
map: {id: test/random, title: Random, maker: Nobody, class_prefix: Random}
manual: {title: None}
models: {One: {}}
"""
NAMES = ("a", "b", "c")


@dataclass
class Level:
    """An array (or the device itself): how its elements are numbered, what stands in one, and the arrays in it.

    Each of `registers` has the name of a register by which its decimals, its limit and its permission are told.
    """

    first: int = 1
    count: int = 1
    registers: dict[str, str] = field(default_factory=dict)
    inner: list["Level"] = field(default_factory=list)


def levels(depth: int) -> st.SearchStrategy[Level]:
    inner = st.lists(levels(depth - 1), max_size=2) if depth else st.just([])
    registers = st.dictionaries(st.sampled_from(NAMES), st.sampled_from(NAMES), max_size=3)
    return st.builds(Level, first=st.integers(0, 3), count=st.integers(1, 3), registers=registers, inner=inner)


def size(level: Level) -> int:
    """How many addresses an element takes."""
    return 2 * len(level.registers) + 1 + sum(one.count * size(one) for one in level.inner)


def lines(level: Level, at: int, indent: str = "      ") -> Iterator[str]:
    """The registers of a level from an address on."""
    yield f"{indent}- {{at: {at}, id: there, name: There}}"
    for name, asked in level.registers.items():
        yield f"{indent}- {{at: {at + 1}, id: {name}, name: Digits {name}, range: 0..3}}"
        yield (
            f"{indent}- {{at: {at + 2}, id: {name}_value, name: Value {name}, decimals: by_{asked}, "
            f"range: {{from: 0, to: {asked}}}, writable: {{when: {{{asked}: 0..9}}, reason: so}}, unit: of_{asked}}}"
        )
        at += 2
    at += 1
    for place, one in enumerate(level.inner):
        yield f"{indent}- id: rows{place}"
        yield f"{indent}  name: Row"
        yield f"{indent}  repeat: {one.first}..{one.first + one.count - 1}"
        yield f"{indent}  stride: {size(one)}"
        yield f"{indent}  registers:"
        yield from lines(one, at, f"{indent}    ")
        at += one.count * size(one)


def expected(level: Level, known: set[str], around: tuple[str, ...] = ("",)) -> Iterator[tuple[str, str]]:
    """The path of each value, and of the register that it asks for: looked for in each element from inside out."""
    for name, asked in level.registers.items():
        yield f"{around[0]}{name}_value", next(f"{one}{asked}" for one in around if f"{one}{asked}" in known)
    for place, one in enumerate(level.inner):
        for index in range(one.first, one.first + one.count):
            yield from expected(one, known, (f"{around[0]}rows{place}[{index}].", *around))


def paths(level: Level, prefix: str = "") -> Iterator[str]:
    yield from (f"{prefix}{name}" for name in level.registers)
    for place, one in enumerate(level.inner):
        for index in range(one.first, one.first + one.count):
            yield from paths(one, f"{prefix}rows{place}[{index}].")


def every_name(level: Level) -> Level:
    """The same with all names at the top, so that each is found somewhere."""
    return Level(1, 1, {name: name for name in NAMES}, level.inner)


@settings(max_examples=15, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))
@given(level=levels(2))
def test_whatever_stands_in_whichever_array_means_the_nearest_of_its_name(
    build: Callable[[str], Any], level: Level
) -> None:
    whole = every_name(level)
    tables = "decimals:\n" + "".join(f"  by_{name}: {{register: {name}}}\n" for name in NAMES)
    tables += "units:\n" + "".join(
        f"  of_{name}: [{{when: {{{name}: 1}}, symbol: s}}, {{symbol: h}}]\n" for name in NAMES
    )
    head = "groups:\n  - id: main\n    name: Main\n    each: {access: rw, type: int16}\n    registers:\n"
    text = HEAD + tables + head + "\n".join(lines(whole, 0)) + "\n"
    built = build(text)
    registers = built.driver("One").registers

    wanted = dict(expected(whole, set(paths(whole))))
    assert set(wanted) == {path for path in registers if re.search(r"\b\w_value$", path)}
    for path, asked in wanted.items():
        one = registers[path]
        assert scale_needs(one) == (asked,), path
        assert one.limit_needs == (asked,), path
        assert one.writable.when.registers == (asked,), path
        assert one.unit[0].when.registers == (asked,), path
    for model in built.map.models:
        for register in model.registers:
            assert registers[register.path].at == register.address
