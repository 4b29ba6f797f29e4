"""The odd device of odd.yaml, and what it holds: values of use, faults by their ids, of bits and parts the word."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from regscribe import plugins
from regscribe.simulate import Running, find_map, simulate

MAP = Path(__file__).with_name("odd.yaml")
NAME = "OddOne-1"

HELD: dict[str, str | float] = {
    "low": 0x9A,
    "high": 0x8B,
    "signed_low": -5,
    "signed_high": -100,
    "absent": "absent",
    "both_signs": "high",
    "broken": "broken",
    "wide_bits": 1 << 63 | 1 << 33 | 1,
    "turned_bits": 1 << 31,
    "halves": 0x8A50,  # 1, and 0xA5 = 165 halves less 10
    "hostile": 7,
    "moved": -12.5,
    "thirds": 3,
    "negative": -20,
    "way": "back",
    "truth": 1,
    "several": 1,
    "coil": 1,
}


@contextmanager
def served(transport: str = "tcp") -> Iterator[Running]:
    """Serve it while the block runs."""
    with simulate(MAP, unit=1, transport=transport) as running:
        for path, value in HELD.items():
            running.poke(path, value)
        yield running


def text(form: str, **options: str) -> str:
    """Return the one text that a format makes of it."""
    known = {one.name: one.default for one in plugins.exporter(form).options}
    (made,) = plugins.export(form, [find_map(MAP)], known | options).texts.values()
    assert isinstance(made, str)
    return made
