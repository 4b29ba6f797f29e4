"""Hypothesis strategies over the language: whole maps of registers that decide, and registers that depend on them."""

import os
from typing import Any, NamedTuple

from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st

from .suite import Json

Draw = st.DrawFn
INTEGERS = ("uint16", "int16", "uint32", "int32", "uint64", "int64")
FLOATS = ("float32", "float64", "float16")
WIDTHS = {"uint8": 8, "int8": 8, "uint24": 24, "int24": 24, "uint48": 48, "int48": 48, "uint128": 128, "int128": 128}
WIDTHS |= {f"{sign}int{bits}": bits for bits in (16, 32, 64) for sign in ("u", "")}
"""Types whose bits can have meanings of their own."""
WORDS_OF_BITS = ("uint32", "uint48", "uint64", "uint128")
"""Those that flags and fields may say by their length."""
FIXED = ("q15", "q8.8", "uq8.8", "q16.16")
LIMITS = {name: (0, 2**bits - 1) for name, bits in WIDTHS.items() if name.startswith("u")}
LIMITS |= {name: (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for name, bits in WIDTHS.items() if name.startswith("i")}
LIMITS |= {"bcd16": (0, 9999), "bcd32": (0, 99999999), "bcd64": (0, 10**16 - 1)}
LIMITS |= {"mod10k_2": (0, 99999999), "mod10k_3": (0, 10**12 - 1)}
LIMITS |= {"signmag16": (-32767, 32767), "signmag32": (1 - 2**31, 2**31 - 1)}
LIMITS |= {"q15": (-1, 0.5), "q8.8": (-128, 127.5), "uq8.8": (0, 255), "q16.16": (-32768, 0.25)}
ONE_WORD = ("t16", "d16", "g16", "t8", "q15", "q8.8", "string")
STEP, ELEMENT, OUTER, VIEW, ALIAS, MOST = 8, 80, 200, 1000, 5000, 3
"""Addresses from one register, element, outer element, view and place to the next; the most that depend."""

FUZZ = int(os.environ.get("FUZZ_MAPS", "10000"))
"""How many maps `make fuzz` draws; about three of four are sound."""
STEADY = settings(
    deadline=None,
    database=None,
    print_blob=True,
    phases=[Phase.generate],  # to shrink a map takes longer than to read it
    suppress_health_check=list(HealthCheck),
)


class Decider(NamedTuple):
    """A register that others ask: its keys, what a condition calls it, and what conditions may hold it against."""

    keys: Json
    subject: str
    matchers: tuple[Any, ...]


SELECTORS = (
    Decider({}, "sel", (0, 1, "2..9", [1, 3])),
    Decider({"type": "int16", "decimals": 1}, "sel", (0.1, 1, "-5..99.9", [0.5, 1.2])),
    Decider({"type": "float32"}, "sel", (0.1, -9999.9, "0..99.9")),
    Decider({"type": "float64", "word_order": "little"}, "sel", (0.3, "-1.5..0.1")),
    Decider({"type": "uint32", "byte_order": "little"}, "sel", (1, 65536, "2..70000")),
    Decider({"enum": {0: "off", 1: "on", 5: "auto"}}, "sel", ("on", 5, ["off", "auto"])),
    Decider({"fields": {"mode": {"bits": "1..2"}, "go": {"bit": 4}}}, "sel.mode", (1, 2, "1..3")),
    Decider({"fields": {"mode": {"bits": "1..2"}, "go": {"bit": 15}}}, "sel.go", (1, 0)),
    Decider({"flags": {3: "warm", 4: "hot"}}, "sel.hot", (1, 0)),
    Decider({"space": "coil"}, "sel", (1, 0)),
    Decider({"kind": "boolean"}, "sel", (1, 0)),
    Decider({"space": "input", "access": "r", "sentinels": {9: "broken"}}, "sel", (1, "2..7")),
    Decider({"type": "int16", "multiply": 0.5, "add": -3}, "sel", (-2.5, "0..4", -3)),
    Decider({"special": {2: "two", 7: {"label": "seven", "means": 70}}}, "sel", (2, 70, "3..80")),
)
DIGITS: tuple[Json, ...] = (
    {"range": "0..3"},
    {"type": "int16"},
    {"enum": {0: "none", 1: "tenths", 2: "hundredths"}},
    {"range": "0..3", "sentinels": {15: "none"}},
    {"type": "uint32", "word_order": "little", "range": "0..2"},
    {"space": "input", "access": "r"},
    {"multiply": 2},
)
ORDERS: tuple[Json, ...] = ({"range": "0..1"}, {"enum": {0: "big", 1: "little"}}, {"space": "coil"}, {"add": -7})
COUNTS: tuple[Json, ...] = (
    {"access": "r"},
    {"access": "r"},
    {"range": "0..2"},
    {"type": "uint8"},
    {"type": "int16"},
    {"sentinels": {65535: "none"}},
)
BOUNDS: tuple[Json, ...] = ({}, {"type": "int16", "decimals": 1}, {"type": "float32"}, {"decimals": "digits"})


def _of(draw: Draw, *choices: Any) -> Any:
    return draw(st.sampled_from(choices))


def _maybe(draw: Draw, share: int = 3) -> bool:
    """Yes once in so many times."""
    return draw(st.integers(1, share)) == share


def _number(draw: Draw, low: int = -50, high: int = 250) -> float:
    """A number of up to two decimals; YAML has no `1.0` for a whole one here."""
    number = draw(st.integers(low, high)) / _of(draw, 1, 1, 1, 10, 100)
    return int(number) if number.is_integer() else number


def _interval(draw: Draw) -> str:
    low, high = sorted((_number(draw), _number(draw)))
    return f"{low}..{high}"


def _condition(draw: Draw, sel: Decider) -> Any:
    matcher = _of(draw, *sel.matchers)
    matcher = {"not": matcher} if _maybe(draw, 4) else matcher
    return _of(draw, {sel.subject: matcher}, {sel.subject: matcher}, "named", [{sel.subject: matcher}, "named"])


def _term(draw: Draw) -> Any:
    """A number of the map, or one that registers make."""
    number = _of(draw, 2, 0.1, -3, "1/3", "-5/9")
    return _of(
        draw,
        number,
        "low",
        "dig",
        {"power": "dig"},
        {"product": [number, "low"]},
        {"sum": ["high", number]},
        {"max": ["low", number]},
        {"min": ["high", "low"]},
    )


def _conversion(draw: Draw, kind: str) -> Json:
    """How a stored number becomes a value: decimals, a factor and a distance, or the values at the ends of the type."""
    form = _of(draw, "decimals", "decimals", "line", "terms", "raw", *["ends"] * (kind in INTEGERS))
    if form == "decimals":
        return {"decimals": draw(st.integers(0, 3))}
    if form == "ends":
        return {"from": _of(draw, 0, -100, -199.9), "to": _of(draw, 100, 455.36)}
    if form == "terms":
        keys = draw(st.sets(st.sampled_from(("multiply", "divide", "exponent", "add")), min_size=1))
        return {key: _of(draw, "dig", 1) if key == "exponent" else _term(draw) for key in sorted(keys)}
    if form == "raw":
        return {"from": _term(draw), "to": _term(draw), "raw": _of(draw, "0..4095", "-100..100")}
    line = {"multiply": _of(draw, 2, 10, 0.5, -1, 0.1, 0.25, 1000), "add": _of(draw, 3, -40, 0.5, -273.1)}
    return {key: line[key] for key in _of(draw, ("multiply",), ("add",), ("multiply", "add"))}


def _scale(draw: Draw, sel: Decider, name: str, kind: str) -> tuple[Json, Json]:
    """Keys of a register that scale it, and the table that they need."""
    form = _of(draw, "none", "none", "own", "own", "digits", "cases", "not_stated")
    if form == "cases":
        cases = [{"when": _condition(draw, sel)} | _conversion(draw, kind) for _ in range(_of(draw, 1, 2))]
        cases += [_conversion(draw, kind)] if _maybe(draw, 2) else []
        return {"scale": name}, {"scales": {name: cases}}
    if form == "digits":
        return {"decimals": "digits"}, {}
    if form == "not_stated":
        return {"decimals": "not_stated"}, {}
    own = _conversion(draw, kind) if form == "own" else {}
    if "raw" in own:
        return {"scale": own}, {}
    return ({"scale": f"{own['from']}..{own['to']}"} if "from" in own else own), {}


def _range(draw: Draw, sel: Decider) -> Any:
    part = st.one_of(
        st.builds(lambda: _interval(draw)),
        st.just({"from": "low", "to": "high"}),
        st.just({"from": {"open": "the least"}, "to": "high"}),
        st.builds(lambda: {"from": _number(draw, -90, -1), "to": {"open": "the most"}}),
        st.builds(lambda: {"from": _term(draw), "to": {"sum": ["high", 100]}}),
    )
    form = _of(draw, "part", "part", "union", "cases")
    if form == "part":
        return draw(part)
    if form == "union":
        return [draw(part), draw(part)]
    cases = [{"when": _condition(draw, sel), "is": draw(part)}]
    return cases + ([{"is": draw(part)}] if _maybe(draw, 2) else [])


def _specials(draw: Draw) -> Json:
    plain = {_number(draw): "follow", _number(draw): "disabled"}
    meant = {_number(draw): {"label": "fast", "means": _number(draw)}}
    return {key: label for part in _of(draw, (plain,), (meant,), (plain, meant)) for key, label in part.items()}


def _sentinels(draw: Draw, kind: str) -> Json:
    if kind in FLOATS:
        return _of(draw, {"nan": "none"}, {-9999.9: "broken"}, {"nan": "none", -32768: "broken"})
    low, high = LIMITS[kind]
    if kind == "q15":
        return {low: "low"}
    interval = {f"{high - 5}..{high}": "none", low: "low"}
    return _of(
        draw, {high: "none"}, {low: "none"}, {low: "low", high: "high"}, {draw(st.integers(0, 30)): "broken"}, interval
    )


def _of_number(draw: Draw, sel: Decider, name: str, kind: str) -> tuple[Json, Json]:
    keys, tables = _scale(draw, sel, name, kind)
    if _maybe(draw):
        keys["range"] = _range(draw, sel)
        if _maybe(draw, 4):
            keys["range_decimals"] = "digits"
    if _maybe(draw, 5):
        keys["valid"] = _range(draw, sel)
    if _maybe(draw):
        keys["special"] = _specials(draw)
    if _maybe(draw, 5):
        keys["kind"] = _of(draw, "number", "integer", "raw")
    return keys, tables


def _meaning(draw: Draw, sel: Decider, name: str, kind: str) -> tuple[Json, Json]:
    """Keys that say what a word, or several, mean, and the tables that they need."""
    form = _of(draw, "number", "number", "number", "number", "enum", "flags", "fields", "version", "boolean")
    most = WIDTHS.get(kind, 0)
    tables: Json = {}
    if form == "number" or (kind in (*FLOATS, *FIXED) and form != "enum") or (form in {"flags", "fields"} and not most):
        keys, tables = _of_number(draw, sel, name, kind)
    elif form == "enum":
        off = _of(draw, "off", {"label": "off", "invalid": "not here"}, {"label": "off", "id": "fl14"})
        ends = (5,) if kind in (*FLOATS, *FIXED) else (5, *LIMITS[kind])
        keys = {"enum": {draw(st.integers(0, 3)): off, 4: _named(draw, sel, "on"), _of(draw, *ends): "last"}}
        keys = {"enum": _by_case(draw, sel, keys["enum"])} if _maybe(draw) else keys
    elif form == "flags":
        bits = draw(st.sets(st.integers(0, most - 1), min_size=1, max_size=4))
        keys = {"flags": {bit: _named(draw, sel, f"bit {bit}") for bit in bits}}
    elif form == "fields":
        first = draw(st.integers(0, most - 2))
        keys = {"fields": {"part": {"bits": f"{first}..{draw(st.integers(first + 1, most - 1))}"}}}
        keys["fields"] |= {"one": {"bit": first - 1}} if first else {}
        keys["fields"]["part"] |= {"when": _condition(draw, sel)} if _maybe(draw) else {}
    else:
        keys = {"version": _of(draw, "n.n", "nn.nn", "nnn")} if form == "version" else {"kind": "boolean"}
    if _maybe(draw):
        table = _sentinels(draw, kind)
        keys["sentinels"] = [{"when": _condition(draw, sel), "is": table}] if _maybe(draw) else table
    return keys, tables


def _named(draw: Draw, sel: Decider, label: str) -> Any:
    """A member or a flag, which may exist in a case only."""
    return {"label": label, "when": _condition(draw, sel)} if _maybe(draw, 4) else label


def _by_case(draw: Draw, sel: Decider, codes: Json) -> list[Json]:
    """An enum by case: the same codes in one, others in another."""
    cases: list[Json] = [{"when": _condition(draw, sel), "is": codes}]
    others = {0: "stop", 4: "off", draw(st.integers(5, 9)): _named(draw, sel, "on")}
    return [*cases, {"is": others} if _maybe(draw, 2) else {"when": _condition(draw, sel), "is": others}]


def _orders(draw: Draw, keys: Json) -> Json:
    """The keys with an order of words, where there are several, and of bytes; of a byte which one it is."""
    if keys["type"] in {"uint8", "int8"}:
        return keys | ({"byte": "high"} if _maybe(draw, 2) else {})
    if keys.get("length", 1) > 1 or "layout" in keys or (not keys["type"].endswith(ONE_WORD) and _maybe(draw, 2)):
        by_register = {"register": "order", "codes": {0: "big", 1: "little"}}
        by_case = [{"when": {"order": 1}, "is": "little"}, {"is": "big"}]
        keys["word_order"] = _of(draw, "little", by_register, by_register, by_case)
        if keys["type"].endswith("64"):
            keys["word_order"] = _of(draw, keys["word_order"], list(draw(st.permutations(range(1, 5)))))
    if _maybe(draw, 4):
        keys["byte_order"] = _of(draw, "little", "little", [{"when": {"order": 1}, "is": "little"}, {"is": "big"}])
    return keys


def _views(draw: Draw, kind: str, access: str, *, scaled: bool) -> Json:
    """A view set: the type of the register first, others beside it with a factor of their own."""
    views: Json = {}
    for number in range(draw(st.integers(2, MOST))):
        view = {"type": kind if not number or not scaled or _maybe(draw) else _of(draw, *INTEGERS[:4], *FLOATS)}
        view |= {"offset": VIEW * number} if number else {}
        if number:
            factor = _of(draw, 10, 100, 0.5, 0.1, {"power": "dig"}, {"product": [2, "dig"]})
            view |= {"factor": factor} if scaled and _maybe(draw, 2) else {}
            if view["type"] in INTEGERS and _maybe(draw, 2):
                view["rounding"] = _of(draw, "half_up", "half_away", "half_even", "down")
            view |= {"saturates": True} if view["type"] in INTEGERS and _maybe(draw) else {}
            view |= (
                {"preferred": True} if _maybe(draw) and not any("preferred" in one for one in views.values()) else {}
            )
        if access == "rw" and _maybe(draw, 5):
            view["functions"] = _of(draw, [3], [3, 16], [3, 6, 16], [16])
        views[f"view{number}"] = _orders(draw, view)
    return views


def _octets(draw: Draw) -> Json:
    """A type of bytes, of at most as many words as there is room for."""
    length = {"length": draw(st.integers(1, STEP))}
    texts = _of(draw, {}, {}, {"text": "latin-1"}, {"text": {"one_per_register": "low", "ends": ["nul", "ff"]}})
    layouts = _of(draw, "yM Dh ms", "Y M D h", "unix", "bcd yM Dh", "unix64 2000-01-01", "iec870", "YYYYMMDD hhmm")
    return _of(
        draw,
        {"type": "string"} | length | texts,
        {"type": "string"} | length | texts,
        {"type": "bytes"} | length,
        {"type": _of(draw, "ipv4", "eui48", "eui64")},
        {"type": "datetime", "layout": layouts},
        {"type": "time", "layout": _of(draw, "hhmm", "hm", "bcd hm s", "minutes", "seconds")},
    )


def _words(draw: Draw, sel: Decider, name: str) -> tuple[Json, Json]:
    """A register of one word or several, or a text."""
    space = _of(draw, "holding", "holding", "holding", "input")
    access = "r" if space == "input" else _of(draw, "rw", "rw", "rw", "r", "w")
    keys: Json = {"access": access} | ({"space": space} if space == "input" else {})
    if _maybe(draw, 10):
        return _orders(draw, keys | _octets(draw)), {}
    kind = _of(draw, "int16", "uint16", *INTEGERS, *FLOATS, draw(st.sampled_from(sorted(LIMITS))))
    meaning, tables = _meaning(draw, sel, name, kind)
    keys |= meaning
    if _maybe(draw):
        scaled = not {"enum", "flags", "fields", "version", "kind"} & keys.keys()
        return keys | {"views": name}, tables | {"views": {name: _views(draw, kind, access, scaled=scaled)}}
    keys = _orders(draw, keys | {"type": kind})
    if kind in WORDS_OF_BITS and {"flags", "fields"} & keys.keys() and _maybe(draw, 2):
        keys["length"] = WIDTHS[keys.pop("type")] // 16
    if access == "rw" and _maybe(draw, 6):
        keys["functions"] = _of(draw, [3, 6, 16], [3, 16], [3])
    if (access == "rw" or space == "input") and _maybe(draw, 4):
        keys |= {"access": "rw", "write": _of(draw, {}, {"functions": [16]}) | {"space": "holding"}}
    return keys, tables


def _default(draw: Draw, keys: Json) -> Any:
    """What a new device may hold: of a special value or a member its code, its id or its number."""
    if keys.get("type") == "string":
        return _of(draw, "", "a", "ab c")
    if "version" in keys:
        return _of(draw, "1.2", "01.20", "120")
    ids = {"special": ("follow", "fast"), "enum": ("on", "off", "open")}
    named = [name for key in ids.keys() & keys.keys() for name in (*ids[key], *keys[key])]
    of_bits = (*range(4), 2 ** draw(st.integers(0, 15))) if {"flags", "fields"} & keys.keys() else ()
    return _of(draw, 0, 1, 7, 12.5, *named, *of_bits, _number(draw))


def _register(draw: Draw, sel: Decider, number: int) -> tuple[Json, Json]:
    name = f"x{number}"
    form = _of(draw, *["words"] * 8, "coil", "discrete")
    if form == "words":
        keys, tables = _words(draw, sel, name)
    else:
        keys, tables = {"space": form, "access": "r" if form == "discrete" else "rw"}, {}
        keys |= {"enum": {0: "open", 1: "closed"}} if _maybe(draw) else {}
    if _maybe(draw, 4):
        keys[_of(draw, "default", "default", "delivered")] = _default(draw, keys)
    if keys["access"] != "r" and _maybe(draw, 6):
        keys["writable"] = {"when": _condition(draw, sel), "reason": "only then"}
    if _maybe(draw, 6):
        keys["when"] = _condition(draw, sel)
    if _maybe(draw, 6):
        keys["twice"] = True
    return {"at": 0, "name": name.upper()} | keys, tables


def _deciders(draw: Draw, sel: Decider) -> list[Json]:
    """The registers that decide, of which each may be of many shapes."""
    shapes = {"sel": sel.keys, "dig": _of(draw, *DIGITS), "order": _of(draw, *ORDERS)}
    shapes |= {"low": _of(draw, *BOUNDS), "high": _of(draw, *BOUNDS), "count": _of(draw, *COUNTS)}
    return [{"at": 0, "name": name.title()} | keys for name, keys in shapes.items()]


def _array(name: str, stride: int, registers: list[Json], repeat: Any = "1..2") -> Json:
    return {"id": name, "name": name, "repeat": repeat, "stride": stride, "registers": registers}


def _repeat(draw: Draw) -> Any:
    """Both elements, or as many as a register says."""
    return _of(draw, "1..2", {"from": 1, "to": "count", "most": 2})


def _placed(draw: Draw, deciders: list[Json], registers: list[Json]) -> list[Json]:
    """All registers at addresses of their own: beside each other, or in an array, or in an array of arrays."""
    place, inside = _of(draw, "alone", "array", "nested"), _maybe(draw, 2)
    for number, one in enumerate([*deciders, *registers]):
        one["at"] = STEP * number
        if "write" in one:
            one["write"]["at"] = one["at"] + VIEW * MOST
        if one.pop("twice", False):
            one["aliases"] = [one["at"] + ALIAS]
    if place == "alone":
        return deciders + registers
    within = deciders + registers if inside else registers
    rows = [_array("rows", ELEMENT, within, "1..2" if inside else _repeat(draw))]
    if place == "nested":
        rows = [_array("parts", OUTER, rows)]
    return rows if inside else deciders + rows


@st.composite
def maps(draw: Draw) -> Json:
    """The parts of a map as `suite.whole_map` completes them; many are sound, the others are refused by a rule."""
    sel = _of(draw, *SELECTORS)
    digits: Json = {"register": "dig"} | ({"at_most": 2} if _maybe(draw, 4) else {})
    digits |= {"when": {sel.subject: _of(draw, *sel.matchers)}} if _maybe(draw, 4) else {}
    parts: Json = {
        "decimals": {"digits": digits},
        "conditions": {"named": {sel.subject: _of(draw, *sel.matchers)}},
        "scales": {},
        "views": {},
    }
    registers = []
    for number in range(draw(st.integers(1, MOST))):
        register, tables = _register(draw, sel, number)
        registers.append(register)
        for table, entries in tables.items():
            parts[table] |= entries
    placed = _placed(draw, _deciders(draw, sel), registers)
    return {key: value for key, value in parts.items() if value} | {"registers": placed}
