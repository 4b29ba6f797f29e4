"""The reference codec: slow, obvious, with fractions only; what every other codec is measured against.

Words -> wire number -> stored value -> value of use, and back. Nothing is cached or guessed; the runtime's codec is
written apart from it, so that neither inherits the other's mistakes.
"""

from regscribe.model.reference.codec import decode, encode, version_text
from regscribe.model.reference.ieee import NotFiniteError, ieee_bits, ieee_number, shortest
from regscribe.model.reference.known import NOTHING_KNOWN, Surroundings, choose, decimal_factor, holds, limits
from regscribe.model.reference.outcome import Meaning, Reading, Reason, RefusedError, UnknownValueError
from regscribe.model.reference.words import round_by, transmit, wire_number, word_order

__all__ = [
    "NOTHING_KNOWN",
    "Meaning",
    "NotFiniteError",
    "Reading",
    "Reason",
    "RefusedError",
    "Surroundings",
    "UnknownValueError",
    "choose",
    "decimal_factor",
    "decode",
    "encode",
    "holds",
    "ieee_bits",
    "ieee_number",
    "limits",
    "round_by",
    "shortest",
    "transmit",
    "version_text",
    "wire_number",
    "word_order",
]
