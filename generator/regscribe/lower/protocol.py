"""How the device behaves on the line, as the map's `protocol` tells it; what it does not tell is as in Modbus."""

from dataclasses import replace
from fractions import Fraction

from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import WRONG_SORT
from regscribe.lower.texts import ends, whole_ends
from regscribe.model import (
    SILENCE,
    ExceptionCode,
    Faults,
    Latency,
    Protocol,
    ProtocolNotes,
    SerialDefaults,
    Space,
    SpaceLimits,
)

_CODES = (
    *("function", "address", "value", "read_only", "condition", "quantity"),
    *("misaligned_address", "misaligned_count", "view_function", "unused_write"),
)


def protocol_of(node: Value) -> Protocol:
    """What a driver knows of the device."""
    plain = Protocol()
    limits = node.mapping_of("limits")
    return Protocol(
        functions=node.wholes_of("functions", plain.functions),
        unit_ids=whole_ends(node.child("unit_ids"), plain.unit_ids),
        read_words=limits.whole_of("read_words", plain.read_words),
        write_words=limits.whole_of("write_words", plain.write_words),
        read_bits=limits.whole_of("read_bits", plain.read_bits),
        write_bits=limits.whole_of("write_bits", plain.write_bits),
        read_holes=node.truth_of("read_holes"),
        broadcast=node.wholes_of("broadcast"),
        exceptions=tuple(
            ExceptionCode(code.key_whole(), code.line_of("name"), code.line_of("meaning"))
            for _, code in node.items_of("exceptions")
        ),
        latencies=tuple(_latency(latency) for _, latency in node.items_of("latency")),
        serial=_serial(node.mapping_of("serial")),
        absent=faults_of(node).address,
        spaces=tuple(
            SpaceLimits(Space(name), each.whole_of("read"), each.whole_of("write"))
            for name, each in node.items_of("space_limits")
        ),
        pause=node.fraction_of("pause"),
    )


def faults_of(protocol: Value) -> Faults:
    """The answers to bad requests."""
    faults, node = Faults(), protocol.mapping_of("faults")
    answers = {key: each for key, each in node.items() if key in _CODES}
    codes = {key: SILENCE if each.value == "silence" else each.whole() for key, each in answers.items()}
    codes.setdefault("unused_write", codes.get("address", faults.unused_write))
    return replace(
        faults,
        **codes,
        later_read=node.choice_of("later_read", faults.later_read),
        later_write=node.choice_of("later_write", faults.later_write),
    )


def notes_of(protocol: Value) -> ProtocolNotes:
    """What documents the protocol."""
    serial = protocol.mapping_of("serial")
    parts = (protocol, protocol.mapping_of("limits"), protocol.mapping_of("faults"), serial)
    return ProtocolNotes(
        section=protocol.text_of("source"),
        serial=serial.text_of("description"),
        latencies=tuple((each.key_whole(), each.text_of("note")) for _, each in protocol.items_of("latency")),
        stated=tuple(sorted({key for part in parts for key, _ in part.items()})),
    )


def _latency(node: Value) -> Latency:
    fixed, per_word = (ends(times) if (times := node.child(key)) else (ZERO, ZERO) for key in ("fixed", "per_word"))
    return Latency(node.key_whole(), *fixed, *per_word, node.fraction_of("characters"))


def _serial(node: Value) -> SerialDefaults:
    plain = SerialDefaults()
    baud, form = plain.baud, plain.format
    default = node.child("default")
    words = default.text().split() if default else []
    if len(words) == 2 and words[0].isdecimal():  # noqa: PLR2004 - the speed and the format
        baud, form = int(words[0]), words[1]
    elif default:
        message = f"`{default.text()}` is no setting of a serial line"
        default.report(WRONG_SORT, message, remedy="write the speed and the character format, as 9600 8N1")
    return SerialDefaults(
        modes=node.texts_of("modes", plain.modes),
        bauds=node.wholes_of("baud"),
        formats=node.texts_of("formats"),
        baud=baud,
        format=form,
        gap=node.fraction_of("gap_characters", Fraction(plain.gap)),
    )
