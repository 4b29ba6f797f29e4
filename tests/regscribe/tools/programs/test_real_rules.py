"""What the real manuals ask for: raw numbers, a count that is left open, options, and limits of the controller."""

from pathlib import Path

import pytest

from regscribe.tools import programs
from regscribe.tools.live.errors import TargetError
from regscribe.tools.programs import NotNow, Program, ProgramRefused, ProgramRuns
from regscribe_devices.athena.platinum_c10_m10 import AthenaC10
from regscribe_devices.athena.platinum_m5000 import AthenaM5000
from regscribe_devices.athena.platinum_x5000 import AthenaX5000
from regscribe_devices.athena.series_c import Athena1ZC, Athena16C
from regscribe_runtime import ValueRefused

from .conftest import Bench, Serve
from .test_devices import M5000, SERIES_C, X5000


def given(folder: Path, text: str) -> Program:
    path = folder / "program.yaml"
    path.write_text(text, encoding="utf-8")
    return programs.load(path).program


def refused(bench: Bench, program: Program, name: str = "") -> str:
    with pytest.raises(ProgramRefused) as caught:
        bench.device.run(programs.write(programs.place(bench.device, name), program))
    return str(caught.value)


def test_a_number_whose_decimals_are_not_stated_must_be_given_raw(serve: Serve, tmp_path: Path) -> None:
    with serve(AthenaM5000) as bench:
        text = M5000.replace("ramp: 45 raw", "ramp: 45 h").replace("to: 250 raw", "to: 250")
        said = refused(bench, given(tmp_path, text))

    assert "segment 0, to: `250`: the manual does not state the decimals" in said
    assert "segment 1, ramp: `45 h`: the manual does not state the decimals" in said
    assert "(the device counts in h): write `45 raw`" in said


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("  number_of_segments: 2\n", "", "it is missing; .* write 2 for the 3 segments 0 to 2"),
        (
            "number_of_segments: 2",
            "number_of_segments: 3",
            r"3 for 3 segments; .* give 4 segments \(0 to 3\), or write 2",
        ),
        ('  final: {to: 20 raw, outputs: {op3: "OFF"}}\n', "", "final: it is missing"),
        ("{to: 0 raw, ramp: 1 raw,", "{to: 0 raw, ramp: 1 raw, soak: 5 raw,", "a further segment to the same setpoint"),
        ("power_failure: RAMP", "power_failure: RMAP", "did you mean `RAMP`"),
        ("cycles: forever", "cycles: 10000", "10000 lies outside 0 to 9999"),
    ],
)
def test_what_a_platinum_program_lacks_is_told(serve: Serve, tmp_path: Path, old: str, new: str, says: str) -> None:
    assert old in M5000
    with serve(AthenaM5000) as bench:
        with pytest.raises(ProgramRefused, match=says):
            bench.device.run(programs.write(programs.place(bench.device), given(tmp_path, M5000.replace(old, new))))
        assert bench.written == []


def test_setpoints_keep_to_the_controllers_present_limits_unless_told(serve: Serve, tmp_path: Path) -> None:
    program = given(tmp_path, M5000)
    with serve(AthenaM5000) as bench:
        bench.poke(setpoint_high_limit=1000)
        said = refused(bench, program)
        assert (
            "segment 1, to: 1500 lies outside 0 to 1000, the present setpoint_low_limit and setpoint_high_limit" in said
        )
        place = programs.place(bench.device)
        bench.device.run(programs.write(place, program, beyond_limits=True))

        assert bench.device.run(programs.read(place)) == program


def test_a_soak_level_keeps_to_the_limits_that_the_manual_states_always(serve: Serve, tmp_path: Path) -> None:
    program = given(tmp_path, SERIES_C)
    with serve(Athena16C) as bench:
        bench.poke(setpoint_high_limit=400)
        with pytest.raises(ProgramRefused, match=r"segment 2, to: 500\.5 lies outside -328 to 400"):
            bench.device.run(programs.write(programs.place(bench.device), program, beyond_limits=True))


def test_the_unit_of_the_controller_counts(serve: Serve, tmp_path: Path) -> None:
    with serve(Athena16C) as bench:
        bench.poke(display_unit_of_measure=2)

        assert "the value is given in °F, but the device works in °C" in refused(bench, given(tmp_path, SERIES_C))


def test_a_model_without_events_refuses_them(serve: Serve, tmp_path: Path) -> None:
    with serve(Athena1ZC) as bench:
        assert "there is no output `ramp_event` in the 1ZC" in refused(bench, given(tmp_path, SERIES_C))


def test_a_recipe_that_is_not_enabled_is_not_started(serve: Serve, tmp_path: Path) -> None:
    with serve(Athena16C) as bench:
        place = programs.place(bench.device)
        with pytest.raises(ValueRefused, match=r"recipe_option: it is DISABLED.* set it to MULTI_STEP_RAMP"):
            bench.device.run(programs.act(place, "start"))
        assert bench.written == []
        bench.device.run(programs.write(place, given(tmp_path, SERIES_C)))
        bench.device.run(programs.act(place, "start"))

        assert bench.running.device.peek("operating_mode") == 5


def test_a_recipe_that_runs_is_not_written_unless_told(serve: Serve, tmp_path: Path) -> None:
    program = given(tmp_path, SERIES_C)
    with serve(Athena16C) as bench:
        place = programs.place(bench.device)
        bench.poke(recipe_state=7)
        with pytest.raises(ProgramRuns, match=r"running \(RAMP_HOLDBACK\).*nothing was written"):
            bench.device.run(programs.write(place, program))
        assert bench.written == []
        bench.device.run(programs.write(place, program, while_running="write"))

        assert bench.device.run(programs.read(place)) == program


def test_a_program_that_runs_is_ended_before_it_is_written_if_so_told(serve: Serve, tmp_path: Path) -> None:
    program = given(tmp_path, M5000)
    with serve(AthenaM5000) as bench:
        place = programs.place(bench.device)
        bench.poke(program_status=3)
        bench.device.run(programs.write(place, program, while_running="reset"))

        assert bench.written[0] == 148
        assert bench.running.device.peek_words("program_status") == (0,)
        assert bench.device.run(programs.read(place)) == program


def test_a_recipe_is_held_and_goes_on_by_the_operating_mode(serve: Serve) -> None:
    with serve(Athena16C) as bench:
        place, mode = programs.place(bench.device), bench.running.device.peek
        bench.poke(recipe_state=6)
        bench.device.run(programs.act(place, "hold"))
        assert mode("operating_mode") == 6
        bench.poke(recipe_state=4)
        bench.device.run(programs.act(place, "resume"))
        assert mode("operating_mode") == 5
        bench.device.run(programs.act(place, "reset"))
        assert mode("operating_mode") == 3


def test_an_m5000_takes_run_and_hold_by_its_own_codes(serve: Serve) -> None:
    with serve(AthenaM5000) as bench:
        place, word = programs.place(bench.device), bench.running.device.peek_words
        bench.device.run(programs.act(place, "start"))
        assert word("program_status") == (2,)
        bench.device.run(programs.act(place, "hold"))
        assert word("program_status") == (1,)
        bench.device.run(programs.act(place, "reset"))
        assert word("program_status") == (0,)


def test_an_x5000_starts_one_of_four_when_it_is_set_to_run_programs(serve: Serve, tmp_path: Path) -> None:
    with serve(AthenaX5000) as bench:
        place = programs.place(bench.device, "4")
        bench.device.run(programs.write(place, given(tmp_path, X5000)))
        with pytest.raises(ValueRefused, match="now setpoint_type is LOCAL_ONLY"):
            bench.device.run(programs.act(place, "start"))
        bench.poke(setpoint_type=5)
        bench.device.run(programs.act(place, "start"))
        assert bench.running.device.peek_words("program_4_run_reset") == (1,)
        with pytest.raises(NotNow, match="names no way to hold"):
            bench.device.run(programs.act(place, "hold"))


def test_where_the_count_is_left_open_all_that_may_run_is_read(serve: Serve) -> None:
    with serve(AthenaM5000) as bench:
        bench.poke(number_of_segments=14)
        place = programs.place(bench.device)

        assert len(bench.device.run(programs.read(place)).segments) == 15
        bench.poke(number_of_segments=3)
        assert len(bench.device.run(programs.read(place)).segments) == 4


def test_a_model_without_programs_says_so() -> None:
    with pytest.raises(TargetError, match="the C10 has no setpoint programs"):
        programs.place(AthenaC10)
