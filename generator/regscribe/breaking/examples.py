"""An example of each rule: a small map and an edit of it; `explain` shows them, and tests hold the rules to them."""

from difflib import unified_diff
from typing import NamedTuple

from regscribe.breaking import rules
from regscribe.breaking.change import Effect, Effects
from regscribe.model import Rule

NONE, COMPATIBLE, BEHAVIOURAL, BREAKING = Effect

BASE = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven manual, number: X1}
models: {M1: {}, M2: {description: with a second loop}}
protocol:
  source: "1"
  functions: [3, 6, 16]
  limits: {read_words: 40, write_words: 20}
  unit_ids: 1..100
  faults: {address: 2}
  serial: {baud: [9600, 19200], formats: [8N1], default: 9600 8N1}
givens:
  ratio: {type: number, range: 1..10, description: ratio, reason: it is set at the plant}
conditions:
  hot: {mode: heat}
chains:
  chain: {at: [4000], marker: [21365, 28243]}
blocks:
  inverter: {chain: chain, id: 101}
enums:
  modes: {0: stop, 1: heat, 2: cool}
sets:
  limits:
    - {at: 0, name: Low, type: int16}
    - {at: 1, name: High, type: int16}
views:
  both:
    base: {type: int16, rounding: half_up}
    ieee: {offset: 8000, stride: 2, type: float32}
groups:
  - id: control
    name: Control
    source: "2"
    order: 1
    each: {access: rw}
    registers:
      - {at: 1, name: Setpoint, type: int16, decimals: 1, unit: °C, range: 0..400, default: 20, aliases: [901]}
      - {at: 2, name: Mode, enum: modes, default: 0}
      - {at: 3, name: Power, type: int16, unit: W, access: r, sentinels: {-32768: no sensor}}
      - {at: 4, name: Total, type: uint32, access: r}
      - {at: 6, name: Timer, unit: s, range: 1..99, special: {0: off}}
      - {at: 7, name: Status, access: r, flags: {0: running, 1: alarm}}
      - {at: 8, name: Serial, access: r, type: string, length: 4, static: true}
      - {at: 12, name: Output, range: 0..100, when: hot, persistence: ram}
      - {at: 13, name: Offset, type: int16, stays: calibration}
      - {at: 20, name: Level, views: both}
      - {at: 22, name: Bank, stays: operation}
      - {at: 23, name: Fan, models: [M2]}
  - id: zones
    name: Zones
    source: "3"
    order: 2
    each: {access: rw}
    registers:
      - id: zones
        name: Zone
        repeat: 1..4
        stride: 2
        registers: [{set: limits, shift: 100}]
  - id: paged
    name: Paged
    source: "4"
    page: {bank: 3}
    registers: [{at: 200, name: Voltage, access: r, multiply: {given: ratio}, unit: V}]
  - id: inverter
    name: Inverter
    source: "5"
    block: inverter
    registers: [{at: 2, name: Current, access: r, unit: A}]
  - id: program
    name: Program
    source: "10"
    each: {access: rw, type: int16}
    registers:
      - {at: 40, name: Start, enum: {0: "no", 1: "yes"}}
      - id: segments
        name: Segment
        repeat: 1..3
        stride: 2
        registers: [{at: 50, name: Target}, {at: 51, name: Time, unit: min}]
commands:
  restart: {name: Restart, source: "6", danger: the heating stops, steps: [{at: 7000, words: [85]}]}
computed:
  energy: {name: Energy, source: "7", is: {product: [total, 2]}, unit: kWh}
process: {source: "8", value: power, setpoint: setpoint, outputs: [{percent: output, pid: {band: timer}}]}
programs:
  recipe: {name: Recipe, source: "10", segments: {array: segments, setpoint: target, ramp: time}, start: {start: 1}}
identify:
  - {when: {bank: 0..5}, models: [M1, M2]}
examples:
  - {source: "9", model: M1, register: setpoint, words: [200], value: 20}
"""
"""The map that the examples edit."""


class Edit(NamedTuple):
    """What is replaced by what, each text once, and the effects of the change."""

    replaced: tuple[tuple[str, str], ...]
    effects: Effects


def _edit(wire: Effect, api: Effect, *texts: str) -> Edit:
    return Edit(tuple(zip(texts[::2], texts[1::2], strict=True)), Effects(wire, api))


EDITS: dict[Rule, Edit] = {
    rules.ADDRESS: _edit(BREAKING, NONE, "at: 13, name: Offset", "at: 14, name: Offset"),
    rules.ALIAS: _edit(BREAKING, NONE, ", aliases: [901]", ""),
    rules.TYPE: _edit(BREAKING, BREAKING, "name: Offset, type: int16", "name: Offset, type: uint16"),
    rules.ORDER: _edit(BREAKING, NONE, "type: uint32, access: r", "type: uint32, word_order: little, access: r"),
    rules.VIEW_SET: _edit(BREAKING, BREAKING, "    ieee: {offset: 8000, stride: 2, type: float32}\n", ""),
    rules.VIEW: _edit(BEHAVIOURAL, NONE, "type: float32}", "type: float32, preferred: true}"),
    rules.REACH: _edit(BREAKING, NONE, "page: {bank: 3}", "page: {bank: 4}"),
    rules.ARRAY: _edit(COMPATIBLE, COMPATIBLE, "repeat: 1..4", "repeat: 1..6"),
    rules.KIND: _edit(NONE, BREAKING, "range: 0..100, when", "kind: raw, range: 0..100, when"),
    rules.SCALE: _edit(NONE, BREAKING, "decimals: 1", "multiply: 0.5", "value: 20}", "value: 100}"),
    rules.UNIT: _edit(NONE, BREAKING, "unit: W,", "unit: kW,"),
    rules.NARROWED: _edit(NONE, BREAKING, "range: 0..400", "range: 0..300"),
    rules.WIDENED: _edit(NONE, BEHAVIOURAL, "range: 0..400", "range: 0..500"),
    rules.LIMITS: _edit(NONE, BREAKING, "range: 0..400", "range: 10..500"),
    rules.DEFAULT: _edit(BEHAVIOURAL, BEHAVIOURAL, "default: 20", "default: 25"),
    rules.CODE_ADDED: _edit(NONE, BEHAVIOURAL, "2: cool}", "2: cool, 3: dry}"),
    rules.CODE_REMOVED: _edit(BEHAVIOURAL, BREAKING, ", 2: cool}", "}"),
    rules.CODE_RENAMED: _edit(NONE, BREAKING, "2: cool}", "2: chill}"),
    rules.CODE_MEANING: _edit(
        BREAKING, BREAKING, "1: heat, 2: cool}", "1: cool, 2: heat}", "hot: {mode: heat}", "hot: {mode: 1}"
    ),
    rules.SPECIAL: _edit(NONE, BREAKING, ", special: {0: off}", ""),
    rules.FAULT_ADDED: _edit(NONE, BEHAVIOURAL, "-32768: no sensor", "-32768: no sensor, -32767: broken"),
    rules.FAULT_REMOVED: _edit(NONE, BREAKING, ", sentinels: {-32768: no sensor}", ""),
    rules.BITS: _edit(BREAKING, NONE, "1: alarm}", "2: alarm}"),
    rules.PART_ADDED: _edit(NONE, COMPATIBLE, "1: alarm}", "1: alarm, 2: door}"),
    rules.PART_REMOVED: _edit(BEHAVIOURAL, BREAKING, ", 1: alarm}", "}"),
    rules.FORM: _edit(BREAKING, BREAKING, "length: 4, static", "length: 4, text: {padding: nul}, static"),
    rules.ACCESS_NARROWED: _edit(BREAKING, BREAKING, "persistence: ram}", "persistence: ram, access: r}"),
    rules.ACCESS_WIDENED: _edit(COMPATIBLE, COMPATIBLE, "type: uint32, access: r", "type: uint32"),
    rules.EXISTENCE: _edit(BEHAVIOURAL, BEHAVIOURAL, "hot: {mode: heat}", "hot: {mode: [heat, cool]}"),
    rules.WRITING: _edit(
        BEHAVIOURAL,
        BREAKING,
        "name: Offset, type: int16",
        "name: Offset, type: int16, writable: {when: {mode: stop}, reason: it stands still}",
    ),
    rules.PERSISTENCE: _edit(BEHAVIOURAL, BEHAVIOURAL, "persistence: ram", "persistence: eeprom"),
    rules.READING: _edit(NONE, BEHAVIOURAL, "unit: V}", "unit: V, poll: slow}"),
    rules.RELATION: _edit(NONE, BEHAVIOURAL, "stays: calibration", "stays: operation"),
    rules.ADDED: _edit(
        COMPATIBLE,
        COMPATIBLE,
        "      - {at: 22, name: Bank",
        "      - {at: 21, name: Door, access: r}\n      - {at: 22, name: Bank",
    ),
    rules.REMOVED: _edit(BREAKING, BREAKING, "      - {at: 13, name: Offset, type: int16, stays: calibration}\n", ""),
    rules.RENAMED: _edit(NONE, BREAKING, "name: Offset", "name: Shift"),
    rules.MOVED_GROUP: _edit(
        NONE,
        BEHAVIOURAL,
        "      - {at: 13, name: Offset, type: int16, stays: calibration}\n",
        "",
        "      - id: zones\n",
        "      - {at: 13, name: Offset, type: int16, stays: calibration}\n      - id: zones\n",
    ),
    rules.UNCERTAIN: _edit(COMPATIBLE, COMPATIBLE, "name: Offset, type: int16", "name: Gain, type: uint16"),
    rules.MODEL_ADDED: _edit(
        COMPATIBLE, COMPATIBLE, "models: {M1: {}", "models: {M3: {}, M1: {}", "[M1, M2]}", "[M1, M2, M3]}"
    ),
    rules.MODEL_REMOVED: _edit(
        BREAKING,
        BREAKING,
        ", M2: {description: with a second loop}",
        "",
        "      - {at: 23, name: Fan, models: [M2]}\n",
        "",
        "models: [M1, M2]",
        "models: [M1]",
    ),
    rules.MODEL_RENAMED: _edit(
        NONE, BREAKING, "M2: {desc", "M2b: {desc", "models: [M2]}", "models: [M2b]}", "[M1, M2]}", "[M1, M2b]}"
    ),
    rules.MAP_RENAMED: _edit(NONE, BREAKING, "id: acme/oven,", "id: acme/kiln,"),
    rules.THING_ADDED: _edit(
        NONE,
        COMPATIBLE,
        "computed:\n",
        '  stop: {name: Stop, source: "6", steps: [{at: 7001, words: [1]}]}\ncomputed:\n',
    ),
    rules.THING_REMOVED: _edit(
        NONE,
        BREAKING,
        'computed:\n  energy: {name: Energy, source: "7", is: {product: [total, 2]}, unit: kWh}\n',
        "",
    ),
    rules.THING_RENAMED: _edit(NONE, BREAKING, "  restart: {", "  reboot: {"),
    rules.COMMAND: _edit(BREAKING, NONE, "words: [85]", "words: [86]"),
    rules.COMPUTED: _edit(NONE, BREAKING, "[total, 2]", "[total, 3]"),
    rules.PROGRAM: _edit(BEHAVIOURAL, BEHAVIOURAL, "start: {start: 1}", "start: {start: 0}"),
    rules.PROCESS: _edit(NONE, BEHAVIOURAL, "pid: {band: timer}", "pid: {band: level}"),
    rules.WRITE_ORDER: _edit(NONE, BEHAVIOURAL, "    order: 2\n", "    order: 3\n"),
    rules.GIVEN_ADDED: _edit(
        NONE,
        BREAKING,
        "conditions:\n",
        "  size: {type: number, description: size, reason: it is on the label}\nconditions:\n",
        "unit: A}",
        "unit: A, multiply: {given: size}}",
    ),
    rules.GIVEN_REMOVED: _edit(
        NONE,
        BREAKING,
        "givens:\n  ratio: {type: number, range: 1..10, description: ratio, reason: it is set at the plant}\n",
        "",
        "multiply: {given: ratio}, ",
        "",
    ),
    rules.GIVEN_CHANGED: _edit(NONE, BREAKING, "range: 1..10,", "range: 1..5,"),
    rules.LIMIT_LOWERED: _edit(BEHAVIOURAL, NONE, "read_words: 40", "read_words: 30"),
    rules.LIMIT_RAISED: _edit(COMPATIBLE, NONE, "write_words: 20", "write_words: 24"),
    rules.FUNCTIONS: _edit(BREAKING, NONE, "functions: [3, 6, 16]", "functions: [3, 16]"),
    rules.UNIT_IDS: _edit(BREAKING, BREAKING, "unit_ids: 1..100", "unit_ids: 1..99"),
    rules.ANSWERS: _edit(BEHAVIOURAL, NONE, "faults: {address: 2}", "faults: {address: silence}"),
    rules.LINE: _edit(BREAKING, BEHAVIOURAL, "default: 9600 8N1", "default: 19200 8N1"),
    rules.IDENTITY: _edit(NONE, BEHAVIOURAL, "{bank: 0..5}", "{bank: 0..6}"),
    rules.MEMORY: _edit(NONE, BEHAVIOURAL, "  unit_ids", "  spares_memory: true\n  unit_ids"),
    rules.NAME_REMOVED: _edit(NONE, BREAKING, "class_prefix: Acme}", "class_prefix: Best}"),
    rules.NAME_ADDED: _edit(
        NONE,
        COMPATIBLE,
        "      - {at: 22, name: Bank",
        "      - {at: 21, name: Door, enum: {0: shut}}\n      - {at: 22, name: Bank",
    ),
    rules.TEXT: _edit(NONE, NONE, "unit: s,", "description: Runs down., unit: s,"),
    rules.EVIDENCE: _edit(NONE, NONE, "number: X1", "number: X2"),
}
"""The edit of each rule, but for maps that come and go as wholes."""


def edited(rule: Rule) -> str:
    """The map after the edit of a rule."""
    text = BASE
    for old, new in EDITS[rule].replaced:
        text = text.replace(old, new, 1)
    return text


def shown(rule: Rule) -> str:
    """The edit of a rule as a unified diff of two lines around it."""
    return "\n".join(list(unified_diff(BASE.splitlines(), edited(rule).splitlines(), lineterm="", n=1))[2:])
