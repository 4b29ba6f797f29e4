"""The options of formats for one device: which model and registers, where it answers, and in which state it is."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from fractions import Fraction

from regscribe.checks.held_values import default_values, unspellable, with_fields
from regscribe.model import GivenKind, Layout, Model, Register, RegisterMap, parse
from regscribe.model.located import layout_of, located
from regscribe.plugins import Option, OptionError
from regscribe.reference import Surroundings, surroundings_of
from regscribe_runtime.values.blocks import bases_in

EVERY = 10
"""Seconds between two polls."""

MODEL = Option("model", "the manual's name of the model; not needed where the map has one.", metavar="M")
CHOICE = (
    Option("group", "only the registers of this group; may be repeated.", metavar="ID", several=True),
    Option("register", "only this register (`*` stands for any text); may be repeated.", metavar="PATH", several=True),
)
STATE = (
    Option("with", "what a register holds for good.", metavar="PATH=VALUE", several=True),
    Option("base", "where a block begins; blocks without it are left out.", metavar="NAME=ADDRESS", several=True),
    Option("given", "a fact that the manual does not say.", metavar="ID=VALUE", several=True),
)
PLACE = (
    Option("at", "where it answers, on TCP or a serial line.", metavar="HOST:PORT|DEVICE"),
    Option("unit", "unit id; else the map's default.", metavar="N"),
)
NAME = Option("name", "what to call it; else by its model and unit.", metavar="NAME")
POLL = Option("every", "seconds between two polls.", default=str(EVERY), metavar="SECONDS")
DEVICE_OPTIONS = (MODEL, *CHOICE, *STATE, *PLACE, NAME, POLL)
"""The options of a format that polls one device; one that only describes the model has no PLACE, NAME or POLL."""

LAST_UNIT = 255
LAST_PORT = 0xFFFF
LONGEST_INTERVAL = 10**9
CALLED = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,39}")
"""What a device may be called: programs make files and topics of it."""

EIGHT_N_ONE = "8N1"
"""The character format that is meant where a program of the field knows no other."""

NUMBER = re.compile(r"-?[0-9]{1,20}(\.[0-9]{1,20})?")
"""A decimal of a sane length: an exponent may ask for more digits than there is memory."""

CODES = re.compile(r"\s*(-?[0-9]{1,6})(?:\.\.(-?[0-9]{1,6}))?\s*")
MOST_CODES = 0x10000
FACTS = {"true": True, "false": False}


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Where a device answers: `host` and `port`, or the serial `device` with its line, and its unit id there."""

    unit: int
    host: str = ""
    port: int = 502
    device: str = ""
    baud: int = 9600
    format: str = EIGHT_N_ONE


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What the options ask for: the model as it stands on the device, the registers chosen, state, place, name, poll.

    `layout` is where its blocks stand, `blocks` the block of each register in one, by path. `named` are paths that were
    asked for by name. `place` is None where none was said. `unplaced` are registers of blocks whose base nobody stated.
    """

    register_map: RegisterMap
    model: Model
    layout: Layout
    registers: tuple[Register, ...]
    named: frozenset[str]
    known: Surroundings
    unit: int
    name: str
    every: int
    place: Place | None
    blocks: Mapping[str, str] = field(default_factory=dict)
    unplaced: tuple[Register, ...] = ()


def request_of(maps: Sequence[RegisterMap], options: Mapping[str, str], form: str, *, placed: bool) -> Request:
    """Return what the options ask for; `placed`: the format must know where the device answers. Raises OptionError."""
    asked = options["model"] or (maps[0].only_model if maps else "")
    if len(maps) != 1 or not asked or (placed and not options["at"]):
        where = ", and where it answers (--at)" if placed else ""
        message = f"--format {form} is for one device: name one MAP, its --model{where}"
        raise OptionError(message)
    (register_map,) = maps
    written = model_of(register_map, asked)
    model, layout = _located(register_map, written, _each(options["base"]), form)
    known = _surroundings(register_map, model, _each(options["with"]), _each(options["given"]))
    wanted, named = chosen(written, _each(options.get("group", "")), _each(options.get("register", "")))
    paths = {one.path for one in wanted}
    standing = {one.path for one in model.registers}
    registers = tuple(one for one in model.registers if one.path in paths)
    usual = register_map.default_unit or max(1, register_map.protocol.unit_ids[0])
    unit = _whole("unit", options.get("unit", "") or str(usual), LAST_UNIT)
    called = options.get("name", "") or f"{model.class_name}-{unit}"
    if not CALLED.fullmatch(called):
        message = f"--name {called}: at most 40 letters, digits, points, hyphens and underscores"
        raise OptionError(message)
    return Request(
        register_map=register_map,
        model=model,
        layout=layout,
        registers=registers,
        unplaced=tuple(one for one in wanted if one.path not in standing),
        named=named,
        blocks={one.path: one.block for one in written.registers if one.block},
        known=known,
        unit=unit,
        name=called,
        every=_whole("every", options.get("every", str(EVERY)), LONGEST_INTERVAL),
        place=_place(register_map, options["at"], unit) if options.get("at") else None,
    )


def _each(texts: str) -> list[str]:
    return texts.split("\n") if texts else []


def model_of(register_map: RegisterMap, wanted: str) -> Model:
    """Return the model of the name, or of the model id. Raises OptionError."""
    if register_map.has(wanted):
        return register_map.model(wanted)
    known = [one.name for one in register_map.models]
    near = get_close_matches(wanted, known, n=1, cutoff=0.3)
    meant = f"; did you mean `{near[0]}`?" if near else ""
    message = f"{register_map.id} has no model `{wanted}`: it has {', '.join(known)}{meant}"
    raise OptionError(message)


def chosen(model: Model, groups: Sequence[str], patterns: Sequence[str]) -> tuple[tuple[Register, ...], frozenset[str]]:
    """Return the registers of the groups and of the patterns, all without any, and the paths that patterns name.

    Raises OptionError for a group or pattern of none.
    """
    known = {group.id: frozenset(group.members) for group in model.groups}
    if unknown := [name for name in groups if name not in known]:
        message = f"--group {unknown[0]}: {model.name} has the groups {', '.join(known) or '(none)'}"
        raise OptionError(message)
    named: set[str] = set()
    for pattern in patterns:
        matching = re.compile(".*".join(map(re.escape, pattern.split("*"))))
        found = {one.path for one in model.registers if matching.fullmatch(one.path)}
        if not found:
            near = get_close_matches(pattern, [one.path for one in model.registers], n=1)
            meant = f"; did you mean `{near[0]}`?" if near else ""
            message = f"--register {pattern}: {model.name} has no such register{meant}"
            raise OptionError(message)
        named |= found
    if not groups and not patterns:
        return model.registers, frozenset()
    wanted = named.union(*(known[name] for name in groups))
    return tuple(one for one in model.registers if one.path in wanted), frozenset(named)


def _located(register_map: RegisterMap, model: Model, texts: Sequence[str], form: str) -> tuple[Model, Layout]:
    """The model with the blocks whose base is stated, without the registers of others, and where the blocks are."""
    try:
        bases = bases_in(register_map.id, register_map.blocks, texts)
    except ValueError as error:
        message = f"--base {error}"
        raise OptionError(message) from None
    blocks = {register.block for register in model.registers} - {""}
    if blocks and not blocks & bases.keys():
        where = f"say where they begin, as --base {min(blocks)}=ADDRESS"
        message = f"registers stand in blocks ({', '.join(sorted(blocks))}), which {form} cannot look for: {where}"
        raise OptionError(message)
    stated = tuple(one for one in model.registers if one.block in bases or not one.block)
    layout = layout_of(register_map, model, bases)
    return located(replace(model, registers=stated), layout) if blocks else model, layout


def _surroundings(register_map: RegisterMap, model: Model, state: Sequence[str], givens: Sequence[str]) -> Surroundings:
    """Return the state for which all is worked out: the defaults, and what --with and --given say.

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
    if problem := unspellable(register, parse(value)):
        message = f"--with {text}: the device cannot hold {value} in `{path}`, {problem}"
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


def _place(register_map: RegisterMap, text: str, unit: int) -> Place:
    serial = register_map.protocol.serial
    if text.startswith("/") or re.fullmatch(r"COM[0-9]{1,3}", text):
        return Place(unit=unit, device=text, baud=serial.baud, format=serial.format)
    found = re.fullmatch(r"([\w.-]+):([0-9]{1,5})", text)
    if not found or not 1 <= int(found[2]) <= LAST_PORT:
        message = f"--at {text}: write HOST:PORT, for example 10.0.0.7:502, or a serial device such as /dev/ttyUSB0"
        raise OptionError(message)
    return Place(unit=unit, host=found[1], port=int(found[2]))


def _whole(option: str, text: str, most: int) -> int:
    if not re.fullmatch(r"[0-9]{1,10}", text) or not 1 <= int(text) <= most:
        message = f"--{option} {text}: write a whole number from 1 to {most}"
        raise OptionError(message)
    return int(text)
