"""A setpoint program as a typed value, independent of the registers of a device."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from types import MappingProxyType

RAW = "raw"
"""The unit of a number whose scale the manual does not state: the register's own count."""

FOREVER = "forever"
"""The number of cycles of a program without end."""

SECONDS = MappingProxyType({"s": Decimal(1), "min": Decimal(60), "h": Decimal(3600), "d": Decimal(86400)})
"""The units of time, in seconds."""

_NUMBER = r"[+-]?[0-9]{1,20}(?:\.[0-9]{1,20})?"
_AMOUNT = re.compile(rf"({_NUMBER})\s*(\D.*)?")
_TIMES = re.compile(rf"(?:{_NUMBER}\s*(?:d|h|min|s)\s*){{2,4}}")
_TIME = re.compile(rf"({_NUMBER})\s*(d|h|min|s)")


@dataclass(frozen=True, slots=True)
class Amount:
    """A number and its unit: a symbol (`°C`, `min`), `raw` for a count whose scale is not stated, or "" for none."""

    number: Decimal
    unit: str = ""

    def __str__(self) -> str:
        return f"{plain(self.number)} {self.unit}".rstrip()


Setting = Amount | str
"""The value for a register of a program: an amount, or the name of a special value (`OFF`)."""

Outputs = Mapping[str, str]
"""The states of outputs and events by the names that the map gives them: names of members."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """A ramp `to` a setpoint in the time `ramp`, and the time `soak` there (None: the device has ramps only)."""

    to: Setting
    ramp: Setting
    soak: Setting | None = None
    outputs: Outputs = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Final:
    """The setpoint and outputs after the last segment."""

    to: Setting
    outputs: Outputs = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Program:
    """A setpoint program. What is None the device does not have, or (in a file) leaves as it is.

    `number_of_segments` is needed only where the manual does not say which segments the device counts. `cycles` is the
    device's own number of runs or repetitions, or `forever`. `time_unit` is s, min, h or d; `power_failure` and `end`
    are names of members of the device's registers. `map_id` and `model` are those of the device it was made for; these
    and the name do not count when programs are compared, since a device does not keep them.
    """

    segments: tuple[Segment, ...]
    name: str = field(default="", compare=False)
    final: Final | None = None
    number_of_segments: int | None = None
    cycles: int | str | None = None
    time_unit: str | None = None
    holdback: Setting | None = None
    power_failure: str | None = None
    end: str | None = None
    map_id: str = field(default="", compare=False)
    model: str = field(default="", compare=False)


def plain(number: Decimal) -> str:
    """A number as decimal text without an exponent and without zeros at its end."""
    text = f"{number:f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def setting(text: str) -> Setting:
    """The setting of a text: `250 °C`, `1 h 30 min`, `30 raw`, else a name. ValueError for an empty one."""
    text = " ".join(text.split())
    if not text:
        message = "there is no value"
        raise ValueError(message)
    if _TIMES.fullmatch(text):
        parts = _TIME.findall(text)
        unit = min((unit for _, unit in parts), key=SECONDS.__getitem__)  # the smallest
        seconds = sum((Decimal(number) * SECONDS[own] for number, own in parts), Decimal(0))
        return Amount(seconds / SECONDS[unit], unit)
    found = _AMOUNT.fullmatch(text)
    return Amount(Decimal(found[1]), found[2] or "") if found else text
