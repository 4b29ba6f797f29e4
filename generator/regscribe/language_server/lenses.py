"""What a compiled map adds to its text: how worked examples read, and addresses in other notations."""

from collections.abc import Iterator

from regscribe.checks.rule import RuleScope
from regscribe.checks.worked_frames import Addressed, addressed
from regscribe.checks.worked_values import in_example
from regscribe.compose.tree import elements, members
from regscribe.language_server.files import MapText
from regscribe.language_server.names import REGISTER, Declaration, declared_at
from regscribe.language_server.positions import place_of
from regscribe.language_server.register_facts import read_as
from regscribe.model import FrameExample, RegisterMap, ValueExample
from regscribe.model.address_text import hexadecimal, modicon
from regscribe.reference import Known, UnknownValueError, decode
from regscribe.source import SourceNode, SourcePlace, display_name

FRAME_REGISTERS = 4
"""Registers of a frame that are named; the rest is counted."""


def read_examples(file: MapText, register_map: RegisterMap) -> Iterator[tuple[SourcePlace, str]]:
    """The worked examples of a file, each with its bytes and what they mean."""
    own = display_name(file.path)
    scopes = {model.name: RuleScope.of(register_map, model) for model in register_map.models}
    for example in register_map.examples:
        if isinstance(example, ValueExample | FrameExample) and example.span.file == own:
            scope = scopes.get(example.model, next(iter(scopes.values())))
            said = _reads(example, scope) if isinstance(example, ValueExample) else _carries(example, scope)
            if said:
                yield place_of(example.span), said


def _reads(example: ValueExample, scope: RuleScope) -> str:
    """What the words of an example mean."""
    register = scope.registers.get(example.register)
    if register is None:
        return ""
    view = next((one for one in register.views if one.name == example.view), register.base)
    known = in_example(scope, example.state)
    try:
        reading = decode(register, view, example.words, known)
    except UnknownValueError:
        return ""
    octets = " ".join(f"{word >> 8 & 0xFF:02X} {word & 0xFF:02X}" for word in example.words)
    return f"{octets} = {read_as(register, reading, known)}"


def _carries(example: FrameExample, scope: RuleScope) -> str:
    """What a frame says: to whom, by which function, and of which registers which values."""
    found = addressed(example, scope)
    if found is None:
        return ""
    frame, registers = found
    known = in_example(scope, (*example.state, *example.writes))
    said = [_carried(one, known) for one in registers[:FRAME_REGISTERS]]
    said += [f"{more} more"] if (more := len(registers) - FRAME_REGISTERS) > 0 else []
    said += [f"exception {frame.exception}"] if frame.exception else []
    direction = "from" if example.answer else "to"
    return f"{direction} unit {frame.unit}, function {frame.function:02d}{': ' if said else ''}{', '.join(said)}"


def _carried(one: Addressed, known: Known) -> str:
    try:
        value = read_as(one.register, decode(one.register, one.view, one.words, known), known) if one.words else ""
    except UnknownValueError:
        value = ""
    return f"{one.register.path} = {value}" if value else one.register.path


def other_addresses(file: MapText, register_map: RegisterMap) -> Iterator[tuple[SourcePlace, str]]:
    """Where each `at` of a file stands, with the address in hexadecimal and Modicon's number."""
    every = [register for model in register_map.models for register in model.registers]
    by_span = {register.span: register for register in reversed(every)}
    own = display_name(file.path)
    for declared in _declared(file):
        found = by_span.get(declared.spot.place.span(own))
        at = declared.node.child("at")
        if found and at and at.elements is None:
            address = found.address
            known = modicon(found.base.space, address)
            yield at.place, f"{hexadecimal(address)}{f' ({known})' if known else ''}"


def _declared(file: MapText) -> Iterator[Declaration]:
    lists = [group.child("registers") for group in elements(file.root.child("groups"))]
    waiting: list[SourceNode | None] = [*lists, *members(file.root.child("sets")).values()]
    while waiting:
        for one in elements(waiting.pop()):
            if one.child("registers"):
                waiting.append(one.child("registers"))
            elif one.members is not None:
                yield declared_at(file.path, one, REGISTER)
