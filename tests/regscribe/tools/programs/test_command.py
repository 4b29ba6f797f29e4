"""`regscribe program` against simulated devices."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from regscribe.cli.app import run
from regscribe.simulate import Running, simulate

from .conftest import shipped
from .test_devices import SERIES_C, X5000


class Result(NamedTuple):
    code: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory without any configuration."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("COLUMNS", "100")
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return here


@pytest.fixture
def cli(folder: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., Result]:
    """Run `regscribe program` in this process."""

    def call(*arguments: object) -> Result:
        assert Path.cwd() == folder
        capsys.readouterr()
        try:
            code = run(["program", *map(str, arguments)])
        except SystemExit as end:
            code = int(end.code or 0)
        captured = capsys.readouterr()
        assert "Traceback" not in captured.out + captured.err
        assert "internal error" not in captured.err, captured.err
        return Result(code, captured.out, captured.err)

    return call


class Oven(NamedTuple):
    running: Running
    target: str


@pytest.fixture
def oven() -> Iterator[Oven]:
    with simulate(shipped("athena/series-c"), "16C", unit=1) as running:
        running.device.poke("temperature_decimal_position", 1)  # a ramp goes to 500.5
        yield Oven(running, f"tcp:{running.host}:{running.port}?model=16C")


@pytest.fixture
def anneal(folder: Path) -> str:
    (folder / "anneal.yaml").write_text(SERIES_C, encoding="utf-8")
    return "anneal.yaml"


Cli = Callable[..., Result]


def test_a_file_is_written_read_back_and_started(cli: Cli, oven: Oven, anneal: str) -> None:
    assert cli("validate", oven.target, anneal).code == 0
    assert "registers written, all read back" in cli("write", oven.target, anneal).err
    read = cli("read", oven.target)
    started = cli("start", oven.target)

    assert "{to: 500.5 °F, ramp: 45 min, soak: 0 min, outputs: {" in read.out
    assert started.code == 0
    assert oven.running.device.peek("operating_mode") == 5


def test_what_is_read_can_be_written_again(cli: Cli, oven: Oven, anneal: str) -> None:
    cli("write", oven.target, anneal)
    cli("read", oven.target, "--out", "again.yaml")
    done = cli("write", oven.target, "again.yaml", "--json")

    assert json.loads(done.out)["written"] == 0
    assert not list(Path.cwd().glob(".*"))


def test_a_program_is_shown_with_its_curve(cli: Cli, oven: Oven, anneal: str, folder: Path) -> None:
    cli("write", oven.target, anneal)
    shown = cli("show", oven.target, "--svg", "anneal.svg")

    assert "EVENT_1_ALARM_1_ON" in shown.out
    assert "(d)" in shown.out
    assert any("\u2801" <= char <= "\u28ff" for char in shown.out)
    assert (folder / "anneal.svg").read_text(encoding="utf-8").startswith("<!--")


def test_a_file_is_drawn_without_a_device(cli: Cli, anneal: str, folder: Path) -> None:
    assert cli("draw", anneal, "--svg", "it.svg").code == 0
    assert "500.5 °F" in (folder / "it.svg").read_text(encoding="utf-8")
    assert "500.5 °F" in cli("draw", anneal).out


def test_mistakes_are_told_with_line_and_column_and_nothing_is_written(cli: Cli, oven: Oven, folder: Path) -> None:
    (folder / "bad.yaml").write_text(
        SERIES_C.replace("500.5 °F", "5000 °F").replace("cycles: 3", "cycles: 200"), encoding="utf-8"
    )
    said = cli("write", oven.target, "bad.yaml")
    plain = cli("validate", oven.target, "bad.yaml", "--json")

    assert said.code == 1
    assert "bad.yaml:3:11: cycles: 200 lies outside 0 to 99" in said.err
    assert "bad.yaml:9:12: segment 2, to: 5000 lies outside -328 to 1400" in said.err
    assert (plain.code, json.loads(plain.out)["valid"]) == (1, False)
    assert [one["where"] for one in json.loads(plain.out)["problems"]] == ["cycles", "segment 2, to"]
    assert oven.running.device.peek("recycle_number") == 0


def test_a_program_that_runs_is_refused_by_name(cli: Cli, oven: Oven, anneal: str) -> None:
    oven.running.device.poke("recipe_state", 5)
    said = cli("write", oven.target, anneal)

    assert (said.code, "running (RAMPING)" in said.err) == (1, True)
    assert cli("write", oven.target, anneal, "--while-running", "write").code == 0


def test_the_state_is_told_as_text_and_as_json(cli: Cli, oven: Oven) -> None:
    oven.running.device.poke("recipe_state", 6)
    oven.running.device.poke("current_recipe_segment", 3)

    assert "SOAKING" in cli("status", oven.target).out
    plain = json.loads(cli("status", oven.target, "--json").out)
    assert (plain["state"], plain["detail"], plain["segment"], plain["program"]) == ("running", "SOAKING", 3, None)


def test_what_means_nothing_now_is_refused(cli: Cli, oven: Oven) -> None:
    for act in ("hold", "resume", "reset"):
        said = cli(act, oven.target)
        assert (said.code, f"there is nothing to {act}" in said.err) == (1, True)


def test_one_of_several_programs_must_be_named(cli: Cli, folder: Path) -> None:
    (folder / "x.yaml").write_text(X5000, encoding="utf-8")
    with simulate(shipped("athena/platinum-x5000"), "X5000", unit=1) as running:
        target = f"tcp:{running.host}:{running.port}?model=X5000"
        said = cli("show", target)
        assert (said.code, "name one of program 1, program 2" in said.err) == (2, True)
        assert cli("write", target, "x.yaml", "--program", "3", "--beyond-limits").code == 0
        found = json.loads(cli("show", target, "--program", "3", "--json").out)["program"]

    assert (found["time_unit"], found["segments"][1]["to"]) == ("h", "1500 raw")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("write", "{target}", "none.yaml"), "there is no file none.yaml"),
        (("show", "{target}", "--program", "recpie"), "did you mean `recipe`"),
        (("show", "tcp:127.0.0.1:1?model=C10"), ""),
        (("shwo", "{target}"), "No such command"),
    ],
)
def test_bad_usage_is_told_in_a_line(cli: Cli, oven: Oven, arguments: tuple[str, ...], says: str) -> None:
    said = cli(*(one.format(target=oven.target) for one in arguments))

    assert said.code in {2, 3}
    assert says in said.err


def test_a_file_for_another_device_is_said_to_be_one(cli: Cli, oven: Oven, folder: Path) -> None:
    text = SERIES_C.replace("program:\n", "program:\n  map: athena/platinum-m5000\n  model: M5000\n")
    (folder / "other.yaml").write_text(text, encoding="utf-8")
    said = cli("validate", oven.target, "other.yaml")

    assert (said.code, "made for athena/platinum-m5000 M5000; this is athena/series-c 16C" in said.err) == (0, True)


def test_a_drawing_is_told_to_programs_too(cli: Cli, folder: Path) -> None:
    (folder / "glaze.yaml").write_text(SERIES_C, encoding="utf-8")
    said = json.loads(cli("draw", "glaze.yaml", "--svg", "glaze.svg", "--json").out)
    assert (said["file"], said["svg"], len(said["program"]["segments"])) == ("glaze.yaml", "glaze.svg", 3)
    assert "<svg" in (folder / "glaze.svg").read_text(encoding="utf-8")
