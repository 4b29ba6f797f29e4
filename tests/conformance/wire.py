"""A small Modbus TCP server that knows no map: words in, words out, and a log of what was asked."""

import socketserver
import struct
import threading
from collections import defaultdict
from collections.abc import Mapping
from typing import Any

READS = {1: "coil", 2: "discrete", 3: "holding", 4: "input", 23: "holding"}
WRITES = {5: "coil", 6: "holding", 15: "coil", 16: "holding"}
BITS = frozenset({"coil", "discrete"})
ON = 0xFF00
LONG = 1 << 40
PAGE = 16
"""The bits of an address below the number of its page."""


class Memory:
    """What the addresses of each space hold (0 where nothing was put), and the requests that came: PDUs in order.

    At addresses that are `long` a register has 32 bits, of space `enron`: two words, from LONG + twice the address on.
    Addresses from `paged` on are those of the page that is selected: the first of `pages` whose words the device holds
    (by space and address). A page with a `unit` is what the device of that unit id has.
    """

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forget everything."""
        self.cells: dict[str, dict[int, int]] = defaultdict(dict)
        self.log: list[bytes] = []
        self.long: range | set[int] = range(0)
        self.paged = 0x10000
        self.pages: tuple[Any, ...] = ()

    def put(self, space: str, address: int, words: list[int]) -> None:
        """Set words (or bits) from an address on."""
        start = _inside(space, address)
        self.cells[space].update({start + place: word for place, word in enumerate(words)})

    def get(self, space: str, address: int, count: int) -> list[int]:
        """The words (or bits) from an address on."""
        start = _inside(space, address)
        return [self.cells[space].get(at, 0) for at in range(start, start + count)]

    def page(self, address: int, unit: int) -> int:
        """An address on the page that it means now; -1 if no page is selected that could have it."""
        behind = [number for number, page in enumerate(self.pages, 1) if page.get("unit") == unit]
        if not behind and address < self.paged:
            return address
        shown = [number for number, page in enumerate(self.pages, 1) if "unit" not in page and self._holds(page)]
        found = [*behind, *shown]
        return found[0] << PAGE | address if found else -1

    def _holds(self, page: Mapping[str, Mapping[int, list[int]]]) -> bool:
        every = [(space, at, words) for space, cells in page.items() for at, words in cells.items()]
        return all(self.get(space, at, len(words)) == words for space, at, words in every)

    def answer(self, pdu: bytes, unit: int = 0) -> bytes:  # noqa: PLR0911 (as many kinds of answers)
        """The answer to a request."""
        self.log.append(pdu)
        function = pdu[0]
        if function == 7:
            return bytes([7, self.get("status", 0, 1)[0]])
        forms = {20: self._records, 21: self._records, 24: self._queue, 43: self._object}
        forms |= dict.fromkeys((3, 6, 16), self._long) if int.from_bytes(pdu[1:3], "big") in self.long else {}
        if special := forms.get(function):
            return special(pdu)
        address, number = struct.unpack(">HH", pdu[1:5])
        if function == 23:
            into = self.page(int.from_bytes(pdu[5:7], "big"), unit)
            self.put("holding", into, list(struct.unpack(f">{pdu[9] // 2}H", pdu[10:])))
        address = self.page(address, unit)
        if address < 0:
            return bytes([function | 0x80, 2])
        if function in READS:
            found = self.get(READS[function], address, number)
            packed = _packed(found) if READS[function] in BITS else struct.pack(f">{number}H", *found)
            return bytes([function, len(packed)]) + packed
        if function in (5, 6):
            self.put(WRITES[function], address, [int(number == ON) if function == 5 else number])
            return pdu
        if function == 15:
            bits = int.from_bytes(pdu[6:], "little")
            self.put("coil", address, [bits >> place & 1 for place in range(number)])
        elif function == 16:
            self.put("holding", address, list(struct.unpack(f">{number}H", pdu[6:])))
        else:
            return bytes([function | 0x80, 1])
        return pdu[:5]

    def _long(self, pdu: bytes) -> bytes:
        """The answer about registers of four bytes."""
        function, address, number = struct.unpack(">BHH", pdu[:5])
        start = LONG + 2 * address
        if function == 3:
            return struct.pack(f">BB{2 * number}H", 3, 4 * number, *self.get("enron", start, 2 * number))
        data = pdu[3:] if function == 6 else pdu[6:]
        assert len(data) == 4 * (1 if function == 6 else number), pdu.hex(" ")
        self.put("enron", start, list(struct.unpack(f">{len(data) // 2}H", data)))
        return pdu if function == 6 else pdu[:5]

    def _queue(self, pdu: bytes) -> bytes:
        """The count of a queue and its values."""
        first = struct.unpack(">H", pdu[1:3])[0] << 6
        words = self.get("queue", first, 1 + self.get("queue", first, 1)[0])
        return struct.pack(f">BH{len(words)}H", 24, 2 * len(words), *words)

    def _object(self, pdu: bytes) -> bytes:
        """One object of the identification: its text, two characters a word, up to the first NUL."""
        assert pdu[:3] == bytes((43, 14, 4)), pdu.hex(" ")
        words = self.get("identification", pdu[3] << 8, 123)
        text = struct.pack(">123H", *words).partition(b"\0")[0]
        return bytes((43, 14, 4, 0x83, 0, 0, 1, pdu[3], len(text))) + text

    def _records(self, pdu: bytes) -> bytes:
        """The answer to a request with one group of records: byte count, 6, file, record, number of words, words."""
        function, size, kind, file, record, number = struct.unpack(">BBBHHH", pdu[:9])
        assert kind == 6, "the only type of reference that the standard knows"
        assert size == len(pdu) - 2
        if function == 21:
            self.put("file", file << 16 | record, list(struct.unpack(f">{number}H", pdu[9:])))
            return pdu
        words = self.get("file", file << 16 | record, number)
        return struct.pack(f">BBBB{number}H", 20, 2 + 2 * number, 1 + 2 * number, 6, *words)


def _inside(space: str, address: int) -> int:
    """Where the words of a register of 32 bits are, of an address as it stands in requests."""
    return LONG + 2 * address if space == "enron" and address < LONG else address


def _packed(bits: list[int]) -> bytes:
    return sum(bit << place for place, bit in enumerate(bits)).to_bytes(-(-len(bits) // 8), "little")


class _Handler(socketserver.StreamRequestHandler):
    def handle(self) -> None:
        while head := self.rfile.read(7):
            pdu = self.rfile.read(int.from_bytes(head[4:6], "big") - 1)
            answer = self.server.memory.answer(pdu, head[6])  # type: ignore[attr-defined] # set below
            self.wfile.write(head[:4] + (len(answer) + 1).to_bytes(2, "big") + head[6:7] + answer)


class Server(socketserver.ThreadingTCPServer):
    """The server on a free port of this machine; a context manager that serves in a thread of its own."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.memory = Memory()
        self.port = int(self.server_address[1])
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def __exit__(self, *args: object) -> None:
        self.shutdown()
        super().__exit__(*args)
