"""Words of EdgeX device profiles for Modbus."""

from collections.abc import Mapping

from regscribe.dialects import ABCD, BADC, CDAB, DCBA, Orders
from regscribe.model import Access, Space, WireType

TABLES: Mapping[Space, str] = {
    Space.HOLDING: "HOLDING_REGISTERS",
    Space.INPUT: "INPUT_REGISTERS",
    Space.COIL: "COILS",
    Space.DISCRETE: "DISCRETE_INPUTS",
}
"""Values of the attribute `primaryTable`."""

TYPES: Mapping[WireType, str] = {
    WireType.INT16: "Int16",
    WireType.UINT16: "Uint16",
    WireType.INT32: "Int32",
    WireType.UINT32: "Uint32",
    WireType.INT64: "Int64",
    WireType.UINT64: "Uint64",
    WireType.FLOAT32: "Float32",
    WireType.FLOAT64: "Float64",
    WireType.STRING: "String",
}
"""Values of the property `valueType`, for words that hold such a number themselves."""

RAW_TYPES: Mapping[WireType, str] = {
    WireType.INT16: "Int16",
    WireType.UINT16: "Uint16",
    WireType.INT32: "Int32",
}
"""Values of the attribute `rawType`: words of a whole number that becomes a float by a scale."""

BOOL = "Bool"

SWAPS: Mapping[Orders, tuple[bool, bool]] = {
    ABCD: (False, False),
    CDAB: (False, True),
    BADC: (True, False),
    DCBA: (True, True),
}
"""The attributes `isByteSwap` and `isWordSwap` of a number of 32 bits."""

ACCESS: Mapping[Access, str] = {Access.READ: "R", Access.WRITE: "W", Access.READ_WRITE: "RW"}
"""Values of the property `readWrite`."""
