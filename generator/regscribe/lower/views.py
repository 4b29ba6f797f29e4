"""The views of a register: from a view set and its address formula, or the single one that its type gives."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.interval_text import whole_ends
from regscribe.lower.node import Value, choice_of, fraction_of, truth_of, whole_of, wholes_of
from regscribe.lower.rules import IDLE_KEY, IDLE_LENGTH, TYPE_BESIDE_VIEWS, UNKNOWN_VIEWS, WRONG_SORT
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.tree import TreeNode
from regscribe.model import Order, OrderFrom, Rounding, Space, View, WireType

_OF_EACH_VIEW = ("type", "word_order", "byte_order", "functions")
_DEFAULT_TYPES = {Space.COIL: WireType.BIT, Space.DISCRETE: WireType.BIT, Space.STATUS: WireType.UINT8}


@dataclass(frozen=True, slots=True)
class Home:
    """What all views of a register share: the space, and the length of texts."""

    space: Space
    length: int


def views_of(entry: TreeNode, scope: Scope) -> tuple[View, ...]:
    """The views of a register, the base view first; RS0306 for an unknown view set, RS0336 for an idle length."""
    views = _views_of(entry, scope)
    length = entry.settings.get("length")
    if length and not any(view.type is WireType.STRING for view in views):
        message = (
            f"`{entry.id}` has a `length`, but its type is {', '.join(dict.fromkeys(view.type for view in views))}"
        )
        length.report(IDLE_LENGTH, message, remedy="remove `length`, or write `type: string`", at_key=True)
    return views


def _views_of(entry: TreeNode, scope: Scope) -> tuple[View, ...]:
    settings = entry.settings
    space = settings["space"].choice(Space.HOLDING) if "space" in settings else Space.HOLDING
    length = settings["length"].whole() if "length" in settings else 1
    home = Home(space, length)
    if "views" not in settings:
        return (_single(entry, home, scope),)
    for key in (key for key in _OF_EACH_VIEW if key in settings):
        message = f"`{entry.id}` has `{key}` beside the view set `{settings['views'].value}`"
        settings[key].report(
            TYPE_BESIDE_VIEWS, message, remedy=f"drop one: each view says its own `{key}`", at_key=True
        )
    view_set = scope.named(settings["views"], "views", rule=UNKNOWN_VIEWS, what="view set")
    return (set_at(view_set, home, scope) if view_set else ()) or (_single(entry, home, scope),)


def at_of(entry: TreeNode) -> int:
    """The `at` of the address formulas of a register's views."""
    at = entry.settings.get("at")
    if at is None:
        message = f"`{entry.id}` has no address"
        entry.node.report(
            WRONG_SORT, message, remedy="give `at`: the address in the manual's table, or the n of its views"
        )
        return 0
    return at.whole() + entry.place.shift


def set_at(node: Value, home: Home, scope: Scope) -> tuple[View, ...]:
    """The views of the set that stands at `node`, the base view first; read once for all registers that have it."""
    views = scope.once((node.path, home), lambda: [_view(name, each, home, scope) for name, each in node.items()])
    return tuple(sorted(views, key=lambda view: view.name != "base"))


def _single(entry: TreeNode, home: Home, scope: Scope) -> View:
    settings = entry.settings
    default = _DEFAULT_TYPES.get(home.space, WireType.UINT16)
    wire = settings["type"].choice(default) if "type" in settings else default
    functions = tuple(node.whole() for node in settings["functions"].elements()) if "functions" in settings else ()
    return View(
        name="base",
        space=home.space,
        type=wire,
        words=home.length if wire is WireType.STRING else wire.words,
        order=_order(settings.get("word_order"), scope),
        byte_order=settings["byte_order"].choice(Order.BIG) if "byte_order" in settings else Order.BIG,
        functions=functions,
    )


def _view(name: str, node: Value, home: Home, scope: Scope) -> View:
    wire = choice_of(node, "type", WireType.UINT16)
    _report_idle(name, node, wire)
    region = node.child("region")
    return View(
        name=name,
        space=home.space,
        offset=whole_of(node, "offset"),
        type=wire,
        words=home.length if wire is WireType.STRING else wire.words,
        factor=fraction_of(node, "factor", Fraction(1)),
        rounding=choice_of(node, "rounding", Rounding.NONE),
        saturates=truth_of(node, "saturates"),
        order=_order(node.child("word_order"), scope),
        byte_order=choice_of(node, "byte_order", Order.BIG),
        functions=wholes_of(node, "functions"),
        align=whole_of(node, "align", 1),
        region=whole_ends(region) if region else None,
        preferred=truth_of(node, "preferred"),
        stride=whole_of(node, "stride", 1),
    )


def _report_idle(name: str, node: Value, wire: WireType) -> None:
    """Report what a view says of words or fractions that its type does not have (RS0338)."""
    idle = {
        "word_order": wire is not WireType.STRING and wire.words == 1 and "its value is one word",
        "rounding": wire.is_float and "a float carries fractions",
    }
    for key, why in idle.items():
        told = node.child(key)
        if told and why:
            told.report(IDLE_KEY, f"view `{name}` has `{key}`, but {why}", remedy="remove it", at_key=True)


def _order(node: Value | None, scope: Scope) -> Order | OrderFrom:
    if node is None:
        return Order.BIG
    if not node.is_mapping:
        return node.choice(Order.BIG)
    register, codes = node.child("register"), node.child("codes")
    path = path_of(scope.register(register), register.text()) if register else ""
    pairs = [(each.key_whole(), each.choice(Order.BIG)) for each in codes.values()] if codes else []
    return OrderFrom(register=path, codes=tuple(pairs))
