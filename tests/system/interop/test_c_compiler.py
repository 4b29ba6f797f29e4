"""Compilers take the header, and a C program that knows its constants alone reads what our driver reads."""

import subprocess
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from itertools import chain
from pathlib import Path

import pytest

from regscribe import plugins
from regscribe.model import Kind, Register, Space
from regscribe.plugins import OptionError
from regscribe.simulate import find_map

from ...conformance.suite import cases, diagnose, whole_map  # noqa: TID252 (tests are no package)
from .stage import Stage

pytestmark = pytest.mark.interop("c-compiler")

STRICT = ("-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wconversion")
COMPILERS = {"c99": ("gcc", "-std=c99", "-x", "c"), "c++11": ("g++", "-std=c++11", "-x", "c++")}
HERE = Path(__file__).parent
SHIPPED = sorted((HERE.parents[2] / "maps").glob("*/*.yaml"))
MODELS = [(path, model.name) for path in SHIPPED if ".library." not in path.name for model in find_map(path).models]
FEWEST = 150
"""Cases that a header says something of."""

STRUCTURED = frozenset({"float16", "ipv4", "eui48", "bytes", "datetime"})
"""Types whose numbers a C program needs more than shifts for."""

each_compiler = pytest.mark.parametrize("language", COMPILERS)


def compiled(language: str, source: str, folder: Path, name: str = "program") -> Path:
    """Compile a program without a warning."""
    (folder / f"{name}.in").write_text(source, encoding="utf-8")
    command = [*COMPILERS[language], *STRICT, "-I", str(folder), "-o", str(folder / name), str(folder / f"{name}.in")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)  # noqa: S603 - our own text
    assert done.returncode == 0, done.stderr
    return folder / name


@each_compiler
def test_the_headers_of_all_shipped_models_compile_side_by_side(language: str, tmp_path: Path) -> None:
    assert len(MODELS) > 15
    for number, (path, model) in enumerate(MODELS):
        options = {one.name: one.default for one in plugins.exporter("c-header").options} | {"model": model}
        made = plugins.export("c-header", [find_map(path)], options)
        (tmp_path / f"model_{number}.h").write_text(str(made.texts[""]), encoding="utf-8")
    includes = "".join(f'#include "model_{number}.h"\n' for number in [*range(len(MODELS)), 0])
    compiled(language, f"{includes}int main(void) {{ return 0; }}\n", tmp_path)


@each_compiler
def test_the_headers_of_all_cases_compile(language: str, tmp_path: Path) -> None:
    options = {one.name: one.default for one in plugins.exporter("c-header").options}
    sound = [case for case in cases() if case.rows and not case.refused and not case.place]
    for number, case in enumerate(sound):
        register_map, found = diagnose(whole_map(case.map))
        assert register_map is not None, found
        with suppress(OptionError):  # it can say nothing of the case
            text = plugins.export("c-header", [register_map], options).texts[""]
            (tmp_path / f"case_{number}.in").write_text(str(text), encoding="utf-8")
    files = sorted(map(str, tmp_path.iterdir()))
    assert len(files) > FEWEST
    command = [*COMPILERS[language], *STRICT, "-fsyntax-only", *files]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)  # noqa: S603 - our own text
    assert done.stderr == ""


@each_compiler
def test_a_program_of_its_constants_reads_what_our_driver_reads(stage: Stage, language: str, tmp_path: Path) -> None:
    (tmp_path / "device.h").write_text(stage.text("c-header"), encoding="utf-8")
    decoder = (HERE / "decoder.c").read_text(encoding="utf-8")
    program = compiled(language, f"{decoder}\n{held(stage)}\n{calls(stage)}", tmp_path)
    done = subprocess.run([program], capture_output=True, timeout=60, check=True)  # noqa: S603 - our own text
    printed = dict(line.split(" ", 1) for line in done.stdout.decode("latin-1").strip().split("\n"))
    readable = {one.path: one for one in registers(stage)}
    wrong = {path: text for path, text in printed.items() if not agrees(stage, readable[path], text)}
    assert (wrong, printed.keys()) == ({}, readable.keys())


def registers(stage: Stage) -> list[Register]:
    """The registers that the program reads."""
    return [one for one in stage.running.device.model.registers if one.base.type not in STRUCTURED]


def held(stage: Stage) -> str:
    """What each space of the device holds, as arrays of C."""
    cells: dict[Space, list[int]] = {
        space: [0] * 256 for space in (Space.COIL, Space.DISCRETE, Space.HOLDING, Space.INPUT)
    }
    for one in stage.running.device.model.registers:
        words = stage.held[one.path].words
        cells[one.base.space][one.address : one.address + len(words)] = words
    arrays = (
        f"static const uint16_t {space.name.lower()}[] = {{{', '.join(map(str, cells[space]))}}};" for space in cells
    )
    chosen = " : ".join(f"space == INTEROPONE_SPACE_{space.name} ? {space.name.lower()}" for space in cells)
    body = f"static const uint16_t *memory(unsigned space)\n{{\n    return {chosen} : (const uint16_t *)0;\n}}"
    return "\n".join([*arrays, body])


def calls(stage: Stage) -> str:
    """A main() that reads each register by its constants."""
    return "\n".join(["int main(void)\n{", *chain.from_iterable(map(call, registers(stage))), "    return 0;\n}\n"])


def call(one: Register) -> Iterator[str]:
    """The calls of one register."""
    base = f"INTEROPONE_{one.path.replace('[1]', '').replace('[2]', '').replace('.', '_').upper()}"
    index = f"({one.index[0]})" if one.index else ""
    if one.base.space.is_bits:
        yield f'    bit_at("{one.path}", {base}_ADDR, {base}_SPACE);'
    else:
        place = ", ".join(f"{base}_{key}" for key in ("WORDS", "SPACE", "TYPE", "ORDER"))
        yield f'    words_at("{one.path}", {base}_ADDR{index}, {place});'
    if one.kind in {Kind.NUMBER, Kind.INTEGER}:
        yield f"    scale({base}_SCALE_NUM, {base}_SCALE_DEN, {base}_OFFSET_NUM, {base}_OFFSET_DEN);"


def agrees(stage: Stage, one: Register, printed: str) -> bool:
    """Whether what the program printed is the value that is held, and that our driver read."""
    expected = stage.held[one.path]
    if one.kind is Kind.STRING:
        return printed.rstrip("\0 ") == expected.value == stage.driver[one.path]
    raw, *ratios = printed.split(" ")
    if expected.fault:
        return raw == ("nan" if one.base.type.is_float else "-32768")
    slope, offset = map(Fraction, ratios) if ratios else (Fraction(1), Fraction(0))
    if one.kind is Kind.VERSION:
        return raw == "123"
    return Fraction(raw) * slope + offset == expected.number


@each_compiler
def test_codes_masks_faults_and_ends_are_those_of_the_map(stage: Stage, language: str, tmp_path: Path) -> None:
    (tmp_path / "device.h").write_text(stage.text("c-header"), encoding="utf-8")
    facts = {
        "INTEROPONE_MODE_COOL": "2",
        "INTEROPONE_TREND_FALLING": "-1",
        "INTEROPONE_CHOICE_FAST": "7",
        "INTEROPONE_STATUS_FAULT_MASK": "0x8000",
        "INTEROPONE_WIDE_STATUS_TRIP_MASK": "INT64_C(0x80000000)",
        "INTEROPONE_PARTS_LEVEL_MASK >> INTEROPONE_PARTS_LEVEL_SHIFT": "0xFF",
        "INTEROPONE_LEVEL_FAULT_SENSOR_BROKEN": "-32768",
        "INTEROPONE_SETPOINT_RAW_MIN": "-500",
        "INTEROPONE_SETPOINT_RAW_MAX": "4000",
        "INTEROPONE_LIMIT_RAW_MAX": "INT64_C(4000000000)",
        "INTEROPONE_COUNTER_RAW_MIN": "-INT64_C(1000000000000)",
        "INTEROPONE_DELAY_SPECIAL_OFF": "0",
        "INTEROPONE_CHANNELS_GAIN_ADDR(INTEROPONE_CHANNELS_GAIN_LAST)": "156",
    }
    checks = "\n".join(f"    if ((int64_t)({name}) != ({number})) return __LINE__;" for name, number in facts.items())
    program = compiled(language, f'#include "device.h"\nint main(void)\n{{\n{checks}\n    return 0;\n}}\n', tmp_path)
    assert subprocess.run([program], timeout=60, check=False).returncode == 0  # noqa: S603 - our own text
