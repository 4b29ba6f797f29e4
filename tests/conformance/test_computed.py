"""Numbers that follow from several registers: worked out by hand, over a server that knows no map."""

import asyncio
import json
from collections.abc import Iterator
from typing import Any

import pytest

from regscribe.emit import markdown
from regscribe.export.json import json_text
from regscribe_runtime.errors import NotDecodable, NotPresent, OutOfRange

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
    "clamped": {"max": [{"sum": ["power_1", {"product": [-1, "power_2"]}]}, 0]},
    "least": {"min": ["power_1", "power_2", 100]},
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
        ("clamped", [125, 2, 0, 0], 10.5),  # 12.5 - 2
        ("clamped", [125, 13, 0, 0], 0.0),  # 12.5 - 13 is below 0
        ("least", [125, 13, 0, 0], 12.5),
        ("least", [5000, 400, 0, 0], 100.0),
        ("least", [5000, 0xFFFF, 0, 0], -1.0),
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


CONDITIONAL: Json = {
    "registers": [
        {"at": 0, "name": "Mode", "type": "uint16", "enum": {0: "off", 1: "on"}},
        {"at": 1, "name": "Import", "id": "taken", "type": "int16"},
        {"at": 2, "name": "Export", "id": "given_back", "type": "int16"},
    ],
    "computed": {
        "net": {
            "name": "Net",
            "is": {"sum": ["taken", {"product": [-1, "given_back"]}]},
            "valid": {"from": -5, "to": "taken"},
            "when": {"mode": "on"},
        },
        "either": {"name": "Either", "is": [{"when": {"mode": "on"}, "is": "taken"}, {"is": "given_back"}]},
    },
}


@pytest.fixture
def conditional() -> Iterator[tuple[Any, Server]]:
    with Server() as server:
        module = build(whole_map(CONDITIONAL)).module
        with module.CaseA.tcp("127.0.0.1", port=server.port, unit=1) as driver:
            yield driver, server


def test_a_computed_value_exists_while_its_condition_holds(conditional: tuple[Any, Server]) -> None:
    driver, server = conditional
    server.memory.put("holding", 0, [1, 9, 4])
    assert driver.net.read() == 5
    server.memory.put("holding", 0, [0, 9, 4])
    with pytest.raises(NotPresent, match=r"net: it exists only while mode is ON \(1\); mode is OFF \(0\)"):
        driver.net.read()


@pytest.mark.parametrize(("words", "why"), [([1, 0, 6], "-6 lies outside -5 to 0"), ([1, 3, 0xFFFF], "4 lies outside")])
def test_a_computed_value_outside_what_is_valid_is_no_value(
    conditional: tuple[Any, Server], words: list[int], why: str
) -> None:
    driver, server = conditional
    server.memory.put("holding", 0, words)
    with pytest.raises(OutOfRange, match=why):
        driver.net.read()


def test_a_case_of_a_term_may_ask_for_a_code(conditional: tuple[Any, Server]) -> None:
    driver, server = conditional
    server.memory.put("holding", 0, [1, 9, 4])
    assert driver.either.read() == 9
    server.memory.put("holding", 0, [0, 9, 4])
    assert driver.either.read() == 4


def test_docs_and_exports_tell_when_a_computed_value_exists_and_is_valid() -> None:
    register_map = build(whole_map(CONDITIONAL)).map
    (page,) = (text for path, text in markdown.render(register_map).items() if path.endswith("case.md"))
    row = next(line for line in page.splitlines() if "`net`" in line)
    assert "-5 to" in row
    assert "on (1)" in row
    (model,) = json.loads(json_text([register_map]))["maps"][0]["models"]
    assert model["computed"][0]["when"]["tests"][0]["register"] == "mode"
    assert model["computed"][0]["valid"][0]["then"]["intervals"][0]["low"] == {"value": -5}


@pytest.mark.parametrize(
    ("more", "rule"),
    [({"when": {"mode": 7}}, "RS0470"), ({"when": {"nothing": 1}}, "RS0301"), ({"valid": "9..1"}, "RS0315")],
)
def test_a_condition_or_limit_of_a_computed_value_that_cannot_be_is_refused(more: Json, rule: str) -> None:
    net = CONDITIONAL["computed"]["net"] | more
    _, found = diagnose(whole_map(CONDITIONAL | {"computed": {"net": net}}))
    assert rule in {one.rule for one in errors_of(found)}


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
