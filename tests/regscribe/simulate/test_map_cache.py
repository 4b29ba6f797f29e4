"""Maps by id, compiled once, and anew when their files change."""

import os
import shutil
from pathlib import Path

import pytest

from regscribe.map_files import LIBRARY, ids_in, shipped
from regscribe.model import RegisterMap
from regscribe.simulate import SimulatorError, find_map, simulate

FURNACE = Path(__file__).with_name("furnace.yaml")


@pytest.fixture
def local(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A map acme/furnace below a folder maps/ in the working directory."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "maps" / "acme" / "furnace.yaml"
    path.parent.mkdir(parents=True)
    shutil.copy(FURNACE, path)
    return path


def test_a_map_that_comes_with_regscribe_is_found_by_its_id_and_kept() -> None:
    first = find_map("fdc/series-100")
    assert (first.id, find_map("fdc/series-100") is first) == ("fdc/series-100", True)


def test_a_map_is_found_by_its_file_and_a_map_is_itself(furnace: RegisterMap) -> None:
    assert find_map(FURNACE).title == find_map(str(FURNACE)).title == "Furnace"
    assert find_map(furnace) is furnace


def test_a_map_of_the_working_directory_is_compiled_anew_when_it_changes(local: Path) -> None:
    assert find_map("acme/furnace").title == "Furnace"
    local.write_text(local.read_text(encoding="utf-8").replace("title: Furnace,", "title: Kiln,"), encoding="utf-8")
    os.utime(local, ns=(1, 1))
    assert find_map("acme/furnace").title == "Kiln"


def test_an_unknown_map_is_one_clear_message() -> None:
    with pytest.raises(SimulatorError, match=r"no map 'athena/series-x'.*did you mean 'athena/series-c'"):
        find_map("athena/series-x")
    with pytest.raises(SimulatorError, match="no map"):
        find_map("../" * 1000)


def test_a_map_with_mistakes_is_told_with_its_place(local: Path) -> None:
    local.write_text("format: 1\n", encoding="utf-8")
    with pytest.raises(SimulatorError, match=r"has mistakes.*\n.*furnace.yaml:1"), simulate("acme/furnace", "F1"):
        pass


def test_the_maps_that_a_message_lists_are_no_libraries() -> None:
    with pytest.raises(SimulatorError, match="known are") as caught:
        find_map("zzz")
    known = set(str(caught.value).partition("known are ")[2].split(", "))
    assert "fdc/series-100" in known
    libraries = ids_in([shipped()], LIBRARY)
    assert [name for name in known if name.removesuffix(".library") in libraries] == []
