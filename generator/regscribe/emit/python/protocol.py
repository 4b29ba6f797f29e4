"""The protocol of a device family as one constant of its driver."""

from regscribe.emit.python.layout import Call, call, group, mapping
from regscribe.emit.python.literals import literal
from regscribe.emit.text import one_line
from regscribe.model import Protocol

PROTOCOL = "_PROTOCOL"
"""The name of the constant."""
MARGIN_SECONDS = 0.5
"""Added to the manual's longest latency for the frames themselves and for a gateway."""
SHORTEST_TIMEOUT = 1.0


def protocol_call(protocol: Protocol) -> Call:
    """The constant of a map's protocol."""
    serial = protocol.serial
    return call(
        "Protocol",
        functions=group([str(code) for code in protocol.functions]),
        read_words=str(protocol.read_words),
        write_words=str(protocol.write_words),
        read_bits=str(protocol.read_bits),
        read_holes=str(protocol.read_holes),
        unit_ids=group([str(unit) for unit in protocol.unit_ids]),
        exceptions=mapping(
            [(str(one.code), group([literal(one.name), literal(one_line(one.meaning))])) for one in protocol.exceptions]
        ),
        timeout=str(timeout(protocol)),
        baud=str(serial.default_baud) if serial.default_baud else None,
        format=literal(serial.default_format) if serial.default_format else None,
        modes=group([literal(mode) for mode in serial.modes]),
    )


def timeout(protocol: Protocol) -> float:
    """Seconds after which no good answer can come: the longest latency of a full request and a margin."""
    words = max(protocol.read_words, protocol.write_words)
    longest = max((one.maximum + one.maximum_per_word * words for one in protocol.latencies), default=0)
    return max(SHORTEST_TIMEOUT, float(longest) / 1000 + MARGIN_SECONDS)
