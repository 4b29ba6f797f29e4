"""The protocol of a device family as one constant of its driver."""

from fractions import Fraction

from regscribe.emit.python.formatting import Call, call, group, mapping
from regscribe.emit.python.literals import literal
from regscribe.emit.words import one_line
from regscribe.model import USUAL_PROTOCOL, Latency, Protocol, Serial

PROTOCOL = "_PROTOCOL"
"""The name of the constant."""
MARGIN_SECONDS = 0.5
"""Added to the manual's longest latency for the frames themselves and for a gateway."""
SHORTEST_TIMEOUT = 1.0
USUAL = Serial()


def protocol_call(protocol: Protocol) -> Call:
    """The constant of a map's protocol."""
    serial = protocol.serial
    [(str(one.function), _latency(one)) for one in protocol.latencies]
    return call(
        "Protocol",
        functions=group([str(code) for code in protocol.functions]),
        read_words=str(protocol.read_words),
        write_words=str(protocol.write_words),
        read_bits=str(protocol.read_bits),
        write_bits=str(protocol.write_bits) if protocol.write_bits != USUAL_PROTOCOL.write_bits else None,
        read_holes=str(protocol.read_holes),
        unit_ids=group([str(unit) for unit in protocol.unit_ids]),
        exceptions=mapping(
            [(str(one.code), group([literal(one.name), literal(one_line(one.meaning))])) for one in protocol.exceptions]
        ),
        absent=str(protocol.faults.address) if protocol.faults.address != USUAL_PROTOCOL.faults.address else None,
        timeout=str(timeout(protocol)),
        baud=str(serial.default_baud) if serial.default_baud else None,
        format=literal(serial.default_format) if serial.default_format else None,
        modes=group([literal(mode) for mode in serial.modes]),
        bauds=group([str(baud) for baud in serial.baud_rates]) if serial.baud_rates else None,
        formats=group([literal(form) for form in serial.formats]) if serial.formats else None,
        gap=_number(serial.gap_characters) if serial.gap_characters != USUAL.gap_characters else None,
        latencies=mapping([(str(one.function), _latency(one)) for one in protocol.latencies])
        if protocol.latencies
        else None,
        broadcast=group([str(code) for code in protocol.broadcast]) if protocol.broadcast else None,
    )


def _latency(latency: Latency) -> Call:
    times = {
        "minimum": latency.minimum,
        "maximum": latency.maximum,
        "minimum_per_word": latency.minimum_per_word,
        "maximum_per_word": latency.maximum_per_word,
        "characters": latency.characters,
    }
    return call("Latency", **{name: _number(time) if time else None for name, time in times.items()})


def _number(number: Fraction) -> str:
    return str(number.numerator) if number.denominator == 1 else repr(float(number))


def timeout(protocol: Protocol) -> float:
    """Seconds after which no good answer can come: the longest latency of a full request and a margin."""
    words = max(protocol.read_words, protocol.write_words)
    longest = max((one.maximum + one.maximum_per_word * words for one in protocol.latencies), default=0)
    return max(SHORTEST_TIMEOUT, float(longest) / 1000 + MARGIN_SECONDS)
