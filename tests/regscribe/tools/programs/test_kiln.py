"""What the made-up kiln adds: scales that are stated, a manual that forbids writing, an order of its own, danger."""

from collections.abc import Callable
from decimal import Decimal
from pathlib import Path

import pytest

from regscribe.tools import programs
from regscribe.tools.live.errors import TargetError
from regscribe.tools.programs import NotNow, Program, ProgramRefused, ProgramRuns, ProgramSlot
from regscribe_runtime import RegscribeError, ValueRefused

from .conftest import Bench, Built

GLAZE = """\
format: 1
program:
  cycles: 2
  time_unit: min
  holdback: 2.5 °C
  segments:
    - {to: 600 °C, ramp: 4 h, soak: 30 min, outputs: {fan: SLOW}}
    - {to: 1240 °C, ramp: 250 min, soak: 0 min, outputs: {fan: "OFF"}}
"""


def given(folder: Path, text: str) -> Program:
    path = folder / "program.yaml"
    path.write_text(text, encoding="utf-8")
    return programs.load(path).program


@pytest.fixture
def first(kiln: Bench) -> ProgramSlot:
    return programs.place(kiln.device, "recipe 1")


@pytest.fixture
def problems(kiln: Bench, first: ProgramSlot, tmp_path: Path) -> Callable[..., list[str]]:
    """What is wrong with the glaze after replacing parts of its text; nothing may have been written."""

    def found(*changes: tuple[str, str], text: str = GLAZE) -> list[str]:
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        program = given(tmp_path, text)
        with pytest.raises(ProgramRefused) as caught:
            kiln.device.run(programs.write(first, program))
        assert kiln.written == []
        checked = kiln.device.run(programs.check(first, program))
        assert checked.problems == caught.value.problems
        return [str(one) for one in checked.problems]

    return found


def test_a_program_in_stated_units_comes_back(kiln: Bench, first: ProgramSlot, tmp_path: Path) -> None:
    program = given(tmp_path, GLAZE.replace("4 h", "240 min"))
    kiln.device.run(programs.write(first, program))

    assert kiln.device.run(programs.read(first)) == program


def test_times_are_converted_to_the_unit_that_the_program_sets(kiln: Bench, first: ProgramSlot, tmp_path: Path) -> None:
    kiln.device.run(programs.write(first, given(tmp_path, GLAZE)))

    assert kiln.running.device.peek("recipes[1].steps[0].ramp_time") == 240
    assert kiln.device.run(programs.read(first)).segments[0].ramp == programs.Amount(Decimal(240), "min")


def test_the_order_of_the_map_counts(kiln: Bench, first: ProgramSlot, tmp_path: Path) -> None:
    kiln.device.run(programs.write(first, given(tmp_path, GLAZE)))

    assert kiln.written.index(100) < kiln.written.index(110)


def test_the_first_segment_is_not_counted_where_the_map_says_so(
    kiln: Bench, first: ProgramSlot, tmp_path: Path
) -> None:
    kiln.device.run(programs.write(first, given(tmp_path, GLAZE)))

    assert kiln.running.device.peek("recipes[1].number_of_segments") == 1
    assert kiln.device.run(programs.read(first)).number_of_segments is None


def test_a_setpoint_beyond_the_present_limits_is_refused_with_the_numbers(
    kiln: Bench, problems: Callable[..., list[str]]
) -> None:
    kiln.poke(highest_setpoint=1200)

    assert problems() == ["segment 1, to: 1240 lies outside 0 to 1200"]


def test_every_mistake_is_told_at_once(problems: Callable[..., list[str]]) -> None:
    found = problems(("to: 600 °C", "to: 600 °F"), ("fan: SLOW", "fan: SLWO"), ("holdback: 2.5", "holdback: 0.2"))

    assert [one.split(":")[0] for one in found] == ["holdback", "segment 0, to", "segment 0, outputs.fan"]
    assert "0.2 lies outside 0.5 to 20" in found[0]
    assert "did you mean `SLOW`" in found[2]
    assert "the device works in °C" in found[1]


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("ramp: 4 h", "ramp: 240", "segment 0, ramp: `240`: the number has no unit"),
        ("ramp: 4 h", "ramp: 4 °C", "°C is no unit of time"),
        ("ramp: 4 h", "ramp: 90 s", "the device counts whole min, and this is 1.5 min"),
        ("ramp: 4 h", "ramp: 10 h", "600 lies outside 0 to 500"),
        ("ramp: 4 h", "ramp: 240 raw", "the scale is known here"),
        ("ramp: 4 h", "ramp: never", "`never` is no number"),
        ("to: 600 °C", "to: 600.5 °C", "600.5 is no whole number"),
        ("time_unit: min", "time_unit: h", "there is no unit of time `h` in the K1"),
        ("  time_unit: min\n", "", "time_unit: it is missing: say in what the times count, one of s, min"),
        ("cycles: 2", "cycles: 100", "cycles: 100 lies outside 1 to 99"),
        ("cycles: 2", "cycles: 0", "cycles: 0 stands for a program without end: write `forever`"),
        ("holdback: 2.5 °C", "holdback: 2.55 °C", "2.55 is finer"),
        ("holdback: 2.5 °C", "end: STOP", "end: the K1 has no such setting: remove `end`"),
        (", outputs: {fan: SLOW}", "", "`fan` is missing, and the manual has no default: give one of OFF, SLOW, FAST"),
        ("fan: SLOW", "fan: SLOW, vent: OPEN", "there is no output `vent` in the K1"),
        ("  segments:", "  number_of_segments: 4\n  segments:", "4, but 2 segments are 1 as the device counts them"),
        ("  segments:", "  final: {to: 20 °C}\n  segments:", "final: the K1 has no such setting"),
    ],
)
def test_a_mistake_is_refused_with_its_place_and_a_way_out(
    problems: Callable[..., list[str]], old: str, new: str, says: str
) -> None:
    assert says in "\n".join(problems((old, new)))


def test_more_segments_than_the_device_has_are_refused(problems: Callable[..., list[str]]) -> None:
    line = '    - {to: 20 °C, ramp: 1 min, outputs: {fan: "OFF"}}\n'

    assert problems(text=GLAZE + 5 * line) == ["segments: 7 segments, but the K1 has 6: leave some out (0 to 5)"]


def test_a_program_without_segments_is_refused(problems: Callable[..., list[str]]) -> None:
    empty = GLAZE.partition("  segments:")[0] + "  segments: []\n"

    assert problems(text=empty) == ["segments: there are none: a program has at least one"]


@pytest.mark.parametrize(("state", "word"), [(1, "RUNNING"), (2, "WAITING"), (3, "PAUSED")])
def test_nothing_is_written_while_a_program_runs(
    kiln: Bench, first: ProgramSlot, tmp_path: Path, state: int, word: str
) -> None:
    kiln.poke(state=state)

    with pytest.raises(ProgramRuns, match=rf"\({word}\).*nothing was written"):
        kiln.device.run(programs.write(first, given(tmp_path, GLAZE)))
    assert kiln.written == []


def test_what_the_manual_forbids_while_it_runs_cannot_be_forced(
    kiln: Bench, first: ProgramSlot, tmp_path: Path
) -> None:
    kiln.poke(state=1)

    with pytest.raises(ProgramRuns, match="the manual forbids"):
        kiln.device.run(programs.write(first, given(tmp_path, GLAZE), while_running="write"))
    assert kiln.written == []


def test_it_can_be_started_held_and_reset(kiln: Bench, first: ProgramSlot) -> None:
    order = kiln.running.device.peek
    kiln.device.run(programs.act(first, "start"))
    assert order("order_1") == 1
    kiln.poke(state=1)
    kiln.device.run(programs.act(first, "hold"))
    assert order("order_1") == 2
    kiln.poke(state=3)
    kiln.device.run(programs.act(first, "reset"))
    assert order("order_1") == 0


def test_the_second_program_is_started_by_its_own_register_and_only_if_the_danger_is_known(kiln: Bench) -> None:
    second = programs.place(kiln.device, "2")

    with pytest.raises(ValueRefused, match="no door switch"):
        kiln.device.run(programs.act(second, "start"))
    kiln.device.run(programs.act(second, "start", confirm=True))
    assert (kiln.running.device.peek("order_1"), kiln.running.device.peek("order_2")) == (0, 1)


def test_an_act_that_means_nothing_now_is_refused(kiln: Bench, first: ProgramSlot) -> None:
    for state, act in [(0, "hold"), (0, "reset"), (1, "start"), (3, "start"), (3, "hold")]:
        kiln.poke(state=state)
        with pytest.raises(NotNow, match=f"nothing to {act}"):
            kiln.device.run(programs.act(first, act))
    with pytest.raises(NotNow, match="names no way to resume"):
        kiln.device.run(programs.act(first, "resume"))
    assert kiln.written == []


def test_the_state_tells_what_runs_and_where(kiln: Bench, first: ProgramSlot) -> None:
    kiln.poke(state=2, segment_now=4, program_now=2)

    assert kiln.device.run(programs.status(first)) == programs.ProgramState(
        state="running", detail="WAITING", program=2, segment=4
    )


def test_a_code_that_the_map_does_not_know_is_no_state(kiln: Bench, first: ProgramSlot, tmp_path: Path) -> None:
    kiln.poke(state=9)

    assert kiln.device.run(programs.status(first)).state == "unknown"
    with pytest.raises(ProgramRuns):
        kiln.device.run(programs.write(first, given(tmp_path, GLAZE)))


def test_a_write_that_breaks_off_is_given_back(kiln: Bench, first: ProgramSlot, tmp_path: Path) -> None:
    kiln.device.run(programs.write(first, given(tmp_path, GLAZE)))
    before = kiln.device.run(programs.read(first))
    kiln.running.device.handle, sound = _refusing(112, kiln.running.device.handle), kiln.running.device.handle
    with pytest.raises(RegscribeError, match="given back"):
        kiln.device.run(
            programs.write(first, given(tmp_path, GLAZE.replace("30 min", "31 min").replace("cycles: 2", "cycles: 3")))
        )
    kiln.running.device.handle = sound

    assert kiln.device.run(programs.read(first)) == before


def _refusing(address: int, handle: Callable[..., bytes | None]) -> Callable[..., bytes | None]:
    """A device that refuses to have one address written."""

    def refuse(pdu: bytes, **more: bool) -> bytes | None:
        first = int.from_bytes(pdu[1:3])
        many = int.from_bytes(pdu[3:5]) if pdu[0] == 16 else 1
        if pdu[0] in {6, 16} and first <= address < first + many:
            return bytes((pdu[0] | 0x80, 4))
        return handle(pdu, **more)

    return refuse


def test_a_program_is_found_by_name_or_number(kiln_map: Built) -> None:
    assert [one.name for one in programs.places(kiln_map.driver)] == ["recipe 1", "recipe 2"]
    assert programs.place(kiln_map.driver, "2").number == 2
    with pytest.raises(TargetError, match="name one of recipe 1, recipe 2"):
        programs.place(kiln_map.driver)
    with pytest.raises(TargetError, match="did you mean `recipe 1`"):
        programs.place(kiln_map.driver, "recip 1")
