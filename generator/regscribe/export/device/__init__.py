"""One device for another program: what all formats share that poll or describe a device (docs/export.md).

A format declares a `Target` and renders a `Device`; what it does not carry of a register's facts is told by itself.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from regscribe.emit.words import one_line
from regscribe.export.device.facts import CODES, RESOLVED, Carries, Carry, device_losses, losses_of
from regscribe.export.device.options import Place, Request, request_of
from regscribe.export.device.points import Fits, LeftOutError, Point, Wire, point_of
from regscribe.losses import Exported, Grade, Loss
from regscribe.model import Kind, Model, Register, RegisterMap
from regscribe.plugins import OptionError
from regscribe.visible import safe

__all__ = [
    "LEFT_OUT",
    "RESOLVED",
    "Carries",
    "Carry",
    "Device",
    "Fits",
    "LeftOutError",
    "Place",
    "Point",
    "Request",
    "Target",
    "Wire",
    "device_of",
    "exported",
]

LEFT_OUT = "register"
UNVERIFIED = "not verified with the real program"


def _nothing(_: Point, __: Request) -> str:
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A form of another program: its name, what it carries of each fact, which words it can read.

    `refuses` says why it leaves out a register whose words it can read (nothing: it does not). `verified` names the
    real program that read such an export in the project's tests, empty if none did. `placed`: it says where the device
    answers. `truth_as_number`: a truth value in a word is exported as the number there, which is told.
    """

    name: str
    carries: Carries
    fits: Fits
    refuses: Callable[[Point, Request], str] = _nothing
    verified: str = ""
    placed: bool = True
    truth_as_number: bool = False

    @property
    def remark(self) -> str:
        """Whether a real program ever read such an export, in words."""
        return f"verified with {self.verified}" if self.verified else UNVERIFIED


@dataclass(slots=True)
class Device:
    """A device to be rendered: its registers worked out for one state, and the losses, to which a format adds."""

    request: Request
    target: Target
    points: tuple[Point, ...] = ()
    losses: list[Loss] = field(default_factory=list)

    @property
    def model(self) -> Model:
        """The model as it stands on the device."""
        return self.request.model

    @property
    def register_map(self) -> RegisterMap:
        """The map."""
        return self.request.register_map

    @property
    def name(self) -> str:
        """What the user calls it."""
        return self.request.name

    @property
    def place(self) -> Place:
        """Where it answers. Raises OptionError if nobody said it."""
        if self.request.place is None:
            message = f"--format {self.target.name} needs to know where the device answers: say it by --at"
            raise OptionError(message)
        return self.request.place

    def each(self) -> Iterator[Point | Loss]:
        """Every register that was asked for, in the order of the map: a point, or the loss of all of it."""
        points = {point.register.path: point for point in self.points}
        lost = {loss.register: loss for loss in self.losses if loss.fact == LEFT_OUT}
        yield from (points.get(one.path) or lost[one.path] for one in self.request.registers)

    @property
    def heading(self) -> tuple[str, ...]:
        """What stands above an export, as comments where a format has any: what it was made of."""
        what = f"{one_line(self.register_map.title)}, model {one_line(self.model.name)}, map {self.register_map.id}"
        state = "for one state of the device: the defaults of the map and what was stated beside them"
        return safe(what), state, f"{self.target.name}: {self.target.remark}"

    def lose_version(self, point: Point) -> None:
        """Tell that a version is shown as a number, if it is one."""
        if point.register.kind is Kind.VERSION:
            done = f"shown as the number that packs its {point.register.version_digits} digits"
            self.lose(point.register, "version", Grade.LOST, done)

    def lose(self, register: Register | str, fact: str, grade: Grade, done: str) -> None:
        """Tell a loss, by its fact or code, of a register (by itself or its path; empty: of the whole device)."""
        if fact not in CODES:
            message = f"`{fact}` is none of the facts and codes of losses"
            raise KeyError(message)
        path = register if isinstance(register, str) else register.path
        self.losses.append(Loss(path, fact, grade, done, self.model.name))


Render = Callable[[Device], str | bytes | Mapping[str, str | bytes]]
"""Makes the text of a device, or several by path."""


def exported(target: Target, maps: Sequence[RegisterMap], options: Mapping[str, str], render: Render) -> Exported:
    """Return the export of the one device that the options ask for. Raises OptionError."""
    device = device_of(target, request_of(maps, options, target.name, placed=target.placed))
    if not device.points:
        reasons = "; ".join(dict.fromkeys(loss.done for loss in device.losses)) or "the model has no registers"
        message = f"{target.name} can say nothing of what was asked for: {reasons}"
        raise OptionError(message)
    made = render(device)
    texts = made if isinstance(made, Mapping) else {"": made}
    return Exported(texts, tuple(device.losses), (f"{target.name}: {target.remark}",))


def device_of(target: Target, request: Request) -> Device:
    """Return the device that was asked for, with the losses that follow from what the target declares."""
    device = Device(request, target)
    for one in request.unplaced:
        block = one.block
        why = f"left out: nobody stated where its block `{block}` begins: say it by --base {block}=ADDRESS"
        device.lose(one, LEFT_OUT, Grade.LOST, why)
    device.points = tuple(point for one in request.registers if (point := _point(one, device)) is not None)
    device.losses += device_losses(request.register_map, request.model, target.carries)
    return device


def _point(register: Register, device: Device) -> Point | None:
    """Work out a register and tell its losses; None, with the reason told, where the form cannot say it."""
    if device.target.placed and register.reading.clears and register.path not in device.request.named:
        done = "left out: reading it changes it; name it by --register to have it polled"
        device.lose(register, LEFT_OUT, Grade.LOST, done)
        return None
    try:
        point = point_of(register, device.request.known, device.target.carries, device.target.fits)
    except LeftOutError as why:
        device.lose(register, LEFT_OUT, Grade.LOST, f"left out: {why}")
        return None
    if why_not := device.target.refuses(point, device.request) or _too_long(point, device):
        device.lose(register, LEFT_OUT, Grade.LOST, f"left out: {why_not}")
        return None
    if block := device.request.blocks.get(register.path):
        device.lose(register, "block", Grade.WRONG, f"fixed for the device as stated: where its block `{block}` begins")
    if device.target.truth_as_number and register.kind is Kind.BOOLEAN and point.wire.space.is_words:
        device.lose(register, "boolean", Grade.COSMETIC, "a number: 0 is false")
    device.losses += losses_of(register, device.target.carries, device.model.name, point.view)
    if point.written_otherwise and device.target.carries.get("write", Carry.NO) is not Carry.NO:
        device.lose(register, "write", Grade.LOST, "read only: it is written in another form than it is read in")
    return point


def _too_long(point: Point, device: Device) -> str:
    """Why a program that polls cannot read a point at all: it reads each in one request."""
    most = device.register_map.protocol.most_read(point.wire.space)
    if not device.target.placed or point.words <= most:
        return ""
    return f"it has {point.words} words, of which the device answers {most} in a request"
