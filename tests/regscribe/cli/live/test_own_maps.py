"""Live commands on maps of the user's own, for which no driver was generated."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe import map_files
from regscribe.simulate import Running, simulate
from regscribe.tools.live import catalogue, map_drivers

Run = Callable[..., Any]

PUMP = """\
format: 1
map: {id: acme/pump, title: Acme Pump, maker: Acme, class_prefix: Acme}
manual: {title: Pump Manual, number: PM-1}
models: {P1: {}}
protocol: {functions: [3, 4, 6, 16]}
groups:
  - id: all
    name: All
    each: {access: rw, type: uint16}
    registers:
      - {at: 0, name: Kind, access: r}
      - {at: 1, name: Speed, unit: rpm}
identify: [{when: {kind: 7}, models: [P1]}]
"""


@pytest.fixture
def pump(folder: Path, model_of: Callable[[str], Any]) -> Iterator[Running]:
    """A simulated pump whose map is maps/acme/pump.yaml here."""
    assert Path.cwd() == folder
    put("maps/acme/pump.yaml", PUMP)
    with simulate(model_of(PUMP), "P1") as running:
        running.device.poke("kind", 7)
        running.device.poke("speed", 1450)
        yield running


def put(path: str, text: str) -> None:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(text, encoding="utf-8")


def link(running: Running, **more: str) -> str:
    query = "&".join(f"{key}={value}" for key, value in more.items())
    return f"tcp:{running.host}:{running.port}?{query}".rstrip("?")


@pytest.mark.parametrize(
    "named",
    [
        {"model": "P1"},
        {"model": "acme/pump"},
        {"model": "maps/acme/pump.yaml:P1"},
        {"map": "acme/pump"},
        {"map": "maps/acme/pump.yaml", "model": "p1"},
        {},
    ],
)
def test_a_map_here_needs_no_generated_driver(named: dict[str, str], cli: Run, pump: Running) -> None:
    result = cli("read", link(pump, **named), "speed")
    assert (result.code, result.out, result.err) == (0, "speed  1450 rpm\n", "")


def test_a_map_elsewhere_is_named_by_its_file(cli: Run, pump: Running, tmp_path: Path) -> None:
    Path("maps/acme/pump.yaml").rename(tmp_path / "pump.yaml")
    assert cli("read", link(pump, model="P1"), "speed").code == 2
    assert cli("read", link(pump), "speed", "--map", tmp_path / "pump.yaml").out == "speed  1450 rpm\n"


def test_the_configuration_names_a_map_beside_itself(cli: Run, pump: Running, tmp_path: Path) -> None:
    Path("maps/acme/pump.yaml").rename(tmp_path / "pump.yaml")
    (tmp_path / "devices.yaml").write_text(
        f"format: 1\ndevices: {{well: {{link: 'tcp:{pump.host}:{pump.port}', map: pump.yaml}}}}\n", encoding="utf-8"
    )
    assert cli("read", "well", "speed", "--config", tmp_path / "devices.yaml").out == "speed  1450 rpm\n"


def test_a_device_of_a_map_here_is_listed_and_identified(cli: Run, pump: Running) -> None:
    assert cli("devices", "acme").out == "P1  acme/pump  Acme P1 (maps/acme/pump.yaml)\n"
    (plain,) = json.loads(cli("devices", "acme", "--json").out)["devices"]
    assert (plain["file"], "driver" in plain) == ("maps/acme/pump.yaml", False)
    result = cli("identify", link(pump))
    assert (result.code, result.out.split()[:2]) == (0, ["P1", "acme/pump"])
    assert "kind at address 0 is 7 (acme/pump)" in result.err


def test_writing_checks_the_identity_by_the_map_here(cli: Run, pump: Running) -> None:
    assert cli("write", link(pump, model="P1"), "speed", "900").code == 0
    pump.device.poke("kind", 8)
    assert "does not show to be a P1: kind is 8" in cli("write", link(pump, model="P1"), "speed", "901").err
    assert cli("read", link(pump, model="P1"), "speed", "--value").out == "900\n"


def test_a_map_here_counts_instead_of_the_driver_of_the_same_id_and_that_is_said(cli: Run, oven: str) -> None:
    text = (map_files.shipped() / "athena/series-c.yaml").read_text(encoding="utf-8")
    put("maps/athena/series-c.yaml", text + "# ours\n")
    for name in ("series-c-process.library.yaml",):
        put(f"maps/athena/{name}", (map_files.shipped() / "athena" / name).read_text(encoding="utf-8"))
    result = cli("read", oven, "setpoint_low_limit")
    assert (result.code, result.out) == (0, "setpoint_low_limit  -328 °F\n")
    assert result.err == (
        "athena/series-c:16C is that of maps/athena/series-c.yaml, not the driver that comes with regscribe\n"
    )


def test_the_errors_of_a_map_are_told_as_check_tells_them(cli: Run, pump: Running) -> None:
    put("maps/acme/pump.yaml", PUMP.replace("at: 1,", "at: 0,"))
    told = cli("check", "maps/acme/pump.yaml").out.splitlines()
    pump.requests.clear()
    for named in ({"map": "acme/pump"}, {"model": "acme/pump:P1"}, {"map": "maps/acme/pump.yaml"}):
        result = cli("read", link(pump, **named), "speed")
        assert (result.code, told[0] in result.err) == (1, True), result.err
        assert "Error: the map maps/acme/pump.yaml has errors, so nothing was sent\n" in result.err
    assert not pump.requests
    failed = json.loads(cli("read", link(pump, map="acme/pump"), "speed", "--json").out)
    assert (failed["error"]["kind"], failed["error"]["exit_code"]) == ("map", 1)


def test_a_map_with_errors_keeps_nobody_from_the_others(cli: Run, pump: Running) -> None:
    put("maps/acme/valve.yaml", "format: 1\n")
    assert cli("read", link(pump, model="P1"), "speed").out == "speed  1450 rpm\n"
    assert "maps/acme/valve.yaml has errors and is left out" in cli("devices", "acme").err


def test_a_driver_does_not_stand_in_for_a_map_here_that_has_errors(cli: Run, oven: str) -> None:
    put("maps/athena/series-c.yaml", "format: 1\n")
    result = cli("read", oven, "input_type")
    assert (result.code, "the map maps/athena/series-c.yaml has errors" in result.err) == (1, True)


def test_a_model_that_nobody_has_says_where_it_was_looked_for(cli: Run, pump: Running) -> None:
    put("maps/acme/valve.yaml", "format: 1\n")
    result = cli("read", link(pump, model="zzz"), "speed")
    assert result.code == 2
    assert (
        "in maps/ (2 of your own, maps/acme/valve.yaml has errors: `regscribe check`) or among the drivers"
        in result.err
    )
    assert "there are P1, C10" in result.err
    assert "did you mean `acme/pump`?" in cli("read", link(pump, map="acme/pmup"), "speed").err
    Path("maps").rename("other")
    assert "here (there is no folder maps/)" in cli("read", link(pump, model="zzz"), "speed").err


def test_models_of_the_same_name_in_two_maps_are_asked_about(cli: Run, pump: Running) -> None:
    put("maps/acme/pump-2.yaml", PUMP.replace("acme/pump,", "acme/pump-2,"))
    result = cli("read", link(pump, model="P1"), "speed")
    assert (result.code, "write acme/pump:P1 or acme/pump-2:P1" in result.err) == (2, True)
    assert cli("read", link(pump, model="acme/pump:P1"), "speed").code == 0


def test_two_files_with_one_id_are_asked_about(cli: Run, pump: Running) -> None:
    put("maps/copies/pump.yaml", PUMP)
    result = cli("read", link(pump, model="P1"), "speed")
    assert (result.code, "several maps here have the id acme/pump" in result.err) == (2, True)
    assert cli("read", link(pump, map="maps/copies/pump.yaml"), "speed").code == 0


def test_an_edited_map_is_compiled_anew_and_an_unchanged_one_is_not(
    cli: Run, pump: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[Path] = []
    make = map_drivers._make
    monkeypatch.setattr(map_drivers, "_make", lambda path, place: made.append(path) or make(path, place))
    for _ in range(2):
        assert cli("read", link(pump, model="P1"), "speed").code == 0
    put("maps/acme/pump.yaml", PUMP.replace("Speed", "Revolutions"))
    assert cli("read", link(pump, model="P1"), "revolutions").code == 0
    assert len(made) == 2


def test_a_driver_in_the_cache_that_somebody_changed_is_made_again(cli: Run, pump: Running, tmp_path: Path) -> None:
    assert cli("read", link(pump, model="P1"), "speed").code == 0
    (module,) = (tmp_path / "cache").rglob("pump.py")
    before = module.read_text(encoding="utf-8")
    module.write_text("raise SystemExit('changed')\n", encoding="utf-8")
    assert cli("read", link(pump, model="P1"), "speed").code == 0
    assert module.read_text(encoding="utf-8") == before


def test_a_home_that_cannot_be_written_to_is_no_obstacle(
    cli: Run, pump: Running, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert cli("read", link(pump, model="P1"), "speed").out == "speed  1450 rpm\n"


LIBRARY = """\
format: 1
library: {id: acme/common, title: Common}
enums:
  way: {0: left, 1: right}
"""


def test_a_library_of_ones_own_goes_with_its_map(cli: Run, pump: Running) -> None:
    put("maps/acme/common.library.yaml", LIBRARY)
    of_library = PUMP.replace("manual:", "uses: [acme/common]\nmanual:").replace("unit: rpm", "enum: way")
    put("maps/acme/pump.yaml", of_library)
    pump.device.poke("speed", 1)
    result = cli("read", link(pump, model="P1"), "speed")
    assert result.out == "speed  RIGHT\n", result.err
    put("maps/acme/common.library.yaml", LIBRARY.replace("right", "onward"))
    assert cli("read", link(pump, model="P1"), "speed").out == "speed  ONWARD\n"


def test_the_maps_of_a_checkout_are_not_compiled_where_their_drivers_are_generated(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(map_files.shipped().parent)
    assert not any(map_drivers.origin_of(known.driver) for known in catalogue.models())
