"""What Zensical is given: the layout of the repository, mended links, and a menu that people can read."""

from pathlib import Path

import pytest

from regscribe.site.config import configuration
from regscribe.site.nav import navigation
from regscribe.site.sources import project_pages, public_address, runtime_pages
from regscribe.site.staging import Around, Page, stage

THERE = {"maps/oven.yaml", "schema/map.schema.json", "docs/adr"}
PUBLIC = "https://code.example/acme/oven"


def staged(target: str, *, public: str = "", here: str = "docs/cli.md") -> str:
    """The line of a page with one link, on the site."""
    pages = [Page("README.md", "Home", ""), Page("docs/bus.md", "Buses", ""), Page("gen/docs/README.md", "All", "")]
    around = Around({"docs/a.svg"}, public, THERE.__contains__)
    texts, _ = stage([*pages, Page(here, "Here", f"[x]({target})")], around, browser=False)
    return texts[here].rpartition("\n")[2]


def broken(target: str, *, reference: bool = False) -> list[str]:
    """What is said of a link that leads nowhere."""
    page = Page("docs/cli.md", "Here", f"[x]({target})", reference=reference)
    _, found = stage([page], Around(exists=THERE.__contains__), browser=False)
    return [str(fault) for fault in found]


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ("bus.md", "[x](bus.md)"),
        ("bus.md#rtu", "[x](bus.md#rtu)"),
        ("../README.md", "[x](../index.md)"),
        ("../gen/docs/README.md#coverage", "[x](../gen/docs/index.md#coverage)"),
        ("../gen/docs", "[x](../gen/docs/index.md)"),
        ("a.svg", "[x](a.svg)"),
        ("#here", "[x](#here)"),
        ("https://other.example/a", "[x](https://other.example/a)"),
        ("mailto:a@b.example", "[x](mailto:a@b.example)"),
    ],
)
def test_a_link_inside_leads_to_the_staged_page(target: str, expected: str) -> None:
    assert staged(target) == expected


@pytest.mark.parametrize(
    "target", ["../schema/map.schema.json", "../maps/oven.yaml#L3", "adr", "../../secret", "/etc/passwd"]
)
def test_a_link_to_what_is_not_on_the_site_becomes_its_text(target: str) -> None:
    assert staged(target) == "x"


def test_a_link_to_what_is_not_on_the_site_leads_to_the_public_repository_where_there_is_one() -> None:
    assert staged("../maps/oven.yaml#L3", public=PUBLIC) == f"[x]({PUBLIC}/blob/HEAD/maps/oven.yaml#L3)"
    assert staged("../../secret", public=PUBLIC) == "x"


def test_a_link_of_a_projects_page_to_what_is_nowhere_is_told() -> None:
    said = "docs/cli.md: the link to {} leads nowhere: there is no {}; name what is there"
    assert broken("gone.md#x") == [said.format("gone.md#x", "docs/gone.md")]
    assert broken("../../maps/oven.yaml") == [said.format("../../maps/oven.yaml", "../maps/oven.yaml")]
    assert broken("../maps/oven.yaml") == broken("https://x.example/gone.md") == broken("#gone") == []


def test_a_reference_may_name_a_map_that_is_not_on_the_site() -> None:
    assert broken("../acme/base.md", reference=True) == []


def test_a_reference_has_no_contents_menu_and_a_link_to_the_register_browser() -> None:
    page = Page("gen/acme/oven.md", 'Oven "A": x', "<!-- made -->\n\n# Oven\n\nText.", reference=True)
    texts, _ = stage([page], Around(), browser=True)
    assert texts["gen/acme/oven.md"] == (
        '---\ntitle: "Oven \\"A\\": x"\nhide: ["toc"]\n---\n\n<!-- made -->\n\n# Oven { #oven }\n\n'
        "[Find a register and calculate its values](../../registers.html)\n\nText."
    )


def test_the_menu_groups_families_by_maker() -> None:
    registers = "Registers"
    pages = [
        Page("README.md", "Home", ""),
        Page("gen/README.md", "All devices", "", (registers,)),
        Page("gen/acme/a.md", "Oven A", "", (registers, "Acme")),
        Page("gen/fdc/x.md", "FDC 100", "", (registers, "Future Design Controls")),
        Page("gen/acme/b.md", "Oven B", "", (registers, "Acme")),
    ]
    assert navigation(pages, browser=True) == [
        {"Home": "index.md"},
        {
            "Registers": [
                {"Register browser": "registers.html"},
                {"All devices": "gen/index.md"},
                {"Acme": [{"Oven A": "gen/acme/a.md"}, {"Oven B": "gen/acme/b.md"}]},
                {"Future Design Controls": [{"FDC 100": "gen/fdc/x.md"}]},
            ]
        },
    ]


def test_a_projects_pages_come_in_the_order_of_its_readme(tmp_path: Path) -> None:
    (tmp_path / "docs" / "adr").mkdir(parents=True)
    (tmp_path / "README.md").write_text("# Oven\n\n[b](docs/b.md#x) [a](docs/a.md)\n")
    for name, title in {
        "docs/a.md": "All",
        "docs/b.md": "`b` is\\* first",
        "docs/c.md": "",
        "CHANGES.md": "Changes",
    }.items():
        (tmp_path / name).write_text(f"# {title}\n" if title else "none")
    (tmp_path / "docs/adr/0001-x.md").write_text("# 1. Why\n")
    (tmp_path / "docs/a.svg").write_text("<svg/>")
    pages, files = project_pages(tmp_path)

    assert [(page.path, page.title, page.section) for page in pages] == [
        ("README.md", "Home", ()),
        ("docs/b.md", "b is* first", ("Guides",)),
        ("docs/a.md", "All", ("Guides",)),
        ("docs/c.md", "C", ("Guides",)),
        ("docs/adr/0001-x.md", "1. Why", ("Decisions",)),
        ("CHANGES.md", "Changes", ("Project",)),
    ]
    assert files == {"docs/a.svg": b"<svg/>"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('[project.urls]\nSource = "https://code.example/oven/"\n', "https://code.example/oven"),
        ('[project.urls]\nDocumentation = "https://docs.example"\n', ""),
        ("[project\n", ""),
        ("", ""),
    ],
)
def test_the_public_repository_is_what_pyproject_says(tmp_path: Path, text: str, expected: str) -> None:
    (tmp_path / "pyproject.toml").write_text(text)
    assert public_address(tmp_path) == expected


def test_the_runtimes_reference_has_its_public_names_each_once() -> None:
    pages = {page.title: page.text for page in runtime_pages()}
    assert "::: regscribe_runtime.driver.bus.Bus\n" in pages["Driver"]
    assert "::: regscribe_runtime.errors.OutOfRange\n" in pages["Errors"]
    named = [line for text in pages.values() for line in text.splitlines() if line.startswith(":::")]
    assert len(named) == len(set(named)) > 100
    assert not [name for name in named if "._" in name]


def test_the_configuration_asks_for_no_font_and_reads_titles_as_texts() -> None:
    text = configuration('A "title": {x}', [{"Home: a": "index.md"}], url="", repository="", api=False)
    assert '"font": false' in text
    assert '"site_name": "A \\"title\\": {x}"' in text
