"""Words of Home Assistant's integration modbus."""

from collections.abc import Mapping

from regscribe.dialects import ABCD, BADC, CDAB, DCBA, Orders, lower
from regscribe.model import Space, WireType

TYPES: Mapping[WireType, str] = lower(
    *(WireType.INT16, WireType.INT32, WireType.INT64, WireType.UINT16, WireType.UINT32, WireType.UINT64),
    *(WireType.FLOAT16, WireType.FLOAT32, WireType.FLOAT64, WireType.STRING),
)
"""Values of `data_type`; int16 is what holds where none is."""

SWAPS: Mapping[Orders, str] = {ABCD: "", CDAB: "word", BADC: "byte", DCBA: "word_byte"}
"""Values of `swap`; no order is a key that is left out."""

SPACES: Mapping[Space, str] = {
    Space.HOLDING: "holding",
    Space.INPUT: "input",
    Space.COIL: "coil",
    Space.DISCRETE: "discrete_input",
}
"""Values of `input_type`; sensors have the first two."""

WRITES: Mapping[str, Space] = {
    "holding": Space.HOLDING,
    "holdings": Space.HOLDING,
    "coil": Space.COIL,
    "coils": Space.COIL,
}
"""Values of `write_type`."""

STRUCT_CODES: Mapping[str, WireType] = {
    "h": WireType.INT16,
    "H": WireType.UINT16,
    "i": WireType.INT32,
    "I": WireType.UINT32,
    "l": WireType.INT32,
    "L": WireType.UINT32,
    "q": WireType.INT64,
    "Q": WireType.UINT64,
    "e": WireType.FLOAT16,
    "f": WireType.FLOAT32,
    "d": WireType.FLOAT64,
}
"""What one letter of `structure` means, in the notation of Python's struct with `>` before it."""
