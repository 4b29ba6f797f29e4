"""A new version of a list goes into a map that a person edited: what the list changed, where nobody else did."""

import pytest

from regscribe import source
from regscribe.draft.differences import Change, Merged
from regscribe.draft.merge import merge, restored, stored
from regscribe.source import Document

HEAD = "format: 1\nmap: {id: acme/pump, title: Pump, maker: Acme, class_prefix: Acme}\nmodels: {Basic: {}}\n"
LISTED = """\
groups:
  - id: drive
    name: Drive
    registers:
      - {at: 1, name: Speed, access: rw, unit: '%'}
      - {at: 2, name: Flow, access: r, decimals: 1}
"""


def document(text: str, name: str = "list.csv") -> Document:
    found, wrong = source.parse(HEAD + text, name=name)
    assert found is not None, wrong
    return found


def merged(new: str, ours: str = LISTED, base: str = LISTED) -> Merged:
    return merge(restored(stored(document(base))), document(new), document(ours, "map.yaml"))


def told(found: Merged) -> list[tuple[Change, str, str]]:
    return [(note.change, note.name, note.message) for note in found.notes]


def test_a_list_that_says_the_same_changes_nothing() -> None:
    found = merged(LISTED)
    assert (found.text, found.notes) == (HEAD + LISTED, ())


def test_a_key_that_the_list_changed_is_changed_in_its_place_and_all_else_stays() -> None:
    ours = LISTED.replace("groups:", "# mine\ngroups:  # all of them").replace("name: Flow,", "name: Flow,  ")
    found = merged(LISTED.replace("decimals: 1", "decimals: 2"), ours)
    assert found.text == HEAD + ours.replace("decimals: 1", "decimals: 2")
    assert told(found) == [(Change.CHANGED, "Flow (holding 2)", "decimals: `1` -> `2` in the list")]
    assert (found.notes[0].place.file, found.notes[0].place.line) == ("map.yaml", 10)


def test_a_key_that_a_person_changed_stays_and_is_told_where_the_list_changed_it_too() -> None:
    ours = LISTED.replace("decimals: 1", "decimals: 3")
    found = merged(LISTED.replace("decimals: 1", "decimals: 2"), ours)
    assert found.text == HEAD + ours
    assert told(found) == [(Change.KEPT, "Flow (holding 2)", "decimals: `1` -> `2` in the list, and `3` here")]


def test_a_key_that_a_person_changed_stays_where_the_list_did_not_change_it() -> None:
    ours = LISTED.replace("decimals: 1", "multiply: 0.5, range: 0..10")
    assert merged(LISTED, ours).text == HEAD + ours
    assert merged(LISTED, ours).notes == ()


def test_keys_that_the_list_adds_and_drops_are_added_and_dropped() -> None:
    new = LISTED.replace(", unit: '%'", "").replace("decimals: 1", "decimals: 1, range: 0..9")
    found = merged(new)
    assert found.text == HEAD + new
    assert [note.message for note in found.notes] == [
        "unit: `%` -> not stated in the list",
        "range: not stated -> `0..9` in the list",
    ]


def test_a_register_that_a_person_wrote_on_several_lines_is_changed_there() -> None:
    ours = LISTED.replace(
        "- {at: 2, name: Flow, access: r, decimals: 1}",
        "- at: 2  # checked on the bench\n        name: Flow\n        access: r\n"
        "        decimals: 1  # sure\n\n        description: mine",
    )
    new = LISTED.replace("decimals: 1", "decimals: 2, unit: l/h")
    found = merged(new, ours)
    assert found.text == HEAD + ours.replace("decimals: 1", "decimals: 2").replace("mine", "mine\n        unit: l/h")
    dropped = merged(LISTED.replace(", decimals: 1", ""), ours)
    assert [note.change for note in dropped.notes] == [Change.CHANGED]
    assert "decimals" not in dropped.text
    assert "# sure" in dropped.text


def test_a_value_that_a_comment_stands_in_is_left_to_the_person() -> None:
    base = LISTED.replace("decimals: 1", "enum: {0: off, 1: on}")
    ours = base.replace("{0: off, 1: on}", "{0: off,  # measured\n          1: on}")
    found = merged(base.replace("1: on", "1: run"), ours, base)
    assert found.text == HEAD + ours
    assert "change it by hand (a comment stands in what would be replaced)" in found.notes[0].message


def test_a_default_of_the_group_counts_as_a_key_of_its_registers() -> None:
    ours = LISTED.replace("    registers:", "    each: {access: r}\n    registers:").replace(", access: r,", ",")
    assert merged(LISTED, ours).notes == ()
    found = merged(LISTED.replace("access: r,", "access: w,"), ours)
    assert "name: Flow, decimals: 1, access: w}" in found.text


def test_a_new_row_stands_behind_the_row_that_it_follows_in_the_list_with_its_comments() -> None:
    row = "      # TODO the scale is unclear\n      - {at: 9, name: Level, access: r, decimals: not_stated}\n"
    new = LISTED.replace("      - {at: 2", f"{row}      - {{at: 2")
    ours = LISTED.replace("unit: '%'}", "unit: '%'}  # tried").replace("      - {at: 2", "      # flow\n      - {at: 2")
    found = merged(new, ours)
    assert found.text == HEAD + ours.replace("# tried\n", f"# tried\n{row}")
    assert told(found) == [(Change.ADDED, "Level (holding 9)", "to the group Drive")]


def test_a_key_and_a_row_that_are_added_at_one_place_keep_their_order() -> None:
    lines = "".join(LISTED.splitlines(keepends=True)[:4])
    base = lines + "      - at: 1\n        name: Speed\n        access: r\n"
    new = lines + "      - {at: 2, name: Flow, access: r}\n      - {at: 1, name: Speed, access: r, unit: V}\n"
    found = merged(new, base, base)
    assert found.text == HEAD + base + "        unit: V\n      - {at: 2, name: Flow, access: r}\n"


def test_comments_behind_the_last_register_stay_behind_what_is_added() -> None:
    row = "      - {at: 9, name: Level, access: r}\n"
    block = LISTED.replace(
        "- {at: 2, name: Flow, access: r, decimals: 1}", "- at: 2\n        name: Flow\n        access: r"
    )
    found = merged(block + row, block + "\n  # a word at the end\n\nnotes: [mine]\n", block)
    assert found.text == HEAD + block + row + "\n  # a word at the end\n\nnotes: [mine]\n"


def test_new_rows_of_a_new_group_become_a_group_at_the_end() -> None:
    new = LISTED + (
        "  - id: alarms\n    name: Alarms\n    registers:\n"
        "      # TODO a\n      - {at: 30, name: Alarm, access: r}\n      - {at: 31, name: Fault, access: r}\n"
    )
    ours = LISTED + "notes: [mine]\n"
    found = merged(new, ours)
    assert found.text == HEAD + new + "notes: [mine]\n"
    assert [note.change for note in found.notes] == [Change.ADDED, Change.ADDED]


def test_a_new_row_that_a_person_has_already_is_not_added_twice() -> None:
    ours = LISTED + "      - {at: 9, name: My level, access: rw}\n"
    found = merged(LISTED + "      - {at: 9, name: Level, access: rw}\n", ours)
    assert found.text == HEAD + ours
    message = "new in the list, but you have it already, with another name"
    assert told(found) == [(Change.KEPT, "My level (holding 9)", message)]


def test_a_row_that_vanished_is_told_and_stays() -> None:
    lines = LISTED.splitlines(keepends=True)
    found = merged("".join(lines[:-1]))
    assert found.text == HEAD + LISTED
    assert [(note.change, note.name) for note in found.notes] == [(Change.GONE, "Flow (holding 2)")]


def test_a_row_that_a_person_took_out_stays_out_and_is_told_if_the_list_changes_it() -> None:
    ours = "".join(LISTED.splitlines(keepends=True)[:-1])
    assert merged(LISTED, ours).notes == ()
    found = merged(LISTED.replace("decimals: 1", "decimals: 2"), ours)
    assert found.text == HEAD + ours
    assert [(note.change, note.name) for note in found.notes] == [(Change.KEPT, "Flow (holding 2)")]


def test_a_register_that_moved_in_the_list_moves_in_the_map() -> None:
    found = merged(LISTED.replace("at: 2", "at: 7"))
    assert found.text == HEAD + LISTED.replace("at: 2", "at: 7")


def test_a_register_that_a_person_renamed_is_still_the_one_at_its_address() -> None:
    ours = LISTED.replace("name: Flow", "name: Volume flow")
    found = merged(LISTED.replace("decimals: 1", "decimals: 2"), ours)
    assert found.text == HEAD + ours.replace("decimals: 1", "decimals: 2")


@pytest.mark.parametrize(
    ("ours", "units"),
    [
        ("", "units: {Pfund: {description: as the list has it}}\n"),
        ("units: {Elle: {}}\n", "units: {Elle: {}, Pfund: {description: as the list has it}}\n"),
        ("units:\n  Elle: {}\n", "units:\n  Elle: {}\n  Pfund: {description: as the list has it}\n"),
    ],
)
def test_a_unit_that_a_new_row_needs_is_declared(ours: str, units: str) -> None:
    declared = "units:\n  Pfund: {description: as the list has it}\n"
    row = "      - {at: 9, name: Load, access: r, unit: Pfund}\n"
    assert merged(declared + LISTED + row, ours + LISTED).text == HEAD + units + LISTED + row


@pytest.mark.parametrize("name", ["Drive", "Fan"])
def test_registers_of_one_address_at_several_unit_ids_are_told_apart(name: str) -> None:
    both = LISTED + (
        "  - id: fan\n    name: Fan\n    unit_id: 2\n    registers:\n"
        "      - {at: 1, name: Speed, access: rw, unit: '%'}\n"
    )
    before, middle, after = both.partition(f"name: {name}")
    new = before + middle + after.replace("unit: '%'", "unit: rpm", 1)
    assert merged(new, both, both).text == HEAD + new


def test_what_a_person_changed_as_the_list_did_is_no_difference() -> None:
    new = LISTED.replace("decimals: 1", "decimals: 2")
    assert merged(new, new) == Merged(HEAD + new, ())
