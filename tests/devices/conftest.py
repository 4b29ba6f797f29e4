"""The two transcribed maps, compiled once."""

from pathlib import Path

import pytest

from regscribe.model import RegisterMap
from regscribe.simulate.map_cache import find_map

MAPS = Path(__file__).parents[2] / "maps"


def _compiled(name: str) -> RegisterMap:
    return find_map(MAPS / f"{name}.yaml")


@pytest.fixture(scope="session")
def maps() -> Path:
    """The folder of the maps and of the lists that were transcribed apart from them."""
    return MAPS


@pytest.fixture(scope="session")
def athena() -> RegisterMap:
    """Athena Series C."""
    return _compiled("athena/series-c")


@pytest.fixture(scope="session")
def fdc() -> RegisterMap:
    """FDC Series 100."""
    return _compiled("fdc/series-100")
