"""How a device answers a read: what it shows at each address, and what it does about addresses it does not have."""

import struct
import zlib
from dataclasses import dataclass

from regscribe.model import Faults, Later, RegisterMap, Space
from regscribe.simulate.device.address_index import AddressIndex
from regscribe.simulate.device.refusal import Refusal
from regscribe.simulate.device.state import DeviceState

ADDRESSES = 1 << 16


def check_request(
    faults: Faults, layout: AddressIndex, space: Space, function: int, address: int, count: int, *, most: int
) -> None:
    """Refuse a request for its form: too many or no words, a foreign function, or an odd address in a view's region.

    What the device ignores comes first: it must see the form before it looks for the register.
    """
    if not 1 <= count <= most:
        raise Refusal(faults.quantity)
    region = layout.region(space, address)
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

    register_map: RegisterMap
    layout: AddressIndex
    state: DeviceState
    seed: int
    unit: int

    def read(self, space: Space, function: int, address: int, count: int) -> tuple[int, ...]:
        """Return the `count` words (bits) from `address` on; raises Refusal."""
        most = self.register_map.accepted("read_bits" if space.is_bits else "read_words")
        check_request(self.register_map.faults, self.layout, space, function, address, count, most=most)
        if any(self._bars(space, function, each) for each in range(address, address + count)):
            raise Refusal(self.register_map.faults.view_function)
        return tuple(
            self._fill(space, address + place, first=place == 0) if word is None else word
            for place, word in enumerate(self.state.words(space, address, count))
        )

    def _bars(self, space: Space, function: int, address: int) -> bool:
        """Whether a value stands at an address whose view this function may not address."""
        place = self.layout.place(space, address)
        return place is not None and not place.view.allows(function)

    def _fill(self, space: Space, address: int, *, first: bool) -> int:
        later = self.register_map.faults.later_read
        if (space, address) in self.layout.reserved or (space, address) in self.layout.unused:
            return 0
        if later is not Later.GARBAGE and self.register_map.protocol.read_holes and self.layout.in_hole(space, address):
            return 0
        if first or later not in {Later.GARBAGE, Later.ZEROS}:
            raise Refusal(self.register_map.faults.address)
        return 0 if later is Later.ZEROS else self._garbage(address) & (1 if space.is_bits else ADDRESSES - 1)

    def _garbage(self, address: int) -> int:
        return zlib.crc32(struct.pack(">qBI", self.seed, self.unit & 0xFF, address))
