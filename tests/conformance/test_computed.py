"""Numbers that follow from several registers: worked out by hand, over a server that knows no map."""

import asyncio
import json
from collections.abc import Iterator
from typing import Any

import pytest

from regscribe.emit import markdown
from regscribe.export.json import json_text
from regscribe_runtime.errors import NotDecodable

from .suite import Json, build, diagnose, errors_of, whole_map
from .wire import Server

REGISTERS = [
    {"at": 0, "name": "Power 1", "type": "int16", "decimals": 1, "unit": "W", "sentinels": {-32768: "none"}},
    {"at": 1, "name": "Power 2", "type": "int16", "unit": "W"},
    {"at": 2, "name": "Voltage", "type": "uint16", "decimals": 1, "unit": "V"},
    {"at": 3, "name": "Ratio", "type": "uint16", "special": {0: "off"}},
]
TERMS: Json = {
    "total": {"sum": ["power_1", "power_2"]},
    "difference": {"sum": ["power_1", {"product": [-1, "power_2"]}]},
    "current": {"quotient": ["power_2", "voltage"]},
    "scaled": {"product": ["power_1", "ratio", "1/3"]},
    "by_case": [{"when": {"power_2": "0..10"}, "is": 0}, {"is": "power_2"}],
}


def with_terms(**terms: Any) -> str:
    computed = {name: {"name": name.title(), "is": term, "unit": "W"} for name, term in terms.items()}
    return whole_map({"registers": REGISTERS, "computed": computed})


@pytest.fixture
def served() -> Iterator[tuple[Any, Any, Server]]:
    with Server() as server:
        module = build(with_terms(**TERMS)).module
        with module.CaseA.tcp("127.0.0.1", port=server.port, unit=1) as driver:
            yield module, driver, server


@pytest.mark.parametrize(
    ("name", "words", "value"),
    [
        ("total", [0xFF9C, 250, 0, 0], 240.0),  # -10.0 + 250
        ("difference", [125, 0xFFFF, 0, 0], 13.5),  # 12.5 + 1
        ("current", [0, 460, 2300, 0], 2.0),  # 460 W / 230.0 V
        ("scaled", [90, 0, 0, 4], 12.0),  # 9.0 x 4 / 3
        ("by_case", [0, 10, 0, 0], 0.0),
        ("by_case", [0, 11, 0, 0], 11.0),
    ],
)
def test_a_number_follows_from_registers(
    served: tuple[Any, Any, Server], name: str, words: list[int], value: float
) -> None:
    _, driver, server = served
    server.memory.put("holding", 0, words)
    server.memory.log.clear()
    assert getattr(driver, name).read() == value
    assert len(server.memory.log) == 1, "all registers come in one request"


@pytest.mark.parametrize(
    ("name", "words", "why"),
    [
        ("total", [0x8000, 1, 0, 0], "computed from power_1"),
        ("scaled", [90, 0, 0, 0], "ratio, which is"),
        ("current", [0, 460, 0, 0], "nothing is divided by 0"),
    ],
)
def test_without_a_value_of_each_register_there_is_none(
    served: tuple[Any, Any, Server], name: str, words: list[int], why: str
) -> None:
    _, driver, server = served
    server.memory.put("holding", 0, words)
    with pytest.raises(NotDecodable, match=why):
        getattr(driver, name).read()


def test_an_asyncio_driver_computes_too(served: tuple[Any, Any, Server]) -> None:
    module, _, server = served
    server.memory.put("holding", 0, [10, 2, 0, 0])

    async def read() -> float:
        async with module.AsyncCaseA.tcp("127.0.0.1", port=server.port, unit=1) as driver:
            value: float = await driver.total.read()
            return value

    assert asyncio.run(read()) == 3.0


def test_docs_and_exports_tell_how_it_follows() -> None:
    register_map = build(with_terms(total=TERMS["total"])).map
    (page,) = (text for path, text in markdown.render(register_map).items() if path.endswith("case.md"))
    assert '## <a id="computed-values"></a>Computed values' in page
    row = next(line for line in page.splitlines() if "`total`" in line)
    assert "power\\_1" in row or "power_1" in row
    (model,) = json.loads(json_text([register_map]))["maps"][0]["models"]
    assert [one["id"] for one in model["computed"]] == ["total"]


@pytest.mark.parametrize(
    ("term", "rule"),
    [("label", "RS0697"), (5, "RS0697"), ({"sum": ["nothing"]}, "RS0301"), ({"quotient": ["power_1", 0]}, "RS0330")],
)
def test_a_term_that_is_no_number_is_refused(term: Any, rule: str) -> None:
    label = {"at": 9, "name": "Label", "type": "string", "length": 2}
    text = whole_map({"registers": [*REGISTERS, label], "computed": {"total": {"name": "T", "is": term}}})
    _, found = diagnose(text)
    assert rule in {one.rule for one in errors_of(found)}


def test_a_computed_value_cannot_have_the_id_of_a_register() -> None:
    _, found = diagnose(with_terms(voltage={"sum": ["power_1", "power_2"]}))
    assert errors_of(found)
