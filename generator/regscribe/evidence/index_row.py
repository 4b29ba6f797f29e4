"""A map's part of the index of the reference docs: Markdown cells of its coverage."""

from collections.abc import Iterator

from regscribe.emit.docs_index import Card
from regscribe.emit.markdown import index_row
from regscribe.emit.markdown.escape import Md, code, escape, join, md, prose
from regscribe.evidence.coverage import coverage
from regscribe.evidence.coverage_values import Addresses, MapCoverage, counts
from regscribe.model import RegisterMap


def card(register_map: RegisterMap) -> Card:
    """Return what the index says of a map."""
    found = coverage(register_map)
    family = md(Md("["), found.title, Md(f"]({found.id}.md)"))
    return Card(
        id=register_map.id,
        family=tuple(map(str, index_row(register_map))),
        sums=(family, *map(str, counts(found))),
        facts=tuple((family, escape(model.name), *map(str, counts(model))) for model in found.models),
        addresses=tuple((family, *row) for row in _addresses(found)),
        remarks=tuple(
            (family, one.kind, join(", ", map(code, one.at)), escape(", ".join(one.models)), prose(one.text))
            for one in found.remarks
        ),
    )


def _addresses(found: MapCoverage) -> Iterator[tuple[str, ...]]:
    """Yield a row for each space; models with the same numbers share it."""
    models: dict[Addresses, list[str]] = {}
    for model in found.models:
        for addresses in model.addresses:
            models.setdefault(addresses, []).append(model.name)
    for item, names in models.items():
        yield (escape(", ".join(names)), item.space, *map(str, counts(item)))
