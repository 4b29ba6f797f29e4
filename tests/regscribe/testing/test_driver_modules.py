"""Generated tests find the driver beside them, whatever is installed and however pytest is called."""

import sys
from pathlib import Path

import pytest

from regscribe.testing import driver_module


@pytest.fixture
def generated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with `regscribe_devices.maker.oven`; what is imported from it is forgotten afterwards."""
    for name in [name for name in sys.modules if name.split(".")[0] == "regscribe_devices"]:
        monkeypatch.delitem(sys.modules, name)
    return write(tmp_path, "1")


def write(folder: Path, mark: str) -> Path:
    package = folder / "regscribe_devices" / "fdc"
    package.mkdir(parents=True)
    for place in (package.parent, package):
        (place / "__init__.py").write_text("")
    (package / "oven.py").write_text(f"MARK = {mark}\n")
    (package / "series_100.py").write_text(f"MARK = {mark}\n")
    return folder


def test_a_driver_is_imported_from_a_folder_that_is_not_on_the_path(generated: Path) -> None:
    assert driver_module(generated, "fdc.oven").MARK == 1


def test_a_driver_goes_before_an_installed_one_of_its_name(generated: Path) -> None:
    assert driver_module(generated, "fdc.series_100").MARK == 1


def test_what_is_installed_beside_it_is_still_found(generated: Path) -> None:
    driver_module(generated, "fdc.oven")
    from regscribe_devices.athena import series_c  # noqa: PLC0415 - imported after the other

    assert series_c.__name__ == "regscribe_devices.athena.series_c"


def test_a_driver_that_was_imported_from_elsewhere_is_not_judged_in_its_place(generated: Path, tmp_path: Path) -> None:
    driver_module(generated, "fdc.oven")
    with pytest.raises(ImportError, match=r"was imported from .* already; these tests are of the one in"):
        driver_module(write(tmp_path / "other", "2"), "fdc.oven")


def test_a_driver_that_is_missing_is_an_error_that_names_it(generated: Path) -> None:
    with pytest.raises(ModuleNotFoundError, match=r"fdc\.kiln"):
        driver_module(generated, "fdc.kiln")
