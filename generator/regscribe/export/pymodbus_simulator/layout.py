"""The JSON of a memory: a block of cells for each space, and lists of cells by type, in ranges as long as can be."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby

from regscribe.export.pymodbus_simulator.memory import CELL_BITS, SPACES, Memory, Typed, Value
from regscribe.model import Space
from regscribe.visible import json_text

SIZES = {Space.COIL: "co size", Space.DISCRETE: "di size", Space.INPUT: "ir size", Space.HOLDING: "hr size"}
ADDRESSES = 0x10000
SECTIONS = ("bits", "uint16", "uint32", "float32", "float64", "string")
DEFAULTS: Mapping[str, Value] = {**dict.fromkeys(SECTIONS, 0), "float32": 0.0, "float64": 0.0, "string": " "}


def layout(server: Mapping[str, object], memory: Memory) -> str:
    """Return the JSON with one server and one device, by the names that the simulator takes if none is said."""
    sizes = _sizes(memory)
    begins = dict(_begins(sizes))
    setup = {
        **{SIZES[space]: sizes[space] for space in SPACES},
        "shared blocks": False,
        "type exception": False,
        "defaults": {"value": DEFAULTS, "action": dict.fromkeys(SECTIONS)},
    }
    lists: dict[str, Iterable[object]] = {
        "invalid": [],
        "write": [
            [*found] for found in _ranges(begins[space] + one for space in SPACES for one in memory.writable[space])
        ],
        **{section: list(_entries(section, memory, begins)) for section in SECTIONS},
        "repeat": [],
    }
    device = "".join(f",\n      {json_text(key)}: {_list(entries)}" for key, entries in lists.items())
    return (
        '{\n  "server_list": {\n    "server": ' + json_text(server) + '\n  },\n  "device_list": {\n    "device": {\n'
        '      "setup": ' + json_text(setup) + device + "\n    }\n  }\n}\n"
    )


def _list(entries: Iterable[object]) -> str:
    """A list with an entry on each line."""
    lines = ",\n".join(f"        {json_text(entry)}" for entry in entries)
    return f"[\n{lines}\n      ]" if lines else "[]"


def _sizes(memory: Memory) -> dict[Space, int]:
    """How many cells each space has: none unused; all before the last, so that no address leads into another space.

    Behind the last one are so many that any request ends in the block: the simulator knows no address behind its end.
    """
    used = [space for space in SPACES if memory.cells[space]]
    sizes = dict.fromkeys(SPACES, 0)
    for space in used:
        full = ADDRESSES // CELL_BITS if space.is_bits else ADDRESSES
        most = space.most // CELL_BITS if space.is_bits else space.most
        sizes[space] = min(full, max(memory.cells[space]) + 1 + most) if space is used[-1] else full
    return sizes


def _begins(sizes: Mapping[Space, int]) -> Iterator[tuple[Space, int]]:
    """Where the block of each space begins."""
    begin = 0
    for space in SPACES:
        yield space, begin
        begin += sizes[space]


def _entries(section: str, memory: Memory, begins: Mapping[Space, int]) -> Iterator[dict[str, object]]:
    """The entries of a list: values that have a type, bits of bit spaces, and else words."""
    kept = [one for one in memory.typed if _is_held(one, memory)]
    if section not in {"bits", "uint16"}:
        for one in sorted(kept, key=lambda one: begins[one.space] + one.address):
            if one.section == section:
                begin = begins[one.space] + one.address
                yield {"addr": [begin, begin + len(one.words) - 1], "value": one.value}
        return
    said = {(one.space, one.address + place) for one in kept for place in range(len(one.words))}
    cells = {
        begins[space] + address: word
        for space in SPACES
        if space.is_bits == (section == "bits")
        for address, word in memory.cells[space].items()
        if (space, address) not in said
    }
    for word, places in _alike(cells):
        yield {"addr": places, "value": word}


def _is_held(one: Typed, memory: Memory) -> bool:
    held = memory.cells[one.space]
    return all(held[one.address + place] == word for place, word in enumerate(one.words))


def _alike(cells: Mapping[int, int]) -> Iterator[tuple[int, list[int]]]:
    """Runs of cells with the same word, each with the first and the last."""
    in_order = enumerate(sorted(cells.items()))
    for (word, _), run in groupby(in_order, key=lambda item: (item[1][1], item[1][0] - item[0])):
        places = [address for _, (address, _) in run]
        yield word, [places[0], places[-1]]


def _ranges(places: Iterable[int]) -> Iterator[tuple[int, int]]:
    """Runs of places without a gap."""
    for _, run in groupby(enumerate(sorted(places)), key=lambda item: item[1] - item[0]):
        found = [place for _, place in run]
        yield found[0], found[-1]
