"""The exporter of a poll by collectd's modbus plugin, of one model of one map (docs/export.md is its contract)."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from fractions import Fraction

from regscribe.checks.held_values import default_values, with_fields
from regscribe.export.collectd.configuration import EVERY, Poll, collectd_text
from regscribe.model import GivenKind, Model, RegisterMap, parse
from regscribe.model.located import layout_of, located
from regscribe.plugins import Option, OptionError
from regscribe.reference import Surroundings, surroundings_of
from regscribe_runtime.values.blocks import bases_in

name = "collectd"
summary = "a configuration of collectd's modbus plugin that polls one model"
options = (
    Option("model", "the manual's name of the model; not needed where the map has one.", metavar="M"),
    Option("at", "where it answers, on TCP or a serial line.", metavar="HOST:PORT|DEVICE"),
    Option("name", "what to call it; else by its model and unit.", metavar="NAME"),
    Option("unit", "unit id; else the map's default.", metavar="N"),
    Option("every", "how often.", default=str(EVERY), metavar="SECONDS"),
    Option("with", "what a register holds for good.", metavar="PATH=VALUE", several=True),
    Option("base", "where a block begins; blocks without it are not polled.", metavar="NAME=ADDRESS", several=True),
    Option("given", "a fact that the manual does not say.", metavar="ID=VALUE", several=True),
)

FIRST_UNIT, LAST_UNIT = 1, 255
LAST_PORT = 0xFFFF
LONGEST_INTERVAL = 10**9
NAME = r"[A-Za-z0-9][A-Za-z0-9._-]{0,39}"
"""What collectd can make a folder of."""

NUMBER = re.compile(r"-?[0-9]{1,20}(\.[0-9]{1,20})?")
"""A decimal of a sane length: an exponent may ask for more digits than there is memory."""

CODES = re.compile(r"\s*(-?[0-9]{1,6})(?:\.\.(-?[0-9]{1,6}))?\s*")
MOST_CODES = 0x10000
FACTS = {"true": True, "false": False}


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> dict[str, str]:
    """Return the configuration. Raises OptionError."""
    wanted = options["model"] or (maps[0].only_model if maps else "")
    if len(maps) != 1 or not wanted or not options["at"]:
        message = "--format collectd polls one device: name one MAP, its --model, and where it answers (--at)"
        raise OptionError(message)
    (register_map,) = maps
    model = _located(register_map, _model(register_map, wanted), _each(options["base"]))
    known = _surroundings(register_map, model, _each(options["with"]), _each(options["given"]))
    return {"": collectd_text(register_map, model, _poll(register_map, model, options), known)}


def _each(texts: str) -> list[str]:
    return texts.split("\n") if texts else []


def _model(register_map: RegisterMap, wanted: str) -> Model:
    if register_map.has(wanted):
        return register_map.model(wanted)
    known = [one.name for one in register_map.models]
    near = get_close_matches(wanted, known, n=1, cutoff=0.3)
    meant = f"; did you mean `{near[0]}`?" if near else ""
    message = f"{register_map.id} has no model `{wanted}`: it has {', '.join(known)}{meant}"
    raise OptionError(message)


def _located(register_map: RegisterMap, model: Model, texts: Sequence[str]) -> Model:
    """The model with the blocks whose base is stated, and without the registers of others."""
    try:
        bases = bases_in(register_map.id, register_map.blocks, texts)
    except ValueError as error:
        message = f"--base {error}"
        raise OptionError(message) from None
    blocks = {register.block for register in model.registers} - {""}
    if blocks and not blocks & bases.keys():
        where = f"say where they begin, as --base {min(blocks)}=ADDRESS"
        message = f"registers stand in blocks ({', '.join(sorted(blocks))}), which collectd cannot look for: {where}"
        raise OptionError(message)
    stated = tuple(one for one in model.registers if one.block in bases or not one.block)
    layout = layout_of(register_map, model, bases)
    return located(replace(model, registers=stated), layout) if blocks else model


def _surroundings(register_map: RegisterMap, model: Model, state: Sequence[str], givens: Sequence[str]) -> Surroundings:
    """Return the state for which the poll is worked out: the defaults, and what --with and --given say.

    Each of `state` is PATH=VALUE (a number or a member's id), each of `givens` ID=VALUE.
    """
    values = with_fields(model, default_values(model) | dict(_register_value(model, text) for text in state))
    stated = dict(_given(register_map, text) for text in givens)
    try:
        return surroundings_of(register_map, stated, values)
    except ValueError as error:
        message = f"--given: {error}"
        raise OptionError(message) from None


def _given(register_map: RegisterMap, text: str) -> tuple[str, bool | str | Fraction | frozenset[Fraction]]:
    name, _, value = text.partition("=")
    kinds = {given.id: given.kind for given in register_map.givens}
    if name not in kinds:
        message = f"--given {text}: write ID=VALUE; {register_map.id} has the givens {', '.join(kinds) or '(none)'}"
        raise OptionError(message)
    if kinds[name] is GivenKind.CODES:
        return name, _codes(text, value)
    if kinds[name] is GivenKind.BOOLEAN:
        if value not in FACTS:
            message = f"--given {text}: it is true or false"
            raise OptionError(message)
        return name, FACTS[value]
    return name, Fraction(value) if NUMBER.fullmatch(value) else value


def _register_value(model: Model, text: str) -> tuple[str, Fraction]:
    path, equals, value = text.partition("=")
    register = next((each for each in model.registers if each.path == path), None)
    if not equals or register is None:
        message = f"--with {text}: write PATH=VALUE, PATH being a register of {model.name}"
        raise OptionError(message)
    members = {name.upper(): code for name, code in register.enum.codes.items()} if register.enum else {}
    if value.upper() in members:
        return path, Fraction(members[value.upper()])
    if not NUMBER.fullmatch(value):
        known = f"a number or one of {', '.join(members)}" if members else "a number"
        message = f"--with {text}: the value of `{path}` is {known}"
        raise OptionError(message)
    return path, parse(value)


def _codes(text: str, value: str) -> frozenset[Fraction]:
    codes: set[Fraction] = set()
    for part in value.split(","):
        found = CODES.fullmatch(part)
        first, last = (int(found[1]), int(found[2] or found[1])) if found else (0, -1)
        if last - first not in range(MOST_CODES):
            message = f"--given {text}: `{part}` is neither a code nor a range of codes; for example 1,4..6"
            raise OptionError(message)
        codes.update(map(Fraction, range(first, last + 1)))
    return frozenset(codes)


def _poll(register_map: RegisterMap, model: Model, options: Mapping[str, str]) -> Poll:
    protocol, place = register_map.protocol, options["at"]
    usual = register_map.default_unit or max(FIRST_UNIT, protocol.unit_ids[0])
    unit = _whole("unit", options["unit"] or str(usual), LAST_UNIT)
    every = _whole("every", options["every"], LONGEST_INTERVAL)
    called = options["name"] or f"{model.class_name}-{unit}"
    if not re.fullmatch(NAME, called):
        message = f"--name {called}: at most 40 letters, digits, points, hyphens and underscores"
        raise OptionError(message)
    if place.startswith("/"):
        return Poll(name=called, unit=unit, every=every, device=place, baud=protocol.serial.baud)
    found = re.fullmatch(r"([^:\s]+):([0-9]{1,5})", place)
    if not found or not 1 <= int(found[2]) <= LAST_PORT:
        message = f"--at {place}: write HOST:PORT, for example 10.0.0.7:502, or a serial device such as /dev/ttyUSB0"
        raise OptionError(message)
    return Poll(name=called, unit=unit, every=every, host=found[1], port=int(found[2]))


def _whole(option: str, text: str, most: int) -> int:
    if not re.fullmatch(r"[0-9]{1,10}", text) or not 1 <= int(text) <= most:
        message = f"--{option} {text}: write a whole number from 1 to {most}"
        raise OptionError(message)
    return int(text)
