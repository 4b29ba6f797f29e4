"""The manual's worked examples: values, frames and times."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.commands import unsigned, view_of
from regscribe.lower.node import ZERO, Value
from regscribe.lower.register_values import named_value
from regscribe.lower.rules import UNKNOWN_COMMAND, UNKNOWN_FLAG, UNKNOWN_MEMBER, UNKNOWN_SENTINEL, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.lower.subject import Subject, code_of_text, subject_of
from regscribe.lower.texts import known_name, unknown
from regscribe.lower.variants import named_models
from regscribe.model import Example, FrameExample, Kind, Model, Outcome, Register, TimingExample, ValueExample
from regscribe.reference import number_of
from regscribe_runtime.values.kinds import OCTETS


@dataclass(frozen=True, slots=True)
class Product:
    """A model, and the names in it that examples refer to."""

    scope: Scope
    model: Model

    def register(self, node: Value, name: str, *, at_key: bool = False) -> Register | None:
        """The register that `node` names; RS0301 or RS0302 where there is none."""
        entry = self.scope.register(node, name, at_key=at_key)
        return self.model.register(entry.path) if entry else None


def examples_of(root: Value, products: list[Product]) -> tuple[Example, ...]:
    """All examples of a map; nothing if the map has no model."""
    nodes = root.elements_of("examples") if products else []
    return tuple(_example(node, products) for node in nodes)


def _example(node: Value, products: list[Product]) -> Example:
    if node.child("timing"):
        return _timing(node)
    product = _product(node, products)
    return _frame(node, product) if node.child("frame") else _value(node, product)


def _product(node: Value, products: list[Product]) -> Product:
    """The model that the example names, or else the first that has all its registers.

    Else the first model that has the first of them, else the first model.
    """
    model = node.child("model")
    if model:
        named = named_models([model], products[0].scope.models)
        return next((each for each in products if each.scope.model in named), products[0])
    names = list(filter(None, (node.text_of("register"), *dict(node.items_of("writes")))))

    def known(product: Product) -> tuple[bool, list[bool]]:
        found = [product.scope.find(name) is not None for name in names]
        return all(found), found[:1]

    return max(products, key=known)


def _state(node: Value, scope: Scope) -> tuple[tuple[str, Fraction], ...]:
    """Values of other registers, bit fields and givens; those of a given are codes of its register."""
    state = []
    for key, value in node.items_of("with"):
        given = scope.map.mapping_of("givens").child(key) if scope.find(key) is None else None
        if given and not value.is_text:
            state.append((key, value.number()))
            continue
        entry = scope.find(given.text_of("register")) if given else None
        subject = Subject(key, entry) if entry else subject_of(value, key, scope)
        if subject:
            state.append((key, code_of_text(value, subject, scope) if value.is_text else value.number()))
    return tuple(state)


def _value(node: Value, product: Product) -> ValueExample:
    name = node.child("register")
    register = product.register(name, name.text()) if name else None
    fault, stored = node.child("fault"), node.child("stored")
    view = view_of(node.child("view"), register).name if register else node.text_of("view", "base")
    value, flags = _reading(node.child("value"), register)
    outcome = Outcome.SATURATED if node.truth_of("saturated") else Outcome.VALUE
    return ValueExample(
        source=node.text_of("source"),
        model=product.scope.model,
        register=register.path if register else node.text_of("register"),
        view=view,
        words=unsigned(node.wholes_of("words")),
        state=_state(node, product.scope),
        stored=stored.number() if stored else None,
        value=_fault(fault, register) if fault else value,
        flags=flags,
        outcome=Outcome.FAULT if fault else outcome,
        lossy=node.truth_of("lossy"),
        span=(name or node).span,
    )


def _reading(node: Value | None, register: Register | None) -> tuple[Fraction | str | None, tuple[str, ...] | None]:
    """The value of an example, or its flags."""
    if node is None or register is None:
        return None, None
    if node.is_list:
        flags = [field.id for field in register.fields if field.is_flag]
        return None, tuple(known_name(each, UNKNOWN_FLAG, "flag", flags, of=register.path) for each in node.elements())
    if node.is_text and register.kind in OCTETS | {Kind.VERSION}:
        return node.text(), None
    return named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER), None


def _fault(node: Value, register: Register | None) -> str:
    known = {sentinel.id.lower(): sentinel.id for sentinel in register.sentinels} if register else {}
    if register and node.text().lower() not in known:
        unknown(node, UNKNOWN_SENTINEL, "sentinel", node.text(), known, of=register.path)
    return known.get(node.text().lower(), "")


def _frame(node: Value, product: Product) -> FrameExample:
    printed = node.mapping_of("frame")
    frame = _bytes(printed)
    address, count, words, command = (node.child(key) for key in ("address", "count", "words", "command"))
    commands = [each.id for each in product.model.commands]
    return FrameExample(
        source=node.text_of("source"),
        model=product.scope.model,
        frame=frame,
        crc=node.truth_of("crc", otherwise=True),
        answer=node.truth_of("answer"),
        unit=node.whole_of("unit", next(iter(frame), 0)),
        function=node.whole_of("function", next(iter(frame[1:]), 0)),
        address=address.whole() if address else None,
        count=count.whole() if count else None,
        words=unsigned(node.wholes_of("words")) if words else None,
        writes=tuple(_write(key, value, product) for key, value in node.items_of("writes")),
        view=node.text_of("view"),
        state=_state(node, product.scope),
        command=known_name(command, UNKNOWN_COMMAND, "command", commands) if command else "",
        span=printed.span,
    )


def _bytes(node: Value) -> bytes:
    try:
        return bytes.fromhex(node.text())
    except ValueError:
        node.report(WRONG_SORT, "the frame is no hex text", remedy="write two hex digits a byte, as 9C 06 0F A9")
        return b""


def _write(key: str, node: Value, product: Product) -> tuple[str, Fraction]:
    register = product.register(node, key, at_key=True)
    if register is None:
        return key, ZERO
    value = named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER)
    number = number_of(register, value)
    if number is not None:
        return register.path, number
    node.report(WRONG_SORT, f"`{key}` is a text, not a number", remedy="give the `words` of the frame instead")
    return register.path, ZERO


def _timing(node: Value) -> TimingExample:
    line = node.mapping_of("timing")
    return TimingExample(
        source=node.text_of("source"),
        baud=line.whole_of("baud"),
        format=line.text_of("format"),
        function=line.whole_of("function"),
        words=line.whole_of("words"),
        gap=node.fraction_of("gap"),
        earliest=node.fraction_of("earliest"),
        latest=node.fraction_of("latest"),
        span=line.key_span,
    )
