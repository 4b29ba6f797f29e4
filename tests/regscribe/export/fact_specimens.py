"""Small maps with and without each fact that a register or a model can have: what differs is that fact alone."""

from typing import NamedTuple


class Specimen(NamedTuple):
    """Registers as lines of YAML, and what stands before (`top`) and behind (`tail`) the groups, with the fact.

    `plain` are the same without it, `plain_top` and `plain_tail` likewise where they differ. `path` is the register
    that has the fact (empty: the model has it); `options` are those that an export for one device needs.
    """

    registers: tuple[str, ...]
    plain: tuple[str, ...]
    top: str = ""
    tail: str = ""
    plain_top: str | None = None
    plain_tail: str | None = None
    path: str = "level"
    options: tuple[tuple[str, str], ...] = ()


MODE = "at: 0, name: Mode, range: 0..3, default: 1"


def one(said: str, plain: str = "", *, before: tuple[str, ...] = (MODE,), top: str = "", tail: str = "") -> Specimen:
    """A register `level` behind another one, with and without something said of it."""
    head = "at: 10, name: Level"
    texts = (f"{head}, {keys}" if keys else head for keys in (said, plain))
    registers, others = ((*before, text) for text in texts)
    return Specimen(registers, others, top, tail)


def of_model(top: str = "", tail: str = "", *registers: str) -> Specimen:
    """A fact of the model beside its registers."""
    lines = registers or (MODE,)
    return Specimen(lines, lines, top, tail, plain_top="", plain_tail="", path="")


def group(name: str, said: str, at: str) -> str:
    """A further group with the register `level`."""
    registers = f"[{{{at}, name: Level, access: rw}}]"
    return f'  - {{id: {name}, name: {name.title()}, source: "3.1", {said}, registers: {registers}}}\n'


LONG = tuple(f"at: {4 * number}, name: Total {number}, type: uint64, access: r" for number in range(5))
DECIMALS = "decimals: {places: {register: mode}}"
BAUD = 'enum: {0: "9600", 1: "19200"}, stays: line'
COILS = "protocol: {functions: [1, 3, 5, 6, 16]}"
RESET = 'commands: {reset: {name: Reset, source: "1", steps: [{at: 90, words: [85]}]}}\n'
BLOCK = (
    "blocks: {placed: {base: {given: start}}}\ngivens: {start: {type: number, description: where, reason: a switch}}"
)

SPECIMENS: dict[str, tuple[Specimen, ...]] = {
    "condition": (one("when: {mode: 1}"), one("type: float32, access: r, when: {mode: 1}", "type: float32, access: r")),
    "parts-condition": (
        one("enum: {0: off, 1: {label: on, when: {mode: 1}}}", "enum: {0: off, 1: on}"),
        one("flags: {0: hot, 1: {label: cold, when: {mode: 1}}}", "flags: {0: hot, 1: cold}"),
    ),
    "scale": (one("decimals: 1"), one("multiply: 0.5, access: r", "access: r")),
    "offset": (one("multiply: 0.5, add: -40, access: r", "multiply: 0.5, access: r"),),
    "scale-register": (one("decimals: places, access: r", "decimals: 1, access: r", top=DECIMALS),),
    "word-order-register": (
        one(
            "type: int32, word_order: {register: mode, codes: {0: little, 1: big}}, access: r",
            "type: int32, access: r",
            before=("at: 0, name: Mode, range: 0..1, default: 1",),
        ),
    ),
    "scale-not-stated": (one("decimals: not_stated, access: r", "access: r"),),
    "unit": (
        one("unit: °C, access: r", "access: r"),
        one("unit: kWh, decimals: 1, access: r", "decimals: 1, access: r"),
    ),
    "unit-register": (one("unit: [{when: {mode: 1}, is: °C}, {is: K}], access: r", "unit: °C, access: r"),),
    "range": (one("range: 0..50"), one("decimals: 1, range: 0..50, unit: °C", "decimals: 1, unit: °C")),
    "range-register": (one("range: {from: 0, to: mode}", "range: 0..1"),),
    "range-union": (one("range: [0..5, 8..9]", "range: 0..9"),),
    "step": (one("step: 5"), one("decimals: 1, step: 0.5, range: 0..50", "decimals: 1, range: 0..50")),
    "valid": (
        one("valid: 0..100, access: r", "access: r"),
        one("valid: 0..100, unit: V, access: r", "unit: V, access: r"),
    ),
    "saturates": (
        Specimen(
            ("at: 10, name: Level, views: both",),
            ("at: 10, name: Level, views: both",),
            "views: {both: {base: {type: int16, factor: 10, saturates: true}}}",
            plain_top="views: {both: {base: {type: int16, factor: 10}}}",
        ),
    ),
    "sentinel": (one("sentinels: {-32768: broken}, access: r", "access: r"),),
    "sentinel-condition": (
        one("sentinels: [{when: {mode: 1}, is: {-1: broken}}], access: r", "sentinels: {-1: broken}, access: r"),
    ),
    "special-value": (one("range: 1..9, special: {0: automatic}", "range: 1..9"),),
    "special-number": (
        one("range: 1..9, special: {0: {label: automatic, means: 5}}", "range: 1..9, special: {0: automatic}"),
    ),
    "enum": (one("enum: {0: idle, 5: busy}, type: uint16"), one("enum: {0: idle, 5: busy}, access: r", "access: r")),
    "flags": (one("flags: {0: heating, 3: alarm}, type: uint16, access: r", "type: uint16, access: r"),),
    "fields": (one("fields: {zone: {bits: 0..3}}, type: uint16, access: r", "type: uint16, access: r"),),
    "boolean": (one("kind: boolean, type: uint16, access: r", "type: uint16, access: r"),),
    "string": (one("type: string, length: 2, access: r", "type: uint32, access: r"),),
    "padding": (
        one("type: string, length: 2, text: {padding: nul}, access: r", "type: string, length: 2, access: r"),
        one("type: string, length: 2, text: {padding: nul}", "type: string, length: 2"),
    ),
    "version": (one("version: n.n.n, type: uint16, access: r", "type: uint16, access: r"),),
    "bytes": (one("type: bytes, length: 2, access: r", "type: uint32, access: r"),),
    "date": (one("type: datetime, layout: Y M D h m s, access: r", "type: bytes, length: 6, access: r"),),
    "write": (
        one("range: 0..9, access: rw", "access: r"),
        one("enum: {0: off, 1: on}", "enum: {0: off, 1: on}, access: r"),
    ),
    "write-only": (one("access: w", "access: rw"),),
    "write-condition": (one("writable: {when: {mode: 1}, reason: interlock}"),),
    "unlock-apply": (one("unlock: reset", tail=RESET),),
    "settle": (one("settle: 500"), one("space: coil, type: bit, settle: 1500", "space: coil, type: bit", top=COILS)),
    "line-setting": (
        one(
            f"{BAUD}, governs: {{setting: baud, codes: {{0: 9600, 1: 19200}}, from: at_once}}",
            BAUD,
            top="protocol: {serial: {baud: [9600, 19200], formats: [8N1], default: 9600 8N1}}",
        ),
    ),
    "danger": (one("danger: the door opens"),),
    "memory-wear": (one("persistence: eeprom, endurance: 1000"),),
    "default": (one("default: 7"), one("default: 7, access: r", "access: r")),
    "poll": (one("poll: slow, access: r", "access: r"), one("poll: once, access: r", "access: r")),
    "view": (
        Specimen(
            ("at: 10, name: Level, views: both",),
            ("at: 10, name: Level",),
            "views: {both: {base: {type: int16}, ieee: {offset: 2000, stride: 2, type: float32}}}",
            plain_top="views: {both: {base: {type: int16}}}",
        ),
    ),
    "alias": (one("aliases: [110]"),),
    "functions": (
        one("functions: [3, 16]", top="protocol: {functions: [3, 4, 6, 16]}"),
        one("functions: [3], access: r", "access: r", top="protocol: {functions: [3, 4, 6, 16]}"),
    ),
    "page": (
        Specimen(
            (f"{MODE}, stays: operation",),
            (f"{MODE}, stays: operation",),
            tail=group("paged", "page: {mode: 2}", "at: 10"),
            plain_tail=group("paged", "description: plain", "at: 10"),
        ),
    ),
    "block": (
        Specimen(
            (MODE,),
            (MODE,),
            BLOCK,
            group("placed", "block: placed", "at: 2"),
            plain_tail=group("placed", "description: plain", "at: 2"),
            plain_top="",
            options=(("base", "placed=40"),),
        ),
    ),
    "array": (
        Specimen(
            ("id: loops, name: Loop, repeat: 1..2, stride: 10, registers: [{at: 10, name: Level}]",),
            ("at: 10, name: Level 1, id: loops_1_level", "at: 20, name: Level 2, id: loops_2_level"),
            path="loops[1].level",
        ),
    ),
    "group": (
        Specimen(
            (MODE,),
            (MODE,),
            tail=group("filling", "description: plain", "at: 10"),
            plain_tail=group("emptying", "description: plain", "at: 10"),
        ),
    ),
    "name": (Specimen(("id: level, at: 10, name: Tank Level",), ("id: level, at: 10, name: Height",)),),
    "symbol": (one("symbol: LVL"),),
    "description": (one("description: how high the water stands"),),
    "source": (one('source: "7.4"'),),
    "relations": (one("shadows: mode"),),
    "identity": (one("stays: calibration"), one("mandatory: false, access: r", "access: r")),
    "commands": (of_model(tail=RESET),),
    "computed": (of_model(tail="computed: {twice: {name: Twice, is: {sum: [mode, mode]}, unit: W}}\n"),),
    "programs": (
        of_model(
            "",
            "programs: {ramps: {name: Ramps, source: '1', segments: {array: steps, setpoint: goal, ramp: time}, "
            "time_unit: {register: counted, codes: {second: s, minute: min}}, while_running: refused}}\n",
            "at: 1, name: Counted, enum: {0: second, 1: minute}",
            "id: steps, name: Step, repeat: 1..2, stride: 2, registers: [{at: 10, name: Goal}, {at: 11, name: Time}]",
        ),
    ),
    "givens": (
        Specimen(
            (MODE, "at: 10, name: Level, when: {given: card}"),
            (MODE, "at: 10, name: Level"),
            "givens: {card: {type: boolean, description: whether the card is fitted, reason: an option}}",
            plain_top="",
            path="",
            options=(("given", "card=true"),),
        ),
    ),
    "limits": (of_model("protocol: {limits: {read_words: 10, write_words: 10}}", "", *LONG),),
    "pause": (of_model("protocol: {pause: 50}"),),
    "errata": (of_model("", 'errata: [{where: "3.1", printed: "1", read: "2", why: the example says so}]\n'),),
}
"""The specimens of each fact, by its id; a format shows what it carries in one of them at least."""
