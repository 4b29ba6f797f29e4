"""The reference codec, which every other codec is tested against: slow, obvious, in exact fractions.

Words -> wire number -> stored value -> value of use, and back. The runtime's codec shares no code with it, so that
neither inherits the other's mistakes.
"""

from regscribe.reference.codec import (
    decode,
    encode,
    existing_members,
    missing_bits,
    number_of,
    part_bits,
    part_value,
    present_sentinels,
    sentinel_number,
    special_value,
    version_number,
    version_text,
)
from regscribe.reference.computed import Held, compute
from regscribe.reference.givens import surroundings_of
from regscribe.reference.ieee import ieee_bits, ieee_number, shortest
from regscribe.reference.limits import divided_limits, is_valid, limits, within
from regscribe.reference.outcome import Meaning, Reading, RefusalReason, RefusedError, UnknownValueError
from regscribe.reference.surroundings import (
    MOST_DECIMALS,
    Known,
    Surroundings,
    choose,
    decimal_factor,
    holds,
)
from regscribe.reference.terms import Straight, amount, present_view, straight
from regscribe.reference.whole_numbers import whole_bits
from regscribe.reference.words import (
    AS_IS,
    Arrangement,
    bytes_in_order,
    round_by,
    sent_words,
    transmit,
    wire_number,
    word_order,
    words_in_order,
    words_of_bits,
)

__all__ = [
    "AS_IS",
    "MOST_DECIMALS",
    "Arrangement",
    "Held",
    "Known",
    "Meaning",
    "Reading",
    "RefusalReason",
    "RefusedError",
    "Straight",
    "Surroundings",
    "UnknownValueError",
    "amount",
    "bytes_in_order",
    "choose",
    "compute",
    "decimal_factor",
    "decode",
    "divided_limits",
    "encode",
    "existing_members",
    "holds",
    "ieee_bits",
    "ieee_number",
    "is_valid",
    "limits",
    "missing_bits",
    "number_of",
    "part_bits",
    "part_value",
    "present_sentinels",
    "present_view",
    "round_by",
    "sent_words",
    "sentinel_number",
    "shortest",
    "special_value",
    "straight",
    "surroundings_of",
    "transmit",
    "version_number",
    "version_text",
    "whole_bits",
    "wire_number",
    "within",
    "word_order",
    "words_in_order",
    "words_of_bits",
]
