"""What a compiled map adds to its text: how worked examples read, and addresses in other notations."""

from collections.abc import Iterator

from regscribe.checks.rule import RuleScope
from regscribe.checks.worked_values import in_example
from regscribe.compose.tree import elements, members
from regscribe.language_server.files import MapText
from regscribe.language_server.names import REGISTER, Declaration, declared_at
from regscribe.language_server.positions import place_of
from regscribe.language_server.register_facts import read_as
from regscribe.model import RegisterMap, ValueExample
from regscribe.model.address_text import hexadecimal, modicon
from regscribe.reference import UnknownValueError, decode
from regscribe.source import SourceNode, SourcePlace, display_name


def read_examples(file: MapText, register_map: RegisterMap) -> Iterator[tuple[SourcePlace, str]]:
    """The worked examples of a file, each with its bytes and what they mean."""
    own = display_name(file.path)
    scopes = {model.name: RuleScope.of(register_map, model) for model in register_map.models}
    for example in register_map.examples:
        if isinstance(example, ValueExample) and example.span.file == own:
            scope = scopes.get(example.model, next(iter(scopes.values())))
            if said := _reads(example, scope):
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
