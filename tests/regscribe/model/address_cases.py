"""What written addresses mean: to the compiler, and to the page of the register browser, which has the same grammar."""

from regscribe.model import Space

ANY_SPACE: list[tuple[int, Space | None]] = [(4049, None)]

MEANINGS: dict[str, list[tuple[int, Space | None]]] = {
    "4049": ANY_SPACE,
    "0xFD1": ANY_SPACE,
    "0XfD1": ANY_SPACE,
    "FD1h": ANY_SPACE,
    "0fd1H": ANY_SPACE,
    "$FD1": ANY_SPACE,
    " 4049 ": ANY_SPACE,
    "44050": [(44050, None), (4049, Space.HOLDING)],
    "00001": [(1, None), (0, Space.COIL)],
    "10001": [(10001, None), (0, Space.DISCRETE)],
    "30001": [(30001, None), (0, Space.INPUT)],
    "400001": [(0, Space.HOLDING)],
    "465536": [(65535, Space.HOLDING)],
    "465537": [],
    "40000": [(40000, None)],
    "65535": [(65535, None)],
    "65536": [],
    "99999": [],
    "000001": [(1, None), (0, Space.COIL)],
}

NO_ADDRESSES = ("", "0x", "0x10000", "-1", "12.5", "setpoint", "٤٠٤٩", "h", "each", "4049h1", "1234567", "0b1")

MODICON_NUMBERS = (
    (Space.HOLDING, 4049, "44050"),
    (Space.HOLDING, 9998, "49999"),
    (Space.HOLDING, 9999, "410000"),
    (Space.COIL, 0, "00001"),
    (Space.INPUT, 65535, "365536"),
    (Space.FILE, 3, ""),
)
