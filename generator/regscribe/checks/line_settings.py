"""Registers that set the line they are written over: what their codes mean, and that they are not copied."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.representable import Fit, best_fit
from regscribe.checks.rule import Problem, RuleScope, register_rule
from regscribe.model import Governs, Kind, Register, SerialDefaults, Setting
from regscribe.reference.states import domain
from regscribe_runtime.values.serial_line import ADDRESSINGS, DATA_BITS, FORMATS, PARITIES, STOP_BITS

ADDRESSES = frozenset({Kind.INTEGER, Kind.RAW})
"""Kinds of registers that can hold a unit id: whole numbers."""

CODES = ADDRESSES | {Kind.NUMBER, Kind.ENUM, Kind.BOOLEAN}
"""Kinds of registers that can hold a code: one value, no word of several parts and no text."""

MOST_BAUD = 10_000_000
"""The fastest speed that the language lets a line have."""


def _possible(setting: Setting, serial: SerialDefaults) -> tuple[str, ...]:
    """What the line can be set to, as far as the map says it; empty if it can be any speed or address."""
    return {
        Setting.BAUD: tuple(map(str, serial.bauds)),
        Setting.PARITY: PARITIES,
        Setting.DATA_BITS: tuple(map(str, DATA_BITS)),
        Setting.STOP_BITS: tuple(map(str, STOP_BITS)),
        Setting.FORMAT: serial.formats or FORMATS,
        Setting.ADDRESSING: tuple(ADDRESSINGS),
        Setting.ADDRESS: (),
    }[setting]


@register_rule("RS0474", "Setting that the line cannot have")
def impossible_setting(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """The driver follows the device to what the code stands for."""
    governs = register.governs
    if governs is None:
        return
    kinds = ADDRESSES if governs.setting is Setting.ADDRESS else CODES
    if register.kind not in kinds:
        message = f"governs the {governs.setting} and is of kind {register.kind}"
        yield message, f"possible are: {', '.join(sorted(kinds))}"
    elif governs.setting is Setting.ADDRESS and governs.codes:
        yield "governs the address with codes", "remove them: the value itself is the address"
    else:
        yield from _codes(register, governs, _possible(governs.setting, scope.register_map.protocol.serial))


def _codes(register: Register, governs: Governs, possible: tuple[str, ...]) -> Iterator[Problem]:
    for code, value in governs.codes:
        valid = value in possible if possible else value.isdecimal() and 0 < int(value) <= MOST_BAUD
        if not valid:
            shown = ", ".join(possible) or f"1 to {MOST_BAUD}"
            yield f"sets {governs.setting} to {value} by code {code}", f"possible are: {shown}"
        elif not _has_value(register, Fraction(code)):
            message = f"governs by code {code}, which is none of its values"
            yield message, "correct the code (a value of use, as scaled), the range or the type"


def _has_value(register: Register, value: Fraction) -> bool:
    if register.enum is not None:
        return value in {member.code for member in register.enum.members}
    if register.kind is Kind.BOOLEAN:
        return value in {0, 1}
    return any(one.holds(value) for one in domain(register)) and best_fit(register, (value,)) is Fit.EXACT


@register_rule("RS0487", "Setting of the line that would be copied")
def copied_setting(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A copy of it to another device cuts that device off, or puts two at one address."""
    if register.governs is None:
        return
    wanted = "address" if register.governs.setting is Setting.ADDRESS else "line"
    if register.stays != wanted:
        now = f"`stays: {register.stays}`" if register.stays else "no `stays`"
        yield f"governs the {register.governs.setting} and has {now}", f"give it `stays: {wanted}`"


@register_rule("RS0493", "Applied without a command")
def applied_without_command(register: Register, _: RuleScope) -> Iterator[Problem]:
    """What holds from its application on needs the command that applies it."""
    governs = register.governs
    if governs is not None and governs.since == "apply" and not register.apply:
        message = f"governs the {governs.setting} from its application on, but has no `apply`"
        yield message, "name the command under `apply`, or correct `from`"
