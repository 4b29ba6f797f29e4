"""How to talk to the device: functions, limits, serial line, latency, and its answers to bad requests."""

from collections.abc import Iterable
from itertools import chain

from regscribe.emit.markdown.context import SPACES, PageContext
from regscribe.emit.markdown.escape import Md, escape, md, prose
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.words import listed, one_line
from regscribe.model import SILENCE, Latency, Later, RegisterMap, SpaceLimits, show

FUNCTIONS = {
    1: "read coils",
    2: "read discrete inputs",
    3: "read holding registers",
    4: "read input registers",
    5: "write one coil",
    6: "write one register",
    7: "read the exception status",
    8: "diagnostics",
    15: "write several coils",
    16: "write several registers",
    17: "report the server id",
    22: "mask a register",
    23: "write and read registers",
    43: "read the device identification",
}
BIT_FUNCTIONS = frozenset({1, 2, 5, 15})
USUAL = " (as Modbus has it; not stated here)"
"""Stands behind a default of Modbus for which the map has no key."""

LATER_READ = {
    Later.EXCEPTION: "",
    Later.GARBAGE: "answered; the words after the last good one mean nothing",
    Later.ZEROS: "answered; zeros after the last good word",
    Later.STOP: "answered up to the last good word",
}
LATER_WRITE = {
    Later.EXCEPTION: "refused as a whole, as above",
    Later.STOP: "writing stops at the first bad word; the answer counts the words that were written",
}


def line(context: PageContext) -> PageTable:
    """Return functions, limits and the serial line as a table of two columns."""
    register_map = context.map
    section = escape(one_line(register_map.protocol_notes.section))
    rows = [*_requests(register_map), *_serial(register_map), ("Section", section)]
    return table(("Property", "Value"), [row for row in rows if row[1]])


def _requests(register_map: RegisterMap) -> Iterable[tuple[str, Md]]:
    protocol = register_map.protocol
    yield "Functions", md(_functions(protocol.functions))
    alike = (listed([f"{code:02d}" for code in same], last="and") for same in register_map.alike)
    yield "Functions that do the same", md("; ".join(alike))
    unsupported = "not supported" if "broadcast" in register_map.protocol_notes.stated else "not stated"
    yield "Broadcast (unit 0)", md(_functions(protocol.broadcast) or unsupported)
    first, last = protocol.unit_ids
    default = f", {register_map.default_unit} unless set" if register_map.default_unit is not None else ""
    yield "Unit ids", md(f"{first} to {last}{_usual(register_map, 'unit_ids')}{default}")
    yield "Most words in a request", md(_most(register_map, "words"))
    if BIT_FUNCTIONS & set(protocol.functions):
        yield "Most bits in a request", md(_most(register_map, "bits"))
    yield "In single spaces", md("; ".join(map(_space_limits, protocol.spaces)))
    yield "Pause between requests", md(f"{show(protocol.pause)} ms" if protocol.pause else "")
    yield "Reading over unused addresses", md("allowed" if protocol.read_holes else "not relied upon")
    yield "Writing what is there already", md("spares the lasting memory" if register_map.spares_memory else "")


def _most(register_map: RegisterMap, what: str) -> str:
    """Return the most that one request may carry, and the limit that the device is known to accept."""
    found = []
    for verb in ("read", "write"):
        limit = f"{verb}_{what}"
        most, accepted = getattr(register_map.protocol, limit), register_map.accepted(limit)
        beyond = f" (a device also answers {accepted})" if accepted != most else ""
        found.append(f"{most} to {verb}{_usual(register_map, limit)}{beyond}")
    return ", ".join(found)


def _space_limits(limits: SpaceLimits) -> str:
    parts = ((limits.read, "to read"), (limits.write, "to write"))
    return f"{SPACES[limits.space].lower()}: {', '.join(f'{most} {verb}' for most, verb in parts if most)}"


def _usual(register_map: RegisterMap, key: str) -> str:
    return "" if key in register_map.protocol_notes.stated else USUAL


def _functions(codes: Iterable[int]) -> str:
    return "; ".join(map(_function, codes))


def _function(code: int) -> str:
    return f"{code:02d} {FUNCTIONS[code]}" if code in FUNCTIONS else f"{code:02d}"


def _serial(register_map: RegisterMap) -> Iterable[tuple[str, Md]]:
    serial, notes = register_map.protocol.serial, register_map.protocol_notes
    yield "Transmission", md(listed([one_line(mode).upper() for mode in serial.modes]))
    yield "Baud rates", md(", ".join(map(str, serial.bauds)))
    yield "Character formats", md(", ".join(map(one_line, serial.formats)))
    yield "Default", md(f"{serial.baud} baud, {serial.format}" if "default" in notes.stated else "")
    usual = _usual(register_map, "gap_characters")
    yield "Silence between messages", md(f"{show(serial.gap)} characters{usual}")
    yield "Remark", prose(notes.serial)


def latency(context: PageContext) -> PageTable:
    """Return the time from the end of a request to the start of the answer by function."""
    headers = ("Function", "Fixed", "For each word", "Characters at the speed of the line", "Remark")
    notes = dict(context.map.protocol_notes.latencies)
    return table(headers, (_latency(item, notes.get(item.function, "")) for item in context.map.protocol.latencies))


def _latency(item: Latency, note: str) -> tuple[str, ...]:
    spans = ((item.minimum, item.maximum), (item.minimum_per_word, item.maximum_per_word))
    fixed, words = (f"{show(low)} to {show(high)} ms" if high else "" for low, high in spans)
    characters = show(item.characters) if item.characters else ""
    return (_function(item.function), fixed, words, characters, prose(note))


def faults(context: PageContext) -> PageTable:
    """Return the device's answer to each kind of bad request that it can get."""
    registers = list(chain(*(model.registers for model in context.map.models)))
    views = [view for register in registers for view in register.views]
    aligned = any(view.align > 1 for view in views)
    bad_requests = (
        ("function code that the device does not have", "function", True),
        ("address of no register", "address", True),
        ("value outside its range", "value", True),
        ("write to a read-only register", "read_only", True),
        ("write under a condition that forbids it", "condition", any(register.writable for register in registers)),
        ("write to an address listed as unused", "unused_write", any(model.unused for model in context.map.models)),
        ("more words than a request may have", "quantity", True),
        ("first address between two values of several words", "misaligned_address", aligned),
        ("number of words that ends inside a value", "misaligned_count", aligned),
        ("function that the view does not allow", "view_function", any(view.functions for view in views)),
    )
    rows = [(words, _fault(context, key)) for words, key, possible in bad_requests if possible]
    return table(("Bad request", "Answer"), [*rows, *_later(context)])


def _fault(context: PageContext, key: str) -> Md:
    if key == "unused_write" and key not in context.map.protocol_notes.stated:
        key = "address"  # which counts for both then
    return md(_answer(context, getattr(context.map.faults, key)), _usual(context.map, key))


def _later(context: PageContext) -> Iterable[tuple[str, Md]]:
    register_map, found = context.map, context.map.faults
    refused = md("refused as a whole: ", _answer(context, found.address))
    read = md(LATER_READ[found.later_read] or refused, _usual(register_map, "later_read"))
    yield "read that starts well and runs onto an address of no register", read
    write = LATER_WRITE.get(found.later_write, LATER_WRITE[Later.EXCEPTION])
    yield "write of several words with a bad one after good ones", md(write, _usual(register_map, "later_write"))


def _answer(context: PageContext, code: int) -> Md:
    if code == SILENCE:
        return Md("**no answer**")
    name = context.map.protocol.exception(code).name
    return md(f"exception {code:02d}", f" ({name})" if name else "")


def exceptions(context: PageContext) -> PageTable:
    """Return the exception codes of the device with their meanings."""
    found = context.map.protocol.exceptions
    rows = ((f"{item.code:02d}", item.name, prose(item.meaning)) for item in found)
    return table(("Code", "Name", "Meaning"), rows)
