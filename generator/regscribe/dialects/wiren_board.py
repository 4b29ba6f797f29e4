"""Words of the templates of Wiren Board's wb-mqtt-serial."""

from collections.abc import Mapping

from regscribe.model import Order, Space, WireType

SPACES: Mapping[Space, str] = {
    Space.HOLDING: "holding",
    Space.INPUT: "input",
    Space.COIL: "coil",
    Space.DISCRETE: "discrete",
}
"""Values of `reg_type`."""

SINGLE_WRITES: Mapping[str, tuple[int, ...]] = {"holding_single": (6,), "holding_multi": (16,)}
"""Values of `reg_type` for holding registers that one function writes."""

TYPES: Mapping[WireType, str] = {
    WireType.UINT8: "u8",
    WireType.INT8: "s8",
    WireType.UINT16: "u16",
    WireType.INT16: "s16",
    WireType.UINT24: "u24",
    WireType.INT24: "s24",
    WireType.UINT32: "u32",
    WireType.INT32: "s32",
    WireType.UINT64: "u64",
    WireType.INT64: "s64",
    WireType.FLOAT32: "float",
    WireType.FLOAT64: "double",
    WireType.BCD16: "bcd16",
    WireType.BCD32: "bcd32",
    WireType.STRING: "string",
}
"""Values of `format`; u16 where none is. A `string` has one character in the low byte of each word."""

OTHER_TYPES: Mapping[str, str] = {
    "bcd8": "two decimal digits in one byte",
    "bcd24": "six decimal digits",
    "char8": "one character",
}
"""Values of `format` that no wire type is."""

STRING8 = "string8"
"""The format of a text with two characters in a word."""

ORDERS: Mapping[Order, str] = {Order.BIG: "big_endian", Order.LITTLE: "little_endian"}
"""Values of `word_order` and `byte_order`."""
