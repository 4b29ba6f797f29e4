"""The steps of Zabbix items, run on the words of all cases by hand (tests/conformance/cases), give the values by hand.

What the agent tells of words is a small model of it here, by the table that test_zabbix.py holds against the agent.
"""

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import pytest
import yaml

from regscribe import plugins
from regscribe.model import RegisterMap
from regscribe.plugins import OptionError

from ...conformance.suite import Case, cases, diagnose, whole_map, words_of  # noqa: TID252 (tests are no package)
from .zabbix_agent import run_scripts

pytestmark = pytest.mark.interop("zabbix-agent2")

KEY = re.compile(r'modbus\.get\["[^"]+","[^"]+",\d, *\d+,(\d+),(\w+),?(\w*)\]')
WORDS = {"bit": 1, "uint16": 1, "int16": 1, "uint32": 2, "int32": 2, "uint64": 4}
WORDS_TURNED = {(1, "le"), (2, "le"), (2, "mbe"), (4, "le"), (4, "mle")}
BYTES_TURNED = {(1, "le"), (2, "le"), (2, "mle"), (4, "le"), (4, "mbe")}
NEEDS_MORE = frozenset({"view", "holds", "only", "lossy"})
"""Rows in other views or states, of writes alone, and of what a double cannot be."""
FEWEST = 300
LEAST = 1e-37
"""Below this a float of 32 bits has too few digits to be compared."""


class Row(NamedTuple):
    """A row of a case, the steps of its item, and what the agent tells of its words."""

    case: str
    row: dict[str, Any]
    steps: Sequence[dict[str, Any]]
    told: str


def rows() -> Iterator[Row]:
    for case in cases():
        sound = case.rows and not case.refused and not case.place
        register_map, _ = diagnose(whole_map(case.map)) if sound else (None, [])
        if register_map is not None and not register_map.blocks:
            yield from of_case(case, register_map)


def of_case(case: Case, register_map: RegisterMap) -> Iterator[Row]:
    options = {one.name: one.default for one in plugins.exporter("zabbix").options} | {"at": "h:502"}
    try:
        made = plugins.export("zabbix", [register_map], options)
    except OptionError:  # it can say nothing of the case
        return
    (template,) = yaml.safe_load(str(made.texts[""]))["zabbix_export"]["templates"]
    items = {one["name"]: one for one in reversed(template["items"])}
    registers = {one.path: one for one in register_map.models[0].registers}
    fixed = {one.register for one in made.losses if one.grade.name == "WRONG"}
    for row in case.rows:
        register = registers.get(row.get("register", ""))
        if register is None or register.path in fixed or NEEDS_MORE & row.keys() or "words" not in row:
            continue
        item = items.get(f"{register.name} ({register.path})" if register.index else register.name)
        if item is not None and register.base.type.value != "float16":  # the driver says its shortest decimal
            yield Row(case.name, row, item.get("preprocessing", []), told(item["key"], words_of(row["words"])))


def told(key: str, words: list[int]) -> str:
    """What the agent tells of these words."""
    found = KEY.fullmatch(key)
    assert found, key
    count, kind, endian = int(found[1]), found[2], found[3]
    size = WORDS[kind]
    assert len(words) == count * size, (key, words)
    each = [number(words[at : at + size], kind, endian) for at in range(0, len(words), size)]
    return str(each[0]) if count == 1 else f"[{','.join(map(str, each))}]"


def number(words: list[int], kind: str, endian: str) -> int:
    size = len(words)
    ordered = words[::-1] if (size, endian) in WORDS_TURNED else words
    raw = b"".join(word.to_bytes(2, "little" if (size, endian) in BYTES_TURNED else "big") for word in ordered)
    return int.from_bytes(raw, "big", signed=kind.startswith("int"))


def test_the_values_of_all_cases_are_those_by_hand() -> None:
    found = list(rows())
    scripts = [next((step["parameters"][0] for step in one.steps if step["type"] == "JAVASCRIPT"), "") for one in found]
    made = run_scripts([(script or "return value;", one.told) for script, one in zip(scripts, found, strict=True)])
    judged = [judge(one, *multiplied(one, *said)) for one, said in zip(found, made, strict=True)]
    assert [(one, said) for one, said, right in zip(found, made, judged, strict=True) if right is False] == []
    assert judged.count(True) > FEWEST


def multiplied(one: Row, kind: str, text: str) -> tuple[str, str]:
    factors = [float(step["parameters"][0]) for step in one.steps if step["type"] == "MULTIPLIER"]
    return kind, repr(float(text) * factors[0]) if factors else text


def judge(one: Row, kind: str, text: str) -> bool | None:
    """Whether what is stored is what the row says by hand; None where it says of parts and members."""
    if "fault" in one.row:
        return kind == "error"
    value = one.row.get("value")
    if value is None:
        return None
    if isinstance(value, str) and not re.fullmatch(r"-?\d+/\d+", value):
        return (kind, text) == ("value", value)
    by_hand = float(value if isinstance(value, bool) else Fraction(str(value)))
    if 0 < abs(by_hand) < LEAST:
        return None
    return kind == "value" and float(text) == pytest.approx(by_hand, rel=1e-6, abs=0)
