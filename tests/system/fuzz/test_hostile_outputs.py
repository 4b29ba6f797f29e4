"""What maps, devices and files say stays text in backups, logs, pictures, tables and configurations of others."""

import contextlib
import csv
import io
import json
import os
import re
import sqlite3
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from datetime import UTC, datetime
from decimal import Decimal
from importlib import import_module
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
import yaml

from regscribe import plugins
from regscribe.cli.shared import output
from regscribe.emit import python
from regscribe.export.collectd import TARGET, collectd_text
from regscribe.export.csv import csv_text
from regscribe.export.device import Place, device_of
from regscribe.export.device.options import request_of
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.simulate import simulate
from regscribe.tools.live.decode import Decoder
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.log import open_log
from regscribe.tools.live.reading import RegisterReading
from regscribe.tools.live.watch import Round
from regscribe.tools.programs.picture import picture
from regscribe.tools.programs.program import Amount, Program, Segment
from regscribe.tools.programs.program_file import dump as program_text
from regscribe.tools.programs.program_file import load as load_program
from regscribe.tools.settings import backup_file as backups
from regscribe.tools.settings.take import backup
from regscribe_runtime import tcp
from regscribe_runtime.wire.capture import CapturedFrame

from .test_hostile import CANARY, REFUSED, hostile_map, texts

COLLECTD = re.compile(
    r'\s*(#.*|LoadPlugin modbus|</?Plugin( modbus)?>|<(Data|Host) "(?:[^"\\]|\\.)*">|</(Data|Host|Slave)>|<Slave \d+>|'
    r'(Instance|Collect|Address|Port|Type) "(?:[^"\\]|\\.)*"|(RegisterBase|Interval|Baudrate) \d+|'
    r"Register(Type|Cmd) \w+|(Scale|Shift) -?[\d.]+)?"
)
FORMULA = re.compile(r"[=@\t\r]|[+-].*[(|!=]", re.DOTALL)
SPREADSHEET = ("=1+1", "@SUM(A1)", "+cmd|' /C calc'!A0", '=HYPERLINK("http://x","y")')
TERMINAL = (
    "\x1b[31mred",
    "\x1b]0;title\x07",
    "\x9b2J",
    "\r\nnext",
    "a\x08\x08b",
    "\u202eabc",
    "[bold]x[/bold]",
    "[link=http://x]y[/link]",
)


def with_program(hostile: str) -> dict[str, Any]:
    """The hostile map, with a program, effects and what a simulator is told."""
    made, new = hostile_map(hostile), texts(hostile)
    about = {"name": new(), "description": new(), "source": new()}
    steps = [{"at": 20 + at, "id": name, "access": "rw", **about} for at, name in enumerate(("soak", "ramp", "stay"))]
    steps[1]["unit"] = steps[2]["unit"] = "min"
    rows = {"id": "rows", **about, "repeat": "1..2", "stride": 10, "registers": steps}
    made["groups"][1] = {"id": "more", **about, "registers": [rows]}
    made["commands"]["reset"]["effects"] = [{"set": {"level": 1}}]
    made["groups"][0]["registers"][0]["stays"] = "calibration"
    made["programs"] = {
        "recipe": {**about, "segments": {"array": "rows", "setpoint": "soak", "ramp": "ramp", "soak": "stay"}}
    }
    return made


@pytest.fixture(scope="module")
def maps(
    hostile: tuple[str, ...], as_yaml: Callable[[Any], str], tmp_path_factory: pytest.TempPathFactory
) -> list[RegisterMap]:
    path = tmp_path_factory.mktemp("hostile") / "example" / "controller.yaml"
    path.parent.mkdir()
    found = []
    for text in (*hostile, *SPREADSHEET, *TERMINAL):
        path.write_text(as_yaml(with_program(text)), encoding="utf-8", newline="")
        compiled = compile_map(path)
        assert compiled.map or REFUSED & {one.rule for one in compiled.diagnostics}, (text, compiled.diagnostics)
        found += [compiled.map] if compiled.map else []
    return found


def driver_of(register_map: RegisterMap) -> Any:
    ((_, code),) = python.render(register_map).items()
    names: dict[str, Any] = {"__name__": "driver"}
    exec(code, names)  # noqa: S102 - what this test is about
    return names[register_map.models[0].class_name]


def test_programs_of_hostile_text_are_part_of_a_driver_that_executes_nothing(maps: list[RegisterMap]) -> None:
    for register_map in maps:
        driver = driver_of(register_map)
        assert [one.id for one in driver.setpoint_programs] == ["recipe"]
    assert CANARY not in os.environ


def test_a_backup_of_hostile_units_reads_back_as_it_was_taken(maps: list[RegisterMap], tmp_path: Path) -> None:
    path = tmp_path / "backup.yaml"
    for register_map in maps[::4]:
        givens: dict[str, Any] = {"codes": frozenset({1}), "cooled": True}
        with simulate(register_map, "Big", givens=givens) as running:
            link = tcp(running.host, port=running.port, timeout=2.0)
            with driver_of(register_map)(link, unit=running.device.unit, **givens) as device:
                taken = device.run(backup(type(device), link="tcp:h"))
        text = backups.to_text(taken)
        backups.save(path, text)
        assert backups.load(path) == taken
        assert yaml.safe_load(text)["format"] == 1
    assert CANARY not in os.environ


def _spelled(char: str) -> str:
    """A character as a cell has it: as it is if it can be seen, else by its number."""
    if char.isprintable():
        return char
    short = {"\t": "\\t", "\r": "\\r"}
    return short.get(char) or (f"\\x{ord(char):02x}" if ord(char) < 256 else f"\\u{ord(char):04x}")


@pytest.mark.parametrize("text", [*SPREADSHEET, *TERMINAL, "', x); DROP TABLE readings; --", '"', "a,b", "\n"])
def test_a_log_holds_what_a_device_says_as_text(text: str, tmp_path: Path) -> None:
    readings = (RegisterReading("label", text, text, text, None),)
    said = Round(1, datetime(2026, 1, 1, tzinfo=UTC), 0.1, readings, frozenset(), None, late=False)
    for ending in ("csv", "jsonl", "sqlite"):
        log = open_log(tmp_path / f"log.{ending}", "oven")
        log.write(said)
        log.close()
    with (tmp_path / "log.csv").open(newline="", encoding="utf-8") as file:
        row = list(csv.reader(file))[1]
    told = "\n".join("".join(_spelled(char) for char in line) for line in text.split("\n"))
    assert set(row[3:5]) <= {told, f"'{told}"}
    assert not any(FORMULA.match(cell.lstrip()) for cell in row)
    assert json.loads((tmp_path / "log.jsonl").read_text("utf-8"))["registers"]["label"]["value"] == text
    base = sqlite3.connect(tmp_path / "log.sqlite")
    assert base.execute("SELECT value, unit FROM readings").fetchall() == [(text, text)]
    base.close()


def test_the_csv_export_of_hostile_text_holds_no_formula(maps: list[RegisterMap]) -> None:
    for row in csv.reader(io.StringIO(csv_text(maps), newline="")):
        assert [cell for cell in row if FORMULA.match(cell)] == []


def test_a_collectd_configuration_of_hostile_text_holds_its_own_directives_only(maps: list[RegisterMap]) -> None:
    for register_map in maps:
        asked = options_of("collectd", register_map)
        named = request_of([register_map], asked, "collectd", placed=True)
        request = replace(named, name=register_map.title, place=Place(unit=1, host=register_map.title))
        text = collectd_text(device_of(TARGET, request))
        assert [line for line in text.split("\n") if not COLLECTD.fullmatch(line)] == []


def options_of(form: str, register_map: RegisterMap) -> dict[str, str]:
    """The options of a format, for the first model."""
    known = {option.name: option.default for option in plugins.exporter(form).options}
    said = {"model": register_map.models[0].name, "given": "codes=1\ncooled=true", "at": "h:502"}
    return known | {key: value for key, value in said.items() if key in known}


class Tagless(yaml.SafeLoader):
    """Takes the tags that ESPHome's export needs, and no others."""


Tagless.add_constructor("!lambda", lambda loader, node: ("lambda", loader.construct_scalar(node)))  # type: ignore[arg-type]  # a text
Tagless.add_constructor("!literal", lambda loader, node: ("literal", loader.construct_scalar(node)))  # type: ignore[arg-type]  # a text
NUMBERS = re.compile(r"[-+\w\s.=<>&?:;()*/]*")
"""All that a lambda has: numbers, the raw one, and what is done with them."""


def texts_of(found: Any) -> Iterator[Any]:
    """Every key and value of a document."""
    if isinstance(found, dict):
        for key, value in found.items():
            yield from (key, *texts_of(value))
    elif isinstance(found, list):
        for one in found:
            yield from texts_of(one)
    else:
        yield found


@pytest.mark.parametrize("form", ["home-assistant", "esphome", "wiren-board"])
def test_an_export_of_hostile_text_holds_texts_and_nothing_that_is_replaced_or_run(
    maps: list[RegisterMap], form: str
) -> None:
    known = {option.name: option.default for option in plugins.exporter(form).options}
    for register_map in maps:
        asked = known | {"model": register_map.models[0].name, "given": "codes=1\ncooled=true"}
        (text,) = plugins.export(
            form, [register_map], asked | ({"at": "h:502"} if "at" in known else {})
        ).texts.values()
        assert isinstance(text, str)
        plain = re.sub("^//.*\n", "", text, flags=re.MULTILINE)
        said = list(texts_of(json.loads(plain) if form == "wiren-board" else yaml.load(text, Tagless)))  # noqa: S506 - safe
        assert all(NUMBERS.fullmatch(one[1]) for one in said if isinstance(one, tuple) and one[0] == "lambda")
        assert form != "esphome" or not [one for one in said if isinstance(one, str) and "$" in one]
    assert CANARY not in os.environ


OPENHAB = re.compile(
    r"""\s*(//.*|\}|(Bridge|Thing)[ ](?:[^"\\\n]|"(?:[^"\\\n]|\\[btnfru"\\])*")*|
    (Switch|Number(:[A-Za-z]+)?)[ ]\w+[ ](?:[^"\\\n]|"(?:[^"\\\n]|\\[btnfru"\\])*")*\})?""",
    re.VERBOSE,
)


def test_flows_descriptions_and_items_of_hostile_text_hold_their_own_words_only(maps: list[RegisterMap]) -> None:
    codes, keys = set(), set()
    for register_map in maps:
        options = {
            "model": register_map.models[0].name,
            "given": "codes=1\ncooled=true",
            "at": "h:502",
            "writes": "yes",
        }
        made = {}
        for form in ("node-red", "wot-td", "openhab"):
            known = {option.name: option.default for option in plugins.exporter(form).options}
            asked = known | {key: text for key, text in options.items() if key in known}
            made[form] = plugins.export(form, [register_map], asked).texts
        flow = json.loads(made["node-red"][""])
        # the code is the same for every map: what a map says stands in a table of JSON behind the first lines
        codes |= {node["func"].partition("\n]\n")[2] or node["func"] for node in flow if node["type"] == "function"}
        keys |= json.loads(made["wot-td"][""]).keys()
        for text in made["openhab"].values():
            assert isinstance(text, str)
            assert [line for line in text.split("\n") if not OPENHAB.fullmatch(line)] == []
    assert len(codes) == 2
    assert keys == {"@context", "@type", "id", "title", "description", "securityDefinitions", "security", "properties"}
    assert CANARY not in os.environ


def test_a_picture_of_a_hostile_program_is_sound_and_holds_nothing_active(
    hostile: tuple[str, ...], tmp_path: Path
) -> None:
    for text in (*hostile, *TERMINAL):
        unit = " ".join(text.split())[:20]
        segment = Segment(to=Amount(Decimal(5), unit), ramp=Amount(Decimal(1), "min"), outputs={text or "x": text})
        program = Program(name=text, segments=(segment,))
        for element in ET.fromstring(picture(program)).iter():  # noqa: S314 - our own text
            assert element.tag.rpartition("}")[2] not in {"script", "foreignObject", "image", "iframe", "a"}
            assert not [name for name, _ in element.items() if name.startswith("on") or name.endswith("href")]
        path = tmp_path / "program.yaml"
        path.write_text(program_text(program), encoding="utf-8")
        assert yaml.safe_load(path.read_text(encoding="utf-8"))["format"] == 1
        with contextlib.suppress(TargetError):
            assert load_program(path).program.name == " ".join(text.split())


@pytest.mark.parametrize("is_terminal", [False, True])
@pytest.mark.parametrize("text", TERMINAL)
def test_a_table_shows_control_characters_and_markup_instead_of_obeying(
    text: str, *, is_terminal: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = io.StringIO()
    monkeypatch.setattr(shown, "isatty", lambda: is_terminal, raising=False)
    monkeypatch.setattr(sys, "stdout", shown)
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setenv("NO_COLOR", "1")
    output.show_table(("name", "value"), [("level", text)], title=text)
    lines = shown.getvalue().split("\n")
    assert all(line.isprintable() for line in lines), lines
    for mark in re.findall(r"\[/?\w+[^\]\x07]*\]", text):
        assert mark in shown.getvalue()


def test_what_was_captured_of_a_hostile_map_is_decoded_into_text(maps: list[RegisterMap]) -> None:
    for register_map in maps[::4]:
        decoder = Decoder(driver_of(register_map))
        for at in range(10):
            asked = bytes([3, 0, at, 0, 1])
            decoder.feed(CapturedFrame("rtu", 1, asked, asked), "sent")
            answer = bytes([3, 2, 0, 2])
            assert decoder.feed(CapturedFrame("rtu", 1, answer, answer), "received")


MOST = 100_000
"""Characters of a text that a map may hold."""

LONG_PLACES: dict[str, Callable[[dict[str, Any], str], Any]] = {
    "description of the map": lambda made, long: made.update(description=long),
    "title": lambda made, long: made["map"].update(title=long),
    "name": lambda made, long: made["groups"][0]["registers"][1].update(name=long),
    "label": lambda made, long: made["enums"]["kinds"]["1"].update(label=long),
    "note": lambda made, long: made["notes"].append(long),
    "meaning of an exception": lambda made, long: made["protocol"]["exceptions"]["2"].update(meaning=long),
    "danger of a command": lambda made, long: made["commands"]["reset"].update(danger=long),
    "name of a program": lambda made, long: made["programs"]["recipe"].update(name=long),
}


@pytest.mark.parametrize("place", LONG_PLACES)
@pytest.mark.parametrize("characters", [MOST, 1_000_000])
def test_a_text_of_a_megabyte_is_refused_with_its_place_and_the_longest_is_rendered(
    place: str, characters: int, as_yaml: Callable[[Any], str], tmp_path: Path
) -> None:
    made = with_program("plain")
    LONG_PLACES[place](made, "x" * characters)
    path = tmp_path / "example" / "controller.yaml"
    path.parent.mkdir()
    path.write_text(as_yaml(made), encoding="utf-8")
    compiled = compile_map(path)
    assert (compiled.map is None) == (characters > MOST), compiled.diagnostics
    if compiled.map is None:
        assert [one.rule for one in compiled.diagnostics] == ["RS0117"]
        assert compiled.diagnostics[0].span.line
    else:
        driver_of(compiled.map)
        for name in ("emit.markdown", "pictures"):
            assert all(import_module(f"regscribe.{name}").render(compiled.map).values())
        assert csv_text([compiled.map])
