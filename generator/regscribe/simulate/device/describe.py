"""Descriptions of requests and answers in the names of the device's map."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from regscribe.simulate.device import codec, plain_values
from regscribe.simulate.device.device import READS, SimulatedDevice
from regscribe.simulate.device.device_plan import AddressSpan
from regscribe.simulate.line.server_context import BROADCAST
from regscribe.simulate.line.service import Exchange
from regscribe_runtime.values.kinds import OCTETS
from regscribe_runtime.values.wire_types import PAGE_BITS, WRITE_AND_READ, Space
from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.pdu import EXCEPTION_BIT, decode_reply
from regscribe_runtime.wire.requests import READ_HOLDING, Request

NAMES = dict.fromkeys(READS, "read") | dict.fromkeys((5, 6, 15, 16, 21), "write")
NAMES |= {7: "read status", 20: "read", 24: "read", 43: "read", 8: "loopback", 22: "mask", 23: "write and read"}
MOST_SHOWN = 6
"""Registers that are named; of more, only their number is given."""


@dataclass(frozen=True, slots=True)
class Told:
    """A request in words: unit, verb, registers with their values, and outcome."""

    unit: int
    verb: str
    what: str
    outcome: str
    good: bool


def tell(devices: Sequence[SimulatedDevice], exchange: Exchange) -> Told:
    """Describe a request and its answer in the names of the device that it concerns."""
    request = exchange.request
    device = next((each for each in devices if request.unit in each.units), None)
    if request.unit == BROADCAST:
        device = devices[0] if devices else None
    verb = NAMES.get(request.pdu[0], f"function {request.pdu[0]}") if request.pdu else "nothing"
    what = _registers(device, exchange) if device is not None else "a unit that is not here"
    good, outcome = _outcome(device, exchange)
    return Told(request.unit, verb, what, outcome, good)


def _outcome(device: SimulatedDevice | None, exchange: Exchange) -> tuple[bool, str]:
    answer = exchange.answer
    if answer is None:
        return exchange.request.unit == BROADCAST, "broadcast" if exchange.request.unit == BROADCAST else "no answer"
    if answer[0] & EXCEPTION_BIT and len(answer) > 1:
        name = device.register_map.protocol.exception(answer[1]).name if device is not None else ""
        return False, f"exception {answer[1]}{f': {name}' if name else ''}"
    return True, "ok"


def _registers(device: SimulatedDevice, exchange: Exchange) -> str:
    """The registers of a request with their values: those that were written, or those that the answer shows."""
    pdu = exchange.request.pdu
    try:
        request = device.understood(pdu)
    except MalformedError:
        return pdu.hex(" ")
    words = request.words
    if request.fetches and exchange.answer is not None:
        words = decode_reply(request, exchange.answer).words
    if request.function == WRITE_AND_READ:
        request = request._replace(function=READ_HOLDING)
    if request.space is None:
        return pdu[1:].hex(" ")
    shown = list(_values(device, request, words, exchange.request.unit))
    if not shown:
        first, last = request.address, request.address + request.quantity - 1
        space = request.space
        return f"{space} {space.spelled(first)}" + (f"..{space.spelled(last)}" if last > first else "")
    more = len(shown) - MOST_SHOWN
    return ", ".join(shown[:MOST_SHOWN]) + (f" and {more} more" if more > 0 else "")


def _values(device: SimulatedDevice, request: Request, words: tuple[int, ...], unit: int) -> Iterator[str]:
    layout = device.state.blueprint.layout
    alike = (READS[code] for codes in device.register_map.alike for code in codes if code in READS)
    spaces = [request.space or Space.HOLDING, *alike]
    at = request.address
    while at < request.address + request.quantity:
        places = (layout.place(each, device.on_page(each, at, unit), writing=not request.reads) for each in spaces)
        place = next(filter(None, places), None)
        if place is None:
            at += 1
            continue
        shift = place.view.space.page(place.start) << PAGE_BITS
        part = words[at - request.address : place.end - shift - request.address]
        whole = at == place.start - shift and len(part) == place.view.words
        yield _spelled(device, place, part if whole else ())
        at = place.end - shift


def _spelled(device: SimulatedDevice, place: AddressSpan, words: tuple[int, ...]) -> str:
    register, view, state = place.register, place.view, device.state
    name = register.path if view is register.base else f"{register.path} ({view.name})"
    if not words:
        return name
    stored = codec.decode(state.seen(view), words, state.order(view))
    if stored is None:
        return f"{name} = NaN"
    if register.kind in OCTETS or isinstance(stored, str):
        return f"{name} = {str(stored).rstrip(chr(0) + ' ')!r}"
    return f"{name} = {plain_values.spell(state, register, stored)}"
