"""What a device does by itself: effects of commands, and the loop between its process value and its outputs.

Only a simulator needs these facts; a driver has the device itself. Registers are named by path, bits and bit fields as
`register.field`.
"""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe_runtime.values.conditions import ALWAYS, Condition


@dataclass(frozen=True, slots=True)
class Effect:
    """What a command changes besides the words that it writes, if `when` holds as it comes.

    `sets` are (register or field, value of use), `defaults` the registers that return to their defaults; `unlatch`:
    latched alarms are released.
    """

    when: Condition = ALWAYS
    sets: tuple[tuple[str, Fraction | str], ...] = ()
    defaults: tuple[str, ...] = ()
    unlatch: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Pid:
    """Proportional control under `when`: registers of its parameters (empty: the device has none).

    `band` is in units of the process value, or in per cent of the distance between the two registers of `ends`; a band
    of 0 is on/off control. `integral` and `derivative` are in seconds, 0 is none; `bias` is added to the output.
    """

    when: Condition = ALWAYS
    band: str
    integral: str = ""
    derivative: str = ""
    bias: str = ""
    ends: tuple[str, str] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class OnOff:
    """On/off control under `when`: on at `hysteresis` (a register) before the setpoint, off at the setpoint."""

    when: Condition = ALWAYS
    hysteresis: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Output:
    """One output: the register that shows it, of which `full` is all of it, and what decides how much it gives.

    It heats, but cools where `cools` holds. In manual mode it gives what `manual` says (empty: what is written to
    `percent` itself), with a broken sensor what `failsafe` says (empty: nothing). `low` and `high` limit it; they and
    `failsafe` count as `percent` does. `active` is a bit that tells whether it gives anything.
    """

    percent: str
    full: Fraction = Fraction(100)
    cools: Condition | None = None
    pid: Pid | None = None
    on_off: OnOff | None = None
    manual: str = ""
    failsafe: str = ""
    low: str = ""
    high: str = ""
    active: str = ""


class TripKind(StrEnum):
    """What makes an alarm: the process value beyond a limit, or its distance from the setpoint."""

    HIGH = "high"
    LOW = "low"
    DEVIATION_HIGH = "deviation_high"
    DEVIATION_LOW = "deviation_low"
    INSIDE = "inside"
    OUTSIDE = "outside"


@dataclass(frozen=True, slots=True)
class Trip:
    """One kind of alarm under `when`; `limit` is the register of the limit, of the deviation or of half the band."""

    kind: TripKind
    limit: str
    when: Condition = ALWAYS


@dataclass(frozen=True, slots=True, kw_only=True)
class Alarm:
    """One alarm, in use where `when` holds: the bits that show it and the first of `trips` that holds.

    It ends when the process value is `hysteresis` (a register) back, or, where `latched` holds, when it is released.
    It begins once the trip lasted `delay` seconds (a register), and not in the first `inhibit` seconds (a register)
    after power came.
    """

    active: tuple[str, ...]
    trips: tuple[Trip, ...]
    when: Condition = ALWAYS
    latched: Condition | None = None
    hysteresis: str = ""
    delay: str = ""
    inhibit: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ramp:
    """How the working setpoint goes to a new one: registers of the steps up and down in `seconds`; 0 is at once.

    `shows` is the register of the working setpoint (empty: none shows it).
    """

    rises: str = ""
    falls: str = ""
    seconds: int = 60
    shows: str = ""
    when: Condition = ALWAYS


@dataclass(frozen=True, slots=True, kw_only=True)
class Process:
    """Which registers of a model play which role in controlling one process value.

    `off`: no output gives anything; `manual`: the outputs are set by hand. `highest` and `lowest` keep the extremes of
    `value`, `fault` is a bit that tells of a broken sensor. `assumed` is what the manual leaves open, (what, why).
    """

    value: str
    setpoint: str
    outputs: tuple[Output, ...] = ()
    alarms: tuple[Alarm, ...] = ()
    ramp: Ramp | None = None
    off: Condition | None = None
    manual: Condition | None = None
    highest: str = ""
    lowest: str = ""
    fault: str = ""
    assumed: tuple[tuple[str, str], ...] = ()
    section: str = ""
    span: Span = NOWHERE
