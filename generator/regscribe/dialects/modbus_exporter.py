"""Words of the Prometheus exporter for Modbus (modbus_exporter)."""

from collections.abc import Mapping

from regscribe.dialects import ABCD, BADC, CDAB, DCBA, Orders, lower
from regscribe.model import Space, WireType

TYPES: Mapping[WireType, str] = lower(
    *(WireType.INT16, WireType.UINT16, WireType.INT32, WireType.UINT32, WireType.INT64, WireType.UINT64),
    *(WireType.FLOAT32, WireType.FLOAT64),
)
"""Values of `dataType`."""

BOOL = "bool"
"""The dataType of one bit; of a register its number is `bitOffset`."""

ENDIANNESS: Mapping[Orders, str] = {ABCD: "big", CDAB: "yolo", BADC: "mixed", DCBA: "little"}

FUNCTIONS: Mapping[Space, str] = {
    Space.COIL: "1",
    Space.DISCRETE: "2",
    Space.HOLDING: "3",
    Space.INPUT: "4",
}
"""The first digit of an `address` is the function that reads: the reverse of Modicon's notation for 3 and 4."""
