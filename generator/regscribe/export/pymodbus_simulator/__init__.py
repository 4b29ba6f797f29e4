"""The exporter of a device for the simulator of pymodbus 3: what each register holds at first, and what may be written.

It holds words and knows no meaning, so every type and order is said by its words. Blocks are never shared: holding 0
and input 0 are two things. Its lists int16, int32, int64 and uint64 are left alone: the first packs a float, the others
are refused.
"""

from collections.abc import Mapping, Sequence

from regscribe.export.device import RESOLVED, Carries, Carry, Device, Place, Target, Wire, exported
from regscribe.export.device.options import CHOICE, MODEL, PLACE, STATE
from regscribe.export.pymodbus_simulator.layout import layout
from regscribe.export.pymodbus_simulator.memory import SPACES, memory_of
from regscribe.losses import Exported
from regscribe.model import RegisterMap
from regscribe.visible import safe

name = "pymodbus-simulator"
summary = "a device for the simulator of pymodbus, with the defaults of the map"
options = (MODEL, *CHOICE, *STATE, *PLACE)

LISTENING = Place(unit=1, host="127.0.0.1", port=5020)
"""Where a simulated device answers if nothing else is said."""

LONGEST = 200
"""Characters of an object of the identification."""

carries: Carries = RESOLVED | {
    **dict.fromkeys(("default", "string", "padding", "version", "bytes", "date", "boolean"), Carry.WHOLE),
    **dict.fromkeys(("write", "write-only", "view", "alias"), Carry.PARTLY),
}


def _fits(wire: Wire) -> bool:
    return wire.space in SPACES


VERIFIED = "pymodbus 3.16.1, read back by the generated driver"
TARGET = Target(name=name, carries=carries, fits=_fits, verified=VERIFIED, placed=False)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the JSON. Raises OptionError."""
    return exported(TARGET, maps, options, _text)


def _text(device: Device) -> str:
    server = {
        **_server(device.request.place or LISTENING),
        "device_id": device.request.unit,
        "identity": _identity(device),
    }
    return layout(server, memory_of(device))


def _server(place: Place) -> dict[str, object]:
    if place.host:
        return {"comm": "tcp", "host": place.host, "port": place.port, "framer": "socket"}
    data, parity, stop = tuple(place.format)
    return {
        "comm": "serial",
        "port": place.device,
        "stopbits": int(stop),
        "bytesize": int(data),
        "parity": parity,
        "baudrate": place.baud,
        "timeout": 3,
        "reconnect_delay": 2,
        "framer": "rtu",
    }


def _identity(device: Device) -> dict[str, str]:
    """What the simulator tells of itself; JSON has no comments, so what it was made of stands here."""
    made_of = "; ".join(device.heading)
    said = {"VendorName": device.register_map.maker, "ModelName": device.model.name, "UserApplicationName": made_of}
    return {key: safe(text)[:LONGEST] for key, text in said.items()}
