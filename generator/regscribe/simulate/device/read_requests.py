"""Read requests: the words shown at each address, and the device's answer for addresses that it does not have."""

import struct
import zlib
from dataclasses import dataclass

from regscribe.model import Later, Space
from regscribe.simulate.device.device_plan import Blueprint
from regscribe.simulate.device.state import DeviceState


class Refusal(Exception):  # noqa: N818 -- the device refuses; nothing went wrong in the program
    """The device refuses a request: `code` is the exception code that it answers, or `SILENCE`."""

    def __init__(self, code: int) -> None:
        super().__init__(f"exception code {code}")
        self.code = code


def check_request(blueprint: Blueprint, space: Space, function: int, address: int, count: int, *, most: str) -> None:
    """Refuse a request for its form: count (`most` names the limit), function or alignment in the region of a view.

    The form is checked before any register is looked up, as devices do.
    """
    faults = blueprint.register_map.faults
    if not 1 <= count <= blueprint.register_map.accepted(f"{most}_bits" if space.is_bits else f"{most}_words"):
        raise Refusal(faults.quantity)
    region = blueprint.layout.region(space, address)
    if region is None:
        return
    if region.functions and function not in region.functions:
        raise Refusal(faults.view_function)
    if count % region.align:
        raise Refusal(faults.misaligned_count)
    if address % region.align:
        raise Refusal(faults.misaligned_address)


@dataclass(frozen=True, slots=True)
class Reader:
    """Reads words (or bits) of one device; `seed` and `unit` make its garbage its own, and the same at every run."""

    state: DeviceState
    seed: int
    unit: int

    def read(self, space: Space, function: int, address: int, count: int) -> tuple[int, ...]:
        """Return the `count` words (bits) from `address` on; raises Refusal."""
        blueprint = self.state.blueprint
        check_request(blueprint, space, function, address, count, most="read")
        for each in range(address, address + count):
            place = blueprint.layout.place(space, each)
            if place is not None and not place.view.allows(function):
                raise Refusal(blueprint.register_map.faults.view_function)
        return tuple(
            self._fill(space, address + index, first=index == 0) if word is None else word
            for index, word in enumerate(self.state.words(space, address, count))
        )

    def _fill(self, space: Space, address: int, *, first: bool) -> int:
        """The word at an address where no readable register stands; raises Refusal."""
        layout, register_map = self.state.blueprint.layout, self.state.blueprint.register_map
        later = register_map.faults.later_read
        if (space, address) in layout.reserved or (space, address) in layout.unused:
            return 0
        hole = layout.documents(space, address) and layout.place(space, address) is None
        if hole and later is not Later.GARBAGE and register_map.protocol.read_holes:
            return 0
        if first or later not in {Later.GARBAGE, Later.ZEROS}:
            raise Refusal(register_map.faults.address)
        garbage = zlib.crc32(struct.pack(">qBI", self.seed, self.unit & 0xFF, address))
        return 0 if later is Later.ZEROS else garbage & (1 if space.is_bits else 0xFFFF)
