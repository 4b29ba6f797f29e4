"""Words of Telegraf's input plug-in modbus."""

from collections.abc import Mapping

from regscribe.dialects import LETTERS, Orders, upper
from regscribe.model import Space, WireType

SPACES: Mapping[Space, str] = {
    Space.HOLDING: "holding",
    Space.INPUT: "input",
    Space.COIL: "coil",
    Space.DISCRETE: "discrete",
}
TYPES: Mapping[WireType, str] = {
    **upper(WireType.INT16, WireType.UINT16, WireType.INT32, WireType.UINT32, WireType.INT64, WireType.UINT64),
    **upper(WireType.FLOAT16, WireType.FLOAT32, WireType.FLOAT64, WireType.STRING),
}
ORDERS: Mapping[Orders, str] = LETTERS

BIT = "BIT"
"""The type of a bit of a word, whose number stands beside it."""

BYTES: Mapping[str, tuple[WireType, str]] = {
    "INT8L": (WireType.INT8, "low"),
    "INT8H": (WireType.INT8, "high"),
    "UINT8L": (WireType.UINT8, "low"),
    "UINT8H": (WireType.UINT8, "high"),
}
"""Types of one byte of a word, and which byte it is."""

LOCATIONS: Mapping[str, str] = {"": "both", "low": "lower", "high": "upper"}
"""Which bytes of its words a text takes: all, or one of each word; a connection has one."""

TABLES: Mapping[str, Space] = {
    "holding_registers": Space.HOLDING,
    "input_registers": Space.INPUT,
    "coils": Space.COIL,
    "discrete_inputs": Space.DISCRETE,
}
"""What the style `register` calls its lists of fields."""

OLD_TYPES: Mapping[str, WireType] = {
    **{word: one for one, word in TYPES.items() if not one.is_float},
    "FLOAT16-IEEE": WireType.FLOAT16,
    "FLOAT32-IEEE": WireType.FLOAT32,
    "FLOAT64-IEEE": WireType.FLOAT64,
}
"""Values of `data_type` in the style `register`; FLOAT32 without more is a whole number there."""

FIXED: Mapping[str, bool] = {"FIXED": True, "UFIXED": False, "FLOAT32": False}
"""Whole numbers, as wide as the addresses that are named, which a scale makes a fraction; whether they have a sign."""
