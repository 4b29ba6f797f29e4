"""What long declarations of one group have in common, as a constant that they unpack: `**_CALIBRATION`."""

from collections.abc import Iterable, Mapping, Sequence

from regscribe.emit.python.constants import Pool
from regscribe.emit.python.formatting import Call, Expression, lay, mapping
from regscribe.emit.python.literals import literal
from regscribe.model import Model, Register

ENOUGH_LINES = 3
"""A declaration of at most so many lines is left as it is."""
FEWEST = 2
"""So many registers must have so many facts in common."""
Facts = Sequence[tuple[str, Expression]]


def with_group_facts(
    registers: Sequence[Register], calls: Mapping[str, Call], pool: Pool, model: Model
) -> dict[str, Call]:
    """The declarations of registers by id; long ones unpack what those of their group have in common."""
    found = dict(calls)
    for group_id in dict.fromkeys(register.group for register in registers):
        own = {one.id: calls[one.id] for one in registers if one.group == group_id}
        lines = {name: _lines(name, call) for name, call in own.items()}
        common = _shared_facts([own[name] for name, count in lines.items() if count > ENOUGH_LINES])
        if common:
            facts = mapping([(literal(key.removesuffix("=")), value) for key, value in common])
            constant = pool.share(facts, group_id, f"{group_id}_{model.name}", type_name="dict[str, Any]")
            alike = [name for name, count in lines.items() if count > 1 and set(common) <= set(own[name].items)]
            found |= {name: _without(own[name], common, constant) for name in alike}
    return found


def _shared_facts(calls: Sequence[Call]) -> Facts:
    """What the calls have in common, if these are enough of both."""
    common = _common(calls)
    return common if min(len(calls), len(common)) >= FEWEST else ()


def _lines(name: str, call: Call) -> int:
    return len(lay(call, head=f"{name} = ", depth=1))


def _common(calls: Iterable[Call]) -> Facts:
    """The keyword arguments that all calls have, in the order of the first."""
    first, *others = [[item for item in call.items if item[0]] for call in calls] or [[]]
    return [item for item in first if all(item in other for other in others)]


def _without(call: Call, facts: Facts, name: str) -> Call:
    """The call with the facts unpacked from a constant."""
    own = tuple(item for item in call.items if item not in facts)
    return Call(call.opening, (*own, ("", f"**{name}")), call.closing)
