"""The tiny maps of the key matrix: one register under trial, at a place, among registers that it may speak of."""

from copy import deepcopy
from typing import Any, NamedTuple

from regscribe.files import dump

from .suite import FUNCTIONS, Json

PATHS = {"array": "rows[2].x", "nested": "rows[2].cells[2].x"}
"""Where the register stands; at all other places as `x`."""
PLACES = ("alone", "array", "nested", "views", "second", "each", "variant")
SECOND_AT = 1000

KINDS: dict[str, Json] = {
    "number": {"kind": "number"},
    "integer": {"kind": "integer"},
    "raw": {"kind": "raw", "decimals": "not_stated"},
    "enum": {"enum": {0: "none", 1: "one", 5: "five"}},
    "flags": {"flags": {0: "low", 2: "high"}},
    "fields": {"fields": {"part": {"bits": "0..1"}, "bit": {"bit": 2}}},
    "string": {"kind": "string"},
    "version": {"version": "n.n"},
    "boolean": {"kind": "boolean"},
}
"""What makes the register one of a kind."""

WORD_TYPES = ("uint16", "int16", "uint32", "int32", "uint64", "int64", "float32", "float64", "string")
WORD_TYPES += ("uint8", "int24", "float16", "bcd32", "signmag16", "q8.8")
TYPES = {
    "holding": WORD_TYPES,
    "input": WORD_TYPES,
    "coil": ("bit",),
    "discrete": ("bit",),
    "status": ("uint8",),
}
ACCESSES = {"holding": ("rw", "r", "w"), "coil": ("rw", "r")}


class Seed(NamedTuple):
    """A register without the key under trial: its kind, type, space, access and place."""

    kind: str
    type: str
    space: str
    access: str
    place: str

    @property
    def path(self) -> str:
        """The path of the register."""
        return PATHS.get(self.place, "x")


def seeds() -> list[Seed]:
    """Every kind in every type, space, access and place (many of them are refused)."""
    return [
        Seed(kind, wire, space, access, place)
        for place in PLACES
        for space, types in TYPES.items()
        for access in ACCESSES.get(space, ("r",))
        for wire in types
        for kind in KINDS
    ]


def surroundings() -> Json:
    """What the register may speak of: registers, tables and commands."""
    return {
        "format": 1,
        "map": {"id": "test/matrix", "title": "Matrix", "maker": "Test", "class_prefix": "Matrix"},
        "manual": {"title": "Manual", "number": "1"},
        "models": {"A": {}, "B": {}},
        "protocol": {
            "functions": FUNCTIONS,
            "faults": {"read_only": 4, "view_function": 5, "address": 2, "value": 3, "condition": 6},
            "serial": {"baud": [9600, 19200], "formats": ["8N1"], "default": "9600 8N1"},
        },
        "units": {"temperature": [{"when": {"deg": 1}, "symbol": "°C"}, {"symbol": "°F"}]},
        "enums": {"choice": {0: "off", 3: "on"}},
        "views": {},
        "decimals": {"digits": {"register": "dig"}},
        "scales": {"cases": [{"when": {"sel": 1}, "multiply": 2}, {"decimals": 1}]},
        "commands": {
            "unlock_it": {"name": "Unlock", "source": "1", "steps": [{"at": 700, "words": [1]}]},
            "apply_it": {"name": "Apply", "source": "1", "steps": [{"at": 701, "words": [1]}]},
        },
        "groups": [
            {
                "id": "around",
                "name": "Around",
                "source": "1",
                "each": {"access": "rw"},
                "registers": [
                    {"at": 900, "name": "Sel", "range": "0..9", "default": 0},
                    {"at": 901, "name": "Dig", "range": "0..3", "default": 0},
                    {"at": 902, "name": "Ord", "range": "0..1", "default": 0},
                    {"at": 903, "name": "Low", "default": 2},
                    {"at": 904, "name": "High", "default": 50},
                    {"at": 905, "name": "Deg", "range": "0..1", "rescales": "temperature", "default": 0},
                    {"at": 910, "name": "Words", "type": "string", "length": 2},
                    {"at": 920, "name": "Plain"},
                    {"at": 930, "name": "Heat", "unit": "temperature", "default": 20},
                ],
            }
        ],
    }


def register_of(seed: Seed, beside: Json) -> Json:
    """The register of a seed, with what stands beside the key under trial."""
    own: Json = {"at": 10, "name": "X", "access": seed.access}
    own |= {} if seed.space == "holding" else {"space": seed.space}
    own |= deepcopy(KINDS[seed.kind]) | deepcopy(beside)
    own |= {"length": 2} if seed.kind == "string" else {}
    if seed.place in {"views", "second"}:
        return own | {"views": "two"}
    return own if (seed.space, seed.type) == ("holding", "uint16") else own | {"type": seed.type}


def whole(seed: Seed, beside: Json, keys: Json) -> Json:
    """The map of a seed, with the keys that stand beside the one under trial, and that key."""
    found = surroundings()
    own = register_of(seed, beside)
    if seed.place in {"views", "second"}:
        other = {"offset": SECOND_AT, "type": seed.type, **({"preferred": True} if seed.place == "second" else {})}
        found["views"]["two"] = {"base": {"type": seed.type}, "other": other}
    group: Json = {"id": "trial", "name": "Trial", "source": "1", "registers": [own]}
    if seed.place == "each":
        group["each"] = keys
    elif seed.place == "variant":
        own["variants"] = [{"models": ["A"], **keys}]
    else:
        own |= keys
    if seed.place == "array":
        group["registers"] = [_array("rows", 20, [own])]
    if seed.place == "nested":
        group["registers"] = [_array("rows", 20, [_array("cells", 8, [own])])]
    found["groups"].append(group)
    return found


def _array(name: str, stride: int, registers: list[Json]) -> Json:
    return {"id": name, "name": name.capitalize(), "repeat": "1..2", "stride": stride, "registers": registers}


def text(document: Any) -> str:
    """A map as YAML."""
    return dump(document)
