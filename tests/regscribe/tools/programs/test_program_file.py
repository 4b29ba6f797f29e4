"""Programs as files: what a person may write, what is refused with its place, and what comes out again."""

from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.tools import programs
from regscribe.tools.live.errors import TargetError
from regscribe.tools.programs import Amount, Final, Program, Segment, setting

SHORT = """\
format: 1
program:
  segments:
    - {to: 20, ramp: 5 min}
"""


def load(folder: Path, text: str) -> Program:
    path = folder / "short.yaml"
    path.write_text(text, encoding="utf-8")
    return programs.load(path).program


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("250 °C", Amount(Decimal(250), "°C")),
        ("-0.5°F", Amount(Decimal("-0.5"), "°F")),
        ("  30   min ", Amount(Decimal(30), "min")),
        ("1 h 30 min", Amount(Decimal(90), "min")),
        ("1d 2 h", Amount(Decimal(26), "h")),
        ("1 h 0 min 5 s", Amount(Decimal(3605), "s")),
        ("12 raw", Amount(Decimal(12), "raw")),
        ("7", Amount(Decimal(7))),
        ("OFF", "OFF"),
        ("1 h later", Amount(Decimal(1), "h later")),
    ],
)
def test_a_setting_is_a_number_with_a_unit_or_a_name(text: str, meant: object) -> None:
    assert setting(text) == meant


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (SHORT.replace("ramp: 5 min", "rmap: 5 min"), "short.yaml:4:16: unknown key `rmap`"),
        (SHORT.replace(", ramp: 5 min", ""), "short.yaml:4:7: "),
        (SHORT.replace("to: 20", "to: [20]"), "short.yaml:4:12: "),
        (SHORT.replace("format: 1", "format: 2"), "short.yaml:1:9: "),
        (SHORT.replace("  segments:", "  cycles: often\n  segments:"), "short.yaml:3:11: "),
        (SHORT.replace("  segments:", "  time_unit: week\n  segments:"), "short.yaml:3:14: "),
        (SHORT + "  segments: []\n", "short.yaml:5:3: "),
        ("a: [", "short.yaml:1"),
        ("", "short.yaml:1"),
    ],
)
def test_a_mistake_in_a_file_is_told_with_line_and_column(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(TargetError) as caught:
        load(tmp_path, text)
    assert says in str(caught.value)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(TargetError, match=r"there is no file .*none\.yaml"):
        programs.load(tmp_path / "none.yaml")


def test_a_problem_of_the_device_has_its_place_in_the_file(tmp_path: Path) -> None:
    path = tmp_path / "short.yaml"
    path.write_text(SHORT, encoding="utf-8")
    found = programs.load(path)

    assert found.place(("segments", 0, "to")).endswith("short.yaml:4:12")
    assert found.place(("segments", 0, "outputs", "op3")).endswith("short.yaml:4:7")


_numbers = st.decimals(-(10**6), 10**6, places=2).map(lambda number: number.normalize() + 0)
_amounts = st.builds(Amount, _numbers, st.sampled_from(["", "°C", "°F", "K", "min", "s", "raw", "%"]))
_names = st.from_regex(r"[A-Z][A-Z0-9_]{0,20}", fullmatch=True)
_settings = st.one_of(_amounts, _names)
_outputs = st.dictionaries(st.from_regex(r"[a-z][a-z0-9_]{0,9}", fullmatch=True), _names, max_size=3)
_segments = st.builds(Segment, to=_settings, ramp=_settings, soak=st.none() | _settings, outputs=_outputs)
_programs = st.builds(
    Program,
    name=st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=20),
    segments=st.lists(_segments, max_size=4).map(tuple),
    final=st.none() | st.builds(Final, to=_settings, outputs=_outputs),
    number_of_segments=st.none() | st.integers(0, 20),
    cycles=st.none() | st.integers(0, 9999) | st.just("forever"),
    time_unit=st.none() | st.sampled_from(["s", "min", "h", "d"]),
    holdback=st.none() | _settings,
    power_failure=st.none() | _names,
    end=st.none() | _names,
    model=st.sampled_from(["", "16C", "25"]),
)


@given(_programs)
def test_whatever_is_dumped_is_loaded_as_the_same(tmp_path_factory: pytest.TempPathFactory, program: Program) -> None:
    path = tmp_path_factory.getbasetemp() / "any.yaml"
    path.write_text(programs.dump(program), encoding="utf-8")
    found = programs.load(path).program

    assert (found, found.name, found.model) == (program, program.name, program.model)
