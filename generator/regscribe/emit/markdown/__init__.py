"""Reference docs in Markdown: a map in, `{path: text}` out; no clock, no environment, no order of sets."""

from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined

from regscribe.emit.header import header
from regscribe.emit.markdown.alt_text import address_map
from regscribe.emit.markdown.computed import computed
from regscribe.emit.markdown.context import context
from regscribe.emit.markdown.entries import commands, sections
from regscribe.emit.markdown.escape import Md, code, escape, join, link, md, prose
from regscribe.emit.markdown.examples import examples
from regscribe.emit.markdown.inherited import base, overrides
from regscribe.emit.markdown.overview import overview
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.markdown.process import assumptions, process
from regscribe.emit.markdown.programs import programs
from regscribe.emit.markdown.protocol import exceptions, faults, latency, line
from regscribe.emit.markdown.quickstart import quick_start
from regscribe.emit.markdown.transmission import (
    blocks,
    conditions,
    givens,
    identity,
    plain,
    reserved,
    unit_notes,
    units,
    unused,
    views,
)
from regscribe.emit.words import one_line
from regscribe.model import Manual, RegisterMap

__all__ = ["index_row", "render"]


def render(register_map: RegisterMap) -> dict[str, str]:
    """Return the reference of a map: CommonMark with tables, at `docs/<maker>/<family>.md`."""
    text = _environment().get_template("page.md.j2").render(page=_page(register_map))
    return {f"docs/{register_map.id}.md": text}


@cache
def _environment() -> Environment:
    """Return an environment that escapes every value for Markdown unless it is a `Md`."""
    return Environment(
        loader=PackageLoader("regscribe.emit.markdown", "templates"),
        autoescape=False,  # noqa: S701 (the output is Markdown: `finalize` escapes for it, HTML included)
        finalize=_ready,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
        auto_reload=False,
    )


def _ready(value: object) -> object:
    return escape(value) if isinstance(value, str) and not isinstance(value, Md) else value


def _page(register_map: RegisterMap) -> dict[str, object]:
    found = context(register_map)
    groups = sections(found)
    errata = ((one_line(one.where), *map(prose, (one.printed, one.read, one.why))) for one in register_map.errata)
    return {
        "header": Md(header(register_map, prefix="<!-- ", suffix=" -->")),
        "title": one_line(register_map.title),
        "paragraphs": (prose(register_map.description),) if register_map.description else (),
        "manual": _manual(register_map.manual),
        "models": _models(register_map),
        "identity": identity(found),
        "contents": tuple(link(group.name, group.anchor) for group in groups),
        "quick_start": quick_start(found),
        "line": line(found),
        "latency": latency(found),
        "givens": givens(found),
        "transmission": plain(found),
        "views": views(found),
        "blocks": blocks(found),
        "conditions": conditions(found),
        "units": units(found),
        "unit_notes": unit_notes(found),
        "address_map": address_map(found),
        "overview": overview(found),
        "reserved": reserved(found),
        "unused": unused(found),
        "groups": groups,
        "commands": commands(found),
        "computed": computed(found),
        "programs": programs(found),
        "process": process(found),
        "assumptions": assumptions(found),
        "faults": faults(found),
        "exceptions": exceptions(found),
        "examples": examples(found),
        "base": base(found),
        "overrides": overrides(found),
        "errata": table(("Where", "The manual says", "Read as", "Why"), errata),
        "notes": tuple(prose(note) for note in register_map.notes),
    }


def _manual(manual: Manual) -> Md:
    facts = (manual.number, manual.date, manual.publisher)
    title = md(Md("*"), one_line(manual.title), Md("*"))
    return join(", ", (title, *(escape(one_line(fact).removesuffix(".")) for fact in facts)))


def _models(register_map: RegisterMap) -> PageTable:
    headers = ("Model", "Class", "Values", "Commands", "Remark")
    rows = (
        (
            one_line(model.name),
            code(model.class_name),
            str(len(model.registers)),
            str(len(model.commands)),
            prose(model.description),
        )
        for model in register_map.models
    )
    return table(headers, rows)


def index_row(register_map: RegisterMap) -> tuple[str, ...]:
    """Return the row of a map in the list of all references: link, maker, models, registers at most, manual."""
    return (
        md(Md("["), one_line(register_map.title), Md(f"]({register_map.id}.md)")),
        escape(one_line(register_map.maker)),
        escape(", ".join(one_line(model.name) for model in register_map.models)),
        str(max((len(model.registers) for model in register_map.models), default=0)),
        _manual(register_map.manual),
    )
