"""A backup goes back into the device that it was taken of without a write, whatever words that device holds."""

from pathlib import Path
from typing import Any

import pytest

from regscribe.tools import settings

from .matrix_watch import Wire
from .suite import build, whole_map
from .wire import Memory

CARD = {"at": 0, "name": "Card", "type": "uint16"}
FAULTY = {"lo": {"bits": "0..7", "sentinels": {255: {"label": "open", "id": "sx"}}}, "hi": {"bits": "8..15"}}
HELD: dict[str, tuple[dict[str, Any], list[int]]] = {
    "a text that ends with a zero": ({"type": "string", "length": 2}, [0x4142, 0x4300]),
    "a text of 200 words": ({"type": "string", "length": 200}, [0x4142] * 200),
    "bytes of 126 words": ({"type": "bytes", "length": 126}, [1] * 126),
    "bytes of 3000 words": ({"type": "bytes", "length": 3000}, [1] * 3000),
    "a text of 700 words that is none": ({"type": "string", "length": 700}, [0xFFFE] * 700),
    "a field of 600 digits": ({"length": 123, "fields": {"a": {"bits": "0..1960"}}}, [0xFFFF] * 123),
    "bits of a field from 64 up": ({"length": 6, "fields": {"a": {"bits": "0..3"}}}, [0x8000, 0, 0, 0, 0, 5]),
    "a flag without a name from 100 up": ({"length": 8, "flags": {0: "on"}}, [0x8000, 0, 0, 0, 0, 0, 0, 1]),
    "a field of more than 20 digits": ({"length": 8, "fields": {"a": {"bits": "0..127"}}}, [0xFFFF] * 8),
    "a number of 39 digits": ({"type": "uint128"}, [0xFFFF] * 8),
    "a part that is a fault": ({"type": "uint16", "fields": FAULTY}, [0x05FF]),
    "a code without a name": ({"type": "uint16", "enum": {0: "off", 1: "on"}}, [5]),
    "a number beyond its range": ({"type": "uint16", "range": "0..10"}, [500]),
    "a float below zero by its sign alone": ({"type": "float32"}, [0x8000, 0]),
    "a register that is not writable now": (
        {"type": "uint16", "writable": {"when": {"card": 1}, "reason": "only with a card"}},
        [7],
    ),
}


class Bench:
    """A driver on memory that knows no map."""

    def __init__(self, register: dict[str, Any], words: list[int]) -> None:
        built = build(whole_map({"registers": [CARD, {"at": 10, "name": "Held", **register}]}))
        self.memory = Memory()
        self.memory.put("holding", 10, words)
        self.driver = built.module.CaseA(Wire(self.memory.answer), unit=1)

    def backup(self, folder: Path) -> Any:
        """A backup that went through a file."""
        file = folder / "kept.yaml"
        settings.save(file, settings.to_text(self.driver.run(settings.backup(type(self.driver)))))
        return settings.load(file)

    def restore(self, backup: Any, **options: Any) -> tuple[Any, list[str]]:
        """The report of a restore, and the PDUs of its writes."""
        self.memory.log.clear()
        done = self.driver.run(settings.restore(type(self.driver), backup, **options))
        return done, self.writes

    @property
    def writes(self) -> list[str]:
        return [pdu.hex() for pdu in self.memory.log if pdu[0] in {6, 16, 22}]


@pytest.mark.parametrize("what", HELD)
def test_a_restore_into_the_untouched_device_writes_nothing(what: str, tmp_path: Path) -> None:
    bench = Bench(*HELD[what])
    done, writes = bench.restore(bench.backup(tmp_path))
    assert (set(done.report.equal), done.fit.misfits, writes) == ({"card", "held"}, (), [])


def test_what_is_not_held_and_cannot_be_written_is_told(tmp_path: Path) -> None:
    bench = Bench(*HELD["a part that is a fault"])
    kept = bench.backup(tmp_path)
    bench.memory.put("holding", 10, [0x0503])
    bench.memory.put("holding", 0, [9])
    with pytest.raises(settings.UnfitError, match="held: `SX` is no number"):
        bench.restore(kept)
    done, writes = bench.restore(kept, partial=True)
    assert ([one.path for one in done.fit.misfits], writes) == (["held"], ["0600000000"])


def test_a_setting_whose_meaning_the_restore_changes_is_written_again(tmp_path: Path) -> None:
    scaled = {"type": "uint16", "multiply": [{"when": {"card": 1}, "is": 0.1}, {"is": 1}]}
    bench = Bench(scaled, [250])
    bench.memory.put("holding", 0, [1])
    kept = bench.backup(tmp_path)
    bench.memory.put("holding", 0, [0])
    done, writes = bench.restore(kept)
    assert (done.report.written, writes) == (("card",), ["0600000001"])
    assert done.report.equal == ("held",)


def test_long_patterns_are_restored_from_their_text(tmp_path: Path) -> None:
    for what in (
        "bits of a field from 64 up",
        "a field of more than 20 digits",
        "a number of 39 digits",
        "a field of 600 digits",
    ):
        register, words = HELD[what]
        bench = Bench(register, words)
        kept = bench.backup(tmp_path)
        bench.memory.put("holding", 10, [0] * len(words))
        _, (write,) = bench.restore(kept)
        assert (
            write == f"10000a00{len(words):02x}{2 * len(words):02x}" + b"".join(one.to_bytes(2) for one in words).hex()
        )


@pytest.mark.parametrize(
    ("register", "words", "value"),
    [({"type": "string", "length": 2}, [0x4142, 0x4300], "ABC"), ({"type": "float32"}, [0x8000, 0], 0.0)],
)
@pytest.mark.parametrize("persistence", ["ram", "eeprom"])
def test_a_value_that_reads_as_the_one_wanted_is_not_written(
    register: dict[str, Any], words: list[int], value: object, persistence: str
) -> None:
    bench = Bench({**register, "persistence": persistence}, words)
    report = bench.driver.configure({"held": value})
    assert (report.equal, bench.writes) == (("held",), [])
    if persistence == "eeprom":
        bench.driver.held.write(value)
        assert bench.writes == []
