"""A site made of a map and a few pages, by Zensical itself."""

import json
from pathlib import Path

import pytest

from regscribe.cli.app import run

MAP = """
format: 1
map: {id: acme/oven, title: Acme Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven, number: "7"}
models: {A: {}}
protocol: {source: "1", functions: [3, 6]}
groups:
  - {id: g, name: Group, source: "2", registers: [{at: 4049, name: Input Type, symbol: INPT, access: rw}]}
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with a map, a README and a page."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "maps/acme").mkdir(parents=True)
    (tmp_path / "maps/acme/oven.yaml").write_text(MAP, encoding="utf-8")
    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text("# Ovens\n\n[All](generated/docs/README.md), [use](docs/use.md), [map](maps)\n")
    (tmp_path / "docs/use.md").write_text("# Use\n\n[oven](../generated/docs/acme/oven.md#register-input_type)\n")
    return tmp_path


def test_a_map_alone_makes_a_site_with_its_register_browser(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["site", "-o", "out"]) == 0
    assert capsys.readouterr().out.startswith("2 pages in out; ")
    items = json.loads((project / "out/search.json").read_text(encoding="utf-8"))["items"]
    (found,) = (item for item in items if item["location"] == "acme/oven/#register-input_type")
    assert found["title"] == "Input Type"
    assert "holding 4049 (0xFD1, Modicon 44050)" in found["text"]
    assert not [item["location"] for item in items if "#overview" in item["location"]]
    assert "Acme Oven" in (project / "out/registers.html").read_text(encoding="utf-8")


def test_a_projects_own_pages_link_to_the_references(project: Path) -> None:
    assert run(["site", "--docs", ".", "-o", "out"]) == 0
    use = (project / "out/docs/use/index.html").read_text(encoding="utf-8")
    assert 'href="../../generated/docs/acme/oven/#register-input_type"' in use
    assert run(["site", "--docs", ".", "-o", "out"]) == 0  # its own site is replaced


def test_a_broken_link_fails_the_build_and_leaves_the_site_of_before(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["site", "--docs", ".", "-o", "out"]) == 0
    (project / "docs/use.md").write_text("# Use\n\n[oven](../generated/docs/acme/oven.md#register-gone)\n")
    capsys.readouterr()

    assert run(["site", "--docs", ".", "-o", "out"]) == 1

    said = capsys.readouterr()
    assert said.out == (
        "docs/use.md: the link to ../../generated/docs/acme/oven/#register-gone leads nowhere: "
        "generated/docs/acme/oven/index.html has no id register-gone; link to one of its headings\n"
    )
    assert said.err == "nothing was written: 1 fault\n"
    assert "register-input_type" in (project / "out/docs/use/index.html").read_text(encoding="utf-8")


def test_a_page_that_is_not_there_fails_the_build(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / "docs/use.md").write_text("# Use\n\n[gone](gone.md), [map](../maps/acme/oven.yaml)\n")
    assert run(["site", "--docs", ".", "-o", "out"]) == 1
    assert capsys.readouterr().out == (
        "docs/use.md: the link to gone.md leads nowhere: there is no docs/gone.md; name what is there\n"
    )
    assert not (project / "out").exists()


def test_a_folder_that_is_no_site_is_not_replaced(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["site", "-o", "docs"]) == 1
    assert "docs is there already and is no site of regscribe" in capsys.readouterr().err
    assert (project / "docs/use.md").is_file()


@pytest.mark.usefixtures("project")
def test_without_zensical_it_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("regscribe.site.building.find_spec", lambda _: None)
    assert run(["site"]) == 1
    assert "pip install 'regscribe[site]'" in capsys.readouterr().err
