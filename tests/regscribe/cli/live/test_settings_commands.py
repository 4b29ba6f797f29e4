import json
import os
import re
import signal
from collections.abc import Callable
from errno import ENOSPC
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Running
from regscribe.tools import settings

Cli = Callable[..., Any]
Serve = Callable[..., Any]
Start = Callable[..., Any]


def name_of(running: Running, model: str = "16C") -> str:
    return f"tcp:{running.host}:{running.port}?unit=1&model={model}"


def test_settings_are_kept_in_a_file_and_shown_without_one(cli: Cli, oven: str, folder: Path) -> None:
    result = cli("backup", oven, "oven.yaml")
    assert (result.code, result.out) == (0, "")
    assert "settings of" in result.err
    text = (folder / "oven.yaml").read_text(encoding="utf-8")
    assert "    input_filter: {value: 5.0, unit: 0.1 s, raw: [0, 16544]}\n" in text
    assert "    controller_id: {value: 1, raw: [1], stays: address}\n" in text
    assert cli("backup", oven).out.splitlines()[-1] == text.splitlines()[-1]


def test_a_file_that_is_there_is_replaced_only_when_told(cli: Cli, oven: str, folder: Path) -> None:
    (folder / "oven.yaml").write_text("mine", encoding="utf-8")
    assert cli("backup", oven, "oven.yaml").code == 2
    assert (folder / "oven.yaml").read_text(encoding="utf-8") == "mine"
    assert cli("backup", oven, "oven.yaml", "--force").code == 0


def test_a_full_disk_leaves_the_old_file_and_nothing_else(
    cli: Cli, oven: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "oven.yaml").write_text("mine", encoding="utf-8")

    def full(_: int) -> None:
        raise OSError(ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    result = cli("backup", oven, "oven.yaml", "--force")
    assert (result.code, "No space left" in result.err) == (74, True)
    assert [(one.name, one.read_text(encoding="utf-8")) for one in folder.iterdir()] == [("oven.yaml", "mine")]


def test_a_restore_shows_its_plan_and_then_does_it(cli: Cli, serve: Serve) -> None:
    with serve() as one:
        one.device.poke("input_filter", 9)
        assert cli("backup", name_of(one), "one.yaml").code == 0
    with serve() as other:
        plan = cli("restore", name_of(other), "one.yaml", "--dry-run", "--confirm")
        assert plan.out.split() == ["input_filter", "5", "9", "planned"]
        assert other.device.peek("input_filter") == 5
        done = cli("restore", name_of(other), "one.yaml", "--confirm", "--json")
        assert other.device.peek("input_filter") == 9
        found = [one for one in json.loads(done.out)["changes"] if one["fate"] != "equal"]
        assert found == [{"register": "input_filter", "before": "5", "after": "9", "fate": "written"}]


def test_files_and_devices_and_the_factory_are_compared_by_name_and_unit(cli: Cli, serve: Serve) -> None:
    with serve() as running:
        oven = name_of(running)
        running.device.poke("access_level", "factory")  # it is delivered with another
        cli("backup", oven, "before.yaml")
        running.device.poke("input_filter", 9)
        cli("backup", oven, "after.yaml")
        row = ["input_filter", "5 0.1 s", "9 0.1 s"]
        for left, right in (("before.yaml", "after.yaml"), ("before.yaml", oven), ("factory", "after.yaml")):
            result = cli("diff", left, right)
            heads, cells = (
                [cell.strip() for cell in line.split("  ") if cell.strip()] for line in result.out.splitlines()
            )
            assert (result.code, len(heads), heads[0], cells) == (1, 3, "REGISTER", row)
        assert cli("diff", "after.yaml", oven).code == 0
        (found,) = json.loads(cli("diff", oven, "factory", "--json").out)["differences"]
        assert (found["left"], found["right"]) == ({"value": 9, "unit": "0.1 s"}, {"value": 5, "unit": "0.1 s"})


def test_a_device_whose_manual_gives_no_defaults_is_not_said_to_be_as_delivered(cli: Cli, serve: Serve) -> None:
    with serve("athena/platinum-c10-m10", "C10") as one:
        result = cli("diff", name_of(one, "C10"), "factory")
        assert (result.code, "the manual of the C10 gives no defaults" in result.err) == (2, True)


def test_settings_without_a_default_are_named_where_others_have_one(
    cli: Cli, oven: str, running: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    running.device.poke("access_level", "factory")  # it is delivered with another
    whole = settings.factory
    monkeypatch.setattr(
        settings, "factory", lambda *driver: {key: one for key, one in whole(*driver).items() if key != "input_filter"}
    )
    result = cli("diff", oven, "factory")
    assert (result.code, "not compared, for the manual gives no default: input_filter\n" in result.err) == (0, True)
    assert json.loads(cli("diff", oven, "factory", "--json").out)["not_compared"] == ["input_filter"]


def test_a_clone_sets_each_device_and_a_silent_one_stops_none_of_the_others(cli: Cli, serve: Serve) -> None:
    with serve() as one, serve(unit=2) as other, serve() as third:
        one.device.poke("input_filter", 9)
        nobody = f"tcp:{one.host}:{one.port}?unit=9&model=16C&timeout=0.2"
        two = f"tcp:{other.host}:{other.port}?unit=2&model=16C"
        result = cli("clone", name_of(one), nobody, two, name_of(third), "--confirm", "--json")
        assert result.code == 1
        assert ["error" in device for device in json.loads(result.out)["devices"]] == [True, False, False]
        assert other.device.peek("input_filter") == 9
        assert third.device.peek("input_filter") == 9


def test_a_file_that_is_no_backup_is_told_with_its_place(cli: Cli, oven: str, folder: Path) -> None:
    (folder / "wrong.yaml").write_text("format: 1\nbackup: {map: x}\nsettings: {a: {b: {valu: 3}}}\n", encoding="utf-8")
    result = cli("restore", oven, "wrong.yaml")
    assert result.code == 2
    assert "wrong.yaml:3:20" in result.err
    assert "did you mean" in result.err
    assert cli("restore", oven, "none.yaml").code == 2


def test_ctrl_c_during_a_clone_stops_it_at_all_devices(cli: Cli, serve: Serve, start: Start) -> None:
    with serve() as one:
        for name in ("input_filter", "display_filter", "output_1_cycle_time", "output_2_cycle_time"):
            one.device.poke(name, 9)
        cli("backup", name_of(one), "one.yaml")
    waiting: list[Any] = []

    async def slow(exchange: Any) -> bytes:
        if exchange.request.pdu[0] in {6, 16} and waiting:
            waiting.pop().send_signal(signal.SIGINT)
        frame: bytes = exchange.frame
        return frame

    with serve(delivery=slow) as first, serve() as second:
        process = start("clone", "one.yaml", name_of(first), name_of(second), "--confirm")
        waiting.append(process)
        out, err = process.communicate(timeout=30)
        assert (process.returncode, second.device.peek("input_filter")) == (4, 5), out
        assert f"{second.port}: not begun: it holds what it held\n" in err
        assert f"{first.port}: Run the same command again: it goes on where this one was.\n" in err
        assert re.search(r"configure: stopped by Ctrl-C\. equal: \d+ registers; ", err)


def test_a_clone_that_breaks_off_in_a_device_says_so_by_its_exit_code(cli: Cli, serve: Serve) -> None:
    with serve() as one:
        one.device.poke("input_filter", 9)
        cli("backup", name_of(one), "one.yaml")

    def refusing(request: Any, act: Callable[[], bytes | None]) -> bytes | None:
        return bytes([request.pdu[0] | 0x80, 4]) if request.pdu[0] in {6, 16} else act()

    with serve(arrival=refusing) as bad, serve() as good:
        result = cli("clone", "one.yaml", name_of(bad), name_of(good), "--confirm", "--json")
        devices = json.loads(result.out)["devices"]
        assert (result.code, devices[0]["error"]["exit_code"], good.device.peek("input_filter")) == (4, 4, 9)


def test_ctrl_c_during_a_restore_says_what_was_written_and_a_second_run_completes_it(
    cli: Cli, serve: Serve, start: Start
) -> None:
    with serve() as one:
        for name in ("input_filter", "display_filter", "output_1_cycle_time", "output_2_cycle_time"):
            one.device.poke(name, 9)
        cli("backup", name_of(one), "one.yaml")
    waiting: list[Any] = []

    async def slow(exchange: Any) -> bytes:
        if exchange.request.pdu[0] in {6, 16} and waiting:
            waiting.pop().send_signal(signal.SIGINT)
        frame: bytes = exchange.frame
        return frame

    with serve(delivery=slow) as other:
        process = start("restore", name_of(other), "one.yaml", "--confirm")
        waiting.append(process)
        out, err = process.communicate(timeout=30)
        assert (process.returncode, "not written" in err, "Run the same command again" in err) == (4, True, True), out
        assert cli("restore", name_of(other), "one.yaml", "--confirm").code == 0
        assert cli("diff", "one.yaml", name_of(other)).code == 0
