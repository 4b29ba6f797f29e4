"""Results of decoding, and reasons for which encoding refuses a value."""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction


class UnknownValueError(LookupError):
    """A needed value is not known: the register (or `register.field`, or given) is the only argument."""


class RefusalReason(StrEnum):
    """Why a value cannot be encoded."""

    RANGE = "range"
    RESOLUTION = "resolution"
    MEMBER = "member"
    BITS = "bits"
    SENTINEL = "sentinel"
    TYPE = "type"
    CONDITION = "condition"


class RefusedError(ValueError):
    """A value that has no words: `reason` is the class of cause, the message has the numbers."""

    def __init__(self, reason: RefusalReason, detail: str) -> None:
        self.reason = reason
        super().__init__(detail)


class Meaning(StrEnum):
    """Kind of result of decoding."""

    VALUE = "value"
    UNKNOWN_MEMBER = "unknown_member"
    SATURATED = "saturated"
    FAULT = "fault"
    OUT_OF_RANGE = "out_of_range"
    NOT_DECODABLE = "not_decodable"
    NOT_PRESENT = "not_present"


@dataclass(frozen=True, slots=True)
class Reading:
    """Result of decoding: `value` (a number or a text), or `fault` (the sentinel's id), or neither."""

    meaning: Meaning
    value: Fraction | str | None = None
    fault: str = ""


NOT_DECODABLE = Reading(Meaning.NOT_DECODABLE)
SATURATED = Reading(Meaning.SATURATED)
OUT_OF_RANGE = Reading(Meaning.OUT_OF_RANGE)
NOT_PRESENT = Reading(Meaning.NOT_PRESENT)
