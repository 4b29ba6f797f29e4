"""Which registers of a model a worked example of the manual checks."""

from collections.abc import Iterator

from regscribe.model import FrameExample, Model, Register, RegisterMap, Space, ValueExample, View

SPACES = {
    1: Space.COIL,
    2: Space.DISCRETE,
    3: Space.HOLDING,
    4: Space.INPUT,
    5: Space.COIL,
    6: Space.HOLDING,
    7: Space.STATUS,
    15: Space.COIL,
    16: Space.HOLDING,
}
"""The space that a function code addresses."""


def exemplified(register_map: RegisterMap, model: Model) -> frozenset[str]:
    """Return the paths of the registers of `model` that an example decodes, writes, or reads and writes in a frame.

    An example is about one model; it counts for another one whose register has the same views and scale.
    """
    own = {register.path: register for register in model.registers}
    paths = {(name, path) for name, path in _named(register_map) if register_map.has(name)}
    return frozenset(path for name, path in paths if path in own and _alike(own[path], register_map.model(name), path))


def _alike(register: Register, other: Model, path: str) -> bool:
    try:
        shown = other.register(path)
    except KeyError:
        return False
    return (shown.views, shown.scale) == (register.views, register.scale)


def _named(register_map: RegisterMap) -> Iterator[tuple[str, str]]:
    """Yield model and path of every register that an example is about."""
    for example in register_map.examples:
        if isinstance(example, ValueExample):
            yield example.model, example.register
        elif isinstance(example, FrameExample):
            yield from ((example.model, path) for path, _ in example.writes)
            yield from ((example.model, path) for path in _touched(register_map, example))


def _touched(register_map: RegisterMap, frame: FrameExample) -> Iterator[str]:
    """Yield the registers whose words a frame carries; a request without words counts if it is for one register."""
    if frame.address is None or frame.function not in SPACES or not register_map.has(frame.model):
        return
    alike = next((codes for codes in register_map.alike if frame.function in codes), (frame.function,))
    spaces = {SPACES[code] for code in alike if code in SPACES}
    end = frame.address + (frame.count or len(frame.words or ()) or 1)
    found = [
        register.path
        for register in register_map.model(frame.model).registers
        if any(_inside(view, spaces, frame.address, end) for view in register.views)
    ]
    if frame.words or len(found) == 1:
        yield from found


def _inside(view: View, spaces: set[Space], start: int, end: int) -> bool:
    return view.space in spaces and start <= view.address and view.last < end
