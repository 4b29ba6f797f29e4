"""The cases as exporters see them: registers as points of a form, while the device holds what a row says."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from regscribe.export.device import Device, LeftOutError, Place, Point, Request, Target
from regscribe.export.device.points import point_of
from regscribe.model import Layout, Register
from regscribe.model.located import layout_of, located
from regscribe.reference import holds

from . import judges
from .suite import Built, Case, Json, cases, diagnose, whole_map, words_of
from .wire import Memory


@dataclass(frozen=True, slots=True)
class Asked:
    """A row of a case that a form can say: its register, and the device with the one point."""

    case: str
    row: Json
    register: Register
    device: Device
    point: Point

    @property
    def words(self) -> list[int]:
        """The words (or the bit) of the row."""
        return words_of(self.row["words"])


def compiled_cases() -> list[tuple[Case, Built]]:
    """Each case as it is written, with its map; a driver is not needed."""
    return [(case, _compiled(case)) for case in cases() if not case.refused and not case.place]


def _compiled(case: Case) -> Built:
    register_map, found = diagnose(whole_map(case.map))
    assert register_map is not None, found
    (model,) = register_map.models
    layout = layout_of(register_map, model, {})
    placed = replace(register_map, models=(located(model, layout),)) if layout.headers else register_map
    return Built(placed, None)


def reads(target: Target, case: Case, built: Built) -> Iterator[Asked]:
    """The rows whose words are read."""
    for row in case.rows:
        if "words" not in row or row.get("only") == "write":
            continue
        memory = Memory()  # a point is worked out when it is needed
        register, view = judges.register_of(built, row)
        case.prepare(memory, row.get("holds", {}))
        memory.put(view.space.value, view.address(register.at), words_of(row["words"]))
        yield from _asked(target, case, built, memory, row, writes=False)


def writes(target: Target, case: Case, built: Built) -> Iterator[Asked]:
    """The rows whose value is written, or refused for its own sake."""
    not_sent = {"fault", "no_value", "unknown", "unnamed", "shows", "flags", "fields", "rounded"}
    for row in case.rows:
        if row.get("only") == "read" or not_sent & set(row) or _is_odd(built, row):
            continue
        memory = Memory()
        case.prepare(memory, row.get("holds", {}))
        for one in _asked(target, case, built, memory, row, writes=True):
            condition = one.register.writable
            if one.register.access.writable and (not condition or holds(condition.when, one.device.request.known)):
                yield one


def _asked(target: Target, case: Case, built: Built, memory: Memory, row: Json, *, writes: bool) -> Iterator[Asked]:
    """A row, unless the form leaves the register out."""
    register, view = judges.register_of(built, row, writes=writes)
    known = judges.Present(built, memory).known
    (model,) = built.map.models
    request = Request(
        register_map=built.map,
        model=model,
        layout=Layout({}, {}),
        registers=(register,),
        named=frozenset({register.path}),
        known=known,
        unit=1,
        name="device",
        every=10,
        place=Place(unit=1, host="h"),
    )
    try:
        point = point_of(replace(register, views=(view,)), known, target.carries, target.fits)
    except LeftOutError:
        return
    if not target.refuses(point, request):
        yield Asked(case.name, row, register, Device(request, target, (point,)), point)


def _is_odd(built: Built, row: Json) -> bool:
    """Whether a value is one that no program of the field has, or a text for a number, which some take."""
    value = row.get("refuses")
    return (isinstance(value, str) and value in {*judges.NO_NUMBERS, *judges.FAR}) or judges.of_another_sort(built, row)


def label_of(asked: Asked) -> str:
    """The label of the fault or the special value that a row names."""
    named = asked.row.get("fault", asked.row.get("special"))
    return next(one.label for one in (*asked.register.sentinels, *asked.register.specials) if one.id == named)


def code_of(asked: Asked) -> int:
    """The code of the member that a row names."""
    assert asked.register.enum is not None
    place, _, name = asked.row["member"].rpartition(".")
    members = asked.register.enum.each[int(place or 1) - 1].members
    return next(one.code for one in members if one.id == name)
