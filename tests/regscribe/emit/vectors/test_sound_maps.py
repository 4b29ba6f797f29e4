"""Maps without a fault: the generated tests pass on their drivers, and fail on a driver that is broken."""

import sys
from collections.abc import Callable
from importlib.machinery import ModuleSpec
from importlib.util import module_from_spec
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from regscribe import checks, lower, schema, source
from regscribe.emit import render
from regscribe.emit.write import write
from regscribe.model import RegisterMap, Severity
from regscribe_runtime.registers import codec

HEAD = """\
format: 1
map: {id: test/sound, title: Sound, maker: Test, class_prefix: Sound}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [1, 2, 3, 4, 5, 6, 7, 15, 16]}
"""
GROUP = """\
groups:
  - id: all
    name: All
    source: "1"
    registers:
"""

SOUND = {
    "nothing can be written": (
        "- {at: 0, name: A, access: r}\n- {at: 1, name: B, type: int16, decimals: 1, access: r}"
    ),
    "nothing can be read": "- {at: 0, name: A, access: w}\n- {at: 1, name: B, type: string, length: 2, access: w}",
    "truth in words": (
        "- {at: 0, name: A, kind: boolean, access: rw}\n- {at: 1, name: B, type: uint32, kind: boolean, access: rw}"
    ),
    "parts of a signed word": (
        "- {at: 0, name: A, type: int16, access: rw, fields: {x: {bits: 0..3}, y: {bits: 12..15}}}"
    ),
    "halves that are whole": "- {at: 0, name: A, multiply: 0.5, kind: integer, access: rw}",
    "odd steps that are whole": "- {at: 0, name: A, multiply: 0.75, add: 1.5, kind: integer, access: rw}",
    "a fault while no scale holds": (
        "- {at: 0, name: M, access: rw, enum: {0: a, 1: b}}\n"
        "- {at: 1, name: V, type: int16, access: rw, scale: s, sentinels: {-1: none}}"
    ),
    "limits in registers while no scale holds": (
        "- {at: 0, name: M, access: rw, enum: {0: a, 1: b}}\n- {at: 1, name: Low, access: rw}\n"
        "- {at: 2, name: V, type: int16, access: rw, scale: s, range: {from: low, to: 500}}"
    ),
    "faults among bits": (
        "- {at: 0, name: A, type: int16, access: rw, fields: {x: {bits: 0..3}}, sentinels: {0: none, -1: bad}}\n"
        "- {at: 1, name: B, access: rw, flags: {3: b, 7: c}, sentinels: {0: none, 136: bad}}"
    ),
    "steps of a thousand": (
        "- {at: 0, name: A, type: uint64, multiply: 1000, access: rw, sentinels: {0: none}}\n"
        "- {at: 4, name: B, type: int16, multiply: -10, add: 7, access: rw}"
    ),
    "two equal views": (
        "- {at: 0, name: A, views: twice, access: rw, range: 0..100}\n- {at: 1, name: B, views: twice, access: r}"
    ),
    "a float that is a tenth": "- {at: 0, name: A, views: tenth, access: rw}",
    "floats that are more than tenths": (
        "- {at: 0, name: A, type: float32, multiply: 0.3, add: -7.7, range: -50..50, access: rw}\n"
        "- {at: 2, name: B, type: float64, add: 0.5, access: rw}\n"
        "- {at: 6, name: C, type: float32, multiply: 0.3, kind: integer, access: rw}"
    ),
    "ids in small letters": (
        "- {at: 0, name: A, access: rw, flags: {0: {label: x, id: fl14}, 1: {label: y, id: Id2}}}\n"
        "- {at: 1, name: E, access: rw, enum: {0: {label: z, id: aB}, 1: {label: q, id: CD}}}"
    ),
    "texts of one word": "- {at: 0, name: A, type: string, length: 1, access: rw}",
    "bits": "- {at: 0, name: A, space: coil, access: rw}\n- {at: 0, name: B, space: discrete, access: r}",
    "frames of coils, of another view and of an alias": (
        "- {at: 20, name: Framed, space: coil, access: rw}\n- {at: 21, name: Next, space: coil, access: rw}\n"
        "- {at: 30, name: Level, views: tens, aliases: [40], access: rw}"
    ),
    "numbers beyond a double": "- {at: 0, name: A, type: float64, multiply: 1.0e+300, access: rw}",
    "wide whole numbers": "- {at: 0, name: A, type: uint64, multiply: 7, add: 3, access: rw}",
    "faults and special values in floats": (
        "- {at: 0, name: A, type: float32, access: rw, sentinels: {nan: n, -9999.9: b}}\n"
        "- {at: 2, name: B, type: float32, access: rw, range: -5..5, special: {99.9: d}}"
    ),
    "every order": (
        "- {at: 0, name: A, type: uint32, byte_order: little, access: rw}\n"
        "- {at: 2, name: B, type: float32, word_order: little, byte_order: little, access: rw}\n"
        "- {at: 4, name: C, type: string, length: 2, word_order: little, access: rw}\n"
        "- {at: 6, name: D, type: int16, byte_order: little, access: rw}"
    ),
    "special values that decimals divide": (
        "- {at: 0, name: P, range: 0..2, access: rw}\n"
        "- {at: 1, name: T, decimals: d, range: 0..100, range_decimals: d, special: {2000: two}, access: rw}"
    ),
}
TABLES = {
    "scale: s": "scales: {s: [{when: {m: 1}, multiply: 0.1}]}\n",
    "views: twice": "views: {twice: {base: {type: int16}, again: {offset: 100, type: int16}}}\n",
    "views: tens": (
        "views: {tens: {base: {type: int16}, wide: {offset: 100, type: int16, factor: 10}}}\n"
        "examples:\n"
        "  - {source: '1', frame: 01 05 00 14 FF 00, crc: false, writes: {framed: 1}}\n"
        "  - {frame: 01 0F 00 14 00 02 01 02, crc: false, writes: {framed: 0, next: 1}}\n"
        "  - {source: '1', frame: 01 06 00 82 00 46, crc: false, writes: {level: 7}}\n"
        "  - {source: '1', frame: 01 06 00 28 00 07, crc: false, writes: {level: 7}}\n"
    ),
    "views: tenth": "views: {tenth: {base: {type: float32, factor: 0.1, stride: 2}}}\n",
    "decimals: d": "decimals: {d: {register: p}}\n",
}


def _text(registers: str) -> str:
    tables = "".join(table for key, table in TABLES.items() if key in registers)
    return HEAD + tables + GROUP + "".join(f"      {line}\n" for line in registers.splitlines())


def _module(name: str, code: str, path: Path) -> ModuleType:
    module = module_from_spec(ModuleSpec(name, None))
    module.__file__ = str(path)
    exec(compile(code, str(path), "exec"), vars(module))  # noqa: S102 (generated just now)
    return module


def _compiled(text: str) -> RegisterMap:
    document, found = source.parse(text, name="maps/test/sound.yaml")
    assert document is not None, found
    assert schema.validate(document) == []
    register_map, found = lower.lower(document)
    assert register_map is not None, found
    assert [one for one in checks.check(register_map) if one.severity is Severity.ERROR] == []
    return register_map


def _generated_tests(text: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, Callable[[], None]]]:
    """The tests that are generated for a map, each ready to be called for each of its models."""
    files = render(_compiled(text))
    write(files, folder)
    for name in ("regscribe_devices.test", "regscribe_devices.test.sound"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))  # to be forgotten after the test
        del sys.modules[name]
    test = next(name for name in files if name.startswith("tests/"))
    module = _module("generated_test", files[test], folder / test)
    found = []
    for name, function in vars(module).items():
        if name.startswith("test_"):
            (mark,) = (one for one in function.pytestmark if one.name == "parametrize")
            found += [(name, lambda function=function, bench=bench: function(bench)) for bench in mark.args[1]]
    return found


@pytest.mark.parametrize("registers", SOUND.values(), ids=SOUND)
def test_the_generated_tests_pass(registers: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tests = _generated_tests(_text(registers), tmp_path, monkeypatch)

    assert len(tests) >= 8
    for _, test in tests:
        test()


def _failing(tests: list[tuple[str, Callable[[], None]]]) -> set[str]:
    failed = set()
    for name, test in tests:
        try:
            test()
        except (AssertionError, ExceptionGroup):
            failed.add(name)
    return failed


@pytest.mark.parametrize(
    ("registers", "broken"),
    [
        (SOUND["every order"], "arranger"),
        (SOUND["faults and special values in floats"], "_faults"),
        (SOUND["special values that decimals divide"], "_specials"),
        (SOUND["a fault while no scale holds"], "_faults"),
    ],
)
def test_a_broken_driver_fails_them(
    registers: str, broken: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    harmless: dict[str, Any] = {
        "arranger": lambda *_, **__: lambda words: words,
        "_faults": lambda *_: {},
        "_specials": lambda *_: {},
    }
    tests = _generated_tests(_text(registers), tmp_path, monkeypatch)
    monkeypatch.setattr(codec, broken, harmless[broken])

    assert "test_words_decode_to_the_values_of_the_vectors" in _failing(tests)
