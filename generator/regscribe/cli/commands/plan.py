"""`regscribe plan`: which requests read registers at the least cost, and why."""

import sys
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction

import click

from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.map_arguments import find_map
from regscribe.cli.shared.output import print_json, raised_as, refuse, remark, show_table, tell
from regscribe.cli.shared.target_options import base_option, json_option
from regscribe.emit.words import span_words
from regscribe.model import RegisterMap, parse
from regscribe.model.located import arrays_in
from regscribe.planned_model import PlannedModel
from regscribe.tools.live.errors import TargetError, unknown
from regscribe.tools.live.names import NamedRegisters
from regscribe_runtime.operations.prepared_read import laid_out
from regscribe_runtime.planning import plan
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import Block, Plan, Planned, SplitReason, Terms
from regscribe_runtime.planning.read_order import ReadOrder
from regscribe_runtime.planning.read_places import read_places
from regscribe_runtime.values.blocks import bases_in
from regscribe_runtime.values.serial_line import FORMATS, SerialLine
from regscribe_runtime.values.terms import registers_in

COLUMNS = ("FC", "ADDRESSES", "WANTED", "CARRIED", "BYTES", "MS", "APART BECAUSE", "REGISTERS")
MOST_NAMED = 3
"""Registers of a request that the table names."""


@click.command(
    epilog="Example: regscribe plan fdc/series-100 --model C21 --group setpoints --baud 19200\n\n"
    "Exit code 0: done, 1: errors in the map, 2: wrong usage.",
)
@click.argument("map_name", metavar="MAP", shell_complete=complete_map)
@click.argument("ids", nargs=-1, metavar="[ID]...")
@click.option("--model", metavar="M", help="The model that answers, where the map has several.")
@click.option("--group", "groups", multiple=True, metavar="ID", help="All registers of a group (repeatable).")
@click.option("--all", "everything", is_flag=True, help="All registers.")
@click.option("--baud", type=click.IntRange(min=50, max=10_000_000), help="Speed of the line; default: as delivered.")
@click.option(
    "--line-format", "form", metavar="8N1", help="Characters: data bits, parity, stop bits; default: as delivered."
)
@click.option("--ascii", "framing", flag_value="ascii", default="rtu", help="ASCII instead of RTU frames.")
@click.option("--tcp", is_flag=True, help="Over TCP; with --baud through a gateway to such a line.")
@click.option("--remembered", is_flag=True, help="Without the registers that the meaning of others depends on.")
@base_option
@click.option("--with", "state", multiple=True, metavar="NAME=VALUE", help="What a register holds (repeatable).")
@json_option
def command(  # noqa: PLR0913 - one parameter an option
    *,
    map_name: str,
    ids: tuple[str, ...],
    model: str | None,
    groups: tuple[str, ...],
    everything: bool,
    baud: int | None,
    form: str | None,
    framing: str,
    tcp: bool,
    remembered: bool,
    bases: tuple[str, ...],
    state: tuple[str, ...],
    as_json: bool,
) -> None:
    """Show the requests that read registers of a model at the least cost on a line, and why they are not one.

    ID is a register, a group, an array or element of one, a computed value, or an address, as `read` takes them; MAP
    is a map file or the id of a map (fdc/series-100). The plan is
    that of the model's driver on such a line, in the order of sending: what the meaning of others depends on (decimals,
    input type, word order) is read behind them. Times are the expected ones: the mean of the
    manual's shortest and longest. Where a device tells the base of blocks, an assumed one counts unless --base says
    it; a driver finds them by requests of its own, once per connection. Registers that exist under a condition are
    left out where it does not hold by --with, or else by the defaults of the map. A packed array has all its elements.
    """
    (register_map,) = compiled_maps([find_map(map_name)], nothing="nothing is planned")
    subject = _subject(register_map, model, bases)
    wanted = _selected(subject, ids, groups, everything=everything)
    held = dict(_held(subject, text) for text in state)
    _refuse_fewer_packed(subject, held)
    absent = subject.absent(subject.known(register_map, held))
    terms = subject.terms(_cost(subject, baud, form, framing, tcp=tcp), absent)
    gone = [path for path in wanted if path in absent]
    wanted = [path for path in wanted if path not in absent]
    selected = [subject.registers[path] for path in wanted]
    layout, read, _ = laid_out(subject.registers, selected, terms, fresh=not remembered, gone=absent)
    read = {path: one for path, one in read.items() if path not in absent}
    spans = [read_places(register)[0].span for register in read.values()]
    found = plan.explain(layout.blocks, terms, again=layout.again)
    also = list(read)[len(wanted) :]
    report = _PlanReport(layout, list(read), terms, found, plan.one_by_one(spans, terms))
    if as_json:
        missing = {"absent": gone} if gone else {}
        print_json(map=register_map.id, model=subject.model.name, also=also, **missing, **report.plain())
    else:
        report.print(f"{register_map.title} {subject.model.name}", also)
        if gone:
            tell(f"left out, since they do not exist then: {', '.join(gone)}\n")


def _held(subject: PlannedModel, text: str) -> tuple[str, Fraction]:
    """The path and the number of `NAME=VALUE`; a member of an enum by its id."""
    path, equals, value = text.partition("=")
    register = subject.registers.get(path)
    if not equals or register is None:
        refuse(f"--with {text}: write NAME=VALUE, NAME being a register of {subject.model.name}")
    members = register.enum.codes if register.enum else {}
    if value.lower() in members:
        return path, Fraction(members[value.lower()])
    with raised_as(click.UsageError, ValueError):
        return path, parse(value)


def _refuse_fewer_packed(subject: PlannedModel, held: Mapping[str, Fraction]) -> None:
    """A plan has what stands behind a packed array where it stands behind all elements."""
    for array in arrays_in(subject.model.members):
        number = held.get(array.counted, array.count)
        if array.packed and number < array.count:
            what = f"{number} of the {array.count} elements of `{array.id}`, which is packed"
            refuse(f"--with {array.counted}={number}: {what}; a plan is made for a device that has them all")


def _subject(register_map: RegisterMap, wanted: str | None, bases: Sequence[str]) -> PlannedModel:
    names = {one.name.casefold(): one.name for one in register_map.models}
    model = wanted or register_map.only_model
    if not model:
        refuse(f"--model is missing: {register_map.id} has {', '.join(names.values())}")
    if model.casefold() not in names:
        refuse(unknown("model", model, names.values(), where=f"in {register_map.id}"))
    with raised_as(click.UsageError, ValueError):
        stated = bases_in(register_map.id, register_map.blocks, bases)
    return PlannedModel.of(register_map, names[model.casefold()], stated)


def _selected(subject: PlannedModel, ids: Sequence[str], groups: Sequence[str], *, everything: bool) -> list[str]:
    if everything == any((ids, groups)):
        refuse("say what to read: --all, --group ID, or ids of registers")
    if everything:
        return subject.readable
    known = _names(subject)
    for group in groups:
        if group not in known.groups:
            refuse(unknown("group", group, known.groups, where=f"of {subject.model.name}"))
    with raised_as(click.UsageError, TargetError):
        chosen = [choice for name in (*groups, *ids) for choice in known.choices(name)]
    for choice in chosen:
        if choice.note:
            remark(choice.note)
    return list(dict.fromkeys(path for one in chosen for path in known.computed.get(one.path, (one.path,))))


def _names(subject: PlannedModel) -> NamedRegisters:
    """What registers of a model are called, as the commands that ask a device call them."""
    registers, model = subject.registers, subject.model
    return NamedRegisters(
        model=model.name,
        registers=registers,
        groups={one.id: below for one in model.groups if (below := _below(subject.readable, one.members))},
        computed={one.id: registers_in(one.term) for one in model.computed},
        parts=lambda path: [part.id for part in registers[path].fields] if path in registers else (),
    )


def _below(paths: Iterable[str], members: Sequence[str]) -> list[str]:
    heads = tuple(f"{one}{end}" for one in members for end in "[.")
    return [path for path in paths if path in members or path.startswith(heads)]


def _cost(subject: PlannedModel, baud: int | None, form: str | None, framing: str, *, tcp: bool) -> Cost:
    protocol, serial = subject.protocol, subject.protocol.serial
    if form is not None and form not in FORMATS:
        refuse(f"--line-format {form}: write data bits (7, 8), parity (N, E, O) and stop bits (1, 2), for example 8E1")
    _remark_unlisted("baud", baud, serial.bauds)
    _remark_unlisted("characters", form, serial.formats)
    if not tcp:
        return Cost.serial(protocol, baud=baud or 0, form=form or "", framing=framing)
    behind = SerialLine.of("", baud or serial.baud, form or serial.format) if baud or form else None
    return Cost.tcp(protocol, line=behind, framing=framing)


def _remark_unlisted(what: str, value: object, listed: Sequence[object]) -> None:
    if value is not None and listed and value not in listed:
        remark(f"the manual does not list {value} {what}: {', '.join(map(str, listed))}")


class _PlanReport:
    """A plan as a table for people, and as JSON."""

    def __init__(self, layout: ReadOrder, paths: Sequence[str], terms: Terms, found: Plan, one_by_one: Plan) -> None:
        self.terms, self.found, self.one_by_one = terms, found, one_by_one
        names: list[list[str]] = [[] for _ in layout.blocks]
        for path in paths:
            for number in dict.fromkeys(held[path].block for held in (layout.places, layout.checks) if path in held):
                names[number].append(path)
        of_reads = iter(
            [own for own, block in zip(names, layout.blocks, strict=True) for _ in plan.as_sent(block, terms)]
        )
        self.names = [next(of_reads) if one.block.items else [] for one in found.requests]

    def print(self, title: str, also: Sequence[str]) -> None:
        """Print the requests as a table, the totals, and the cost of one request for each register."""
        rows = [self._row(one, names) for one, names in zip(self.found.requests, self.names, strict=True)]
        head = [] if sys.stdout.isatty() else [COLUMNS]  # for people in any case: programs ask for --json
        cost, found = self.terms.cost, self.found
        line, way = cost.line, "TCP" if cost.round_trip else ""
        serial = f"{line.baud} baud, {line.bits} bits a character, {cost.framing.upper()}" if line else ""
        show_table(COLUMNS, [*head, *rows], title=f"{title}, {' to '.join(filter(None, (way, serial)))}")
        total = f"{count(len(found.requests), 'request')}, {found.wanted} addresses wanted, {found.carried} carried"
        single = f"{count(len(self.one_by_one.requests), 'request')}, {self.one_by_one.ms:.1f} ms"
        ratio = self.one_by_one.ms / found.ms if found.ms else 1
        tell(f"{total}, {found.bytes} bytes, {found.ms:.1f} ms\n")
        tell(f"one request a register: {single}, {ratio:.1f} times as long\n")
        if also:
            tell(f"read along, since the meaning of others depends on it: {', '.join(also)}\n")

    def _span(self, block: Block) -> str:
        first, last = (self.terms.spelled(block.space, at) for at in (block.address, block.end - 1))
        return span_words(first, last, "..")

    def _row(self, one: Planned, names: Sequence[str]) -> tuple[str, ...]:
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        block = one.block
        reason = "" if one.split.reason is SplitReason.FIRST else str(one.split.reason)
        return (
            f"{block.function:02d}",
            self._span(block),
            str(one.wanted),
            str(one.quantity),
            str(one.bytes),
            f"{one.ms:.1f}",
            f"{reason} ({one.split.detail})" if one.split.detail else reason,
            ", ".join(names[:MOST_NAMED]) + more,
        )

    def plain(self) -> dict[str, object]:
        """Members of the JSON object; times in milliseconds."""
        found, cost = self.found, self.terms.cost
        line = {"baud": cost.line.baud, "bits": cost.line.bits, "framing": cost.framing} if cost.line else {}
        return {
            "line": {"tcp": bool(cost.round_trip), **line},
            "requests": [
                {
                    "function": one.block.function,
                    **one.block.space.facts(one.block.address),
                    "quantity": one.quantity,
                    "wanted": one.wanted,
                    "bytes": one.bytes,
                    "ms": round(one.ms, 3),
                    "apart": {"because": str(one.split.reason), "detail": one.split.detail},
                    "registers": names,
                    **({"words": list(one.words)} if one.words else {}),
                }
                for one, names in zip(found.requests, self.names, strict=True)
            ],
            "total": {"requests": len(found.requests), "wanted": found.wanted, "carried": found.carried}
            | {"bytes": found.bytes, "ms": round(found.ms, 3)},
            "one_by_one": {"requests": len(self.one_by_one.requests), "ms": round(self.one_by_one.ms, 3)},
        }
