"""Each fact of a register, and of what all models share: what it is called, and how much a change of it matters."""

from typing import Any

import pytest

from regscribe.breaking.change import Effect
from regscribe.breaking.examples import BASE

N, C, H, B = Effect
Case = tuple[str, str, str, Effect, Effect]
SPOT = "      - {at: 22, name: Bank"
EXTRA = "at: 300, name: Extra"
UNITS = "units: {warmth: [{when: {mode: heat}, symbol: °F}, {symbol: °C}]}\n"
WARM = BASE.replace("chains:\n", f"{UNITS}chains:\n").replace(
    "enum: modes, default: 0", "enum: modes, rescales: warmth"
)

REGISTERS: list[Case] = [
    ("type: int16", "type: int16, valid: 0..100", "valid readings", N, B),
    ("access: r, valid: 0..100", "access: r, valid: 0..90", "valid readings", N, H),
    ("valid: 0..90", "valid: 0..100", "valid readings", N, H),
    ("delivered: 3", "delivered: 4", "delivered value", H, H),
    ("default: 3", "default: 4", "default", H, H),
    ("unlock: restart", "apply: restart", "command after a write", H, H),
    ("range: 0..9", "range: 0..9, unlock: restart", "command before a write", H, B),
    ("range: 0..9, unlock: restart", "range: 0..9", "command before a write", H, H),
    ("range: 0..9", "range: 0..9, settle: 100", "settling time in ms", H, H),
    ("persistence: eeprom", "persistence: eeprom, endurance: 1000", "endurance in writes", H, H),
    ("range: 1..9, stays: address", "range: 1..9, stays: address, governs: address", "line setting", H, H),
    ("persistence: ram, shadows: offset", "persistence: ram, shadows: level", "register at power-up", H, H),
    ("access: r", "access: r, follows: bank", "register followed", H, H),
    ("unit: warmth", "unit: warmth, difference: true", "a distance", H, H),
    ("step: 10", "step: 5", "scale", N, H),
    ("step: 5", "step: 10", "scale", N, B),
    ("step: 10", "step: 4", "scale", N, B),
    ("range: 0..9, step: 3", "range: 0..9", "scale", N, H),
    ("range: 0..9", "range: 0..9, step: 3", "scale", N, B),
    ("multiply: 0.5, step: 2", "multiply: 0.25, step: 1", "scale", N, B),
    ("access: r", "access: r, reading: clears", "way of reading", H, H),
    ("access: r", "access: r, poll: slow", "way of reading", N, H),
    ("access: r, mandatory: true", "access: r, mandatory: false", "on each device", N, H),
    ("access: r, mandatory: false", "access: r, mandatory: true", "on each device", N, C),
    ("type: datetime, layout: Y M D h m s", "type: datetime, layout: D M Y h m s", "layout of the date", B, B),
    ("type: uint32", "type: uint32, byte_order: little", "byte order", B, N),
    ("type: uint16, functions: [3, 6, 16]", "type: uint16, functions: [3, 16]", "functions", B, H),
    ("type: uint16, functions: [3, 16]", "type: uint16, functions: [3, 6, 16]", "functions", C, N),
    ("range: 0..9", "range: 0..9, writable: {when: {mode: stop}, reason: it moves}", "condition of writing", H, B),
    ("range: 0..9, danger: it falls", "range: 0..9", "danger", H, H),
    ("flags: {0: run}", "flags: {0: {label: run, when: {mode: heat}}}", "condition of existence of part `run`", H, H),
    ("fields: {gain: {bits: 0..3}}", "fields: {gain: {bits: 0..3, multiply: 2}}", "scale of part `gain`", N, B),
    ("fields: {gain: {bits: 0..3}}", "fields: {gain: {bits: 0..4}}", "bits of part `gain`", B, N),
    ("fields: {gain: {bits: 0..3, unit: s}}", "fields: {gain: {bits: 0..3, unit: min}}", "unit of part `gain`", N, B),
    (
        "fields: {gain: {bits: 0..3, range: 0..9}}",
        "fields: {gain: {bits: 0..3, range: 0..8}}",
        "range of part `gain`",
        N,
        B,
    ),
    (
        "access: r, enum: {0: low, 1: high}",
        "access: r, enum: {0: low, 1: {label: high, when: {bank: 1}}}",
        "condition of the code of code 1",
        N,
        H,
    ),
    ("at: 300, name: Extra, access: r", "at: 300, name: Extra, access: w", "access", B, B),
    ("access: r", "access: rw", "access", C, C),
    ("access: w", "access: rw", "access", C, C),
]


@pytest.mark.parametrize(("old", "new", "what", "wire", "api"), REGISTERS)
def test_a_fact_of_a_register(old: str, new: str, what: str, wire: Effect, api: Effect, bench: Any) -> None:
    base = WARM if "warmth" in old else BASE
    texts = [
        base.replace(SPOT, f"      - {{{line if line.startswith('at') else f'{EXTRA}, {line}'}}}\n{SPOT}")
        for line in (old, new)
    ]
    found = bench.compared(*texts).changes
    assert [tuple(one.effects) for one in found if one.what == what] == [(wire, api)], [one.what for one in found]


TOP: list[Case] = [
    ('source: "1"\n', 'source: "1"\n  default_unit: 5\n', "unit id as delivered", H, H),
    ('source: "1"\n', 'source: "1"\n  pause: 20\n', "pause between requests in ms", H, N),
    ('source: "1"\n', 'source: "1"\n  read_holes: true\n', "reading over gaps", C, N),
    ('source: "1"\n', 'source: "1"\n  broadcast: [6]\n', "functions of a broadcast", H, N),
    ('source: "1"\n', 'source: "1"\n  latency: {3: {fixed: 25..180}}\n', "latencies", H, N),
    ('source: "1"\n', 'source: "1"\n  space_limits: {holding: {read: 8}}\n', "limits of spaces", H, N),
    ("faults: {address: 2}", "faults: {address: 2, value: 4}", "answers to bad requests", H, N),
    (
        "faults: {address: 2}",
        "faults: {address: 2}\n  exceptions: {4: {name: busy, meaning: ask again}}",
        "exception codes",
        H,
        H,
    ),
    ("formats: [8N1]", "formats: [8N1, '8E1']", "character formats", C, C),
    ("formats: [8N1]", "formats: [8N1], modes: [rtu, ascii]", "framings", C, C),
    ("commands:\n", "reserved: [{at: 500..510}]\ncommands:\n", "reserved addresses", H, N),
    ("commands:\n", "unused: [{at: 500..510}]\ncommands:\n", "unused addresses", H, N),
    ("type: number, range: 1..10", "type: number, range: 0..10", "limits of the given", N, C),
    ("type: number, range: 1..10", "type: number, range: 2..10", "limits of the given", N, B),
    ("unit: kWh", "unit: MWh", "unit", N, B),
    ("unit: kWh", "unit: kWh, valid: 0..100", "valid results", N, H),
    ("unit: kWh", "unit: kWh, when: {mode: heat}", "condition of existence", N, H),
    (
        "steps: [{at: 7000, words: [85]}]",
        "steps: [{at: 7000, words: [85]}], effects: [{defaults: all}]",
        "what it changes besides",
        H,
        N,
    ),
    (
        "steps: [{at: 7000, words: [85]}]",
        "steps: [{at: 7000, words: [85]}], when: {mode: heat}",
        "condition of existence",
        H,
        H,
    ),
    ("steps: [{at: 7000, words: [85]}]", "steps: [{at: 7001, words: [85]}]", "requests", B, N),
    ("steps: [{at: 7000, words: [85]}]", "steps: [{at: 7000, words: [85]}, {wait: 50}]", "requests", H, N),
    ("chain: chain, id: 101", "chain: chain, id: 103", "place in the chain", B, H),
    ("stride: 2\n        registers: [{set", "stride: 3\n        registers: [{set", "stride", B, N),
    ("repeat: 1..4", "repeat: {from: 1, to: bank, most: 4}", "how many elements there are", H, H),
    ("repeat: 1..4", "repeat: 1..3", "number of elements", B, B),
    ("repeat: 1..4", "repeat: 0..3", "first index", N, B),
    ('source: "1"\n', 'source: "1"\n  accepts: {read_words: 60}\n', "limits that it goes beyond", H, N),
    ("    order: 2\n", "", "place in the order of writing", N, H),
    ("start: {start: 1}", "start: {start: 1}, while_running: refused", "way of writing", H, H),
    ("start: {start: 1}", "start: {start: 1}, when: {mode: heat}", "condition of existence", H, H),
]


@pytest.mark.parametrize(("old", "new", "what", "wire", "api"), TOP)
def test_a_fact_of_a_map(old: str, new: str, what: str, wire: Effect, api: Effect, edited: Any) -> None:
    found = edited(old, new)
    assert [tuple(one.effects) for one in found if one.what == what] == [(wire, api)], [one.what for one in found]


def test_a_register_that_leaves_its_block_is_reached_otherwise(bench: Any) -> None:
    more = "unit: A}, {at: 3, name: Frequency, access: r}]\n"
    old = BASE.replace("unit: A}]\n", more)
    apart = '  - {id: apart, name: Apart, source: "5", registers: [{at: 3003, name: Frequency, access: r}]}\n'
    found = bench.compared(old, BASE.replace("unit: A}]\n", f"unit: A}}]\n{apart}")).changes
    assert [tuple(one.effects) for one in found if one.what == "block"] == [(B, H)]


def test_what_a_register_converts_is_told_by_the_registers_that_both_versions_have(bench: Any) -> None:
    old = WARM.replace(SPOT, f"      - {{{EXTRA}, unit: warmth}}\n      - {{at: 301, name: Other}}\n{SPOT}")
    more = old.replace("name: Other", "name: Other, unit: warmth")
    found = bench.compared(old, more).changes
    assert sorted((one.rule.id, one.subjects, one.after) for one in found) == [
        ("RS0712", ("other",), "mode is 1: °F; otherwise: °C"),
        ("RS0736", ("mode",), "extra, other"),
    ]
    new = old.replace(SPOT, f"      - {{at: 302, name: Third, unit: warmth}}\n{SPOT}")
    assert [one.rule.id for one in bench.compared(old, new).changes] == ["RS0740"]


def test_a_register_at_the_first_address_shows_another_stride_to_readers_alone(bench: Any) -> None:
    far = "views:\n  far:\n    base: {offset: 500, type: int16}\n"
    line = f"      - {{at: 0, name: Extra, views: far}}\n{SPOT}"
    old = BASE.replace("views:\n", far).replace(SPOT, line)
    (found,) = bench.compared(old, old.replace("{offset: 500,", "{offset: 500, stride: 3,")).changes
    assert (found.rule.id, found.what, found.effects) == ("RS0773", "stride", (N, N))
