import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Exchange, Running

Cli = Callable[..., Any]


def test_all_models_are_listed_and_searched(cli: Cli) -> None:
    assert len(cli("devices").out.splitlines()) == 21
    assert [line.split()[0] for line in cli("devices", "omega").out.splitlines()] == ["CN8200", "CN8240", "CN8260"]
    assert (cli("devices", "nonesuch").code, cli("devices", "athena", "ZONE").out[:3]) == (1, "1ZC")


def test_the_list_for_programs_says_where_the_driver_is(cli: Cli) -> None:
    (found,) = json.loads(cli("devices", "btc-9100", "--json").out)["devices"]
    assert found["driver"] == "regscribe_devices.fdc.series_100.FdcBTC9100"
    assert (found["givens"], found["identifiable"], found["map"]) == (["linear_inputs"], True, "fdc/series-100")


def test_the_registers_of_a_model_are_listed_without_a_device(cli: Cli) -> None:
    text = cli("devices", "16C", "--registers").out
    assert {"setpoint_ram", "segments[8].soak_event", "alarm", "clear_latched_alarms"} <= set(text.split())
    found = json.loads(cli("devices", "16C", "--registers", "--json").out)
    assert found["commands"]["load_defaults"]["danger"]


def test_a_model_that_is_none_says_which_was_meant(cli: Cli) -> None:
    result = cli("devices", "M50000", "--registers")
    assert (result.code, "did you mean `M5000`?" in result.err) == (2, True)


def test_values_are_read_by_name_with_their_units(cli: Cli, oven: str) -> None:
    result = cli("read", oven, "setpoint_low_limit", "input_type", "segments[1].soak_time")
    assert [line.split(None, 1) for line in result.out.splitlines()] == [
        ["setpoint_low_limit", "-328 °F"],
        ["input_type", "J_THERMOCOUPLE"],
        ["segments[1].soak_time", "DISABLED"],
    ]
    assert (result.code, result.err) == (0, "")


def test_groups_arrays_and_elements_are_read_whole(cli: Cli, oven: str) -> None:
    text = cli("read", oven, "segments[2]", "autotune", "segments[2].soak_time").out
    names = [line.split()[0] for line in text.splitlines()]
    assert names == [*(f"segments[2].{one}" for one in EACH), "autotune_damping"]
    assert len(cli("read", oven, "segments").out.splitlines()) == 8 * len(EACH)


EACH = ("ramp_time", "ramp_event", "soak_level", "soak_time", "soak_event")


def test_values_come_alone_or_as_words_where_that_is_asked_for(cli: Cli, oven: str) -> None:
    assert cli("read", oven, "setpoint_low_limit", "input_type", "--value").out == "-328\nJ_THERMOCOUPLE\n"
    assert cli("read", oven, "input_type", "--raw").out == "input_type  0003\n"


def test_programs_get_value_and_unit_of_each_register(cli: Cli, oven: str) -> None:
    found = json.loads(cli("read", oven, "setpoint_low_limit", "status_byte", "--json").out)
    assert found["registers"] == {
        "setpoint_low_limit": {"value": -328, "unit": "°F"},
        "status_byte": {"value": [], "unit": ""},
    }
    assert (found["format"], found["model"], found["map"], found["unit_id"]) == (1, "16C", "athena/series-c", 1)


def test_a_text_of_the_device_does_not_steer_the_terminal(cli: Cli, serve: Callable[..., Any]) -> None:
    with serve("athena/platinum-m300", "M300") as running:
        running.device.poke("product_code", "\x1b[2J")
        target = f"tcp:{running.host}:{running.port}?model=M300"
        assert cli("read", target, "product_code").out == "product_code  \\x1b[2J\n"
        assert cli("read", target, "product_code", "--value").out == "\\x1b[2J\n"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("procss_value", "did you mean `process_value`?"),
        ("segments[1].ramp", "did you mean `segments[1].ramp_time`, `segments[1].ramp_event` or `segments[1]`?"),
        ("setpont", "did you mean `setpoints` or `setpoint_ram`?; groups: setpoints, communication, "),
        ("segments[9]", "did you mean `segments["),
        ("alarms", "did you mean `alarm`?"),
        ("", "there is no register or group ``"),
    ],
)
def test_a_name_that_is_none_says_which_was_meant(name: str, said: str, cli: Cli, oven: str) -> None:
    result = cli("read", oven, name)
    assert (result.code, said in result.err) == (2, True), result.err


@pytest.mark.parametrize(
    "arguments",
    [
        ("read", "x"),
        ("watch", "process_value", "--chart", "x"),
        ("dump", "--group", "x"),
        ("write", "x", "1"),
        ("command", "x"),
    ],
)
def test_names_are_looked_up_before_anybody_is_asked(arguments: tuple[str, ...], cli: Cli) -> None:
    command, *more = arguments
    result = cli(command, "tcp:127.0.0.1:1?model=16C", *more)
    assert (result.code, "there is no" in result.err) == (2, True)


def test_a_number_is_written_in_the_unit_of_the_device(cli: Cli, oven: str, running: Running) -> None:
    assert cli("write", oven, "setpoint_ram", "150 °F").code == 0
    assert cli("read", oven, "setpoint_ram", "--value").out == "150\n"
    running.requests.clear()
    result = cli("write", oven, "setpoint_ram", "150 °C")
    assert (result.code, "given in °C, but the device works in °F" in result.err) == (1, True)
    assert not [pdu for pdu in running.requests if pdu[0] in {5, 6, 15, 16}]


def test_a_negative_number_is_no_option(cli: Cli, oven: str) -> None:
    assert cli("write", oven, "setpoint_ram", "-5").code == 0
    assert cli("read", oven, "setpoint_ram", "--value").out == "-5\n"


def test_an_enum_is_written_by_name_or_label(cli: Cli, oven: str) -> None:
    for text in ("LOW", "normal"):
        assert cli("write", oven, "autotune_damping", text).code == 0
        assert cli("read", oven, "autotune_damping", "--value").out == f"{text.upper()}\n"
    result = cli("write", oven, "autotune_damping", "lwo")
    assert (result.code, "did you mean `LOW`?" in result.err) == (1, True)


@pytest.mark.parametrize(
    ("name", "value", "code", "said"),
    [
        ("setpoint_ram", "99999", 1, "99999 lies outside -328 to 1400"),
        ("process_value", "1", 1, "read-only"),
        ("setpoint_rma", "1", 2, "did you mean `setpoint_ram`?"),
        ("baud_rate", "4800", 1, "add --confirm"),
    ],
)
def test_what_may_not_be_written_is_refused_with_a_reason(
    name: str, value: str, code: int, said: str, cli: Cli, oven: str, running: Running
) -> None:
    running.requests.clear()
    result = cli("write", oven, name, value)
    assert (result.code, said in result.err) == (code, True), result.err
    assert not [pdu for pdu in running.requests if pdu[0] in {5, 6, 15, 16}]


def test_a_view_that_is_none_says_which_there_are(cli: Cli, oven: str) -> None:
    result = cli("write", oven, "setpoint_ram", "5", "--view", "x100")
    assert (result.code, "did you mean `x10`?" in result.err) == (2, True)


def test_a_unit_that_is_not_behind_the_gateway_does_not_answer(cli: Cli, oven: str) -> None:
    result = cli("read", oven, "setpoint_ram", "--unit", "9", "--json")
    said = json.loads(result.out)["error"]
    assert (result.code, said["exit_code"]) == (3, 3)
    assert said["message"].endswith("exception 11 (gateway target device failed to respond)")


def test_a_refusal_that_decides_nothing_is_not_called_a_lost_answer(cli: Cli, serve: Callable[..., Any]) -> None:
    def failing(request: Any, act: Callable[[], bytes | None]) -> bytes | None:
        return bytes([request.pdu[0] | 0x80, 4]) if request.pdu[0] in {5, 6, 16} else act()

    with serve("athena/platinum-x5000", "X5000", arrival=failing) as running:
        result = cli("write", f"tcp:{running.host}:{running.port}?model=X5000", "auto_manual", "MANUAL")
    assert (result.code, "lost" in result.err) == (4, False)
    assert "exception 04 (server device failure)); it holds AUTO, and the device" in result.err


def test_an_array_is_told_from_a_register_that_can_be_written(cli: Cli, oven: str) -> None:
    result = cli("write", oven, "segments[1]", "5")
    assert (
        result.code,
        "`segments[1]` is not one register of 16C but several: segments[1].ramp_time," in result.err,
    ) == (
        2,
        True,
    )


def test_a_value_that_is_too_fine_is_rounded_only_on_demand(cli: Cli, oven: str, running: Running) -> None:
    running.device.poke("temperature_decimal_position", 1)
    refused = cli("write", oven, "setpoint_ram", "100.26", "--view", "x10")
    assert (refused.code, "--rounded" in refused.err) == (1, True)
    said = cli("write", oven, "setpoint_ram", "100.26", "--view", "x10", "--rounded")
    assert (said.code, said.out) == (0, "setpoint_ram  100.3 °F\n")
    running.device.poke("temperature_decimal_position", 0)
    fine = ("thermocouple_span_adjustment", "1.23456789", "--confirm", "--rounded", "--json")
    assert json.loads(cli("write", oven, *fine).out)["value"] == 1.2345679


def test_a_dry_run_shows_the_words_and_writes_nothing(cli: Cli, oven: str, running: Running) -> None:
    before = cli("read", oven, "setpoint_ram", "--value").out
    running.requests.clear()
    result = cli("write", oven, "setpoint_ram", "98", "--dry-run")
    assert (result.code, "nothing was sent" in result.err) == (0, True)
    assert "42C4" in result.out  # 98 as binary32 is 42C40000
    assert not [pdu for pdu in running.requests if pdu[0] in {5, 6, 15, 16}]
    assert cli("read", oven, "setpoint_ram", "--value").out == before
    (request,) = json.loads(cli("write", oven, "setpoint_ram", "98", "--dry-run", "--json").out)["requests"]
    assert (request["function"], request["address"], sorted(request["words"])) == (16, 8004, [0, 0x42C4])


def test_a_dry_run_of_the_speed_leaves_the_line_alone(cli: Cli, serve: Callable[..., Any]) -> None:
    with serve(transport="pty") as running:
        line = f"rtu:{running.path}?baud=9600&model=16C"
        result = cli("write", line, "baud_rate", "BAUD_4800", "--confirm", "--dry-run")
        assert (result.code, result.out.split()[:2]) == (0, ["06", "4082"])
        assert cli("write", line, "controller_id", "9", "--confirm", "--dry-run").code == 0
        assert cli("read", line, "baud_rate", "--value").out == "BAUD_9600\n"


def test_a_dry_run_reads_back_what_it_would_have_written(cli: Cli, oven: str) -> None:
    before = cli("read", oven, "autotune_damping", "--value").out
    wanted = "LOW" if "LOW" not in before else "HIGH"
    result = cli("write", oven, "autotune_damping", wanted, "--dry-run", "--verify")
    assert (result.code, result.out.split()[:2]) == (0, ["06", "4011"]), result.err
    assert cli("read", oven, "autotune_damping", "--value").out == before


def test_a_write_whose_fate_nobody_knows_is_code_four(cli: Cli, serve: Callable[..., Any]) -> None:
    async def mute(exchange: Exchange) -> bytes:
        after_a_write = any(pdu[0] in {6, 16} for pdu in running.requests)
        return b"" if after_a_write else exchange.frame

    with serve(delivery=mute) as running:
        result = cli("write", f"tcp:{running.host}:{running.port}?model=16C&timeout=0.1", "setpoint_ram", "99")
    assert (result.code, "reading back fails too" in result.err) == (4, True)


def test_what_the_device_holds_already_is_not_written_again(cli: Cli, oven: str, running: Running) -> None:
    assert cli("write", oven, "setpoint_eeprom_and_ram", "88").code == 0
    running.requests.clear()
    again = cli("write", oven, "setpoint_eeprom_and_ram", "88")
    assert (again.code, "its EEPROM was spared" in again.err) == (0, True)
    assert not [pdu for pdu in running.requests if pdu[0] in {6, 16}]
    assert json.loads(cli("write", oven, "setpoint_eeprom_and_ram", "88", "--json").out)["written"] is False


def test_a_device_of_another_model_is_not_written_to(cli: Cli, oven: str, running: Running) -> None:
    running.requests.clear()
    result = cli("write", oven, "setpoint_ram", "98", "--model", "25C")
    assert (result.code, "does not show to be a 25C" in result.err) == (1, True)
    assert not [pdu for pdu in running.requests if pdu[0] in {5, 6, 15, 16}]
    assert cli("write", oven, "setpoint_ram", "98", "--model", "25C", "--no-check-identity").code == 0


def test_everything_is_dumped_group_by_group(cli: Cli, oven: str) -> None:
    found = json.loads(cli("dump", oven, "--json").out)["groups"]
    assert found["unit_of_measure"] == {"display_unit_of_measure": {"value": "FAHRENHEIT", "unit": ""}}
    assert len(found) == 15
    text = cli("dump", oven, "--group", "autotune", "--group", "security").out
    assert [line for line in text.splitlines() if line.startswith("#")] == [
        "# Autotune Damping Parameter (autotune)",
        "# Security Parameter (security)",
    ]
    assert "did you mean `status`?" in cli("dump", oven, "--group", "statsu").err


def test_commands_are_listed_without_a_device(cli: Cli) -> None:
    listed = cli("command", "tcp:127.0.0.1:1?model=16C")
    assert (listed.code, "load_defaults" in listed.out) == (0, True)
    assert "clear_latched_alarms" in json.loads(cli("command", "tcp:h?model=16C", "--json").out)["commands"]


def test_a_dangerous_command_says_what_will_be_lost(cli: Cli, oven: str, running: Running) -> None:
    running.requests.clear()
    refused = cli("command", oven, "load_defaults")
    assert (refused.code, "all configuration, calibration and setpoints are lost" in refused.err) == (1, True)
    assert ("--confirm" in refused.err, [pdu for pdu in running.requests if pdu[0] == 16]) == (True, [])
    assert cli("command", oven, "clear_latched_alarms").code == 0
    assert running.requests[-1][:5] == bytes([16, *(7006).to_bytes(2, "big"), 0, 2])


def test_a_command_is_shown_and_not_sent_in_a_dry_run(cli: Cli, oven: str, running: Running) -> None:
    running.requests.clear()
    assert cli("command", oven, "load_defaults", "--confirm", "--dry-run").out == "16  7000  0055 005C\n"
    assert [pdu for pdu in running.requests if pdu[0] == 16] == []
    assert "did you mean `load_defaults`?" in cli("command", oven, "load_default").err
    said = json.loads(cli("command", oven, "load_defaults", "--confirm", "--dry-run", "--json").out)
    assert (said["sent"], said["requests"]) == (False, [{"function": 16, "address": 7000, "words": [0x55, 0x5C]}])


def test_a_device_tells_what_it_is(cli: Cli, running: Running) -> None:
    found = json.loads(cli("identify", f"tcp:{running.host}:{running.port}", "--json").out)
    assert ([one["model"] for one in found["models"]], found["certain"]) == (["16C", "CN8200"], False)
    assert {"controller_type"} <= {one["register"] for one in found["evidence"] if one["error"] is None}


def test_a_device_without_a_driver_is_none_of_the_models(cli: Cli, serve: Callable[..., Any]) -> None:
    with serve() as running:
        running.device.poke("controller_type", 9)
        result = cli("identify", f"tcp:{running.host}:{running.port}")
    assert (result.code, "no driver exists for what answers there" in result.err) == (1, True)


def test_units_behind_a_link_are_found(cli: Cli, running: Running) -> None:
    link = f"tcp:{running.host}:{running.port}?timeout=0.2"
    result = cli("scan", link, "--units", "1-3")
    assert (result.code, result.out.split(None, 1)[0], "at most 1 s" in result.err) == (0, "1", True)
    found = json.loads(cli("scan", link, "--units", "1-3", "--json").out)
    assert (found["complete"], found["found"][0]["models"]) == (True, ["16C", "CN8200"])
    assert cli("scan", link, "--units", "2,3").code == 1
    assert cli("scan", link, "--units", "0-3").code == 2
    assert cli("scan", link, "--bauds", "fast").code == 2


def test_what_changes_is_followed_drawn_and_kept(cli: Cli, oven: str, folder: Path) -> None:
    arguments = ("watch", oven, "process_value", "status_byte", "--every", "0.01", "--count", "3")
    result = cli(*arguments, "--chart", "process_value", "--log", "log.csv")
    assert [line.split()[1] for line in result.out.splitlines()[:2]] == ["process_value", "status_byte"]
    assert "(°F)" in result.out
    with (folder / "log.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["register"] for row in rows] == ["process_value", "status_byte"] * 3
    lines = [json.loads(line) for line in cli(*arguments, "--json", "--log", "log.csv").out.splitlines()]
    assert [set(line["registers"]) for line in lines] == [{"process_value", "status_byte"}] * 3
    assert len((folder / "log.csv").read_text(encoding="utf-8").splitlines()) == 13


def test_a_log_of_another_kind_stops_before_anything_is_watched(cli: Cli, oven: str, folder: Path) -> None:
    (folder / "log.csv").write_text("mine", encoding="utf-8")
    assert cli("watch", oven, "process_value", "--log", "log.csv").code == 2
    assert cli("watch", oven, "process_value", "--log", "log.txt").code == 2


def test_every_frame_is_told_in_names(cli: Cli, oven: str) -> None:
    told = cli("read", oven, "input_type", "--trace").err.splitlines()
    sent = next(number for number, line in enumerate(told) if "-> " in line and "03 0F D1 00 01" in line)
    assert "read holding 4049: input_type" in told[sent + 1]
    assert "input_type = J_THERMOCOUPLE" in "\n".join(told[sent + 2 :])


def test_nobody_at_the_other_end_is_code_three(cli: Cli) -> None:
    result = cli("read", "tcp:127.0.0.1:1?model=16C", "process_value", "--json")
    error = json.loads(result.out)["error"]
    assert (result.code, error["kind"], error["exit_code"]) == (3, "link-lost", 3)
    assert cli("identify", "tcp:127.0.0.1:1").code == 3
    assert cli("scan", "tcp:127.0.0.1:1", "--units", "1").code == 3
    assert cli("read", "rtu:/dev/no-such-port?model=16C", "process_value").code == 3


def test_a_silent_unit_is_code_three(cli: Cli, serve: Callable[..., Any]) -> None:
    with serve(transport="rtu-tcp") as running:
        target = f"tcp:{running.host}:{running.port}?framing=rtu&unit=9&model=16C&timeout=0.05"
        result = cli("read", target, "process_value")
        assert (result.code, "gave no answer" in result.err) == (3, True)
        assert cli("watch", target, "process_value", "--every", "0", "--give-up", "2").code == 3


def test_names_of_the_configuration_are_targets(cli: Cli, folder: Path, running: Running) -> None:
    (folder / "regscribe.yaml").write_text(
        f"format: 1\ndevices:\n  oven: {{link: 'tcp:{running.host}:{running.port}', model: 16C}}\n", encoding="utf-8"
    )
    assert cli("read", "oven", "input_type").code == 0
    assert json.loads(cli("read", "oven", "input_type", "--json").out)["device"] == "oven"
    wrong = cli("read", "ovn", "input_type")
    assert (wrong.code, "did you mean `oven`?" in wrong.err) == (2, True)
    (folder / "regscribe.yaml").write_text("format: 1\ndevice: {}\n", encoding="utf-8")
    assert "regscribe.yaml:2:1: unknown key `device`" in cli("read", "oven", "input_type").err


def test_a_device_with_givens_needs_them(cli: Cli, serve: Callable[..., Any]) -> None:
    with serve("fdc/series-100", "C21", givens={"linear_inputs": frozenset({1})}) as running:
        target = f"tcp:{running.host}:{running.port}?model=C21"
        missing = cli("read", target, "pv")
        assert (missing.code, "--given linear_inputs=1,4..6" in missing.err) == (2, True)
        assert cli("read", target, "lock", "--given", "linear_inputs=1").code == 0
        assert cli("read", f"{target}&given.linear_inputs=1", "mode").out.startswith("mode")
        assert cli("read", target, "lock", "--given", "linear_input=1").code == 2


def test_frames_are_decoded_without_a_device(cli: Cli, folder: Path) -> None:
    result = cli("decode", "16C", *["01", "03", "0F", "A0", "00", "01", "87", "3C"])
    assert (result.code, result.out) == (0, "unit 1 -> read holding 4000: controller_type\n")
    (folder / "bus.log").write_text(
        "12:00:01 TX 01 03 0F A0 00 01 87 3C\n12:00:01 RX 01 03 02 00 02 39 85\n", encoding="utf-8"
    )
    assert cli("decode", "16C", "--log", "bus.log").out.splitlines()[1:] == [
        "unit 1 <- controller_type = MODEL_16C",
    ]
    found = json.loads(cli("decode", "16C", "--log", "bus.log", "--json").out)["frames"]
    assert [(one["line"], one["kind"]) for one in found] == [(1, "request"), (2, "response")]
    assert found[1]["registers"][0]["value"] == "MODEL_16C"


def test_what_is_no_sound_frame_is_code_one(cli: Cli) -> None:
    assert cli("decode", "16C", "01030FA00001873D").code == 1
    assert cli("decode", "16C", "hello").code == 1
    assert cli("decode", "16X", "01").code == 2


def test_what_other_registers_hold_can_be_told(cli: Cli) -> None:
    frames = ("000100000006010300020001", "0001000000050103020096")
    known = ("--with", "input_type=J_THERMOCOUPLE", "--with", "display_unit_of_measure=FAHRENHEIT")
    assert "setpoint_ram = 150 °F" in cli("decode", "16C", *known, *frames).out
    assert "input_type decides what it means" in cli("decode", "16C", *frames).out
    assert cli("decode", "16C", "--with", "input_typ=1", *frames).code == 2


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_get_a_script_that_completes(shell: str, cli: Cli) -> None:
    result = cli("completion", shell)
    assert (result.code, f"_REGSCRIBE_COMPLETE={shell}_complete" in result.out) == (0, True)


@pytest.mark.parametrize(
    "command", ["devices", "scan", "identify", "read", "write", "dump", "watch", "command", "decode"]
)
def test_every_command_explains_itself(command: str, cli: Cli) -> None:
    result = cli(command, "--help")
    assert (result.code, "Exit code" in result.out) == (0, True)
