"""Random lists, edited and published anew: a merge gives each key what a plain comparison of three tables gives it."""

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe import source
from regscribe.draft.merge import merge, restored, stored
from regscribe.source import Document

Keys = dict[str, Any]
Table = dict[int, Keys]
"""The keys of registers by address, but for address and name."""

HEAD = "format: 1\nmap: {id: acme/pump, title: Pump, maker: Acme, class_prefix: Acme}\nmodels: {Basic: {}}\n"
KEYS: dict[str, list[Any]] = {
    "access": ["r", "rw"],
    "unit": ["V", "'%'"],
    "decimals": [1, 2, "not_stated"],
    "enum": ["{0: 'off', 1: on}", "{0: 'off', 2: 'a, b'}"],
    "range": ["0..9", "-5..5"],
}
ROW = st.fixed_dictionaries(
    {"access": st.sampled_from(KEYS["access"])},
    optional={key: st.sampled_from(values) for key, values in KEYS.items() if key != "access"},
)
TABLE = st.dictionaries(st.integers(1, 6), ROW, min_size=1, max_size=5)


def text(table: Table, *, block: frozenset[int] = frozenset(), remarks: frozenset[int] = frozenset()) -> str:
    """A map of the table; registers of some addresses stand on lines of their own, some have a comment."""
    lines = ["groups:", "  - id: drive", "    name: Drive", "    registers:"]
    for at, keys in table.items():
        pairs = [f"at: {at}", f"name: R{at}", *(f"{key}: {value}" for key, value in keys.items())]
        remark = f"  # mine {at}" if at in remarks else ""
        if at in block:
            lines += [f"      - {pairs[0]}{remark}", *(f"        {pair}" for pair in pairs[1:])]
        else:
            lines.append(f"      - {{{', '.join(pairs)}}}{remark}")
    return HEAD + "\n".join(lines) + "\n# the end\n"


def parsed(content: str) -> Document:
    document, wrong = source.parse(content, name="map.yaml")
    assert document is not None, (wrong, content)
    return document


def table_of(document: Document) -> dict[int, Keys]:
    (group,) = document.data["groups"]
    rows = {
        row["at"]: {key: value for key, value in row.items() if key not in {"at", "name"}} for row in group["registers"]
    }
    assert len(rows) == len(group["registers"])
    return rows


def expected(base: dict[int, Keys], new: dict[int, Keys], ours: dict[int, Keys]) -> dict[int, Keys]:
    """What a merge must say: the list's word where only the list changed it, else the person's."""
    found = {at: dict(keys) for at, keys in ours.items()}
    for at, keys in new.items():
        if at not in base:
            found.setdefault(at, keys)
        elif at in found:
            for key in KEYS:
                if ours[at].get(key) == base[at].get(key):
                    found[at].pop(key, None)
                    found[at] |= {key: keys[key]} if key in keys else {}
    return found


@settings(max_examples=150, deadline=None)
@given(TABLE, TABLE, TABLE, st.frozensets(st.integers(1, 6)), st.frozensets(st.integers(1, 6)))
def test_each_key_is_the_lists_where_only_the_list_changed_it_and_else_the_persons(
    base: Table, new: Table, ours: Table, block: frozenset[int], remarks: frozenset[int]
) -> None:
    mine = text(ours, block=block, remarks=remarks)
    documents = [parsed(text(base)), parsed(text(new)), parsed(mine)]
    found = merge(restored(stored(documents[0])), documents[1], documents[2])
    tables = [table_of(document) for document in documents]
    assert table_of(parsed(found.text)) == expected(*tables), found.text
    assert all(f"# mine {at}" in found.text for at in remarks & ours.keys())
    assert found.text.endswith("\n# the end\n")
    if tables[0] == tables[1]:
        assert found.text == mine
