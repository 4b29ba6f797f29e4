"""Keys without effect where they stand, which are reported so that nobody relies on them."""

from collections.abc import Callable
from typing import NamedTuple

from regscribe.lower.node import Value
from regscribe.lower.rules import IDLE_DEFAULT, IDLE_KEY
from regscribe.lower.scales import NOT_STATED
from regscribe.lower.tree import TreeNode
from regscribe.model import Access, Kind, Register, Space
from regscribe_runtime.values.kinds import MOMENTS, OCTETS

_CODES = OCTETS | {Kind.ENUM, Kind.FLAGS, Kind.FIELDS, Kind.VERSION, Kind.BOOLEAN}
_LASTING = frozenset({"eeprom", "both"})


class Idle(NamedTuple):
    """Keys, when they have no effect, why not (after "but "), and what to do."""

    keys: frozenset[str]
    when: Callable[[Register, TreeNode], bool]
    why: str
    remedy: str


TABLE: tuple[Idle, ...] = (
    Idle(
        frozenset({"special", "difference", "step", "range", "range_decimals", "valid"}),
        lambda register, _: register.kind in _CODES,
        "its values are no numbers",
        "remove it, or correct what makes codes, bits or a text of the register",
    ),
    Idle(
        frozenset({"unit"}),
        lambda register, _: register.kind in _CODES - {Kind.ENUM},
        "its values are no numbers",
        "remove it, or correct what makes bits, a text or a version of the register",
    ),
    Idle(
        frozenset({"text"}),
        lambda register, _: register.kind is not Kind.STRING,
        "its values are no texts",
        "remove it, or write `type: string`",
    ),
    Idle(
        frozenset({"layout"}),
        lambda register, _: register.kind not in MOMENTS,
        "its values are no dates and no times",
        "remove it, or write `type: datetime`, `date` or `time`",
    ),
    Idle(
        frozenset({"version"}),
        lambda register, _: register.kind is not Kind.VERSION,
        "it is of another kind",
        "remove it, or write `kind: version`",
    ),
    Idle(
        frozenset({"decimals"}),
        lambda register, entry: entry.settings["decimals"].value == NOT_STATED and register.kind is not Kind.RAW,
        "`not_stated` makes raw numbers, and it is of another kind",
        "remove one of `decimals` and what gives the kind",
    ),
    Idle(
        frozenset({"range_decimals"}),
        lambda register, _: not register.range and not any(special.code for special in register.specials),
        "there are neither limits nor special values to divide",
        "remove it, or give the `range`",
    ),
    Idle(
        frozenset({"sentinels"}),
        lambda register, _: not register.access.readable,
        "it is never read, and a fault is something that is read",
        "remove them, or correct `access`",
    ),
    Idle(
        frozenset({"step"}),
        lambda register, _: not register.access.writable,
        "it is never written",
        "remove it, or correct `access`",
    ),
    Idle(
        frozenset({"danger"}),
        lambda register, _: not register.access.writable,
        "it is never written",
        "remove it, or correct `access`",
    ),
    Idle(
        frozenset({"reading", "poll", "good_for"}),
        lambda register, _: not register.access.readable,
        "it is never read",
        "remove it, or correct `access`",
    ),
    Idle(
        frozenset({"static"}),
        lambda register, _: not register.static,
        "that is so without it",
        "remove it",
    ),
    Idle(
        frozenset({"poll", "good_for"}),
        lambda register, _: register.reading.clears,
        "what reading clears is read only where it is asked for",
        "remove one of them",
    ),
    Idle(
        frozenset({"write_at", "write"}),
        lambda register, _: register.access is not Access.READ_WRITE,
        "it is not both read and written",
        "remove it (where only one is done, `at` and `space` say where), or correct `access`",
    ),
    Idle(
        frozenset({"write_at"}),
        lambda _, entry: "write" in entry.settings and entry.settings["write"].child("at") is not None,
        "`write` says `at`",
        "remove one of them",
    ),
    Idle(
        frozenset({"endurance"}),
        lambda register, _: register.access.writable and register.persistence not in {*_LASTING, "ram"},
        "`persistence` does not say that writing wears it out",
        "add `persistence: eeprom` (or `both`), or remove it",
    ),
    Idle(
        frozenset({"difference"}),
        lambda register, _: not register.unit_id,
        "its unit never changes, so nothing is converted",
        "remove it, or give the `unit` cases",
    ),
    Idle(
        frozenset({"file"}),
        lambda register, _: register.base.space is not Space.FILE,
        "it is no record of a file",
        "remove it, or write `space: file`",
    ),
    Idle(
        frozenset({"queue"}),
        lambda register, _: register.base.space is not Space.QUEUE,
        "it is in no queue",
        "remove it, or write `space: queue`",
    ),
    Idle(
        frozenset({"word_order"}),
        lambda register, entry: register.base.words == 1 and "views" not in entry.settings,
        "its value is one word",
        "remove it; `byte_order` orders the bytes of a word",
    ),
    Idle(
        frozenset({"word_order"}),
        lambda _, entry: "at" in entry.settings and entry.settings["at"].is_list,
        "`at` lists the address of each word, that of the most significant first",
        "remove it",
    ),
    Idle(
        frozenset({"byte_order"}),
        lambda register, entry: register.base.is_byte and "views" not in entry.settings,
        "its value is one byte",
        "remove it; `byte: high` is the upper one",
    ),
    Idle(
        frozenset({"byte"}),
        lambda register, entry: not register.base.is_byte and "views" not in entry.settings,
        "its value is no byte of a word",
        "remove it, or write `type: uint8` or `int8`",
    ),
)
"""The keys that may be without effect, and when they are."""


def report_idle_keys(entry: TreeNode, register: Register) -> None:
    """Report the keys of the register itself that have no effect (RS0338), and note those that have one."""
    found = {
        key: idle for idle in reversed(TABLE) for key in idle.keys & entry.settings.keys() if idle.when(register, entry)
    }
    for key, node in entry.settings.items():
        if key not in found:
            node.context.used.add(node.path)
        elif node.path[: len(entry.node.path)] == entry.node.path:
            message = f"`{entry.id}` has `{key}`, but {found[key].why}"
            node.report(IDLE_KEY, message, remedy=found[key].remedy, at_key=True)
    entry.node.context.used.update(entry.settings.replaced)
    for layer in (*entry.place.layers, *entry.place.over):
        entry.node.context.defaults.setdefault(layer.path, layer)


def report_idle_defaults(root: Value) -> None:
    """Report each default of a group, an array or a use of a set that has no effect on any register (RS0339)."""
    context = root.context
    for layer in context.defaults.values():
        for part in (layer, *layer.elements_of("variants")):
            for key, node in part.items():
                idle = key not in {"variants", "models"} and node.value is not None and node.path not in context.used
                if idle and node.span.file == context.document.name:
                    message = f"`{key}` has no effect on any register here"
                    node.report(IDLE_DEFAULT, message, remedy="remove it", at_key=True)
