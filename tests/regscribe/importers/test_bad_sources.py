"""What is broken, hostile or something else gets one clear message from every importer of a configuration."""

import json
import random
from collections.abc import Callable

import pytest

from regscribe import plugins
from regscribe.plugins import OptionError

from . import (
    test_edgex,
    test_esphome,
    test_home_assistant,
    test_modbus_exporter,
    test_pymodbus_simulator,
    test_solarman,
    test_sunspec,
    test_telegraf,
    test_wiren_board,
)

SAMPLES = {
    "edgex": test_edgex.PROFILE,
    "esphome": test_esphome.CONFIGURATION,
    "home-assistant": test_home_assistant.SENSORS,
    "modbus-exporter": test_modbus_exporter.MODULE,
    "pymodbus-simulator": test_pymodbus_simulator.SHARED,
    "solarman": test_solarman.DEFINITION,
    "sunspec": json.dumps(test_sunspec.CURVES),
    "telegraf": test_telegraf.METRIC,
    "wiren-board": test_wiren_board.TEMPLATE,
}
YAML = ("edgex", "esphome", "home-assistant", "modbus-exporter", "solarman")
JSON = ("pymodbus-simulator", "sunspec", "wiren-board")
TEN = ", ".join(["{0}"] * 10)
BOMB = "a: &a [1, 1]\n" + "".join(
    f"{new}: &{new} [{TEN.format('*' + old)}]\n" for old, new in zip("abcdefg", "bcdefgh", strict=True)
)
MUTANTS = 150


@pytest.mark.parametrize("form", SAMPLES)
@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", ""),
        (b"[1, 2]", ""),
        (b"text", ""),
        (b"a = [\n", ""),
        (b"\xff\xfe\x00", ""),
        (b"a: \xe9", "is no utf-8"),
        (b"a: \x00", "NUL"),
    ],
)
def test_what_is_something_else_is_refused(refusal: Callable[..., str], form: str, data: bytes, said: str) -> None:
    assert said in refusal(form, data)


@pytest.mark.parametrize("form", YAML)
@pytest.mark.parametrize(
    ("text", "said"),
    [
        (BOMB, "more than 400000 values"),
        ("a: " + "[" * 5000, "nested more than 40 deep"),
        ("a: " + "{b: " * 5000, "nested more than 40 deep"),
        ("a: " + "x" * 5_000_000, "a value of 5000000 characters"),
        ("a: *nobody", "names nothing"),
        ("? [a]\n: b", "a key that is a list"),
        ("a: 1\n\tb: 2", "no YAML"),
    ],
)
def test_a_hostile_yaml_is_one_message_at_its_line(
    refusal: Callable[..., str], form: str, text: str, said: str
) -> None:
    assert said in refusal(form, text)


@pytest.mark.parametrize("form", JSON)
@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[" * 100_000, "nested more than 40 deep"),
        ('{"a":' * 5000, "nested more than 40 deep"),
        ('{"a": "' + "x" * 5_000_000 + '"}', "a value of 5000000 characters"),
        ('{"a": 1,, "b": 2}', "no JSON"),
        ('{"a": \n\n nought}', "3: no JSON"),
        ('{"a": "\\q"}', "an escape that is none"),
    ],
)
def test_a_hostile_json_is_one_message_at_its_line(
    refusal: Callable[..., str], form: str, text: str, said: str
) -> None:
    assert said in refusal(form, text)


@pytest.mark.parametrize("form", SAMPLES)
def test_whatever_is_broken_in_a_source_no_importer_breaks(form: str) -> None:
    chance = random.Random(form)  # noqa: S311 - found again by its seed
    options = {one.name: one.default for one in plugins.importer(form).options}
    for _ in range(MUTANTS):
        data = _mutant(SAMPLES[form].encode(), chance)
        try:
            draft = plugins.read(form, data, "source", options)
        except OptionError:
            continue
        assert draft.failed or draft.entries or draft.stated


def _mutant(data: bytes, chance: random.Random) -> bytes:
    """A source with some bytes changed, a piece gone, doubled or put elsewhere, or a number that is absurd."""
    at, length = chance.randrange(len(data)), chance.randrange(1, 40)
    piece = data[at : at + length]
    kind = chance.randrange(5)
    if kind == 0:
        return data[:at] + data[at + length :]
    if kind == 1:
        return data[:at] + piece + piece + data[at + length :]
    if kind == 2:
        other = chance.randrange(len(data))
        return data[:other] + piece + data[other:]
    if kind == 3:
        return data[:at] + bytes([chance.randrange(256)]) + data[at + 1 :]
    digits = [place for place, byte in enumerate(data) if byte in b"0123456789"]
    place = chance.choice(digits)
    absurd = chance.choice((b"-1", b"1e999", b"99999999999999999999", b"0x", b"nan", b"null", b"[1]", b"1.5", b"true"))
    return data[:place] + absurd + data[place + 1 :]
