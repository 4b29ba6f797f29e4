"""Agent 2 of Zabbix reads every item of the template; its steps make of that what our driver reads."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import pytest
import yaml

from regscribe import checks, lower, plugins, schema, source
from regscribe.model import RegisterMap
from regscribe_runtime import SensorFault

from .stage import UNIT, Held, Stage
from .zabbix_agent import Agent, agent, run_scripts

pytestmark = pytest.mark.interop("zabbix-agent2")

Item = dict[str, Any]


@pytest.fixture(scope="module")
def asked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Agent]:
    with agent(tmp_path_factory.mktemp("zabbix")) as found:
        yield found


def items(stage: Stage) -> tuple[list[Item], dict[str, str]]:
    """The items of the template and the values of its macros."""
    (template,) = yaml.safe_load(stage.text("zabbix"))["zabbix_export"]["templates"]
    return template["items"], {one["macro"]: one["value"] for one in template["macros"]}


def expanded(key: str, macros: dict[str, str]) -> str:
    for macro, value in macros.items():
        key = key.replace(macro, value)
    return key


def stored(stage: Stage, asked: Agent) -> dict[str, tuple[str, str]]:
    """What Zabbix would store for each key: `value` or `error`, and its text."""
    found, macros = items(stage)
    told = {one["key"]: asked.ask(expanded(one["key"], macros)) for one in found if "master_item" not in one}
    result: dict[str, tuple[str, str]] = {}
    for depends in (False, True):
        wanted = [one for one in found if ("master_item" in one) is depends]
        scripts = [(one, step) for one in wanted for step in one.get("preprocessing", [])]
        for one in wanted:
            result[one["key"]] = result[one["master_item"]["key"]] if depends else ("value", told[one["key"]])
        run = [(step["parameters"][0], result[one["key"]][1]) for one, step in scripts if step["type"] == "JAVASCRIPT"]
        made = iter(run_scripts(run))
        for one, step in scripts:
            number = (
                float(result[one["key"]][1]) * float(step["parameters"][0]) if step["type"] == "MULTIPLIER" else None
            )
            result[one["key"]] = next(made) if number is None else ("value", repr(number))
    return result


def test_every_register_is_read_as_our_driver_reads_it(stage: Stage, asked: Agent) -> None:
    values = stored(stage, asked)
    by_name = {one["name"]: values[one["key"]] for one in items(stage)[0]}
    lost = {one.register for one in stage.export("zabbix").losses if one.fact == "register"}
    registers = {one.path: one for one in stage.running.device.model.registers}
    wrong = {}
    for path, held in stage.held.items():
        if path in lost:
            continue
        name = f"{registers[path].name} ({path})" if registers[path].index else registers[path].name
        if not agrees(held, stage.driver[path], by_name[name]):
            wrong[path] = held, stage.driver[path], by_name[name]
    assert wrong == {}
    assert lost == {"firmware", "clock", "host", "mac", "key", "cooling"}


def agrees(held: Held, read: object, told: tuple[str, str]) -> bool:
    """Whether what is stored is what the driver reads: a fault is an error, with the map's words for it."""
    kind, text = told
    if held.fault:
        return isinstance(read, SensorFault) and kind == "error" and text == read.label
    if isinstance(held.value, str):
        return (kind, text) == ("value", held.value)
    number = 0 if held.special else held.number
    return kind == "value" and (Fraction(text) == number or float(text) == float(number))


def test_the_parts_of_words_are_those_by_hand(stage: Stage, asked: Agent) -> None:
    values = stored(stage, asked)
    found = {key.removeprefix("modbus.part[").rstrip("]"): text for key, (_, text) in values.items() if "part[" in key}
    for path, held in stage.held.items():
        for flag in ("heating", "alarm", "fault") if path == "status" else ():
            assert found[f"{path}.{flag}"] == str(int(flag in held.flags)), (path, flag)
        for part, number in (held.fields or {}).items():
            assert found[f"{path}.{part}"] == str(number), (path, part)


def test_blanks_in_a_key_change_nothing(stage: Stage, asked: Agent) -> None:
    read = f'modbus.get["tcp://{stage.at}","{UNIT}",3,{{}}1,1,int16,be]'
    assert asked.ask(read.format("  ")) == asked.ask(read.format("")) == "-215"


MORE = """\
format: 1
map: {id: test/scripts, title: Scripts, maker: Nobody, class_prefix: Scripts}
manual: {title: The device that exists in tests only, number: "1"}
models: {One: {}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: r}
    registers:
      - {at: 0, name: Range, type: int16, sentinels: {30000..32767: fault}}
      - {at: 1, name: Half, type: float16}
      - {at: 2, name: Wide, type: uint64, sentinels: {18446744073709551615: none}}
      - {at: 6, name: Long, type: int64, decimals: 2, sentinels: {-9223372036854775808: none}}
      - {at: 10, name: Real, type: float32, sentinels: {-9999.9: open}}
      - {at: 12, name: Valid, type: int16, decimals: 1, valid: 0..10.3, access: r}
      - {at: 13, name: Parts, type: uint16, fields: {deep: {bits: 8..15, type: signed, multiply: 0.5, add: 1}}}
      - {at: 14, name: Latin, type: string, length: 2, text: {encoding: latin-1, padding: nul}}
      - {at: 16, name: Wide Text, type: string, length: 2, text: {encoding: utf-8}}
      - {at: 18, name: Low, type: string, length: 3, word_order: little, text: {one_per_register: low}}
      - {at: 21, name: Truth, type: uint16, kind: boolean}
      - {at: 22, name: Halves, type: int16, kind: integer, multiply: 0.5}
      - {at: 23, name: Serial, type: string, length: 2, sentinels: {4294967295: none}}
"""

GIVEN = (
    ("Range", "29999", "29999"),
    ("Range", "30000", "fault"),
    ("Half", "49536", "-2.75"),
    ("Half", "1", "5.960464477539063e-8"),
    ("Half", "31744", "infinite"),
    ("Wide", "18446744073709551615", "none"),
    ("Wide", "18446744073709551614", "18446744073709551614"),
    ("Long", "[65535,65535,65535,65535]", "-0.01"),
    ("Long", "[32768,0,0,0]", "none"),
    ("Long", "[32768,0,0,1]", "-92233720368547760"),
    ("Real", "3323740058", "open"),
    ("Real", "3323740059", "-9999.9013671875"),
    ("Real", "2143289344", "not a number"),
    ("Real", "925353388", "0.000009999999747378752"),
    ("Valid", "103", "10.3"),
    ("Valid", "104", "outside of what it reads while all is well"),
    ("Valid", "-1", "outside of what it reads while all is well"),
    ("Parts: deep", "65280", "0.5"),
    ("Latin", "[16868,0]", "Aä"),
    ("Wide Text", "[50084,8224]", "ä"),
    ("Low", "[67,66,65]", "ABC"),
    ("Truth", "1", "1"),
    ("Truth", "2", "neither 0 nor 1"),
    ("Halves", "4", "2"),
    ("Halves", "5", "no whole number"),
    ("Serial", "[65535,65535]", "none"),
    ("Serial", "[16706,50089]", "no ASCII"),
    ("Serial", "[16706,17152]", "ABC"),
)
"""Name of an item, what is told (-9999.9 is C61C3F9A, 0.00001 is 3727C5AC, ä is E4 or C3 A4); what is stored."""


def compiled(text: str) -> RegisterMap:
    document, found = source.parse(text.encode(), name="map.yaml")
    assert document is not None, found
    assert not schema.validate(document)
    register_map, found = lower.lower(document)
    assert register_map is not None, found
    assert not checks.check(register_map)
    return register_map


def test_the_scripts_make_of_words_what_is_worked_out_by_hand() -> None:
    register_map = compiled(MORE)
    exporter = plugins.exporter("zabbix")
    options = {one.name: one.default for one in exporter.options} | {"at": "h:502"}
    text = str(plugins.export("zabbix", [register_map], options).texts[""])
    (template,) = yaml.safe_load(text)["zabbix_export"]["templates"]
    scripts = {
        one["name"]: one["preprocessing"][0]["parameters"][0] for one in template["items"] if "preprocessing" in one
    }
    made = run_scripts([(scripts[name], value) for name, value, _ in GIVEN])
    assert [(name, value, text) for (name, value, _), (_, text) in zip(GIVEN, made, strict=True)] == list(GIVEN)
