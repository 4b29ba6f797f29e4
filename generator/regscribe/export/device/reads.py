"""The requests of a poll: those that read all registers at the least cost, as the driver would read them."""

from collections.abc import Iterator

from regscribe.export.device import Device, Point
from regscribe.losses import Grade
from regscribe.planned_model import PlannedModel
from regscribe_runtime.planning.address_ranges import RegisterSpan, span_of
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import Block, Terms, blocks


def planned_reads(device: Device) -> list[tuple[Block, list[Point]]]:
    """Return each request with the registers that it reads, and tell the loss of those that none can read.

    What is write only is in none of them.
    """
    terms = _terms(device)
    by_span: dict[RegisterSpan, list[Point]] = {}
    for point, span in _readable(device, terms):
        by_span.setdefault(span, []).append(point)
    return [(block, [point for item in block.items for point in by_span[item]]) for block in blocks(by_span, terms)]


def _terms(device: Device) -> Terms:
    request, protocol = device.request, device.register_map.protocol
    registers = {register.path: register for register in device.model.registers}
    subject = PlannedModel(device.model, registers, protocol, request.layout)
    place = device.place
    cost = Cost.tcp(protocol) if place.host else Cost.serial(protocol, baud=place.baud, form=place.format)
    return subject.terms(cost, subject.absent(request.known))


def _readable(device: Device, terms: Terms) -> Iterator[tuple[Point, RegisterSpan]]:
    for point in device.points:
        if not point.register.access.readable:
            continue
        span = span_of(point.view, point.address)
        if terms.ground.stretch(span) is None:
            done = "left out: no request may cover all that must be read with it"
            device.lose(point.register, "register", Grade.LOST, done)
        else:
            yield point, span
