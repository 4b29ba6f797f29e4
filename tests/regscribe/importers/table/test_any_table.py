"""Tables of any dirty cells: the importer never breaks, and says of each row that is left out why."""

from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe import plugins

POOLS = {
    "Address": [
        "40001",
        "5",
        "0x1F",
        "1Fh",
        "4x0003",
        "7~14",
        "1234.5",
        "1234/5",
        "100,101",
        "HR9",
        "",
        "see note",
        "70000",
    ],
    "Name": ["Voltage", "Voltage (0.1 V)", "Power (*10)", "", "x" * 200, "Ünïcode \u202e", "State"],
    "Type": [
        "U16",
        "INT",
        "float sw",
        "U32 LE",
        "string[6]",
        "bitmap",
        "enum",
        "BCD",
        "2bit",
        "",
        "in16",
        "Mot signé",
        "BOOL",
    ],
    "Size": ["1", "2", "4 bytes", "32 bit", "", "?"],
    "Scale": ["10", "0.1", "0,1", "x10", "/10", "A_SF", "1 = 0.1 A", "(x-5)*2", "", "0", "1", "nan"],
    "Unit": ["V", "0.1V", "V*10", "°C (x0.1)", "0=Off;1=On", "", "Mw", "F"],
    "Range": ["0..100", "0..65536", "-50..150", "0,1", "0/1", "12 characters", "", "0=off 1=on", "10..0"],
    "Default": ["0", "1.5", "off", "", "0xFFFF"],
    "Access": ["R", "R/W", "RWC", "", "yes", "W"],
    "Values": ["0=off 1=on", "1=a 2=b 4=c 8=d", "bit 0: a, bits 1-3: b", "0=off", "", "0=a 0=b", "off/on"],
    "Function": ["03", "4", "3/6", "", "Coil", "Input"],
    "Remark": ["", "low word first", "signed", "scale 10", "1 = 0.1", "0 = off, 1 = on", "little endian"],
}
"""Cells by heading."""

ROWS = st.lists(st.fixed_dictionaries({head: st.sampled_from(cells) for head, cells in POOLS.items()}), max_size=6)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(ROWS, st.sets(st.sampled_from(sorted(set(POOLS) - {"Address", "Name"}))), st.booleans())
def test_a_table_of_any_cells_is_read_and_what_is_left_out_has_a_reason(
    rows: list[dict[str, str]],
    without: set[str],
    same: bool,  # noqa: FBT001 - a case
) -> None:
    heads = [head for head in POOLS if head not in without]
    if same:
        rows = [row | {"Address": str(number)} for number, row in enumerate(rows)]
    lines = [";".join(heads), *(";".join(row[head].replace(";", ",") for head in heads) for row in rows)]
    options = {one.name: one.default for one in plugins.importer("table").options}
    draft = plugins.read("table", "\n".join(lines).encode(), "list.csv", options)
    assert all(entry.remarks for entry in draft.each if entry.keys is None)
    assert draft.failed or not any(row["Address"] for row in rows) or draft.entries != ()  # a lone name is a heading
