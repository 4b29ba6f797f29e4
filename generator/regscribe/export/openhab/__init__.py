"""The exporter of things and items for openHAB's binding modbus, as text files (docs/export.md).

Facts from the binding's documentation and source: addresses as texts from 0, bits as `X.Y`, no strings and no doubles,
(number + offset) * gain by the profile `modbus:gainOffset`, which fails to write where the quotient has no end.
"""

from collections.abc import Mapping, Sequence

from regscribe.export.device import RESOLVED, Carries, Carry, Device, Target, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.openhab.items import items_of
from regscribe.export.openhab.things import bridge_id, links_of
from regscribe.export.openhab.values import fits
from regscribe.losses import Exported
from regscribe.model import RegisterMap

name = "openhab"
summary = "things and items of openHAB's modbus binding, as two text files"
options = DEVICE_OPTIONS

carries: Carries = RESOLVED | {
    **dict.fromkeys(("scale", "offset", "enum", "flags", "write-only", "name"), Carry.WHOLE),
    **dict.fromkeys(("limits", "functions"), Carry.WHOLE),
    **dict.fromkeys(("unit", "range", "step", "special-value", "boolean", "version", "write"), Carry.PARTLY),
}

TARGET = Target(name=name, carries=carries, fits=fits)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return both files by their places below openHAB's folder `conf`. Raises OptionError."""
    return exported(TARGET, maps, options, _files)


def _files(device: Device) -> Mapping[str, str]:
    lines, links = links_of(device)
    called = bridge_id(device)
    return {
        f"things/{called}.things": "\n".join(lines) + "\n",
        f"items/{called}.items": "\n".join(items_of(device, links)) + "\n",
    }
