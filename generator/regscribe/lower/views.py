"""The views of a register: from a view set and its address formula, or the single one that its type gives."""

from regscribe.lower.conditions import condition_of
from regscribe.lower.node import Keyed, Value
from regscribe.lower.octets import bits_of, words_of
from regscribe.lower.rules import IDLE_KEY, IDLE_LENGTH, NO_PART, TYPE_BESIDE_VIEWS, UNKNOWN_VIEWS, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.lower.terms import ONE, term_of
from regscribe.lower.texts import whole_ends
from regscribe.lower.tree import TreeNode
from regscribe.lower.variants import Keys
from regscribe.model import (
    Access,
    Case,
    Number,
    Order,
    OrderCases,
    Protocol,
    Rounding,
    Space,
    View,
    WireType,
    WordOrder,
    order_from,
)
from regscribe_runtime.values.kinds import MOMENTS
from regscribe_runtime.values.octets import KINDS
from regscribe_runtime.values.wire_types import PAGE_BITS

_OF_EACH_VIEW = ("type", "word_order", "byte_order", "byte", "functions", "write_at", "write")
WRITTEN = "write"
"""The name of the view in which a register is written that says `write_at` or `write`."""
_INHERITED = ("type", "word_order", "byte_order", "byte")
_KNOWN: dict[tuple[int, ...], WordOrder] = {(1,): Order.BIG, (1, 2): Order.BIG, (2, 1): Order.LITTLE}
_DEFAULT_TYPES = {
    Space.COIL: WireType.BIT,
    Space.DISCRETE: WireType.BIT,
    Space.STATUS: WireType.UINT8,
    Space.IDENTIFICATION: WireType.STRING,
}


def views_of(entry: TreeNode, scope: Scope) -> tuple[View, ...]:
    """The views of a register, the base view first; RS0306 for an unknown view set, RS0336 for an idle length."""
    settings = entry.settings
    space, words = settings.choice_of("space", Space.HOLDING), settings
    views: tuple[View, ...] = ()
    if "views" in settings:
        for key in (key for key in _OF_EACH_VIEW if key in settings):
            message = f"`{entry.id}` has `{key}` beside the view set `{settings['views'].value}`"
            remedy = f"drop one: each view says its own `{key}`"
            settings[key].report(TYPE_BESIDE_VIEWS, message, remedy=remedy, at_key=True)
        view_set = scope.named(settings["views"], "views", rule=UNKNOWN_VIEWS, what="view set")
        views = set_at(view_set, space, words, scope) if view_set else ()
    views = views or _single(settings, space, words, scope)
    at = settings.get("at")
    if at and at.is_list:
        views = tuple(_spread_out(entry, view, at) for view in views)
    views = tuple(_in_part(entry, view) if view.space.part_bits else _on_page(entry, view) for view in views)
    told = "views" not in settings and _length_of_bits(settings, space, words)
    types = dict.fromkeys(view.type for view in views)
    if "length" in settings and not (told or any(wire.is_octets and KINDS[wire] not in MOMENTS for wire in types)):
        message = f"`{entry.id}` has a `length`, but its type is {', '.join(types)}"
        remedy = "remove `length`, or write `type: string`; of flags and fields, `length` stands without a `type`"
        settings["length"].report(IDLE_LENGTH, message, remedy=remedy, at_key=True)
    return views


def _length_of_bits(keys: Keyed, space: Space, words: Keyed) -> Value | None:
    """The `length` that says how many words of flags or fields a view has; None where a type says it."""
    bits = words.child("flags") or words.child("fields")
    return None if bits is None or keys.child("type") or space in _DEFAULT_TYPES else words.child("length")


def _single(keys: Keys, space: Space, words: Keyed, scope: Scope) -> tuple[View, ...]:
    """The view of a register without a set; two, for reading and for writing, where it is written in another way."""
    view = _view("base", keys, space, words, scope)
    if keys.choice_of("access", Access.READ) is not Access.READ_WRITE or not keys.keys() & {"write_at", "write"}:
        return (view,)
    written = _written(view, keys, words, scope)
    reads = tuple(code for code in view.functions if code not in written.space.write_functions)
    return view._replace(functions=reads or (space.read_function,)), written


def _written(read: View, keys: Keys, words: Keyed, scope: Scope) -> View:
    """The view in which a register is written that is read as `read`."""
    node, own = keys.get("write"), Keys()
    stated = dict(node.items()) if node else {}
    space = stated["space"].choice(Space.HOLDING) if "space" in stated else _written_space(read.space)
    if (space.is_bits, space.is_words) == (read.space.is_bits, read.space.is_words):
        own.update({key: keys[key] for key in _INHERITED if key in keys})
    own.update(stated)
    view = _view(WRITTEN, own, space, words, scope)
    if node:
        _report_idle(view, node)
    at, to = keys.get("at"), stated.get("at") or keys.get("write_at")
    device = scope.map.mapping_of("protocol").wholes_of("functions", Protocol().functions)
    known = (tuple(code for code in space.write_functions if code in has) for has in (read.functions, device))
    functions = view.functions or next(filter(None, known), space.write_functions)
    return view._replace(offset=to.whole() - at.whole() if at and to else 0, functions=functions)


def _written_space(space: Space) -> Space:
    return space if space.part_bits else Space.COIL if space.is_bits else Space.HOLDING


def _on_page(entry: TreeNode, view: View) -> View:
    """The view on the page of its group."""
    if not entry.place.page:
        return view
    first = entry.place.page << PAGE_BITS
    region = (view.region[0] + first, view.region[1] + first) if view.region else None
    return view._replace(offset=view.offset + first, region=region)


def _in_part(entry: TreeNode, view: View) -> View:
    """The view in the file, or the queue, that the map names; RS0340 where it names none."""
    space, node = view.space, entry.settings.get(view.space)
    if space is Space.ENRON:
        return _of_two_words(entry, view)
    if space is Space.IDENTIFICATION:  # `at` is the number of an object
        return view._replace(stride=1 << space.part_bits)
    if node is None:
        remedy = f"give `{space}: N` here or in the group's `each`"
        entry.node.report(NO_PART, f"`{entry.id}` is in space `{space}`, but in which {space}?", remedy=remedy)
    return view._replace(offset=view.offset + ((node.whole() if node else 1) << space.part_bits))


def _of_two_words(entry: TreeNode, view: View) -> View:
    """The view in registers of 32 bits; RS0340 where its words do not fill whole ones, or stand apart."""
    at = entry.settings.get("at")
    if view.words % view.space.each or (at and at.is_list):
        apart = ", each at its own address" if at and at.is_list else ""
        what = f"view {view.name} has {view.words} words of {view.type}{apart}"
        remedy = "give a type of two or four words, such as `uint32` or `float32`, and one `at`; or `space: holding`"
        entry.node.report(NO_PART, f"`{entry.id}` is in space `enron`, of registers of 32 bits; {what}", remedy=remedy)
    inside, each = view.space.within, view.space.each
    region = (inside(view.region[0]), inside(view.region[1], each - 1)) if view.region else None
    align = each * view.align if view.align > 1 else 1
    return view._replace(offset=inside(view.offset), stride=each * view.stride, align=align, region=region)


def at_of(entry: TreeNode) -> int:
    """The `at` of the address formulas of a register's views."""
    at = entry.settings.get("at")
    if at is None:
        message = f"`{entry.id}` has no address"
        remedy = "give `at`: the address in the manual's table, or the n of its views"
        entry.node.report(WRONG_SORT, message, remedy=remedy)
        return 0
    return min(each.whole() for each in at.elements()) + entry.place.shift


def _spread_out(entry: TreeNode, view: View, at: Value) -> View:
    """The view of words whose addresses are listed, the most significant first; RS0330 for another number of them."""
    numbers = [each.whole() for each in at.elements()]
    fixed = view.type.is_integer or view.type.is_float
    if not fixed or "views" in entry.settings or not view.space.is_words or len(set(numbers)) != view.type.words:
        what = f"`{entry.id}` lists {len(numbers)} addresses; view {view.name} has {view.words} words of {view.type}"
        remedy = "list each address once, of a number of as many words, without `views`"
        at.report(WRONG_SORT, what, remedy=remedy)
        return view
    places = tuple(number - min(numbers) + 1 for number in numbers)
    return view._replace(words=max(places), order=_KNOWN.get(places, places))


def set_at(node: Value, space: Space, words: Keyed, scope: Scope) -> tuple[View, ...]:
    """The views of the set that stands at `node`, the base view first; read once for all registers that have it.

    `words` are the keys that say the length of texts, and the layout of dates.
    """

    def make() -> list[View]:
        return [_view_of_set(name, each, space, words, scope) for name, each in node.items()]

    return tuple(sorted(scope.once((node.path, space, *_lengths(words)), make), key=lambda view: view.name != "base"))


def _lengths(keys: Keyed) -> tuple[str, str]:
    return keys.text_of("length"), keys.text_of("layout")


def _view_of_set(name: str, node: Value, space: Space, words: Keyed, scope: Scope) -> View:
    """A view of a set."""
    view = _view(name, node, space, words, scope)
    _report_idle(view, node)
    return view


def _report_idle(view: View, node: Value) -> None:
    """Report what a view says of words or fractions that its type does not have (RS0338)."""
    idle = {
        "word_order": not view.type.is_octets and view.type.words == 1 and "its value is one word",
        "rounding": view.type.is_float and "a float carries fractions",
        "byte": not view.is_byte and "its value is no byte of a word",
        "byte_order": view.is_byte and "its value is one byte (`byte: high` is the upper one)",
    }
    for key, why in idle.items():
        stated = node.child(key)
        if stated and why:
            stated.report(IDLE_KEY, f"view `{view.name}` has `{key}`, but {why}", remedy="remove it", at_key=True)


def _view(name: str, keys: Keyed, space: Space, words: Keyed, scope: Scope) -> View:
    bits = _length_of_bits(keys, space, words)
    wire = bits_of(bits) if bits else keys.choice_of("type", _DEFAULT_TYPES.get(space, WireType.UINT16))
    factor, region = term_of(keys.child("factor"), scope, ONE), keys.child("region")
    byte = keys.child("byte")
    return View(
        name=name,
        space=space,
        offset=keys.whole_of("offset"),
        type=wire,
        words=words_of(wire, words, space),
        factor=(factor if isinstance(factor, Number) else 1) * (1 << wire.fraction),
        rounding=keys.choice_of("rounding", Rounding.NONE),
        saturates=keys.truth_of("saturates"),
        order=_order(keys.child("word_order"), scope),
        byte_order=Order.LITTLE if byte and byte.text() == "high" else _order(keys.child("byte_order"), scope),
        functions=keys.wholes_of("functions"),
        align=keys.whole_of("align", 1),
        region=whole_ends(region) if region else None,
        preferred=keys.truth_of("preferred"),
        stride=keys.whole_of("stride", 1),
        times=None if isinstance(factor, Number) else factor,
    )


def _order(node: Value | None, scope: Scope) -> WordOrder | OrderCases:
    """An order as it stands, by the codes of a register, or by cases."""
    if node is None:
        return Order.BIG
    if node.is_mapping:
        codes = [(code.key_whole(), _fixed_order(code)) for _, code in node.items_of("codes")]
        return order_from(scope.path(node.child("register")), codes)
    if node.is_list and any(element.is_mapping for element in node.elements()):
        return OrderCases(tuple(Case(condition_of(each, scope), _case_order(each)) for each in node.elements()))
    return _fixed_order(node)


def _case_order(case: Value) -> WordOrder:
    stated = case.child("is")
    return _fixed_order(stated) if stated else Order.BIG


def _fixed_order(node: Value) -> WordOrder:
    return tuple(each.whole() for each in node.elements()) if node.is_list else node.choice(Order.BIG)
