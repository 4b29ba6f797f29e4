"""What the map calls dangerous, guarded or conditional is read only where a click writes, and that is told."""

from collections.abc import Callable

import pytest

from regscribe.losses import Exported

AT = {"at": "10.0.0.7:502"}
FORMATS: dict[str, dict[str, str]] = {
    "home-assistant": AT,
    "esphome": {},
    "wiren-board": {},
    "openhab": AT,
    "wot-td": AT,
    "edgex": {},
    "node-red": AT | {"writes": "yes"},
}
"""The formats of programs that write, and the options that they need."""

RISKS = {
    "danger: the oven gets hot": "a write is dangerous",
    "unlock: open": "a write needs commands around it",
    "apply: open": "a write needs commands around it",
    "writable: {when: {key: 1}, reason: locked}": "a write is accepted under a condition",
}
PLAIN = "at: 7, name: X, type: uint16"
REST = "commands:\n  open: {name: Open, source: '1', steps: [{at: 90, words: [1]}]}\n"


@pytest.mark.parametrize("risk", RISKS)
@pytest.mark.parametrize("form", FORMATS)
def test_a_risky_write_is_no_click(
    export: Callable[..., Exported], small: Callable[..., str], form: str, risk: str
) -> None:
    # Home Assistant writes truth values alone
    register = f"{PLAIN}, kind: boolean" if form == "home-assistant" else PLAIN
    key = "at: 3, name: Key"
    plain = export(form, small(key, register, tail=REST), **FORMATS[form])
    risky = export(form, small(key, f"{register}, {risk}", tail=REST), **FORMATS[form])
    assert [one.done for one in plain.losses if (one.register, one.fact) == ("x", "write")] == []
    assert [one.done for one in risky.losses if (one.register, one.fact) == ("x", "write")] == [
        f"read only: {RISKS[risk]}"
    ]
    assert plain.texts != risky.texts
