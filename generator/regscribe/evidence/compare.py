"""A map against a second transcription, or against another map: what only one side has, and which cells differ."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches

from regscribe.emit.words import one_line
from regscribe.evidence.cell_compare import differing
from regscribe.evidence.columns import Columns, choose, fold
from regscribe.evidence.differences import CellDifference, Comparison
from regscribe.evidence.row_matching import Matching, match
from regscribe.evidence.rows import ComparedRow, Spot, of_map, of_table
from regscribe.evidence.table import Table, TableError
from regscribe.export.csv import COLUMNS
from regscribe.model import RegisterMap

OF_BASE = frozenset({"address", "aliases", "views", "id"})
"""Columns in which a row at an alias describes the alias and not the register."""


def compare_table(
    register_map: RegisterMap,
    table: Table,
    *,
    columns: Sequence[str] = (),
    model: str = "",
    loose: bool = False,
    partial: bool = False,
) -> Comparison:
    """Hold a map against a table that has columns of the export (see docs/evidence.md).

    `columns` are those to compare (`name`, or `name=header` where the table calls it otherwise; none: all of the
    table), `model` the only one to look at, `loose` as in `differing`; with `partial` the table need not have every
    register. Raises TableError where the table cannot be compared.
    """
    notations = tuple(dict.fromkeys(notation.name for notation in register_map.notations))
    chosen = choose(table, columns, notations)
    keys = ["address", *notations, "id"]
    if chosen.at.keys().isdisjoint(map(fold, keys)):
        message = f"{table.name} has none of the columns {', '.join(keys)}: nothing tells which register a row is about"
        raise TableError(message)
    model = _model(register_map, table, chosen, model)
    theirs = list(of_table(table, chosen, register_map, model))
    notes = _other_maps(register_map, table, chosen) + _other_models(register_map, theirs)
    ours = [entry for entry in of_map(register_map) if not model or entry.model == model]
    matching = match(ours, theirs, name=table.name)
    lists_commands = "kind" in chosen.at  # a table without it lists registers: a command in it is a chance
    expected = [entry for entry in matching.only_ours if lists_commands or not entry.is_command]
    matching.only_ours = [] if partial else expected
    notes += _drop_silent_rows(matching, register_map)
    return _comparison(matching, (register_map.id, table.name), chosen.compared, notes, loose=loose)


def compare_maps(
    ours: RegisterMap,
    theirs: RegisterMap,
    *,
    pairs: Mapping[str, str] | None = None,
    columns: Sequence[str] = (),
    loose: bool = False,
) -> Comparison:
    """Hold two maps against each other, model by model, in the columns of the export (`columns`: only these).

    `pairs` names the models that belong together, ours first; without it models of the same name do, and the others in
    their order. Raises TableError where the models cannot be paired so, or for a column that the export has not.
    """
    paired = dict(pairs) if pairs else _paired(ours, theirs)
    labels = {left: left if left == right else f"{left} = {right}" for left, right in paired.items()}
    chosen = choose(Table("the export", COLUMNS, ()), columns, ()).compared
    matching = match(
        _of_models(ours, labels),
        _of_models(theirs, {right: labels[left] for left, right in paired.items()}),
        name=theirs.id,
    )
    unpaired = [
        f"{one.id}: not compared: {', '.join(names)}"
        for one, used in ((ours, paired.keys()), (theirs, paired.values()))
        if (names := [model.name for model in one.models if model.name not in used])
    ]
    return _comparison(matching, (ours.id, theirs.id), chosen, unpaired, loose=loose)


def _of_models(register_map: RegisterMap, labels: Mapping[str, str]) -> list[ComparedRow]:
    """The rows of the models among `labels`, under the label of each."""
    names = {one_line(name): label for name, label in labels.items()}
    return [replace(entry, model=names[entry.model]) for entry in of_map(register_map) if entry.model in names]


def _paired(ours: RegisterMap, theirs: RegisterMap) -> dict[str, str]:
    left, right = ([model.name for model in one.models] for one in (ours, theirs))
    lone_left, lone_right = [name for name in left if name not in right], [name for name in right if name not in left]
    if len(lone_left) != len(lone_right):
        message = (
            f"{ours.id} has {', '.join(left)} and {theirs.id} has {', '.join(right)}: say which belong together, for "
            f"example --pair {left[-1]}={right[-1]}"
        )
        raise TableError(message)
    others = dict(zip(lone_left, lone_right, strict=True))
    return {name: others.get(name, name) for name in left}


def _comparison(
    matching: Matching, sides: tuple[str, str], columns: tuple[str, ...], notes: Sequence[str], *, loose: bool
) -> Comparison:
    """The result for matched rows of two sides, ours first."""
    columns_at_alias = tuple(column for column in columns if column in COLUMNS and column not in OF_BASE)
    found = [each for pair in matching.pairs for each in _differences(*pair, columns=columns, loose=loose)]
    found += [each for pair in matching.by_alias for each in _differences(*pair, columns=columns_at_alias, loose=loose)]
    return Comparison(
        ours=sides[0],
        theirs=sides[1],
        columns=columns,
        matched=len(matching.pairs) + len(matching.by_alias),
        only_ours=tuple(entry.place for entry in matching.only_ours),
        only_theirs=tuple(entry.place for entry in matching.only_theirs),
        differences=tuple(found),
        notes=tuple(notes),
    )


def _differences(
    ours: ComparedRow, theirs: ComparedRow, *, columns: Iterable[str], loose: bool
) -> Iterator[CellDifference]:
    for column in columns:
        left, right = ours.cells.get(column, ""), theirs.cells[column]
        if column == "space" and not right.strip():
            continue  # a row that leaves the space open was looked for in all of them
        if apart := differing(column, left, right, loose=loose):
            yield CellDifference(replace(ours.place, line=theirs.line), column, *apart)


def _drop_silent_rows(matching: Matching, register_map: RegisterMap) -> list[str]:
    """Take out the rows that name no register where the map has none, and note how many there are."""
    silent = _spots_without_register(register_map)
    kept = [
        row
        for row in matching.only_theirs
        if not row.is_silent or not any((row.model, spot) in silent for spot in row.spots)
    ]
    count = len(matching.only_theirs) - len(kept)
    matching.only_theirs = kept
    return [f"{count} rows name no register where the map has none (unused, reserved or a further word)"] * bool(count)


def _spots_without_register(register_map: RegisterMap) -> set[tuple[str, Spot]]:
    """Return model and spot (also without its space) of each address that is listed, but begins no register."""
    found: set[tuple[str, Spot]] = set()
    for model in register_map.models:
        name = one_line(model.name)
        in_words = [register for register in model.registers if not register.base.space.is_bits]
        further = [(one.base.space, one.address + 1, one.base.last(one.at)) for one in in_words]
        for space, first, last in (*model.unused, *register_map.reserved, *further):
            found.update((name, (own, address)) for address in range(first, last + 1) for own in (space.value, ""))
    return found


def _model(register_map: RegisterMap, table: Table, chosen: Columns, model: str) -> str:
    """Return the model to look at; empty for all of them."""
    names = [one_line(one.name) for one in register_map.models]
    if model and one_line(model) not in names:
        message = f"{register_map.id} has no model `{model}`{_meant(model, names)}"
        raise TableError(message)
    if model or "model" in chosen.at:
        return one_line(model)
    if len(names) > 1:
        message = (
            f"{table.name} has no column `model`, and {register_map.id} has {', '.join(names)}: name one with --model"
        )
        raise TableError(message)
    return names[0]


def _other_maps(register_map: RegisterMap, table: Table, chosen: Columns) -> list[str]:
    """Note how many rows are of other maps; TableError if all are."""
    column = chosen.at.get("map")
    maps = [row.cells[column].strip() for row in table.rows] if column is not None else []
    others = [name for name in maps if name != register_map.id]
    listed = ", ".join(dict.fromkeys(others))
    if others and len(others) == len(maps):
        message = f"{table.name} has no row of the map {register_map.id}, but of {listed}"
        raise TableError(message)
    return [f"left out: {len(others)} rows of other maps ({listed})"] if others else []


def _other_models(register_map: RegisterMap, rows: Iterable[ComparedRow]) -> list[str]:
    names = [one_line(model.name) for model in register_map.models]
    foreign = dict.fromkeys(row.model for row in rows if row.model not in names)
    return [f"{register_map.id} has no model `{name}`{_meant(name, names)}" for name in foreign]


def _meant(name: str, names: Sequence[str]) -> str:
    near = get_close_matches(name, names, n=1, cutoff=0.5)
    return f"; did you mean `{near[0]}`?" if near else f": it has {', '.join(names)}"
