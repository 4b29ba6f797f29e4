"""The keys of one file laid over those of another: under each name there is one thing, or it is an error."""

from collections.abc import Iterable

from regscribe.compose.findings import NAME_CLASH, ComposeFindings
from regscribe.compose.tree import elements, key_place, listing, mapping, members, put, text
from regscribe.source import SourceNode

TABLES = {
    "givens": "given",
    "chains": "chain",
    "blocks": "block",
    "conditions": "condition",
    "units": "unit",
    "enums": "enum",
    "views": "view set",
    "decimals": "decimals rule",
    "scales": "scale",
    "sets": "set",
    "commands": "command",
    "computed": "computed value",
    "programs": "program",
}
"""Top-level mappings from a name to a thing, and what the thing is called."""

LISTS = ("reserved", "unused", "examples", "errata", "waivers", "notes")
"""Top-level lists to which each file adds."""

NESTED = ("limits", "accepts", "faults", "exceptions", "latency", "serial")
"""Keys of `protocol` that are merged key by key in turn."""


def laid_over(
    below: SourceNode, above: SourceNode, findings: ComposeFindings, lists: Iterable[str], *, owner: str, advice: str
) -> SourceNode:
    """`below` with the tables, notations, lists and protocol of `above`.

    A name that both have in a table, or a notation of one space, is an error at the one above: `owner` says whose the
    names below are, `advice` what to do.
    """
    below = _merge_tables(below, above, findings, owner=owner, advice=advice)
    have = {_notation(one): one for one in elements(below.child("notations"))}
    for one in elements(above.child("notations")):
        clash = have.get(_notation(one))
        if clash is not None:
            message = f"the notation `{text(one.child('name'))}` is declared here and in {owner}"
            other = (f"the notation of {owner}", clash.place)
            findings.add(NAME_CLASH, message, one.place, "remove one of the two", other)
    below = append(below, above, ("notations", *lists))
    protocol = _merge_protocol(below.child("protocol"), above.child("protocol"))
    return below if protocol is None else put(below, "protocol", protocol, above)


def _merge_protocol(below: SourceNode | None, above: SourceNode | None) -> SourceNode | None:
    """The protocol of both; what stands above wins, key by key."""
    if below is None or above is None:
        return above or below
    merged = below
    for key, value in members(above).items():
        under = below.child(key)
        new = replace(under, value, members(value)) if key in NESTED and under is not None else value
        merged = put(merged, key, new, above)
    return merged


def _merge_tables(
    below: SourceNode, above: SourceNode, findings: ComposeFindings, *, owner: str, advice: str
) -> SourceNode:
    """`below` with the entries of the tables of `above`; those of `below` stand first."""
    for table, what in TABLES.items():
        added, have = above.child(table), below.child(table)
        if added is None:
            continue
        merged = have or mapping({}, added.place)
        for name, value in members(added).items():
            if have is None or have.child(name) is None:
                merged = put(merged, name, value, added)
                continue
            message = f"the {what} `{name}` is declared here and in {owner}"
            other = (f"the {what} of {owner}", key_place(have, name))
            findings.add(NAME_CLASH, message, key_place(added, name), advice, other)
        below = put(below, table, merged, above)
    return below


def _notation(node: SourceNode) -> tuple[str, str]:
    return text(node.child("name")), text(node.child("space"))


def append(below: SourceNode, above: SourceNode, keys: Iterable[str]) -> SourceNode:
    """`below` with the elements of the lists of `above` behind its own."""
    for key in keys:
        have, added = below.child(key), above.child(key)
        if added is not None:
            both = listing([*elements(have), *elements(added)], (have or added).place)
            below = put(below, key, both, above)
    return below


def replace(below: SourceNode, above: SourceNode, keys: Iterable[str]) -> SourceNode:
    """`below` with the values that `above` has under these keys."""
    for key in keys:
        value = above.child(key)
        if value is not None:
            below = put(below, key, value, above)
    return below
