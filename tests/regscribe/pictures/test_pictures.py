"""The pictures are valid, complete, the same every time, readable in light and dark, and hostile maps stay text."""

import os
import re
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from regscribe.emit import markdown, picture_paths
from regscribe.emit.header import origin_of
from regscribe.model import (
    Access,
    Array,
    BitField,
    Enum,
    Group,
    Kind,
    Manual,
    Member,
    Model,
    Register,
    RegisterMap,
    Space,
    View,
    WireType,
)
from regscribe.pictures import drawings, render, style
from regscribe.pictures.address_rows import GRIDS, AddressRow, layout, sections
from regscribe.pictures.address_use import address_uses
from regscribe.pictures.cell_style import looks
from regscribe.pictures.drawing import WIDTH, Box, Drawing, Text
from regscribe.pictures.text_width import clean, shorten, width, wrap
from regscribe.simulate.map_cache import find_map

ROOT = Path(__file__).parents[3]
MAPS = sorted(path for path in (ROOT / "maps").glob("*/*.yaml") if not path.name.endswith(".library.yaml"))
SVG = "{http://www.w3.org/2000/svg}"
HOSTILE = "a|b <script>alert(1)</script>\n\n]]> --> & \"quoted' 😀 \u202e \x00\x0b\ufffe {{7*7}} 中文字 ЖЖЖ"
ELEMENTS = {"svg", "title", "desc", "style", "defs", "pattern", "rect", "path", "text"}
LONG = 2_000_000
"""Bytes that no picture may reach."""


def overlap(one: Box, other: Box) -> bool:
    """Whether both cover a point; edges that touch do not count."""
    across = one.x < other.x + other.width and other.x < one.x + one.width
    return across and one.y < other.y + other.height and other.y < one.y + one.height


def register(
    id_: str, address: int, *, name: str = "", group: str = "main", words: int = 1, **more: object
) -> Register:
    view = View("base", WireType.UINT16, offset=address, words=words)
    fields: dict[str, object] = {"kind": Kind.INTEGER, "access": Access.READ_WRITE, "views": (view,), **more}
    return Register(at=0, id=id_, path=id_, name=name or id_, group=group, **fields)  # type: ignore[arg-type] - by name


def model(name: str, members: Iterable[Register | Array], groups: Iterable[str] = ("main",), **more: object) -> Model:
    found = tuple(members)
    plain = tuple(item for item in found if isinstance(item, Register))
    named = tuple(Group(id=id_, name=f"group {id_}", members=()) for id_ in groups)
    return Model(name=name, class_name=name, members=found, registers=plain, groups=named, **more)  # type: ignore[arg-type] - by name


def family(*models: Model, **more: object) -> RegisterMap:
    fields: dict[str, object] = {"title": "Oven", "maker": "Acme", "manual": Manual("Oven"), **more}
    return RegisterMap(
        id="acme/oven",
        class_prefix="A",
        source="oven.yaml",
        content_hash="0" * 64,
        models=models,
        **fields,
    )  # type: ignore[arg-type] - by name


@pytest.fixture(scope="module")
def hostile() -> RegisterMap:
    enum = Enum("e", tuple(Member(code, HOSTILE, f"M{code}") for code in range(30)))
    parts = tuple(BitField(f"f{n}", HOSTILE * 3, 2 * n, 2 * n + n % 2, enum if n % 3 else None) for n in range(8))
    status = register("status", 12, name=HOSTILE, kind=Kind.FIELDS, fields=parts)
    cells = [register(f"r{n}", 20 + n, name=HOSTILE, group=f"g{n}", access=list(Access)[n % 3]) for n in range(120)]
    deep = replace(register("x", 61000, name=HOSTILE), path="outer[1].inner[0].x", index=(1, 0))
    shallow = replace(register("y", 60000, name=HOSTILE), path="outer[1].y", index=(1,))
    inner = Array(id="inner", name=HOSTILE, first=0, count=1000, stride=2, members=(deep,))
    outer = Array(id="outer", name=HOSTILE, first=1, count=5, stride=0, members=(shallow, inner))
    groups = tuple(Group(id=f"g{n}", name=f"{HOSTILE} {n}", members=()) for n in range(120))
    models = [model(f"M{n} {HOSTILE}", [status, *cells[: 90 + n], *cells[91 + n :], outer]) for n in range(24)]
    expanded = (replace(item, registers=(*item.registers, shallow, deep), groups=groups) for item in models)
    return family(*expanded, title=HOSTILE, maker=HOSTILE)


@pytest.fixture(scope="module", params=["small", "hostile", *MAPS], ids=lambda item: getattr(item, "stem", item))
def any_map(request: pytest.FixtureRequest, oven: RegisterMap, hostile: RegisterMap) -> RegisterMap:
    if isinstance(request.param, str):
        return {"small": oven, "hostile": hostile}[request.param]
    return find_map(request.param)


def texts(drawing: Drawing) -> list[Text]:
    return [item for item in drawing.items if isinstance(item, Text)]


def boxes(drawing: Drawing) -> list[Box]:
    return [item for item in drawing.items if isinstance(item, Box)]


def cells(drawing: Drawing) -> list[Box]:
    return [box for box in boxes(drawing) if box.tip]


def words(drawing: Drawing) -> str:
    return " ".join(item.text for item in texts(drawing))


def address_map(register_map: RegisterMap) -> Drawing:
    return drawings(register_map)["addresses.svg"]


def test_every_picture_is_valid_xml_of_few_elements_and_fits_a_page(any_map: RegisterMap) -> None:
    for path, text in render(any_map).items():
        root = ET.fromstring(text)  # noqa: S314 - our own text, no entities in it
        assert {item.tag.removeprefix(SVG) for item in root.iter()} <= ELEMENTS, path
        _, _, wide, high = (float(number) for number in root.attrib["viewBox"].split())
        assert (wide, high) == (float(root.attrib["width"]), float(root.attrib["height"]))
        assert wide <= 900
        assert len(text) < LONG


def test_every_picture_has_a_title_and_words_for_those_who_do_not_see_it(any_map: RegisterMap) -> None:
    for text in render(any_map).values():
        root = ET.fromstring(text)  # noqa: S314 - our own text, no entities in it
        assert root.attrib["role"] == "img"
        assert root.findtext(f"{SVG}title")
        assert root.findtext(f"{SVG}desc")


@pytest.fixture(scope="module")
def narrow() -> RegisterMap:
    """Return so many registers that the cells are narrow, with two letters and a mark in them."""
    cells = [register(f"r{n}", n, group=f"g{n % 400}") for n in range(1300)]
    groups = [f"g{n}" for n in range(400)]
    return family(*(model(f"M{n}", (item for item in cells if int(item.id[1:]) % 24 != n), groups) for n in range(24)))


def test_no_text_of_narrow_cells_lies_on_another(narrow: RegisterMap) -> None:
    assert "Each row has 50 addresses" in words(address_map(narrow))
    test_no_text_leaves_the_picture_or_lies_on_another(narrow)


def test_no_text_leaves_the_picture_or_lies_on_another(any_map: RegisterMap) -> None:
    for name, drawing in drawings(any_map).items():
        found = sorted((item.box for item in texts(drawing)), key=lambda box: box.y)
        assert all(box.x >= 0 and box.x + box.width <= WIDTH for box in found), name
        assert all(box.y >= 0 and box.y + box.height <= drawing.height for box in found), name
        near = ((one, two) for index, one in enumerate(found) for two in found[index + 1 : index + 120])
        assert not [(one, two) for one, two in near if overlap(one, two)], name


def test_no_box_leaves_the_picture(any_map: RegisterMap) -> None:
    for name, drawing in drawings(any_map).items():
        for box in boxes(drawing):
            assert box.x >= 0, name
            assert box.x + box.width <= WIDTH, name
            assert box.y + box.height <= drawing.height, name


def test_every_group_stands_in_the_legend(any_map: RegisterMap) -> None:
    drawing = address_map(any_map)
    shown = {item.text for item in texts(drawing)} | {item.tip for item in texts(drawing)}
    used = {item.group for model_ in any_map.models for item in model_.registers}
    names = {group.name for model_ in any_map.models for group in model_.groups if group.id in used}
    assert {clean(name) for name in names} - shown == set()


def test_every_address_of_every_view_is_drawn(any_map: RegisterMap) -> None:
    drawn: dict[str, set[int]] = {}
    for cell in cells(address_map(any_map)):
        first, last, what = re.fullmatch(r"(\d+)(?: to (\d+))?: (.*)", cell.tip).groups()  # type: ignore[union-attr] - else it fails
        for path in re.findall(r"[a-z][\w.\[\]]*(?=, r|, w)", what):
            drawn.setdefault(path, set()).update(range(int(first), int(last or first) + 1))
    for item in (item for model_ in any_map.models for item in model_.registers):
        wanted = {address for view in item.views for address in range(view.address(item.at), view.last(item.at) + 1)}
        assert wanted <= drawn[item.path], item.path


def test_the_same_map_gives_the_same_bytes_whatever_the_hash_seed(oven_path: Path) -> None:
    script = (
        "import sys, hashlib\nfrom pathlib import Path\nfrom regscribe import lower, source\n"
        "from regscribe.pictures import render\n"
        "files = render(lower.lower(source.load(Path(sys.argv[1]))[0])[0])\n"
        "print(hashlib.sha256(repr(list(files.items())).encode()).hexdigest())"
    )
    found = {
        subprocess.run(  # noqa: S603 - our own
            [sys.executable, "-c", script, str(oven_path)],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
            timeout=60,
        ).stdout
        for seed in ("0", "1", "4242")
    }
    assert len(found) == 1


def test_the_page_links_every_picture_and_no_other(any_map: RegisterMap) -> None:
    page = next(iter(markdown.render(any_map).values()))
    linked = set(re.findall(r"\]\(([\w./-]+\.svg)\)", page))
    assert linked == {path.removeprefix("docs/").partition("/")[2] for path in render(any_map)}


def test_a_picture_says_which_map_it_was_made_from(tmp_path: Path, oven: RegisterMap) -> None:
    for text in render(oven).values():
        (tmp_path / "x.svg").write_text(text, encoding="utf-8")
        assert origin_of(tmp_path / "x.svg") == oven.id


def test_a_map_without_registers_has_no_pictures() -> None:
    assert render(family(model("A", ()))) == {}


def test_ten_thousand_registers_give_a_small_picture_in_which_each_has_a_cell() -> None:
    many = [register(f"r{n}", n * 6, access=list(Access)[n % 3], group=f"g{n % 30}") for n in range(10_000)]
    register_map = family(model("A", many, (f"g{n}" for n in range(30))))
    drawing = address_map(register_map)
    spans = [re.match(r"(\d+)(?: to (\d+))?: (?!no register)", cell.tip) for cell in cells(drawing)]
    covered = {n for span in spans if span for n in range(int(span[1]), int(span[2] or span[1]) + 1)}
    assert {n * 6 for n in range(10_000)} <= covered
    assert drawing.height < 5000
    assert len(render(register_map)["docs/acme/oven/addresses.svg"]) < LONG
    assert "a cell stands for 100 addresses" in words(drawing)


def test_read_only_write_only_and_alias_are_told_apart_without_colour() -> None:
    kinds = [register("a", 0), register("b", 1, access=Access.READ), register("c", 2, access=Access.WRITE)]
    drawing = address_map(family(model("A", [*kinds, register("d", 3, aliases=(9,))])))
    styles = {cell.tip.partition(":")[0]: cell.style for cell in cells(drawing)}
    assert (styles["0"], styles["1"], styles["9"]) == ("f0", "o0", "f0 alias")
    for words_ in ("filled: read and write", "outline: read only", "with a bar: write only", "dashed, round: alias"):
        assert words_ in words(drawing)
    assert "paper" in style.css(["paper"])


def test_unused_and_reserved_addresses_are_hatched_in_two_ways() -> None:
    unused = model("A", [register("a", 0), register("b", 19)], unused=((Space.HOLDING, 3, 5),))
    drawing = address_map(family(unused, reserved=((Space.HOLDING, 8, 9),)))
    assert [(box.tip, box.style) for box in cells(drawing) if box.style in {"unused", "reserved"}] == [
        ("3 to 5: unused", "unused"),
        ("8 to 9: reserved", "reserved"),
    ]
    assert "url(#unused)" in render(family(unused))["docs/acme/oven/addresses.svg"]


def test_what_only_some_models_have_is_marked_with_a_number_from_the_legend() -> None:
    both = [register("a", 0), register("b", 1)]
    drawing = address_map(family(model("A", both), model("B", [*both, register("c", 2)]), model("C", both)))
    assert [item.text for item in texts(drawing)].count("1") == 2
    assert "only B" in words(drawing)
    assert next(cell.tip for cell in cells(drawing) if cell.tip.startswith("2:")).endswith("only B")


def test_an_address_that_is_something_else_on_another_model_is_marked() -> None:
    drawing = address_map(family(model("A", [register("a", 0)]), model("B", [register("b", 0)])))
    assert "another register on other models" in words(drawing)


def test_long_holes_are_folded_and_named() -> None:
    drawing = address_map(
        family(model("A", [register("a", 0), register("b", 5000)], unused=((Space.HOLDING, 100, 199),)))
    )
    assert "20 to 99: no register; 100 to 199: unused; 200 to 4999: no register" in words(drawing)
    assert drawing.height < 400


def test_the_region_of_each_view_is_a_strip_of_its_own(oven: RegisterMap) -> None:
    shown = words(address_map(oven))
    assert "Holding registers 0 to 999, view base, int16" in shown
    assert "view ieee, float32, at 8000 + 2*n" in shown


def test_a_hole_is_cut_at_the_regions_of_views() -> None:
    view = View("x10", WireType.UINT16, offset=1000, region=(1000, 1999))
    place = replace(register("a", 5), views=(register("a", 5).base, view))
    register_map = family(model("A", [place], unused=((Space.HOLDING, 900, 1100),)))
    found = sections(register_map, address_uses(register_map))
    assert [(section.region, section.holes) for section in found] == [
        (None, (("unused", 900, 999),)),
        ((1000, 1999), (("unused", 1000, 1100),)),
    ]


def test_each_bit_is_drawn_with_its_meaning_and_the_rest_is_hatched() -> None:
    parts = (BitField("a", "alarm", 0, 0), BitField("m", "mode", 4, 6, Enum("e", (Member(1, "idle", "IDLE"),))))
    drawing = drawings(family(model("A", [register("status", 3, fields=parts)])))["bits-status.svg"]
    for expected in ("Holding register 3", "0 alarm", "4..6 mode", "1 = idle", "13 14 15"):
        assert expected in words(drawing)
    assert [box.width for box in boxes(drawing) if box.style in {"f0", "f1"}] == [30, 94]
    assert [box.width for box in boxes(drawing) if box.style == "unused"] == [94, 286]


def test_models_that_cut_a_word_differently_have_a_strip_each() -> None:
    one = register("status", 3, fields=(BitField("a", "alarm", 0, 0),))
    two = register("status", 3, fields=(BitField("m", "mode", 0, 3),))
    drawing = drawings(family(model("A", [one]), model("B", [two])))["bits-status.svg"]
    assert [item.text for item in texts(drawing) if item.text.startswith("On ")] == ["On A", "On B"]


def test_a_bit_that_only_some_models_have_names_them() -> None:
    one = register("status", 3, fields=(BitField("a", "alarm", 0, 0), BitField("b", "door", 1, 1)))
    two = register("status", 3, fields=(BitField("a", "alarm", 0, 0),))
    drawing = drawings(family(model("A", [one]), model("B", [two])))["bits-status.svg"]
    assert "1 door all but B" in words(drawing) or "1 door only A" in words(drawing)


def test_an_array_shows_offsets_step_addresses_and_formulas_of_nested_elements() -> None:
    level = replace(register("level", 101), path="programs[1].segments[1].level")
    time = replace(register("time", 102), path="programs[1].segments[1].time")
    start = replace(register("start", 100), path="programs[1].start")
    inner = Array(id="segments", name="Segment", first=1, count=15, stride=4, members=(level, time))
    outer = Array(id="programs", name="Program", first=1, count=4, stride=70, members=(start, inner))
    drawing = drawings(family(model("A", [register("a", 0), outer])))["array-programs.svg"]
    for expected in (
        "programs[i], i = 1 to 4", "+70", "100 170 240 310", "101..158 171..228", "100 + 70*(i - 1)",
        "programs[1].segments[j], j = 1 to 15", "+4", "101 105 109 157", "offset", "102 + 70*(i - 1) + 4*(j - 1)",
    ):  # fmt: skip
        assert expected in words(drawing)


def test_members_apart_from_each_other_have_no_offsets(oven: RegisterMap) -> None:
    drawing = drawings(oven)["array-segments.svg"]
    assert "offset" not in words(drawing)
    assert "base: 50 + 3*(i - 1)" in words(drawing)
    assert "ieee: 8100 + 6*(i - 1)" in words(drawing)


def test_file_names_differ_whenever_paths_do() -> None:
    paths = ["a.b", "a_b", "a[].b", "A.b", "a.B", "a-b", "a" * 300, "a" * 299 + "b", "../x", "ä", ""]
    names = [picture_paths.bits(path) for path in paths]
    assert len({name.lower() for name in names}) == len(paths)
    assert all(re.fullmatch(r"bits-[a-z0-9_-]{1,100}\.svg", name) for name in names)


def luminance(colour: str) -> float:
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(share * part for share, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, two: str) -> float:
    low, high = sorted((luminance(one), luminance(two)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("side", ["light", "dark"])
def test_ink_on_every_tint_and_every_edge_on_paper_are_readable(side: str) -> None:
    ink, dim, paper = (getattr(paint, side) for paint in (style.INK, style.DIM, style.PAPER))
    assert min(contrast(ink, getattr(paint, side)) for paint in (*style.TINTS, style.PAPER)) >= 7
    assert min(contrast(paper, getattr(paint, side)) for paint in (*style.EDGES, style.DIM)) >= 4.5
    assert contrast(dim, paper) >= 4.5


def test_both_colour_schemes_are_in_the_file(oven: RegisterMap) -> None:
    for text in render(oven).values():
        light, dark = text.split("@media(prefers-color-scheme:dark)")
        assert style.PAPER.light in light
        assert style.PAPER.dark in dark


def test_hatching_that_is_used_is_defined(any_map: RegisterMap) -> None:
    for text in render(any_map).values():
        assert set(re.findall(r"url\(#(\w+)\)", text)) <= set(re.findall(r'<pattern id="(\w+)"', text))


@pytest.mark.parametrize("text", ["", "x", "W" * 50, HOSTILE, "a b " * 40, "中" * 30])
def test_shortened_and_wrapped_text_fits_its_room(text: str) -> None:
    plain = clean(text)
    for room in (0, 5, 40, 300):
        assert width(shorten(plain, room, 12), 12) <= room
        lines = wrap(plain, room, 12, lines=3, bold=True)
        assert len(lines) <= 3
        assert all(width(line, 12, bold=True) <= room for line in lines)


def test_rows_of_a_section_follow_each_other_without_a_gap(any_map: RegisterMap) -> None:
    for section in sections(any_map, address_uses(any_map)):
        rows = layout(section, GRIDS[0])
        spans = [
            (row.cells[0].first, row.cells[-1].last) if isinstance(row, AddressRow) else (row[0][1], row[-1][2])
            for row in rows
        ]
        assert spans[0][0] == section.first
        assert spans[-1][1] == section.last
        assert all(one[1] + 1 == two[0] for one, two in pairwise(spans))


def test_no_two_paints_of_neighbouring_groups_are_alike() -> None:
    assert all(one != two for one, two in combinations(style.TINTS, 2))


def test_groups_of_the_largest_map_that_comes_along_have_colours_of_their_own() -> None:
    maps = list(map(find_map, MAPS))
    largest = max(len(looks(one, address_uses(one)).groups) for one in maps)
    assert len({style.tint(number) for number in range(largest)}) == largest > 12
    assert len({style.outline(number) for number in range(largest)}) == largest
