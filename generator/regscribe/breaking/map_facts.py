"""The facts of a map that all its models share: protocol, line, answers, givens, identification, evidence."""

from collections.abc import Callable

from regscribe.breaking.change import TEXT_ONLY, Effects
from regscribe.breaking.facts import B, C, Fact, H, Judge, N, judged, text
from regscribe.breaking.rules import (
    ANSWERS,
    EVIDENCE,
    FUNCTIONS,
    GIVEN_CHANGED,
    IDENTITY,
    LIMIT_LOWERED,
    LIMIT_RAISED,
    LINE,
    MEMORY,
    PROCESS,
    TEXT,
    UNIT_IDS,
)
from regscribe.model import Given, Model, Protocol, RegisterMap, Rule, SerialDefaults, show


def _functions(old: Protocol, new: Protocol) -> tuple[Rule, Effects]:
    lost = set(old.functions) - set(new.functions)
    return FUNCTIONS, Effects(B, N) if lost else Effects(C, N)


def _unit_ids(old: Protocol, new: Protocol) -> tuple[Rule, Effects]:
    (low, high), (first, last) = old.unit_ids, new.unit_ids
    return UNIT_IDS, Effects(C, C) if first <= low and high <= last else Effects(B, B)


def _limit(name: str) -> Judge[Protocol]:
    def judge(old: Protocol, new: Protocol) -> tuple[Rule, Effects]:
        lower = getattr(new, name) < getattr(old, name)
        return (LIMIT_LOWERED, Effects(H, N)) if lower else (LIMIT_RAISED, Effects(C, N))

    return judge


def _holes(_: Protocol, new: Protocol) -> tuple[Rule, Effects]:
    return (LIMIT_RAISED, Effects(C, N)) if new.read_holes else (LIMIT_LOWERED, Effects(H, N))


def _fewer(name: str) -> Judge[SerialDefaults]:
    def judge(old: SerialDefaults, new: SerialDefaults) -> tuple[Rule, Effects]:
        lost = set(getattr(old, name)) - set(getattr(new, name))
        return LINE, Effects(B, H) if lost else Effects(C, C)

    return judge


def _choices(old: Given, new: Given) -> tuple[Rule, Effects]:
    return GIVEN_CHANGED, Effects(N, B if set(old.choices) - set(new.choices) else C)


def _ends(old: Given, new: Given) -> tuple[Rule, Effects]:
    lower = new.low is None or (old.low is not None and new.low <= old.low)
    higher = new.high is None or (old.high is not None and new.high >= old.high)
    return GIVEN_CHANGED, Effects(N, C if lower and higher else B)


def _given_default(old: Given, new: Given) -> tuple[Rule, Effects]:
    return GIVEN_CHANGED, Effects(N, B if new.default is None else C if old.default is None else H)


def _bounds(given: Given) -> str:
    return " to ".join("..." if end is None else show(end) for end in (given.low, given.high))


PROTOCOL_FACTS: tuple[Fact[Protocol], ...] = (
    Fact(("functions",), "function codes", _functions),
    Fact(("unit_ids",), "unit ids", _unit_ids),
    *(
        Fact((name,), f"limit {name}", _limit(name))
        for name in ("read_words", "write_words", "read_bits", "write_bits")
    ),
    Fact(("spaces",), "limits of spaces", judged(LIMIT_LOWERED, H, N)),
    Fact(("read_holes",), "reading over gaps", _holes),
    Fact(("broadcast",), "functions of a broadcast", judged(FUNCTIONS, H, N)),
    Fact(("exceptions",), "exception codes", judged(ANSWERS, H, H)),
    Fact(("latencies",), "latencies", judged(LINE, H, N)),
    Fact(("pause",), "pause between requests in ms", judged(LINE, H, N)),
)
"""Facts of the protocol; `serial` has its own, and `absent` is told by the faults."""

SERIAL_FACTS: tuple[Fact[SerialDefaults], ...] = (
    Fact(("modes",), "framings", _fewer("modes")),
    Fact(("bauds",), "speeds in baud", _fewer("bauds")),
    Fact(("formats",), "character formats", _fewer("formats")),
    Fact(("baud", "format"), "line as delivered", judged(LINE, B, H)),
    Fact(("gap",), "silence between frames", judged(LINE, H, N)),
)
"""Facts of the serial line."""

GIVEN_FACTS: tuple[Fact[Given], ...] = (
    Fact(("kind",), "kind of the given", judged(GIVEN_CHANGED, N, B)),
    Fact(("register",), "register of the given", judged(GIVEN_CHANGED, N, H)),
    Fact(("choices",), "choices of the given", _choices),
    Fact(("low", "high"), "limits of the given", _ends, _bounds),
    Fact(("default",), "default of the given", _given_default),
    text("description"),
    text("reason"),
)
"""Facts of a given; `id` pairs them."""

MODEL_FACTS: tuple[Fact[Model], ...] = (
    Fact(
        ("process",),
        "process",
        judged(PROCESS, N, H),
        lambda one: f"control of {one.process.value}" if one.process else "none",
    ),
    Fact(("unused",), "unused addresses", judged(ANSWERS, H, N)),
    text("description"),
)
"""Facts of a model."""

MODEL_ELSEWHERE = {
    "name": "compare",
    "class_name": "names",
    "members": "arrays",
    "registers": "register_pairs",
    "groups": "things",
    "commands": "things",
    "computed": "things",
    "programs": "things",
    "program_notes": "things",
    "pages": "places",
}
"""Fields of a model that are compared part by part, and the module that does so."""


def _entries(name: str) -> Callable[[RegisterMap], str]:
    def words(one: RegisterMap) -> str:
        value = getattr(one, name)
        return f"{len(value)} entr{'y' if len(value) == 1 else 'ies'}" if type(value) is tuple else ""

    return words


EVIDENCE_FIELDS = ("manual", "errata", "examples", "notes")

MAP_FACTS: tuple[Fact[RegisterMap], ...] = (
    Fact(("faults",), "answers to bad requests", judged(ANSWERS, H, N)),
    Fact(("default_unit",), "unit id as delivered", judged(UNIT_IDS, H, H)),
    Fact(("spares_memory",), "care of memory", judged(MEMORY, N, H)),
    Fact(("alike",), "functions that do the same", judged(FUNCTIONS, H, N)),
    Fact(("accepts",), "limits that it goes beyond", judged(ANSWERS, H, N)),
    Fact(("reserved",), "reserved addresses", judged(ANSWERS, H, N)),
    Fact(("identity",), "identification", judged(IDENTITY, N, H)),
    *(Fact((name,), name, lambda _, __: (EVIDENCE, TEXT_ONLY), _entries(name)) for name in EVIDENCE_FIELDS),
    text("title"),
    text("maker"),
    text("description"),
    Fact(("protocol_notes",), "notes on the protocol", lambda _, __: (TEXT, TEXT_ONLY)),
    Fact(("notations",), "notations of addresses", lambda _, __: (TEXT, TEXT_ONLY)),
    text("unit_notes", "notes on units"),
)
"""Facts of a map."""


MAP_ELSEWHERE = {
    "id": "compare",
    "class_prefix": "names",
    "models": "compare",
    "protocol": "compare",
    "givens": "compare",
    "blocks": "things",
}
"""Fields of a map that are compared part by part, and the module that does so."""

MAP_UNCOMPARED = {
    "waivers": "excuses for findings; they say nothing about devices",
    "source": "the name of the file",
    "content_hash": "the bytes of the file",
    "unit_symbols": "symbols count where registers use them",
    "extends": "how the map is split into files",
    "uses": "how the map is split into files",
    "overrides": "how the map is split into files; what they say counts in the registers",
    "libraries": "how the map is split into files",
    "shipped": "how the map is split into files",
    "span": "a place in a file",
}
"""Fields of a map that say nothing about devices, and why."""
