"""A unit is asked what it is; what cannot be told apart comes back as a set."""

import asyncio
from pathlib import Path
from typing import Any

import pytest

from regscribe.emit import python
from regscribe.model import RegisterMap
from regscribe.simulate import simulate
from regscribe.simulate.map_cache import find_map
from regscribe_runtime import async_tcp, identify, identify_async, known_models, tcp

MAPS = Path(__file__).parents[3] / "maps"


@pytest.fixture(scope="module")
def series_c() -> RegisterMap:
    return find_map(MAPS / "athena" / "series-c.yaml")


def names(found: Any) -> set[str]:
    return {known.model for known in found.models if known.map_id == "athena/series-c"}


@pytest.mark.parametrize(("model", "told"), [("16C", {"16C"}), ("1ZC", {"1ZC"}), ("25C", {"18C", "25C"})])
def test_a_controller_is_recognised_and_models_that_answer_alike_come_as_a_set(
    series_c: RegisterMap, model: str, told: set[str]
) -> None:
    with simulate(series_c, model, unit=3) as running:
        link = tcp(running.host, port=running.port)
        link.open()
        found = identify(link, unit=3)
        link.close()

    assert names(found) == told
    seen = next(one for one in found.evidence if one.register == "controller_type")
    assert (seen.address, seen.error, "athena/series-c" in seen.map_ids) == (4000, None, True)


def test_a_register_that_the_unit_does_not_have_is_evidence_and_no_failure(series_c: RegisterMap) -> None:
    with simulate(series_c, "16C", unit=1) as running:
        link = tcp(running.host, port=running.port)
        link.open()
        found = identify(link, unit=1)
        link.close()

    refused = next(one for one in found.evidence if one.map_ids == ("fdc/series-100",))
    assert refused.error is not None
    assert "exception 02" in str(refused.error)


def test_the_driver_class_of_the_model_comes_with_it(series_c: RegisterMap) -> None:
    async def ask(port: int) -> Any:
        link = async_tcp("127.0.0.1", port=port)
        await link.open()
        try:
            return await identify_async(link, unit=1)
        finally:
            await link.close()

    with simulate(series_c, "16C", unit=1) as running:
        found = asyncio.run(ask(running.port))

    drivers = {known.driver.__name__ for known in found.models}
    assert "Athena16C" in drivers
    assert {known.async_driver.__name__ for known in found.models} == {f"Async{name}" for name in drivers}


def test_a_text_register_tells_the_model_by_how_it_begins(build: Any) -> None:
    built = build(TWO_MODELS)
    with simulate(built.map, "X4", unit=1) as running:
        link = tcp(running.host, port=running.port)
        link.open()
        found = identify(link, unit=1, packages=(built.module,))
        link.close()

    assert [known.model for known in found.models] == ["X4"]
    assert found.certain
    assert found.evidence[0].value == "X3"


def test_all_models_of_the_package_that_can_be_told_are_known() -> None:
    assert {"1ZC", "16C", "18C", "25C", "C21", "BTC-9100"} <= {known.model for known in known_models()}


TWO_MODELS = """
format: 1
map: {id: test/two, title: Two, maker: Nobody, class_prefix: Two}
manual: {title: None, number: "1", date: "2026"}
models: {X1: {}, X4: {}}
groups:
  - id: all
    name: All
    source: "1"
    registers:
      - {at: 121, name: Product Code, type: string, length: 2, byte_order: little, access: r}
identify:
  - {text: {product_code: X1}, models: [X1]}
  - {text: {product_code: X3}, models: [X4]}
"""


def test_drivers_of_a_package_that_declares_them_are_known(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    register_map = find_map(MAPS / "fdc" / "series-100.yaml")
    (module,) = python.render(register_map).values()
    (tmp_path / "kiln_drivers").mkdir()
    (tmp_path / "kiln_drivers" / "__init__.py").write_text(module.replace('"fdc/series-100"', '"kiln/other"'))
    about = tmp_path / "kiln_drivers-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: kiln-drivers\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[regscribe.drivers]\nkilns = kiln_drivers\n")
    monkeypatch.syspath_prepend(tmp_path)

    known = {(one.map_id, one.model) for one in known_models()}

    assert {("kiln/other", "C21"), ("fdc/series-100", "C21"), ("athena/series-c", "16C")} <= known
