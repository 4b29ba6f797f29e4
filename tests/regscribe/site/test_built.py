"""What is wrong in a built site is found: links, ids, and what other hosts are asked for."""

from pathlib import Path

import pytest

from regscribe.site.built import faults


def told(site: Path, **files: str) -> list[str]:
    """What is said of a site of these files: `a` stands for a/index.html."""
    for name, text in {"index": "", **files}.items():
        path = site / ("index.html" if name == "index" else f"{name}/index.html")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    (site / "style.css").write_text("a{background:url(a.png)}", encoding="utf-8")
    return [f"{one.file}: {one.what}" for one in faults(site)]


@pytest.mark.parametrize(
    "link",
    ["a/", "a/#x", "./a/index.html", "/a/", "a", "#here", "", "style.css?v=1", "https://x.example/", "mailto:a@b.c"],
)
def test_a_link_that_leads_somewhere_is_none_of_them(tmp_path: Path, link: str) -> None:
    assert told(tmp_path, index=f'<p id="here"><a href="{link}">x</a>', a='<p id="x">') == []


@pytest.mark.parametrize(
    ("link", "said"),
    [
        ("b/", "the link to b/ leads nowhere"),
        ("a/#y", "the link to a/#y leads nowhere"),
        ("#y", "the link to #y leads nowhere"),
        ("a.md", "the link to a.md leads nowhere"),
        ("../../a.yaml", "the link to ../../a.yaml leads nowhere"),
    ],
)
def test_a_link_that_leads_nowhere_is_told_with_its_page(tmp_path: Path, link: str, said: str) -> None:
    assert told(tmp_path, index=f'<a href="{link}">x</a>', a='<p id="x">') == [f"index.html: {said}"]


def test_a_picture_that_is_missing_is_told(tmp_path: Path) -> None:
    assert told(tmp_path, a='<img src="../no.svg">') == ["a/index.html: the link to ../no.svg leads nowhere"]


def test_what_to_do_names_the_id_that_is_missing(tmp_path: Path) -> None:
    told(tmp_path, index='<a href="a/#y">x</a>', a='<p id="x">')
    assert [one.todo for one in faults(tmp_path)] == ["a/index.html has no id y; link to one of its headings"]


def test_an_id_that_stands_twice_is_told(tmp_path: Path) -> None:
    assert told(tmp_path, index='<p id="x"><p id="x">') == ["index.html: the id x stands 2 times"]


@pytest.mark.parametrize(
    "element",
    [
        '<script src="https://x.example/a"></script>',
        '<img src="//x.example/a">',
        '<link rel="stylesheet" href="https://x.example/a">',
        '<link rel="preconnect" href="https://x.example/a">',
    ],
)
def test_what_a_browser_would_fetch_from_another_host_is_told(tmp_path: Path, element: str) -> None:
    (found,) = told(tmp_path, index=element)
    assert found.endswith("//x.example/a is fetched from another host")


def test_a_style_that_fetches_from_another_host_is_told(tmp_path: Path) -> None:
    told(tmp_path)
    (tmp_path / "style.css").write_text("@import 'https://x.example/f.css'; a{background:url(//x.example/a.png)}")
    assert sorted(one.what for one in faults(tmp_path)) == [
        "//x.example/a.png is fetched from another host",
        "https://x.example/f.css is fetched from another host",
    ]


def test_an_address_that_is_only_named_is_none_of_them(tmp_path: Path) -> None:
    assert told(tmp_path, index='<link rel="canonical" href="https://x.example/"><a href="https://x.example/">') == []
