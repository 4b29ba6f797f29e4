"""Words of ESPHome's component modbus_controller."""

from collections.abc import Mapping

from regscribe.dialects import ABCD, CDAB, Orders
from regscribe.model import Space, WireType

SPACES: Mapping[Space, str] = {
    Space.HOLDING: "holding",
    Space.INPUT: "read",
    Space.COIL: "coil",
    Space.DISCRETE: "discrete_input",
}
"""Values of `register_type`."""

TYPES: Mapping[tuple[WireType, Orders], str] = {
    (WireType.UINT16, ABCD): "U_WORD",
    (WireType.INT16, ABCD): "S_WORD",
    (WireType.UINT32, ABCD): "U_DWORD",
    (WireType.UINT32, CDAB): "U_DWORD_R",
    (WireType.INT32, ABCD): "S_DWORD",
    (WireType.INT32, CDAB): "S_DWORD_R",
    (WireType.UINT64, ABCD): "U_QWORD",
    (WireType.UINT64, CDAB): "U_QWORD_R",
    (WireType.INT64, ABCD): "S_QWORD",
    (WireType.INT64, CDAB): "S_QWORD_R",
    (WireType.FLOAT32, ABCD): "FP32",
    (WireType.FLOAT32, CDAB): "FP32_R",
}
"""Values of `value_type`: they say the order of the words too."""

RAW = "RAW"
"""The value_type of bytes that a lambda decodes."""

USUAL = "U_WORD"
"""The value_type where none is."""
