"""How the device behaves on the line, as the map's `protocol` tells it."""

from dataclasses import replace
from fractions import Fraction
from typing import TypedDict

from regscribe.lower.interval_text import ends, whole_ends
from regscribe.lower.node import (
    ZERO,
    Value,
    choice_of,
    elements_of,
    fraction_of,
    items_of,
    line_of,
    text_of,
    texts_of,
    truth_of,
    whole_of,
    wholes_of,
)
from regscribe.lower.rules import WRONG_SORT
from regscribe.model import SILENCE, ExceptionCode, Faults, Latency, Protocol, ProtocolNotes, SerialDefaults

_LATER = ("later_read", "later_write")
_CODES = (
    *("function", "address", "value", "read_only", "condition", "quantity"),
    *("misaligned_address", "misaligned_count", "view_function", "unused_write"),
)


def protocol_of(node: Value | None) -> Protocol:
    """What a driver knows of the device; what the map does not tell is as the Modbus specification has it."""
    plain = Protocol()
    if node is None:
        return plain
    limits = node.child("limits") or node
    unit_ids = node.child("unit_ids")
    return Protocol(
        functions=wholes_of(node, "functions", plain.functions),
        unit_ids=whole_ends(unit_ids) if unit_ids else plain.unit_ids,
        read_words=whole_of(limits, "read_words", plain.read_words),
        write_words=whole_of(limits, "write_words", plain.write_words),
        read_bits=whole_of(limits, "read_bits", plain.read_bits),
        write_bits=whole_of(limits, "write_bits", plain.write_bits),
        read_holes=truth_of(node, "read_holes"),
        broadcast=wholes_of(node, "broadcast"),
        exceptions=tuple(
            ExceptionCode(each.key_whole(), line_of(each, "name"), line_of(each, "meaning"))
            for _, each in items_of(node, "exceptions")
        ),
        latencies=tuple(_latency(each) for _, each in items_of(node, "latency")),
        serial=_serial(node.child("serial")),
        absent=faults_of(node).address,
    )


class DeviceFacts(TypedDict, total=False):
    """What the map says of the protocol besides: fields of `RegisterMap`."""

    faults: Faults
    default_unit: int | None
    spares_memory: bool
    alike: tuple[tuple[int, ...], ...]
    accepts: tuple[tuple[str, int], ...]
    protocol_notes: ProtocolNotes


def device_facts(node: Value | None) -> DeviceFacts:
    """The keys of `protocol` that no driver needs."""
    if node is None:
        return {}
    return {
        "faults": faults_of(node),
        "default_unit": whole_of(node, "default_unit") if node.child("default_unit") else None,
        "spares_memory": truth_of(node, "spares_memory"),
        "alike": tuple(tuple(each.whole() for each in one.elements()) for one in elements_of(node, "alike")),
        "accepts": tuple((key, each.whole()) for key, each in items_of(node, "accepts")),
        "protocol_notes": _notes(node),
    }


def _notes(node: Value) -> ProtocolNotes:
    serial = node.child("serial")
    parts = (node, node.child("limits"), node.child("faults"), serial)
    return ProtocolNotes(
        section=text_of(node, "source"),
        serial=text_of(serial, "description") if serial else "",
        latencies=tuple((each.key_whole(), text_of(each, "note")) for _, each in items_of(node, "latency")),
        stated=tuple(sorted({key for part in parts if part for key, _ in part.items()})),
    )


def faults_of(protocol: Value) -> Faults:
    """The answers to bad requests."""
    faults, node = Faults(), protocol.child("faults")
    if node is None:
        return faults
    answers = {key: each for key, each in node.items() if key in _CODES}
    codes = {key: SILENCE if each.value == "silence" else each.whole() for key, each in answers.items()}
    codes.setdefault("unused_write", codes.get("address", faults.unused_write))
    return replace(
        faults,
        **codes,
        later_read=choice_of(node, "later_read", faults.later_read),
        later_write=choice_of(node, "later_write", faults.later_write),
    )


def _latency(node: Value) -> Latency:
    fixed, each = _times(node.child("fixed")), _times(node.child("per_word"))
    return Latency(node.key_whole(), *fixed, *each, fraction_of(node, "characters"))


def _times(node: Value | None) -> tuple[Fraction, Fraction]:
    return ends(node) if node else (ZERO, ZERO)


def _serial(node: Value | None) -> SerialDefaults:
    plain = SerialDefaults()
    if node is None:
        return plain
    baud, form = _default(node.child("default"), plain)
    return SerialDefaults(
        modes=texts_of(node, "modes", plain.modes),
        bauds=wholes_of(node, "baud"),
        formats=texts_of(node, "formats"),
        baud=baud,
        format=form,
        gap=fraction_of(node, "gap_characters", Fraction(plain.gap)),
    )


def _default(node: Value | None, plain: SerialDefaults) -> tuple[int, str]:
    words = node.text().split() if node else []
    if node is None or (len(words) == 2 and words[0].isdecimal()):  # noqa: PLR2004 - the speed and the format
        return (int(words[0]), words[1]) if words else (plain.baud, plain.format)
    message = f"`{node.text()}` is no setting of a serial line"
    node.report(WRONG_SORT, message, remedy="write the speed and the character format, as 9600 8N1")
    return plain.baud, plain.format
