"""What `check` refuses is taken out of a draft: a key alone where the number does not hang on it, else the row."""

from typing import Any

from regscribe.cli.shared.import_source import check
from regscribe.cli.shared.map_heads import head_of
from regscribe.draft import Draft, Entry, Outcome
from regscribe.draft.settle import settle
from regscribe.model import Severity, Span


def settled(*registers: dict[str, Any]) -> Draft:
    entries = tuple(
        Entry(name=str(keys["name"]), place=Span("list.csv", line), keys=keys) for line, keys in enumerate(registers, 2)
    )
    found, _, checked = settle(Draft(entries=entries), head_of("acme/pump"), check)
    assert [one for one in checked if one.severity is Severity.ERROR] == []
    return found


def test_a_default_outside_the_range_goes_alone_though_the_error_stands_at_the_register() -> None:
    level = {"at": 1, "name": "Level", "access": "rw", "range": "0..10", "default": 20}
    flow = {"at": 2, "name": "Flow", "access": "rw", "range": "0..10", "default": 5}
    found = settled(level, flow)
    assert [entry.keys for entry in found.entries] == [
        {"at": 1, "name": "Level", "access": "rw", "range": "0..10"},
        flow,
    ]
    assert found.entries[0].outcome is Outcome.WITH_LOSS
    assert "default `20` is left out" in found.entries[0].remarks[0].message
    assert found.entries[0].remarks[0].todo


def test_a_range_that_is_none_goes_alone_by_its_place() -> None:
    (entry,) = settled({"at": 1, "name": "Level", "access": "r", "range": "10..0"}).entries
    assert entry.keys == {"at": 1, "name": "Level", "access": "r"}


def test_a_register_that_overlaps_another_is_left_out_with_the_reason() -> None:
    found = settled(
        {"at": 1, "name": "Level", "access": "r", "type": "uint32", "default": 1},
        {"at": 2, "name": "Flow", "access": "r"},
    )
    assert [entry.outcome for entry in found.entries] == [Outcome.WHOLE, Outcome.LEFT_OUT]
    assert "overlaps" in found.entries[1].remarks[0].message


def test_names_that_no_driver_can_have_get_ids() -> None:
    names = ["class", "read", "3 phase", "电压", "Level", "level"]
    found = settled(*({"at": at, "name": name, "access": "r"} for at, name in enumerate(names)))
    assert [entry.keys and entry.keys.get("id") for entry in found.entries] == [
        "class_register",
        "read_register",
        "register_3_phase",
        "register_3",
        None,
        "level_2",
    ]
