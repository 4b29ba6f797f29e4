"""Programs of every family: from YAML onto a simulated device and back."""

import asyncio
import re
from pathlib import Path

import pytest

from regscribe.simulate import simulate
from regscribe.tools import programs
from regscribe.tools.programs import FOREVER, Program
from regscribe_devices.athena.platinum_m5000 import AthenaM5000
from regscribe_devices.athena.platinum_x5000 import AthenaX5000
from regscribe_devices.athena.series_c import AsyncAthena16C, Athena1ZC, Athena16C
from regscribe_runtime import BareDevice

from .conftest import DRIVERS, Serve, shipped

SERIES_C = """\
format: 1
program:
  cycles: 3
  holdback: 5 °F
  power_failure: RESUME_ON
  end: LAST_SETPOINT
  segments:
    - {to: 250 °F, ramp: 90 min, soak: 60 min, outputs: {ramp_event: EVENT_1_ALARM_1_ON, soak_event: DISABLED}}
    - {to: 500.5 °F, ramp: 45 min, soak: 0 min, outputs: {ramp_event: DISABLED, soak_event: EVENT_2_ALARM_2_OFF}}
    - {to: 77 °F, ramp: 0 min, soak: 9999 min, outputs: {ramp_event: DISABLED, soak_event: DISABLED}}
"""
ZONE = re.sub(r", outputs: {[^}]*}", "", SERIES_C)  # the 1ZC has no events
M5000 = """\
format: 1
program:
  cycles: forever
  time_unit: h
  holdback: 12 raw
  power_failure: RAMP
  number_of_segments: 2
  segments:
    - {to: 250 raw, ramp: 90 raw, outputs: {op3: OPEN}}
    - {to: 1500 raw, ramp: 45 raw, outputs: {op3: CLOSE}}
    - {to: 0 raw, ramp: 1 raw, outputs: {op3: "OFF"}}
  final: {to: 20 raw, outputs: {op3: "OFF"}}
"""
X400 = M5000.replace("CLOSE}", "CLOSED}").replace('"OFF"', "NO_ACTION")
X5000 = (
    M5000.replace("op3: OPEN", "op3: OPEN, op4: CLOSED")
    .replace("op3: CLOSE}", "op3: CLOSED, op4: DISABLED}")
    .replace('op3: "OFF"', "op3: DISABLED, op4: OPEN")
)
FILES = {"16C": SERIES_C, "CN8200": SERIES_C, "1ZC": ZONE, "M5000": M5000, "X100": X400, "X400": X400, "X5000": X5000}


def given(folder: Path, text: str) -> Program:
    path = folder / "program.yaml"
    path.write_text(text, encoding="utf-8")
    return programs.load(path).program


@pytest.mark.parametrize("driver", DRIVERS, ids=lambda driver: driver.model)
def test_what_is_written_is_read_back(driver: type[BareDevice], serve: Serve, tmp_path: Path) -> None:
    program = given(tmp_path, FILES[driver.model])
    with serve(driver) as bench:
        for place in programs.places(bench.device):
            bench.device.run(programs.write(place, program))

            assert bench.device.run(programs.read(place)) == program


@pytest.mark.parametrize("driver", DRIVERS, ids=lambda driver: driver.model)
def test_a_program_is_a_file_that_is_the_same_program(driver: type[BareDevice], serve: Serve, tmp_path: Path) -> None:
    with serve(driver) as bench:
        place = programs.places(bench.device)[-1]
        bench.device.run(programs.write(place, given(tmp_path, FILES[driver.model])))
        found = bench.device.run(programs.read(place))

    again = given(tmp_path, programs.dump(found, remarks=("as read",)))
    assert (again, again.model, again.map_id) == (found, driver.model, driver.map_id)


def test_programs_are_the_same_through_an_asyncio_driver(tmp_path: Path) -> None:
    program = given(tmp_path, SERIES_C)

    async def work(host: str, port: int) -> Program:
        async with AsyncAthena16C.tcp(host, port=port, unit=1) as device:
            place = programs.place(device)
            await device.run(programs.write(place, program))
            return await device.run(programs.read(place))

    with simulate(shipped("athena/series-c"), "16C", unit=1) as running:
        running.device.poke("temperature_decimal_position", 1)
        assert asyncio.run(work(running.host, running.port)) == program


def test_a_shorter_recipe_leaves_nothing_of_a_longer_one(serve: Serve, tmp_path: Path) -> None:
    long, short = given(tmp_path, SERIES_C), given(tmp_path, SERIES_C.rsplit("    - ", 2)[0])
    with serve(Athena16C) as bench:
        place = programs.place(bench.device)
        bench.device.run(programs.write(place, long))
        bench.device.run(programs.write(place, short))

        assert bench.device.run(programs.read(place)) == short
        assert bench.running.device.peek("segments[2].soak_event") == 0
        assert bench.running.device.peek("segments[3].soak_time") == 0


def test_a_written_recipe_is_one_that_runs(serve: Serve, tmp_path: Path) -> None:
    with serve(Athena16C) as bench:
        bench.device.run(programs.write(programs.place(bench.device), given(tmp_path, SERIES_C)))

        assert bench.running.device.peek("recipe_option") == 2


def test_cycles_without_end_are_the_code_of_the_device(serve: Serve, tmp_path: Path) -> None:
    with serve(AthenaM5000) as bench:
        place = programs.place(bench.device)
        bench.device.run(programs.write(place, given(tmp_path, M5000)))

        assert bench.running.device.peek_words("cycles") == (0,)
        assert bench.device.run(programs.read(place)).cycles == FOREVER
    with serve(Athena16C) as bench:
        place = programs.place(bench.device)
        bench.device.run(programs.write(place, given(tmp_path, SERIES_C.replace("cycles: 3", "cycles: forever"))))

        assert bench.running.device.peek("recycle_number") == 100


def test_a_program_on_a_second_place_leaves_the_first_alone(serve: Serve, tmp_path: Path) -> None:
    with serve(AthenaX5000) as bench:
        first = programs.place(bench.device, "1")
        before = bench.device.run(programs.read(first))
        bench.device.run(programs.write(programs.place(bench.device, "program 3"), given(tmp_path, X5000)))

        assert bench.device.run(programs.read(first)) == before
        assert bench.running.device.peek_words("programs[3].segments[1].setpoint") == (1500,)


def test_the_time_unit_comes_first_and_the_number_of_segments_last(serve: Serve, tmp_path: Path) -> None:
    with serve(AthenaX5000) as bench:
        program = given(tmp_path, X5000)
        bench.device.run(programs.write(programs.place(bench.device, "1"), program))

        assert (bench.written[0], bench.written[-1]) == (181, 183)


def test_what_the_device_holds_already_is_not_written(serve: Serve, tmp_path: Path) -> None:
    program = given(tmp_path, SERIES_C)
    with serve(Athena16C) as bench:
        place = programs.place(bench.device)
        first = bench.device.run(programs.write(place, program))
        before = len(bench.written)
        second = bench.device.run(programs.write(place, program))

        assert first.written > 0
        assert (second.written, len(bench.written) - before) == (0, 0)


def test_times_may_be_given_in_other_units(serve: Serve, tmp_path: Path) -> None:
    with serve(Athena1ZC) as bench:
        place = programs.place(bench.device)
        text = ZONE.replace("90 min", "1 h 30 min").replace("60 min", "3600 s").replace(", soak: 0 min", "")
        bench.device.run(programs.write(place, given(tmp_path, text)))

        assert bench.device.run(programs.read(place)) == given(tmp_path, ZONE)
