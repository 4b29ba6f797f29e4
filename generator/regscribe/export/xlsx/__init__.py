"""The exporter of a workbook: a sheet for each model, with the columns that people's own lists have.

`regscribe import` recognises its headings, so that a list can be exported, edited and read back. The same maps give the
same bytes.
"""

from collections.abc import Iterator, Mapping, Sequence

from regscribe.export.csv import carries as carries
from regscribe.export.csv import losses, rows
from regscribe.export.device.options import CHOICE, MODEL, chosen, model_of
from regscribe.export.xlsx.columns import Line
from regscribe.export.xlsx.workbook import Sheet, workbook
from regscribe.losses import Exported, Grade, Loss
from regscribe.model import Model, RegisterMap

name = "xlsx"
summary = "a workbook of register lists for people, which can be imported again"
options = (MODEL, *CHOICE)
verified = "openpyxl 3.1"


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the workbook as bytes. Raises OptionError."""
    sheets = [sheet for one in maps for sheet in _sheets(one, options)]
    titles = ", ".join(f"{one.title} ({one.id})" for one in maps)
    data, cut = workbook(sheets, titles)
    shortened = [
        Loss(path, fact, Grade.LOST, f"cut after {length} characters: a cell holds no more", model)
        for model, path, fact, length in cut
    ]
    return Exported({"": data}, (*shortened, *losses(maps)))


def _sheets(register_map: RegisterMap, options: Mapping[str, str]) -> Iterator[Sheet]:
    models = [model_of(register_map, options["model"])] if options["model"] else list(register_map.models)
    every = {(row.model, row.id): row for row in rows([register_map])}
    for model in models:
        paths = _paths(model, options)
        lines = [
            Line(row, register, model)
            for path, register in [*((one.path, one) for one in model.registers), *_others(model)]
            if path in paths and (row := every.get((" ".join(model.name.split()), path)))
        ]
        yield Sheet(model.name, lines)


def _others(model: Model) -> Iterator[tuple[str, None]]:
    """What is no register: commands and computed values."""
    yield from ((command.id, None) for command in model.commands)
    yield from ((computed.id, None) for computed in model.computed)


def _paths(model: Model, options: Mapping[str, str]) -> set[str]:
    """The paths that were asked for; without a choice all, commands and computed values too."""
    groups, patterns = (options[key].split("\n") if options[key] else [] for key in ("group", "register"))
    if groups or patterns:
        return {one.path for one in chosen(model, groups, patterns)[0]}
    return {one.path for one in model.registers} | {path for path, _ in _others(model)}
