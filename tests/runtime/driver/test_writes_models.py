"""All 21 models: a whole configuration is written as one operation, and what a manual warns of wants confirmation."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from regscribe.model import Model, RegisterMap
from regscribe.simulate import SimulatedDevice
from regscribe.simulate.map_cache import find_map

ROOT = Path(__file__).parents[3] / "maps"
NAMES = sorted(path.relative_to(ROOT) for path in ROOT.glob("*/*.yaml") if not path.stem.endswith(".library"))
GIVENS: dict[str, dict[str, Any]] = {"fdc/series-100": {"linear_inputs": {8, 9}}}
WRITES = frozenset({5, 6, 15, 16})

Opened = Callable[[RegisterMap, Model], Any]


@pytest.fixture(scope="module", params=NAMES, ids=str)
def family(request: pytest.FixtureRequest) -> RegisterMap:
    return find_map(ROOT / request.param)


@pytest.fixture
def opened(direct: Any) -> Opened:
    def make(family: RegisterMap, model: Model) -> Any:
        givens = GIVENS.get(family.id, {})
        module = import_module(f"regscribe_devices.{family.id.replace('/', '.').replace('-', '_')}")
        device = SimulatedDevice(family, model.name, unit=1, givens=givens)
        return getattr(module, model.class_name)(direct(device), unit=1, **givens)

    return make


def settings(controller: Any) -> dict[str, Any]:
    """The present value of every setting that may be copied, if it is one that the device would take."""
    snapshot, found = controller.read(), dict[str, Any]()
    for path, register in type(controller).registers.items():
        if register.access != "rw" or register.stays or path in snapshot.errors:
            continue
        found[path] = snapshot[path]
    return found


def test_a_configuration_that_the_device_holds_is_not_written(family: RegisterMap, opened: Opened) -> None:
    controller = opened(family, family.models[0])
    values = settings(controller)
    controller.link.log.clear()

    report = controller.configure(values, confirm=True)

    assert set(report.equal) == set(values)
    assert {asked.function for asked in controller.link.log}.isdisjoint(WRITES)


def test_a_changed_configuration_is_written_in_fewer_requests_than_values(family: RegisterMap, opened: Opened) -> None:
    for model in family.models:
        controller = opened(family, model)
        values = {
            path: value + 1
            for path, value in settings(controller).items()
            if type(controller).registers[path].kind in {"integer", "raw"}
            and not (path.endswith(("segments", "limit")) or type(controller).registers[path].range)
        }
        controller.link.log.clear()

        report = controller.configure(values, confirm=True)

        sent = [asked for asked in controller.link.log if asked.function in WRITES]
        assert set(report.written) == set(values), model.name
        assert all(controller.link.device.peek(path) == value for path, value in values.items())
        assert len(sent) <= max(1, len(values) * 2 // 3), model.name


def test_what_governs_the_line_or_calibrates_wants_confirmation(family: RegisterMap) -> None:
    for model in family.models:
        for register in model.registers:
            if register.governs or (register.stays == "calibration" and register.access.writable):
                assert register.danger, f"{model.name} {register.path}"
            if register.governs:
                assert register.stays == ("address" if register.governs.setting == "address" else "line")


def test_every_model_tells_its_address_and_the_speed_of_its_line_from_its_settings(family: RegisterMap) -> None:
    for model in family.models:
        governed = {register.governs.setting.value for register in model.registers if register.governs}
        assert {"address", "baud"} <= governed, model.name
