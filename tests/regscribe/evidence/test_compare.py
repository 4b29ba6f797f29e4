"""A map is held against tables: what is the same however it is written, and what is not."""

import csv
import io
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from regscribe.evidence.cell_compare import OBJECTS, differing
from regscribe.evidence.compare import compare_table
from regscribe.evidence.differences import Comparison
from regscribe.evidence.table import TableError, read
from regscribe.export.csv import COLUMNS
from regscribe.model import RegisterMap

Held = Callable[..., Comparison]


def cells(found: Comparison) -> list[tuple[str, str, str, str]]:
    return [(one.place.id, one.column, one.ours, one.theirs) for one in found.differences]


def test_a_map_equals_its_own_export(held: Held, exported: str) -> None:
    found = held(exported)
    assert found.equal
    assert found.matched == 19
    assert found.columns == tuple(name for name in COLUMNS if name not in {"map", "model"})


def mutants(exported: str, change: Callable[[str, str], str]) -> Iterator[tuple[str, str, str]]:
    """The export with one cell changed; which row and column."""
    head, *rows = list(csv.reader(io.StringIO(exported)))
    for row in rows:
        for index, column in enumerate(head):
            changed = [*row]
            changed[index] = change(column, row[index])
            if changed != row:
                buffer = io.StringIO()
                csv.writer(buffer).writerows([head, *(changed if one is row else one for one in rows)])
                yield f"{row[1]} {row[2]}", column, buffer.getvalue()


def unseen(kiln: RegisterMap, exported: str, change: Callable[[str, str], str]) -> Iterator[tuple[str, str]]:
    """The changes that neither differ nor are refused."""
    for row, column, text in mutants(exported, change):
        try:
            if compare_table(kiln, read(text.encode(), "mutant")).equal:
                yield row, column
        except TableError:
            assert column in {"space", "model"}  # `holding9` is no space, and a row without model is none


def test_every_changed_cell_of_an_export_is_found(kiln: RegisterMap, exported: str) -> None:
    def change(column: str, text: str) -> str:
        return '{"9": "other"}' if column in OBJECTS else "99" if column == "address" else text + "9"

    assert list(unseen(kiln, exported, change)) == []


def test_every_emptied_cell_of_an_export_is_found_but_the_space(kiln: RegisterMap, exported: str) -> None:
    found = list(unseen(kiln, exported, lambda column, text: "" if text != "{}" and column != "space" else text))
    assert found == []


def test_a_cell_that_differs_is_reported_with_register_column_both_values_and_line(held: Held) -> None:
    found = held("model,address,default,access\nK1,1,30,rw\nK1,2,1,r\n", partial=True)
    assert cells(found) == [("set_point_ram", "default", "25", "30"), ("sensor", "access", "rw", "r")]
    assert [one.place.line for one in found.differences] == [2, 3]
    assert found.counts == {"default": 1, "access": 1}
    assert (found.only_ours, found.only_theirs, found.equal) == ((), (), False)


def test_rows_of_one_side_only_are_reported(held: Held, exported: str) -> None:
    lines = exported.splitlines()
    found = held(
        "\n".join([*lines[:2], *lines[3:], lines[1].replace("process_value", "other").replace(",0,", ",70,", 1)])
    )
    assert [(one.model, one.id) for one in found.only_ours] == [("K1", "set_point_ram")]
    assert [(one.id, one.address, one.line) for one in found.only_theirs] == [("other", "70", 20)]


def test_a_wrong_address_is_a_cell_that_differs_where_the_table_has_ids(held: Held, exported: str) -> None:
    found = held(exported.replace("S.P,holding,1,1", "S.P,holding,2,1", 1))
    assert cells(found) == [("set_point_ram", "address", "1", "2")]
    assert found.only_ours == found.only_theirs == ()


def test_a_wrong_address_leaves_both_rows_alone_where_the_table_has_none(held: Held) -> None:
    found = held("address,name\n0,Process Value\n17,Sensor\n", model="K1", columns=["name"])
    assert [one.address for one in found.only_theirs] == ["17"]
    assert "sensor" in [one.id for one in found.only_ours]


@pytest.mark.parametrize(
    ("column", "ours", "theirs"),
    [
        ("default", "25", "25.0"),
        ("default", "25", " +25.00 "),
        ("minimum", "-0.5", "\N{MINUS SIGN}0.50"),
        ("maximum", "1/3", "2/6"),
        ("words", "1", "01"),
        ("aliases", "64 128", "128, 64"),
        ("access", "rw", "R/W"),
        ("access", "r", "read-only"),
        ("access", "rw", "Read and write"),
        ("values", '{"0": "off", "1": "on"}', '{"1":"on","0":"off"}'),
        ("values", '{"0": "off", "1": "on"}', "1 = on; 00 = off"),
        ("values", '{"0": "300", "1": "600"}', '{"0": 300, "1": 600}'),
        ("values", "{}", ""),
        ("bits", '{"8..11": "mode"}', "8-11: mode"),
        ("views", '{"base": {"address": 1, "words": 1, "type": "int16"}}', "base:1"),
        ("views", '{"base": {"address": 1, "words": 1, "type": "int16"}}', '{"base": {"type": "int16", "address": 1}}'),
        ("kind", "enum", "Enum"),
        ("name", "Set Point", " Set  Point "),
    ],
)
def test_two_ways_to_write_the_same_do_not_differ(column: str, ours: str, theirs: str) -> None:
    assert differing(column, ours, theirs, loose=False) is None


@pytest.mark.parametrize(
    ("column", "ours", "theirs"),
    [
        ("default", "25", "25.1"),
        ("default", "25", ""),
        ("default", "", "0"),
        ("minimum", "open (span)", "0"),
        ("aliases", "64 128", "64"),
        ("access", "rw", "r(w)"),
        ("values", '{"0": "off"}', '{"0": "off", "1": "on"}'),
        ("values", '{"0": "off", "1": "on"}', '{"0": "off"}'),
        ("values", '{"1": "on"}', '{"1": true}'),
        ("views", '{"base": {"address": 1}}', '{"base": {}}'),
        ("views", '{"base": {"address": 1}}', "x10:1"),
        ("name", "Set Point", "set-point"),
        ("section", "4.14.2", "4.14"),
        ("symbol", "1.0", "1"),
    ],
)
def test_what_says_something_else_differs(column: str, ours: str, theirs: str) -> None:
    assert differing(column, ours, theirs, loose=False) is not None


@pytest.mark.parametrize(
    ("column", "ours", "theirs", "same"),
    [
        ("name", "Set-Point (RAM)", "set point RAM", True),
        ("name", "Set Point", "Set Points", False),
        ("unit", "%", "°", False),
        ("values", '{"0": "Off."}', '{"0": "off"}', True),
        ("section", "4.14.2", "4.14", True),
        ("section", "4.14", "4.14.2", True),
        ("section", "4.14", "4.1", False),
        ("section", "4.14", "", False),
        ("default", "25", "2.5", False),
    ],
)
def test_loosely_case_punctuation_and_subsections_do_not_count(
    column: str, ours: str, theirs: str, *, same: bool
) -> None:
    assert (differing(column, ours, theirs, loose=True) is None) is same


def test_of_an_object_only_the_entries_that_differ_are_shown() -> None:
    assert differing("values", '{"0": "off", "1": "on"}', '{"0": "off", "1": "run", "2": "x"}', loose=False) == (
        '{"1": "on"}',
        '{"1": "run", "2": "x"}',
    )


def test_a_row_may_be_about_several_models(held: Held) -> None:
    found = held('models,address,default\nK1 K2,1,25\n"K1, K2",2,1\nK1,6,\n', partial=True)
    assert found.equal
    assert found.matched == 5


def test_a_model_that_the_map_lacks_is_found_and_pointed_out(held: Held) -> None:
    found = held("model,address\nK1,1\nK3,1\n", partial=True)
    assert [one.model for one in found.only_theirs] == ["K3"]
    assert found.notes == ("acme/kiln has no model `K3`; did you mean `K2`?",)


def test_only_the_model_asked_for_is_compared(held: Held, exported: str) -> None:
    found = held(exported.replace("K2,sensor,Sensor", "K2,sensor,Probe"), model="K1")
    assert found.equal
    assert {one.model for one in held("address\n1\n", model="K2").only_ours} == {"K2"}


def test_a_table_without_addresses_is_matched_by_id(held: Held) -> None:
    assert cells(held("model,id,default\nK1,sensor,1\nK1,set_point_ram,26\n", partial=True)) == [
        ("set_point_ram", "default", "25", "26")
    ]


def test_an_alias_is_its_register_without_taking_its_place(held: Held) -> None:
    table = "address,space,name\n0,holding,Process Value\n64,holding,Process Value\n128,holding,PV\n"
    found = held(table, model="K1", partial=True)
    assert cells(found) == [("process_value", "name", "Process Value", "PV")]
    missing = held("address,space\n64,holding\n", model="K1")
    assert "process_value" in [one.id for one in missing.only_ours]


def test_an_address_in_another_notation_finds_its_register(held: Held) -> None:
    table = "JBUS address,space,name\n1,coil,Heating\n1,holding,Process Value\n3,holding,Sensor\n"
    assert held(table, model="K1", partial=True).equal
    both = held("address,jbus,space,name\n1,3,holding,Set-Point (RAM)\n", model="K1", partial=True)
    assert cells(both) == [("set_point_ram", "jbus", "2", "3")]


def test_an_address_of_two_spaces_asks_for_the_space(held: Held) -> None:
    with pytest.raises(
        TableError, match=r"t.csv:2: .*holding 0 \(`process_value`\), coil 0 \(`heating`\) of K1.*`space`"
    ):
        held("address,access\n0,r\n", model="K1")
    assert held("address,name\n0,Heating\n", model="K1", partial=True).equal


def test_a_hyphen_for_a_name_agrees_where_no_register_begins(held: Held) -> None:
    table = "address,space,name\n5,holding,-\n8..9,holding,reserved\n"
    found = held(table, model="K1", partial=True)
    assert found.equal
    assert found.notes == ("3 rows name no register where the map has none (unused, reserved or a further word)",)
    assert [one.address for one in held("address,name\n7,-\n8,Heater\n", model="K1", partial=True).only_theirs] == [
        "7",
        "8",
    ]
    assert cells(held("address,name\n3,-\n", model="K1", partial=True)) == [("status", "name", "Status", "-")]


def test_a_command_is_found_by_its_id_and_never_taken_for_the_register_at_its_address(held: Held) -> None:
    assert held("address,name\n6,Gain\n30,-\n", model="K1", partial=True).matched == 1
    assert held("id,kind,address,words\nreset,command,6,2\n", model="K1", partial=True).equal
    assert cells(held("id,kind,address,words\nreset,command,7,2\n", model="K1", partial=True)) == [
        ("reset", "address", "6", "7")
    ]
    registers = "address,space\n" + "".join(f"{at},holding\n" for at in (0, 1, 2, 3, 4, 6, 20, 21)) + "0,coil\n"
    assert held(registers, model="K1").equal


def test_columns_are_chosen_by_name_or_by_what_the_table_calls_them(held: Held) -> None:
    table = "address,value,word\n1,25.0,0019\n2,1.0,0001\n"
    found = held(table, columns=["default=value"], model="K2", partial=True)
    assert (found.columns, found.matched, found.equal) == (("default",), 2, True)


def test_rows_of_another_map_are_left_out_and_told(held: Held, exported: str) -> None:
    other = exported + exported.splitlines()[1].replace("acme/kiln", "acme/oven") + "\n"
    found = held(other)
    assert found.equal
    assert found.notes == ("left out: 1 rows of other maps (acme/oven)",)
    with pytest.raises(TableError, match=r"no row of the map acme/kiln, but of acme/oven"):
        held(exported.replace("acme/kiln", "acme/oven"))


def test_a_map_may_have_two_registers_at_one_place(kiln: RegisterMap) -> None:
    model = kiln.models[0]
    twin = replace(model.registers[1], id="twin", path="twin", name="Twin")
    both = replace(kiln, models=(replace(model, registers=(*model.registers, twin)),))
    table = read(b"address,id,name\n1,twin,Twin\n1,set_point_ram,Set-Point (RAM)\n", "t")
    assert compare_table(both, table, partial=True).equal
