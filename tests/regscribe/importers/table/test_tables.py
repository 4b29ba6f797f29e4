"""Whole tables become registers: headers, columns, sections, continued rows, bits; what is unclear is told by row."""

from collections.abc import Callable
from decimal import Decimal
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.cli.shared.import_source import check
from regscribe.cli.shared.map_heads import head_of
from regscribe.draft import Draft, Outcome
from regscribe.draft.settle import settle
from regscribe.importers.table import read
from regscribe.model import Severity
from regscribe.plugins import OptionError


def draft(text: str | bytes, name: str = "list.csv", **options: str) -> Draft:
    data = text.encode() if isinstance(text, str) else text
    return read(data, name, {key.replace("_", "-"): value for key, value in options.items()})


def keys(found: Draft) -> list[dict[str, Any] | None]:
    assert not found.failed, found.findings
    return [None if entry.keys is None else dict(entry.keys) for entry in found.entries]


def only(text: str, **options: str) -> dict[str, Any]:
    """The keys of the one register of a table."""
    (found,) = keys(draft(text, **options))
    assert found is not None
    return found


def roles(found: Draft) -> dict[str, str]:
    return {column.heading: column.meaning for column in found.recognised}


def codes(found: Draft) -> list[list[str]]:
    return [[remark.code for remark in entry.remarks] for entry in found.entries]


def refusal(text: str | bytes, **options: str) -> str:
    found = draft(text, **options)
    assert (found.failed, found.entries, len(found.findings)) == (True, (), 1)
    return found.findings[0].message


PLAIN = "Address,Name,Type,Access\n"


def test_a_plain_table_becomes_registers_in_its_order() -> None:
    found = draft(PLAIN + "0,Speed,U16,R\n3,Setpoint,S16,R/W\n")
    assert keys(found) == [
        {"at": 0, "name": "Speed", "access": "r"},
        {"at": 3, "name": "Setpoint", "access": "rw", "type": "int16"},
    ]
    assert [(entry.where, entry.place.line) for entry in found.entries] == [("line 2", 2), ("line 3", 3)]
    assert found.head["manual"] == {"title": "list.csv"}


@pytest.mark.parametrize(
    "header",
    [
        "Adresse;Bezeichnung;Datentyp;Einheit;Zugriff;Faktor",
        "Adresse Modbus;Libellé;Type de données;Unité;Accès;Facteur",
        "Indirizzo;Parametro;Tipo dati;Unità di misura;Accesso;Fattore di scala",
        "Dirección;Nombre;Tipo de dato;Unidad;Acceso;Factor de escala",
        "Adres;Naam;Gegevenstype;Eenheid;Toegang;Schaalfactor",
        "Adress;Benämning;Datatyp;Enhet;Åtkomst;Skalfaktor",
        "Adres rejestru;Nazwa parametru;Typ danych;Jednostka;Dostęp;Mnożnik",
        "寄存器地址;参数名称;数据类型;单位;读写;倍率",
        "MODBUS REGISTER (DEC);Parameter name;DATA_TYPE;Unit [SI];R/W;Scaling factor",
    ],
)
def test_headings_are_known_in_several_languages(header: str) -> None:
    found = draft(f"{header}\n0;Speed;INT16;V;R;0.1\n1;Flow;INT16;V;R;0.01\n", "liste.csv")
    expected = {"name": "Speed", "access": "r", "type": "int16", "decimals": 1, "unit": "V"}
    assert keys(found)[0] == {"at": 0, **expected}


def test_what_comes_from_a_clipboard_has_no_name_to_be_cited() -> None:
    found = draft("Address\tName\tType\tAccess\n0\tSpeed\tU16\tR\n", "stdin")
    assert (found.title, dict(found.head), dict(found.groups)) == ("", {}, {})


def test_a_header_is_found_below_notes_and_its_repetitions_are_dropped() -> None:
    text = "Acme pump\n,,,\nValid for type 3,,,\n" + PLAIN + "0,Speed,U16,R\n" + PLAIN + "1,Flow,U16,R\n"
    found = draft(text)
    assert [row and row["at"] for row in keys(found)] == [0, 1]
    assert "the header is repeated in 1 row, which is passed over" in found.stated


def test_a_header_of_two_rows_is_one() -> None:
    text = "Address,,Name,Type,Access,Range,\ndec,hex,,,,min,max\n16,0x10,Level,U16,R/W,0,50\n"
    found = draft(text)
    assert roles(found) == {
        "Address dec": "at",
        "hex": "at",
        "Name": "name",
        "Type": "type",
        "Access": "access",
        "Range min": "min",
        "max": "max",
    }
    assert keys(found) == [{"at": 16, "name": "Level", "access": "rw", "range": "0..50"}]


def test_short_headings_are_divided_by_those_above_them() -> None:
    text = ",,,,Range,,Codes\nAddress,Name,Type,Access,min,max,values\n5,Level,U16,R/W,0,50,\n"
    found = draft(text)
    assert [column.heading for column in found.recognised][4:] == ["Range min", "max", "Codes values"]
    assert keys(found) == [{"at": 5, "name": "Level", "access": "rw", "range": "0..50"}]


def test_cells_beyond_the_header_are_told_as_a_column_without_a_heading() -> None:
    found = draft(PLAIN + "0,Speed,U16,R,stray\n")
    assert [one.message for one in found.findings] == [
        "line 1: column 5, without a heading, is not understood and not read"
    ]


def test_offsets_that_all_differ_are_those_of_addresses_and_are_not_added_to_values() -> None:
    rows = "".join(f"{40001 + number},{number},Value {number},U16,R\n" for number in range(8))
    found = draft(f"Register,Offset,Name,Type,Access\n{rows}")
    assert all("add" not in (entry.keys or {"add": 0}) for entry in found.entries)
    assert found.recognised[1].meaning == "not understood"
    assert "8 of 8 cells differ, as offsets of addresses do" in found.recognised[1].evidence
    said = draft(f"Register,Offset,Name,Type,Access\n{rows}", columns="offset=Offset")
    assert [(entry.keys or {}).get("add", 0) for entry in said.entries] == list(range(8))


def test_a_column_of_decimal_addresses_is_none_of_decimal_places() -> None:
    rows = "".join(f"0x{number:02X},{number},Value {number},U16,R\n" for number in range(8))
    found = draft(f"Hex,Decimal,Name,Type,Access\n{rows}")
    assert [column.meaning for column in found.recognised][:2] == ["at", "at"]
    assert [entry.keys for entry in found.entries][7] == {"at": 7, "name": "Value 7", "access": "r"}


def test_an_accuracy_is_no_scale() -> None:
    assert "multiply" not in only("Address,Name,Type,Access,Accuracy\n0,Level,U16,R,0.5\n")


def test_a_column_without_a_known_heading_is_told_by_its_cells() -> None:
    found = draft("Address,Name,Quux,Access\n0,Speed,U16,R\n1,Flow,S16,R\n2,Level,U16,R\n")
    assert found.recognised[2].meaning == "type"
    assert found.recognised[2].evidence == "3 of 3 cells are such"


def test_merged_cells_above_divide_into_headings(workbook: Callable[..., bytes]) -> None:
    rows = [["Address", "Name", "Type", "Access", "Range", None], [None, None, None, None, "Min", "Max"]]
    data = workbook(
        lambda book: book["Registers"].merge_cells("E1:F1"), Registers=[*rows, [5, "Level", "U16", "RW", 0, 50]]
    )
    found = draft(data, "list.xlsx")
    assert keys(found) == [{"at": 5, "name": "Level", "access": "rw", "range": "0..50"}]
    assert found.entries[0].where == "sheet Registers, row 3"
    assert found.groups["Registers"] == {"source": "sheet Registers"}


def test_a_column_of_types_under_another_heading_is_told_by_its_cells() -> None:
    found = draft("Register,Name,Size,Mode\n0,Speed,u16,R\n1,Flow,s16,R/W\n2,Level,u32,R\n")
    assert roles(found) == {"Register": "at", "Name": "name", "Size": "type", "Mode": "access"}
    assert "3 of 3 cells are for data type" in found.recognised[2].evidence


def test_a_column_that_names_many_rows_alike_is_a_group_and_the_description_names_them() -> None:
    rows = "".join(f"{number},service,Value {number},U16,R\n" for number in range(8))
    found = draft(f"Address,Service name,Description,Type,Access\n{rows}")
    assert {entry.group for entry in found.entries} == {"service"}
    assert found.entries[3].name == "Value 3"


def test_a_column_that_nobody_understands_is_told_and_kept_if_the_user_says_so() -> None:
    text = "Address,Name,Type,Access,Quux\n0,Speed,U16,R,seen once\n"
    found = draft(text)
    assert [one.message for one in found.findings] == ["line 1: column 5, `Quux`, is not understood and not read"]
    assert only(text, columns="description=Quux")["description"] == "seen once"
    assert "description" not in only(text.replace("Quux", "Note"), columns="description=-")


def test_columns_are_fixed_by_heading_letter_or_number_and_roles_can_be_left_to_none() -> None:
    text = "Address,Name,Type,Access,Unit,My gain\n0,Speed,U16,R,V,0.1\n"
    assert only(text, columns="scale=my GAIN,unit=-", scale="multiply") == {
        "at": 0,
        "name": "Speed",
        "access": "r",
        "decimals": 1,
    }
    assert only("0;Speed;U16;R\n", header="none", columns="at=1,name=B,type=3,access=4") == {
        "at": 0,
        "name": "Speed",
        "access": "r",
    }
    assert only(text, columns='scale="My gain"\n-=Unit', scale="divide")["multiply"] == 10


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ("scale=My gian", "--columns scale=My gian: the table has no such column; did you mean `My gain`?"),
        (
            "skale=My gain",
            "--columns skale=My gain: write what a column says and its heading, at=Register; did you mean scale?",
        ),
        ("at", "--columns at: write what a column says"),
        ("type=Name,name=Name", "--columns: `Name` cannot be both type and name"),
        ("unit=Name,unit=Type", "--columns: two columns are said to be unit: name one"),
        ("unit=Zz", "the table has no such column"),
    ],
)
def test_columns_that_are_not_there_are_refused_with_the_nearest(columns: str, said: str) -> None:
    assert said in refusal("Address,Name,Type,Access,My gain\n0,Speed,U16,R,1\n", columns=columns)


def test_a_cell_is_corrected_by_the_name_of_its_row_or_by_its_place_and_all_else_follows() -> None:
    text = "Address,Name,Type,Access,Unit\n0,Fan  speed,in16,R,rpm\n1,Flow,U16,R,l/h\n"
    found = draft(text, cell="Fan speed / type = S16\nE3=V")
    assert keys(found) == [
        {"at": 0, "name": "Fan speed", "access": "r", "type": "int16", "unit": "rpm"},
        {"at": 1, "name": "Flow", "access": "r", "unit": "V"},
    ]
    assert "cell Type of `Fan speed` is read as `S16`, as you said" in found.stated
    assert found.settings["cell"] == "Fan speed / type = S16\nE3=V"


def test_a_cell_of_one_of_several_sheets_is_corrected(workbook: Callable[..., bytes]) -> None:
    rows = [["Address", "Name", "Type", "Access"], [1, "Speed", "in16", "R"]]
    more = [["Address", "Name", "Type", "Access"], [2, "Flow", "in16", "R"]]
    found = draft(workbook(One=rows, Two=more), "list.xlsx", sheet="*", cell="Flow / Type = S16")
    assert [row and row["type"] for row in keys(found)] == [None, "int16"]


@pytest.mark.parametrize(
    ("cell", "said"),
    [
        ("Fan / Type = S16", "--cell Fan / Type = S16: no row is called `Fan`; did you mean `Fan speed`?"),
        ("Fan speed / Typ = S16", "--cell Fan speed / Typ = S16: the table has no column `Typ`; did you mean `Type`?"),
        ("Z99=1", "--cell Z99=1: the table has no such cell"),
        ("nothing", "--cell nothing: write NAME / HEADING = TEXT, or B7 = TEXT"),
    ],
)
def test_a_cell_that_is_not_there_is_refused_with_the_nearest(cell: str, said: str) -> None:
    assert said in refusal("Address,Name,Type,Access\n0,Fan speed,in16,R\n", cell=cell)


def test_a_table_without_a_header_is_refused_with_its_first_rows() -> None:
    said = refusal("0,Speed,U16\n1,Flow,U16\n")
    assert "no row looks like the header of a list of registers" in said
    assert "line 1: 0 | Speed | U16; line 2: 1 | Flow | U16" in said
    assert "no column has the addresses, of `Name`, `Type`" in refusal("Name,Type\nSpeed,U16\n", header="1")


def test_titles_of_sections_become_groups_and_footnotes_are_told() -> None:
    text = PLAIN + "Drive,,,\n0,Speed,U16,R\nInput registers,,,\n0,Alarm,U16,R\n* only type 3,,,\nSpare,,,\n"
    found = draft(text)
    assert [(entry.group, entry.keys and entry.keys.get("space")) for entry in found.entries] == [
        ("Drive", None),
        ("Input registers", "input"),
    ]
    assert [one.message.partition(":")[0] for one in found.findings] == ["line 6", "line 7"]
    assert "this row is no register and the title of none: `* only type 3`" in found.findings[0].message


def test_codes_alone_in_rows_go_on_with_the_register_above_and_pages_are_no_titles() -> None:
    text = PLAIN + "0,Baud rate,U16,R\n,,0 = 9600,\n,,1 = 19200,\nPage 12 of 40,,,\n1,Speed,U16,R\n"
    found = draft(text)
    assert [(entry.group, (entry.keys or {}).get("enum")) for entry in found.entries] == [
        ("Registers", {0: "9600", 1: "19200"}),
        ("Registers", None),
    ]
    assert "the title of none: `Page 12 of 40`" in found.findings[0].message


def test_codes_below_a_register_stay_in_their_own_column_beside_a_unit() -> None:
    found = draft("Address,Name,Type,Unit,Values\n0,Timer,U16,s,\n,,,,0 = off\n,,,,1 = on\n")
    assert dict(found.entries[0].keys or {})["special"] == {0: "off", 1: "on"}


@pytest.mark.parametrize("text", ["1 = 0.1 A", "Status 1 = on"])
def test_other_texts_with_an_equals_sign_are_no_codes_of_the_register_above(text: str) -> None:
    found = draft(PLAIN + f"0,Speed,U16,R\n{text},,,\n1,Level,U16,R\n")
    assert "description" not in (found.entries[0].keys or {})


@pytest.mark.parametrize(
    ("title", "space"),
    [
        ("Input registers", "input"),
        ("Modbus Holding Registers (FC03)", "holding"),
        ("Eingangsregister", "input"),
        ("Discrete Inputs", "discrete"),
        ("Coils:", "coil"),
        ("输入寄存器", "input"),
        ("Digital inputs", None),
        ("Eingangsleistung", None),
        ("Coil temperature", None),
        ("Do not write", None),
        ("Input and holding registers of 8 inputs", None),
    ],
)
def test_a_title_says_a_space_only_by_its_whole_name(title: str, space: str | None) -> None:
    found = draft(PLAIN + f"{title},,,\n0,Speed,,R\n", type="uint16")
    assert (found.entries[0].keys or {}).get("space", "holding") == (space or "holding")
    stated = f"the title `{title}` says that 1 rows are in the space {space}"
    assert (stated in found.stated) == (space is not None)


def test_rows_without_address_and_name_continue_the_codes_above() -> None:
    text = "Address,Name,Type,Access,Values\n0,Mode,U16,R/W,0 = off\n,,,,1 = on\n,,,,2 = auto\n1,Flow,U16,R,\n"
    found = draft(text)
    assert keys(found)[0] == {"at": 0, "name": "Mode", "access": "rw", "enum": {0: "off", 1: "on", 2: "auto"}}
    assert len(found.entries) == 2


def test_a_continued_row_that_says_something_else_is_told() -> None:
    text = "Address,Name,Type,Access,Values,Unit\n0,Mode,U16,R,0 = off,\n,,,,1 = on,V\n,,,,2 = auto,A\n"
    found = draft(text)
    assert found.entries[0].remarks[0].code == "continued"
    assert "line 4 says `A` too" in found.entries[0].remarks[0].message


def test_an_address_and_a_row_that_say_different_spaces_leave_it_out() -> None:
    found = draft("Address,Function,Name,Type,Access\n4x0001,Input,Speed,U16,R\n4x0002,Holding,Flow,U16,R\n")
    assert codes(found) == [["address-unclear"], []]
    assert "is an address of holding registers, and another column says input" in found.entries[0].remarks[0].message


def test_a_range_of_addresses_that_the_type_does_not_fill_leaves_the_row_out() -> None:
    found = draft(PLAIN + "7~14,Levels,U16,R\n20~21,Total,U32,R\n30~37,Levels,,R\n", type="uint16")
    assert codes(found) == [["type-unclear"], [], ["length-unclear"]]
    assert "its address says 8 registers and its type takes 1" in found.entries[2].remarks[0].message


def test_rows_of_bits_become_one_register_with_flags() -> None:
    text = "Address,Bit,Name,Type,Access\n9,0,Door open,U16,R\n9,3,Too hot,U16,R\n10,,Flow,U16,R\n"
    assert keys(draft(text)) == [
        {"at": 9, "name": "Bits of holding 9", "access": "r", "flags": {0: "Door open", 3: "Too hot"}},
        {"at": 10, "name": "Flow", "access": "r"},
    ]


def test_bits_go_into_the_register_of_their_word_and_a_bit_given_twice_is_told() -> None:
    text = PLAIN + "9,Status,U16,R\n9.0,Door open,,R\n9.3,Too hot,,R\n9.3,Too cold,,R\n"
    found = draft(text)
    assert keys(found) == [{"at": 9, "name": "Status", "access": "r", "flags": {0: "Door open", 3: "Too hot"}}]
    assert codes(found) == [["bit-doubled", "bits"]]


def test_labels_that_say_the_same_get_ids_that_differ() -> None:
    text = "Address,Name,Type,Access,Values\n0,Mode,U16,R,0=off;1=reserved;2=reserved\n"
    assert only(text)["enum"] == {0: "off", 1: "reserved", 2: {"label": "reserved", "id": "reserved_2"}}


def test_codes_in_the_column_of_units_are_codes_and_no_unit() -> None:
    found = draft("Address,Name,Type,Access,Unit\n0,Relay,U16,R,0=Open;1=Closed\n")
    assert keys(found) == [{"at": 0, "name": "Relay", "access": "r", "enum": {0: "Open", 1: "Closed"}}]
    assert found.entries[0].outcome is Outcome.WHOLE


SCALED = "Address,Name,Type,Access,Scale,Unit,Range,Default\n"


def test_an_unclear_scale_leaves_the_number_raw_and_takes_all_that_counts_in_its_unit_away() -> None:
    found = draft(SCALED + "0,Level,U16,R,see note,V,0..10,1\n1,Flow,U16,R,0.1,V,,\n")
    assert keys(found)[0] == {"at": 0, "name": "Level", "access": "r", "decimals": "not_stated", "unit": "V"}
    remark = found.entries[0].remarks[0]
    assert (remark.code, remark.todo, "`see note`" in remark.message) == ("scale-unclear", True, True)
    assert codes(found)[0] == ["scale-unclear", "range-unscaled", "default-unscaled"]


def test_scales_and_defaults_are_exact_to_the_last_digit() -> None:
    text = SCALED + "0,Level,U16,R/W,0.3,V,,0.9\n1,Flow,U16,R,0.000000000000000001,V,,\n"
    first, second = keys(draft(text, ranges="value"))
    assert first is not None
    assert (str(first["multiply"]), first["default"]) == ("0.3", Decimal("0.9"))
    assert second is not None
    assert second["decimals"] == 18


@pytest.mark.parametrize(("counts", "limits"), [("value", "0..10"), ("stored", "0..1")])
def test_what_a_range_counts_can_be_said(counts: str, limits: str) -> None:
    assert only(SCALED + "0,Level,U16,R,0.1,V,0..10,\n", ranges=counts)["range"] == limits


def test_ranges_that_are_printed_with_a_decimal_point_count_values_and_so_do_those_beside_them() -> None:
    found = draft(
        SCALED + "0,Level,U16,R/W,0.1,V,20.0..60.0,48\n1,Flow,U16,R/W,0.1,V,0..10,\n2,Odd,U16,R/W,1,V,0..7,7\n"
    )
    assert [row and (row["range"], row.get("default")) for row in keys(found)] == [
        ("20..60", 48),
        ("0..10", None),
        ("0..7", 7),
    ]
    assert "ranges count values, as 1 of them fits its type in no other way" in found.stated


def test_an_unclear_type_order_or_address_leaves_the_row_out_with_the_reason() -> None:
    text = "Address,Name,Type,Access,Word order\n0,A,weird,R,\nx?y,B,U16,R,\n2,C,U32,R,odd\n4,D,,R,\n"
    text += ",E,U16,R,\n6,F,U32,R,CDAB\n"
    found = draft(text)
    assert [row and row.get("word_order") for row in keys(found)] == [None, None, None, None, None, "little"]
    assert codes(found) == [
        ["type-unclear"],
        ["address-unclear"],
        ["order-unclear"],
        ["type-missing"],
        ["address-missing"],
        [],
    ]
    assert all("`" in entry.remarks[0].message for entry in found.entries[:3])


def test_an_order_that_nothing_states_is_assumed_and_the_registers_are_counted() -> None:
    text = PLAIN + "0,A,U32,R\n2,B,F32,R\n4,C,U16,R\n"
    assumed = "nothing states the order of the words of 2 registers: the highest first (ABCD) is assumed; check one, "
    assert any(text.startswith(assumed) for text in draft(text).stated)
    found = draft(text, word_order="little")
    assert [row and row.get("word_order") for row in keys(found)] == ["little", "little", None]
    assert not any("nothing states the order" in text for text in found.stated)


def test_what_no_cell_says_can_be_said_for_all() -> None:
    text = "Address,Name\n0,Speed\n1,Flow\n"
    assert codes(draft(text)) == [["type-missing"], ["type-missing"]]
    assert keys(draft(text, type="int16", access="r", space="input"))[0] == {
        "at": 0,
        "name": "Speed",
        "space": "input",
        "access": "r",
        "type": "int16",
    }


def test_an_access_that_is_missing_is_asked_for_where_others_have_one() -> None:
    found = draft(PLAIN + "0,Speed,U16,R/W\n1,Flow,U16,\n")
    assert codes(found) == [[], ["access-missing"]]
    assert keys(found)[1] == {"at": 1, "name": "Flow", "access": "r"}


def test_a_unit_that_the_language_does_not_know_is_declared() -> None:
    found = draft("Address,Name,Type,Access,Unit\n0,Heat,U16,R,DM\n")
    (unit,) = found.head["units"]
    assert keys(found)[0] == {"at": 0, "name": "Heat", "access": "r", "unit": unit}


def test_several_sheets_with_registers_must_be_chosen_from(workbook: Callable[..., bytes]) -> None:
    rows = [["Address", "Name", "Type", "Access"], [1, "Speed", "U16", "R"]]
    data = workbook(Holding=rows, Input_registers=rows, Notes=[["nothing"]])
    said = draft(data, "list.xlsx").findings[0].message
    assert "several sheets with registers, `Holding` (2 rows), `Input registers` (2 rows): choose with --sheet" in said
    both = draft(data, "list.xlsx", sheet="*")
    assert [(row["at"], row.get("space")) for row in keys(both) if row] == [(1, None), (1, "input")]
    assert "sheet Notes has no header of a list of registers and was passed over" in both.stated
    assert keys(draft(data, "list.xlsx", sheet="2")) == [{"at": 1, "name": "Speed", "space": "input", "access": "r"}]


def test_the_settings_of_an_import_read_the_next_list_alike() -> None:
    found = draft("Register,Name,Type,Access\n40001,Speed,U16,R\n40002,Flow,U16,R\n")
    assert dict(found.settings) == {"base": "modicon", "columns": "at=Register\nname=Name\ntype=Type\naccess=Access"}
    again = draft("Register,Name,Type,Access\n40007,Level,U16,R\n47,Odd,U16,R\n", **found.settings)
    assert [entry.keys and entry.keys["at"] for entry in again.entries] == [6, None]


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("base", "seven", "--base seven: write some of 0, 1, modicon, hex, decimal"),
        ("space", "attic", "--space attic: write one of holding, input"),
        ("type", "u16", "--type u16: write one of bit, uint8"),
        ("range", "H5:A1", "--range H5:A1: write the first and the last cell"),
        ("range", "5:x9y", "--range 5:x9y"),
        ("pages", "0", "--pages 0: write pages that count from 1"),
        ("pages", "3-1", "--pages 3-1"),
        ("area", "1,2,3", "--area 1,2,3: write LEFT,TOP,RIGHT,BOTTOM in points"),
        ("area", "9,9,1,1", "the right and the bottom end must be larger"),
        ("header", "first", "--header first: write the number of the row"),
        ("dialect", "int=17", "--dialect: `int=17` says nothing of a dialect"),
        ("scale", "up", "--scale up: write one of multiply, divide, decimals"),
        ("ranges", "all", "--ranges all: write one of stored, value"),
    ],
)
def test_an_option_that_says_nothing_is_refused_with_what_may_be_written(name: str, value: str, said: str) -> None:
    with pytest.raises(OptionError) as error:
        draft(PLAIN + "0,Speed,U16,R\n", **{name: value})
    assert said in str(error.value)


SEEN = (
    "|40001|0x1F|1234.5|7~14|U16|U32|string(8)|BIT|R/W|yes|x0.1|/10|0,1|0..100|-10--5|°C|0.1V|0=Off 1=On|bit 0: alarm"
    "|Speed|FC03|Holding|CDAB|=?|#REF!|\u202e"
)
CELLS = st.one_of(st.sampled_from(SEEN.split("|")), st.text(max_size=12))
HEADINGS = ["Address", "Name", "Type", "Size", "Access", "Scale", "Decimals", "Offset", "Unit", "Range", "Min", "Max"]
HEADINGS += [
    "Default",
    "Values",
    "Bits",
    "Bit",
    "Function",
    "Word order",
    "Description",
    "Group",
    "Section",
    "Code",
    "",
]


@settings(max_examples=150, deadline=None, derandomize=True)
@given(
    st.lists(st.sampled_from(HEADINGS), min_size=1, max_size=8),
    st.lists(st.lists(CELLS, max_size=9), max_size=6),
)
def test_no_table_raises_and_each_register_has_a_reason_or_keys(heads: list[str], rows: list[list[str]]) -> None:
    quoted = [['"' + cell.replace('"', '""') + '"' for cell in line] for line in [heads, *rows]]
    text = "\n".join(map(",".join, quoted))
    found = draft(text.encode(errors="replace"))
    for entry in found.entries:
        assert entry.keys is not None or entry.remarks


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    st.lists(st.sampled_from(HEADINGS), min_size=4, max_size=9, unique=True).map(
        lambda heads: ["Address", "Name", *heads]
    ),
    st.lists(st.lists(CELLS, min_size=3, max_size=9), min_size=1, max_size=6),
)
def test_what_is_made_of_any_table_passes_check(heads: list[str], rows: list[list[str]]) -> None:
    lines = [heads, *([str(at), *row] for at, row in enumerate(rows))]
    quoted = [['"' + cell.replace('"', '""') + '"' for cell in line] for line in lines]
    found = draft("\n".join(map(",".join, quoted)).encode(errors="replace"), type="uint16")
    settled, written, _ = settle(found, head_of("acme/pump"), check)
    if any(entry.keys is not None for entry in settled.entries):
        assert [one for one in check(written.text) if one.severity is Severity.ERROR] == [], written.text


def test_five_digits_that_begin_with_1_are_plain_addresses_where_types_are_of_words() -> None:
    found = draft("Register,Name,Type\n10400,Power,int32sw\n10402,State,uint16be\n")
    assert [(one["at"], one.get("space", "holding")) for one in keys(found) if one] == [
        (10400, "holding"),
        (10402, "holding"),
    ]


def test_a_row_of_a_word_with_the_address_of_a_bit_is_left_out_and_the_others_are_read() -> None:
    text = "Register,Name,Type\n40001,Flow,uint16\n40002,Speed,uint16\n10003,Odd,uint16\n10004,Door,bool\n"
    found = draft(text)
    assert [one and one["name"] for one in keys(found)] == ["Flow", "Speed", None, "Door"]
    (remark,) = found.entries[2].remarks
    assert remark.code == "address-unclear"
    assert "`10003` is an address of a discrete, which is one bit, and its type takes whole words" in remark.message


def test_a_type_of_words_at_a_bit_that_a_column_says_is_told_as_lost() -> None:
    found = draft("Register,Name,Area,Type\n1,Door,Coil,uint16\n2,Lamp,Coil,bool\n")
    door, lamp = found.entries
    assert [remark.code for remark in door.remarks] == ["type-of-bit"]
    assert (door.outcome, lamp.outcome) == (Outcome.WITH_LOSS, Outcome.WHOLE)


def test_a_list_without_headings_is_read_by_the_numbers_of_its_columns() -> None:
    found = draft("Word 11,R/W,Flow,U16\nWord 12,R,Speed,U16\n", header="none", columns="at=1,access=2,name=3,type=4")
    assert [(one["at"], one["access"], one["name"]) for one in keys(found) if one] == [
        (11, "rw", "Flow"),
        (12, "r", "Speed"),
    ]


def test_an_error_names_its_source_once() -> None:
    (error,) = draft("a,b\nc,d\n").findings
    assert error.span.file == "list.csv"
    assert "list.csv" not in error.message


def test_a_column_for_names_that_is_nearly_empty_leaves_the_names_to_another() -> None:
    rows = "".join(f",uint16,{at},State {at},r\n" for at in range(2, 7))
    found = draft(f"variable name,data type,register,documented name,access\nsoc,uint16,1,Charge,r\n{rows}")
    assert roles(found)["documented name"] == "name"
    assert [one and one["name"] for one in keys(found)][:2] == ["Charge", "State 2"]
    assert keys(found)[0] == {"at": 1, "name": "Charge", "access": "r", "description": "soc"}
    assert found.entries[0].outcome is Outcome.WHOLE


@pytest.mark.parametrize(
    ("description", "kind", "offset", "whole"),
    [
        ("Actual value: -20~18°C", "uint16", "", False),
        ("-20 to 60", "uint16", "", False),
        ("-20 to 60", "int16", "", True),
        ("-20 to 60", "uint16", "-40", True),
        ("steps 5-20 to 60", "uint16", "", True),
        ("20 to 60", "uint16", "", True),
    ],
)
def test_a_description_whose_range_begins_below_0_makes_a_type_without_a_sign_unclear(
    description: str, kind: str, offset: str, *, whole: bool
) -> None:
    found = draft(f"Register,Name,Type,Access,Offset,Description\n1,Outdoor,{kind},r,{offset},{description}\n")
    (entry,) = found.entries
    assert (entry.outcome is not Outcome.LEFT_OUT) is whole
    assert whole or "the range begins at -20: perhaps it has a sign" in entry.remarks[0].message


@pytest.mark.parametrize("description", ["3 phase power", "-20 to 60", "5 minutes mean of it", "100 steps in all"])
def test_a_number_with_which_a_description_begins_is_no_scale(description: str) -> None:
    found = only(f"Register,Name,Type,Access,Description\n1,Power,int16,r,{description}\n")
    assert found == {"at": 1, "name": "Power", "access": "r", "type": "int16", "description": description}


def test_a_number_below_1_before_a_word_that_is_no_unit_leaves_the_scale_open() -> None:
    found = draft("Register,Name,Type,Access,Description\n1,Power,int16,r,0.1 of the load\n")
    assert "scale-unclear" in [remark.code for remark in found.entries[0].remarks]


def test_the_registers_that_most_ranges_of_a_type_have_are_its_width_where_no_range_stands() -> None:
    rows = "10-11,A,UINT,r\n12-13,B,UINT,r\n14-15,C,UINT,r\n16-16,D,UINT,r\n17,E,UINT,r\n"
    found = draft(f"Register,Name,Type,Access\n{rows}")
    types = [one and one.get("type", "uint16") for one in keys(found)]
    assert types == ["uint32", "uint32", "uint32", "uint16", "uint32"]
    assert "UINT has 32 bits, as 3 of 4 sizes beside it say" in found.stated
