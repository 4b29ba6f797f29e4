"""The page of a map and the list of all pages, ready for the templates."""

from regscribe.emit.header import header
from regscribe.emit.markdown.alt_text import address_map
from regscribe.emit.markdown.context import PageContext, context
from regscribe.emit.markdown.entries import commands, sections
from regscribe.emit.markdown.escape import Md, code, escape, join, link, md, prose
from regscribe.emit.markdown.examples import examples
from regscribe.emit.markdown.inherited import base, overrides, unused
from regscribe.emit.markdown.overview import overview
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.markdown.process import assumptions, process
from regscribe.emit.markdown.programs import programs
from regscribe.emit.markdown.protocol import exceptions, faults, latency, line
from regscribe.emit.markdown.quickstart import quick_start
from regscribe.emit.markdown.transmission import conditions, givens, identity, plain, reserved, units, views
from regscribe.emit.words import one_line
from regscribe.model import Manual, RegisterMap


def page(register_map: RegisterMap) -> dict[str, object]:
    """Return everything that the reference of a map shows, by the names in the template."""
    found = context(register_map)
    groups = sections(found)
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
        "conditions": conditions(found),
        "units": units(found),
        "address_map": address_map(found),
        "overview": overview(found),
        "reserved": reserved(found),
        "unused": unused(found),
        "groups": groups,
        "commands": commands(found),
        "programs": programs(found),
        "process": process(found),
        "assumptions": assumptions(found),
        "faults": faults(found),
        "exceptions": exceptions(found),
        "examples": examples(found),
        "base": base(found),
        "overrides": overrides(found),
        "errata": _errata(found),
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


def _errata(found: PageContext) -> PageTable:
    rows = ((one_line(item.where), prose(item.printed), prose(item.read), prose(item.why)) for item in found.map.errata)
    return table(("Where", "The manual says", "Read as", "Why"), rows)


def index_row(register_map: RegisterMap) -> tuple[str, ...]:
    """Return what the list of all references says of a map, ready: link, maker, models, registers at most, manual."""
    return (
        md(Md("["), one_line(register_map.title), Md(f"]({register_map.id}.md)")),
        escape(one_line(register_map.maker)),
        escape(", ".join(one_line(model.name) for model in register_map.models)),
        str(max((len(model.registers) for model in register_map.models), default=0)),
        _manual(register_map.manual),
    )
