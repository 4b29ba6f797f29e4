"""Broadcast requests: writes to all units of a line at once."""

from collections.abc import Iterable, Mapping
from typing import Any

from regscribe_runtime.driver.device import AsyncBareDevice, BareDevice
from regscribe_runtime.errors import ValueRefused
from regscribe_runtime.link.timing import broadcast_seconds
from regscribe_runtime.operations.write_request import check_condition, check_confirmation, condition_needs
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.conditions import State
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import Request

NOBODY = "no device of this bus is known: add one, or pass driver=..."

Driver = type["BareDevice"] | type["AsyncBareDevice"]


def request_for(
    register: Register[Any],
    value: object,
    drivers: Mapping[str, Driver],
    *,
    givens: State,
    view: str | None = None,
    state: State | None = None,
    confirm: bool = False,
) -> Request:
    """The request that writes a register of all units; ValueRefused with the reason if it must not be sent.

    `drivers` are those of all units on the line, by their names in messages.
    """
    chosen, state = register.write_view(view), state or {}
    _check_units(register, drivers)
    command = register.unlock or register.apply
    if command:
        raise ValueRefused(register.path, f"each unit has to answer the command {command} with it: write unit by unit")
    if register.governs is not None:
        raise ValueRefused(register.path, "it changes how units talk, or their ids: write unit by unit")
    if register.block:
        raise ValueRefused(register.path, f"where block {register.block} stands differs by unit: write unit by unit")
    check_confirmation(register, confirm=confirm)
    needs = (*register.needs(chosen), *register.limit_needs, *condition_needs(register))
    missing = [path for path in dict.fromkeys(needs) if path not in state]
    if missing:
        reason = f"it depends on {', '.join(missing)}, which may differ from unit to unit: pass state={{...}}"
        raise ValueRefused(register.path, reason)
    check_condition(register, state, givens)
    words = register.encode(value, view=view, state=state, givens=givens)
    if any(len(words) > driver.protocol.most_written(chosen.space) for driver in drivers.values()):
        raise ValueRefused(register.path, "it takes several requests: write unit by unit")
    address = chosen.address(register.at)
    if chosen.space.page(address):
        raise ValueRefused(register.path, "each unit has to be on its page first: write unit by unit")
    function = _function(register, chosen, len(words), [driver.protocol for driver in drivers.values()])
    return Request(function, address, len(words), words)


def _check_units(register: Register[Any], drivers: Mapping[str, Driver]) -> None:
    if not drivers:
        raise ValueRefused(register.path, NOBODY)
    for name, driver in drivers.items():
        other = driver.registers.get(register.path)
        if other is None or (other.at, other.views) != (register.at, register.views):
            reason = f"a broadcast reaches every unit, but {name} ({driver.model}) has no such register there"
            raise ValueRefused(register.path, reason)


def _function(register: Register[Any], view: View, words: int, protocols: Iterable[Protocol]) -> int:
    single, several = view.space.write_functions
    for function in [several] if words > view.space.each else [single, several]:
        if all(function in protocol.broadcast for protocol in protocols) and view.allows(function):
            return function
    allowed = {name for protocol in protocols for name in protocol.broadcast}
    reason = f"the manual allows broadcasts by functions {sorted(allowed)}" if allowed else "the manual allows none"
    raise ValueRefused(register.path, f"it cannot be broadcast: {reason}")


def timed(request: Request, drivers: Mapping[str, Driver], line: SerialLine | None) -> Request:
    """The request with the time that the slowest unit needs; ValueRefused if a manual does not allow it."""
    shown = f"broadcast of function {request.function:02d} to address {request.address}"
    for name, driver in drivers.items():
        if request.function not in driver.protocol.broadcast:
            allowed = list(driver.protocol.broadcast) or "none"
            reason = f"to {name} ({driver.model}) the manual allows {allowed}"
            raise ValueRefused(shown, reason)
    seconds = [broadcast_seconds(driver.protocol, request, line) for driver in drivers.values()]
    if not seconds:
        raise ValueRefused(shown, NOBODY)
    return request._replace(seconds=max(seconds))
