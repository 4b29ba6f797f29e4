"""Groups of registers: the class that declares them, and facts that long declarations of one group share."""

from collections import Counter
from collections.abc import Mapping, Sequence

from regscribe.emit.common_values import merge, merged_order
from regscribe.emit.python.constants import Pool
from regscribe.emit.python.formatting import Call, Expression, call, lay, mapping
from regscribe.emit.python.literals import literal
from regscribe.emit.words import one_line
from regscribe.model import Model, Register, RegisterMap

ENOUGH_LINES = 3
"""A declaration of at most so many lines is left as it is."""
FEWEST = 2
"""So many registers must have so many facts in common."""
Facts = Sequence[tuple[str, Expression]]


def groups_body(register_map: RegisterMap, homes: Mapping[str, str]) -> list[str]:
    """The declarations of groups, each with the members that any model has; `homes` are the classes of the members."""
    body: list[str] = []
    for merged in merge(register_map.models, lambda model: model.groups, lambda group: group.id):
        last = merged.versions[-1][1]
        members = merged_order([path.split("[")[0] for path in group.members] for _, group in merged.versions)
        declared = (f"{homes[member]}.{member}" for member in members)
        order = None if last.order is None else str(last.order)
        body += lay(call("Group", literal(one_line(last.name)), *declared, order=order), head=f"{last.id} = ", depth=1)
    return body


def with_group_facts(
    registers: Sequence[Register], calls: Mapping[str, Call], pool: Pool, model: Model
) -> dict[str, Call]:
    """The declarations of registers by id; long ones of a group unpack their common facts: `**_CALIBRATION`."""
    found = dict(calls)
    groups: dict[str, dict[str, Call]] = {}
    for register in registers:
        groups.setdefault(register.group, {})[register.id] = calls[register.id]
    for group_id, own in groups.items():
        lines = {name: len(lay(call, head=f"{name} = ", depth=1)) for name, call in own.items()}
        common = _common(own, lines)
        if len(common) >= FEWEST:
            facts = mapping([(literal(key.removesuffix("=")), value) for key, value in common])
            constant = pool.share(facts, group_id, f"{group_id}_{model.name}", type_name="dict[str, Any]")
            alike = [name for name, count in lines.items() if count > 1 and set(common) <= set(own[name].items)]
            found |= {name: _without(own[name], common, constant) for name in alike}
    return found


def _common(calls: Mapping[str, Call], lines: Mapping[str, int]) -> Facts:
    """The keyword arguments that all long calls have, if they are enough, in the order of the first."""
    long = [calls[name].items for name, count in lines.items() if count > ENOUGH_LINES]
    times = Counter(item for items in long for item in items if item[0])
    return [item for item, count in times.items() if count == max(len(long), FEWEST)]


def _without(call: Call, facts: Facts, name: str) -> Call:
    """The call with the facts unpacked from a constant."""
    own = tuple(item for item in call.items if item not in facts)
    return Call(call.opening, (*own, ("", f"**{name}")), call.closing)
