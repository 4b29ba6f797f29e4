"""What keeps a program of the field from writing a register: it sends one function, with nothing before and after."""

from regscribe.export.device.points import Point
from regscribe.model import Protocol


def obstacle(point: Point, protocol: Protocol) -> str:
    """Why a plain write does not do; nothing where it does."""
    register = point.register
    if point.write is None:
        return "it is written in another form than it is read in"
    if register.unlock or register.apply:
        return "a write needs commands around it"
    if register.danger:
        return "a write is dangerous"
    if register.writable:
        return "a write is accepted under a condition"
    return "" if write_function(point, protocol) else "no function of the device writes all of it"


def write_functions(point: Point, protocol: Protocol) -> list[int]:
    """The functions of the device that write it as a whole, that for one register or bit first."""
    to = point.register.write_view
    allowed = [one for one in to.space.write_functions if one in protocol.functions and to.allows(one)]
    single = to.space.write_functions[:1]
    return [one for one in allowed if to.words <= to.space.each or (one,) != single]


def write_function(point: Point, protocol: Protocol) -> int:
    """The first of `write_functions`; 0: none does."""
    return next(iter(write_functions(point, protocol)), 0)


def writes_several(point: Point, protocol: Protocol) -> bool:
    """Whether the function that writes it is the one for several registers or bits."""
    return (write_function(point, protocol),) != point.register.write_view.space.write_functions[:1]
