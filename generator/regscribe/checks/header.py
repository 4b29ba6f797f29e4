"""The head of a map: its protocol, the serial line, its manual, errata and givens, and how models are told apart."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import fields

from regscribe.checks.rule import MAP, Finding, Problem, RuleScope, Scopes, header_rule, map_rule, register_rule
from regscribe.model import SILENCE, Identity, Protocol, Register, RegisterMap

READS = frozenset({1, 2, 3, 4, 7, 11, 12, 17, 20, 24})
"""Functions whose point is the answer, so that they cannot be broadcast."""

ASCII = "ascii"

LAST_UNIT = 255


@header_rule("RS0486", "Fault without a meaning", warns=True)
def fault_without_meaning(register_map: RegisterMap) -> Iterator[Problem]:
    """An exception reaches the user with the device's own meaning of it."""
    protocol = register_map.protocol
    known = {exception.code for exception in protocol.exceptions} | {SILENCE}
    for fault in fields(register_map.faults) if protocol.exceptions else ():
        code = getattr(register_map.faults, fault.name)
        if isinstance(code, int) and code not in known:
            message = f"fault `{fault.name}` is answered by exception {code:02d}, which `protocol.exceptions` lacks"
            yield message, "list the code with its name, or correct the fault"


@header_rule("RS0690", "Accepted limit that is no more than the limit")
def accepts(register_map: RegisterMap) -> Iterator[Problem]:
    """What a device accepts beyond its limits is more."""
    protocol = register_map.protocol
    for limit, most in register_map.accepts:
        if most <= getattr(protocol, limit):
            message = f"`protocol.accepts` has {most} {limit}, and the limit is {getattr(protocol, limit)} already"
            yield message, "leave it out, or lower the limit that a driver keeps to"


@header_rule("RS0686", "Limit of a space that Modbus does not have")
def space_limits(register_map: RegisterMap) -> Iterator[Problem]:
    """One frame carries no more, and a space that cannot be written has no limit of writing."""
    plain = Protocol()
    for space, read, write in register_map.protocol.spaces:
        most = plain.most_read(space), plain.most_written(space) if space.write_functions else 0
        for way, own, limit in zip(("read", "write"), (read, write), most, strict=True):
            if own > limit // space.each:
                told = f"`protocol.space_limits` has {way} {own} for {space}, of {limit // space.each} at most"
                yield told, "correct it"


@header_rule("RS0488", "Unit ids that cannot be")
def unit_ids(register_map: RegisterMap) -> Iterator[Problem]:
    """A unit id is 1 to 255, or 0 of a device over TCP (on serial lines 0 broadcasts); the default is one of them."""
    low, high = register_map.protocol.unit_ids
    if not 0 <= low <= high <= LAST_UNIT or (not low and register_map.protocol.broadcast):
        yield f"unit ids {low}..{high} are not within {int(not low)}..{LAST_UNIT}", "correct `protocol.unit_ids`"
    elif register_map.default_unit is not None and not low <= register_map.default_unit <= high:
        message = f"the default unit id {register_map.default_unit} is outside {low}..{high}"
        yield message, "correct `protocol.default_unit` or `unit_ids`"


@header_rule("RS0489", "Latency that cannot be")
def latency(register_map: RegisterMap) -> Iterator[Problem]:
    """A latency belongs to a function that the device has, and is a time."""
    protocol = register_map.protocol
    for one in protocol.latencies:
        pairs = ((one.minimum, one.maximum), (one.minimum_per_word, one.maximum_per_word))
        if one.function not in protocol.functions:
            yield f"latency of function {one.function:02d}, which `protocol.functions` lacks", "correct one of them"
        elif any(low < 0 or low > high for low, high in pairs):
            message = f"latency of function {one.function:02d} is no time: an end is negative or the ends are swapped"
            yield message, "write the shorter time first"


@header_rule("RS0490", "Function that cannot be broadcast")
def broadcast(register_map: RegisterMap) -> Iterator[Problem]:
    """Nobody answers a broadcast, so it can only be a write."""
    protocol = register_map.protocol
    for code in protocol.broadcast:
        if code in READS or code not in protocol.functions:
            why = "it reads" if code in READS else "`protocol.functions` lacks it"
            yield f"function {code:02d} is listed under `broadcast`, but {why}", "correct `protocol.broadcast`"


@header_rule("RS0492", "Functions alike that cannot be")
def alike(register_map: RegisterMap) -> Iterator[Problem]:
    """Each function of the device does one thing, alone or like others."""
    protocol = register_map.protocol
    every = [code for codes in register_map.alike for code in codes]
    for code in dict.fromkeys(every):
        if code not in protocol.functions or every.count(code) > 1:
            why = "stands in two lists" if every.count(code) > 1 else "is not among `protocol.functions`"
            yield f"function {code:02d} of `protocol.alike` {why}", "correct `protocol.alike`"


@header_rule("RS0491", "Default of the serial line is not offered")
def serial_default(register_map: RegisterMap) -> Iterator[Problem]:
    """The default is one of the speeds and formats listed."""
    line = register_map.protocol.serial
    pairs = (("baud", line.baud, line.bauds), ("format", line.format, line.formats))
    for what, default, offered in pairs if "default" in register_map.protocol_notes.stated else ():
        if offered and default not in offered:
            message = f"the default {what} {default} is not among {', '.join(map(str, offered))}"
            yield message, f"correct `serial.default`, or list the {what}"


@header_rule("RS0661", "Character format too short for RTU")
def too_short_for_rtu(register_map: RegisterMap) -> Iterator[Problem]:
    """RTU sends bytes of 8 bits; 7 carry ASCII alone (Modbus over serial line V1.02, 2.5.1)."""
    line = register_map.protocol.serial
    short = dict.fromkeys(one for one in (*line.formats, line.format) if one.startswith("7"))
    if short and ASCII not in line.modes:
        message = f"the serial line has {', '.join(short)} and the modes {', '.join(line.modes)}: RTU needs 8 data bits"
        yield message, "correct `serial.formats`, or list `ascii` under `serial.modes`"


@header_rule("RS0494", "Models not told apart")
def identification(register_map: RegisterMap) -> Iterator[Problem]:
    """`identify` says for every model, once, how it answers."""
    known: set[Identity] = set()
    listed: set[str] = set()
    for rule in register_map.identity:
        twice = [name for name, count in Counter(rule.models).items() if count > 1]
        if twice:
            yield f"`identify` lists {', '.join(twice)} twice at once", "remove one"
        if rule.identity in known:
            message = f"`identify` has two entries of one condition (the second for {', '.join(rule.models)})"
            yield message, "list the models in one entry"
        known.add(rule.identity)
        listed.update(rule.models)
    missing = [model.name for model in register_map.models if listed and model.name not in listed]
    if missing:
        yield f"`identify` does not say how to tell {', '.join(missing)}", "add them"


@map_rule("RS0699", "Identified by a register that a device may lack", warns=True)
def identified_by_optional(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """A device without the register is not recognised, although it is one of the model."""
    for scope in scopes:
        rules = [one.identity for one in register_map.identity if scope.model.name in one.models]
        for path in dict.fromkeys(path for rule in rules for path in rule.registers()):
            register = scope.model.register(path)
            if register.mandatory is False:
                message = f"`identify` asks `{path}`, which not every {scope.model.name} has (`mandatory: false`)"
                remedy = "ask a register that each has, or give the model a further entry without it"
                yield Finding(path, register.span, message, remedy)


@register_rule("RS0495", "Register without section", warns=True)
def no_section(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A reader must be able to look every value up in the manual."""
    if not register.section:
        yield "does not say where the manual describes it", "add `source` here or at its group"


@header_rule("RS0496", "Manual not identified", warns=True)
def manual_not_identified(register_map: RegisterMap) -> Iterator[Problem]:
    """Makers reissue manuals: number or date tells which one was transcribed."""
    if not (register_map.manual.number.strip() or register_map.manual.date.strip()):
        title = register_map.manual.title
        message = f'the manual "{title}" has neither number nor date' if title else "the map names no manual"
        yield (
            message,
            "add `manual.number` or `manual.date`" if title else "add `manual` with its title, number or date",
        )


@map_rule("RS0498", "Erratum or given that does not say enough")
def blank_reasons(register_map: RegisterMap, _: Scopes) -> Iterator[Finding]:
    """A blank reason cannot be judged by a reviewer."""
    for erratum in register_map.errata:
        texts = {"where": erratum.where, "printed": erratum.printed, "read": erratum.read, "why": erratum.why}
        blank = [key for key, text in texts.items() if not text.strip()]
        if blank:
            message = f'the erratum at "{erratum.where}" leaves {", ".join(blank)} blank'
            yield Finding(MAP, register_map.span, message, "say it in your own words")
    for given in register_map.givens:
        if not (given.description.strip() and given.reason.strip()):
            message = f"given `{given.id}` has a blank description or reason"
            yield Finding(given.id, given.span, message, "say what it is and why the manual does not hold it")
