"""The manual's worked examples: values, frames and times."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.commands import unsigned, view_of
from regscribe.lower.names import unknown
from regscribe.lower.node import Value, elements_of, fraction_of, items_of, text_of, truth_of, whole_of, wholes_of
from regscribe.lower.rules import UNKNOWN_COMMAND, UNKNOWN_FLAG, UNKNOWN_MEMBER, UNKNOWN_SENTINEL, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.lower.special_values import named_value
from regscribe.lower.subject import Subject, code_of_text, subject_of
from regscribe.lower.variants import named_models
from regscribe.model import Example, FrameExample, Kind, Outcome, Register, TimingExample, ValueExample
from regscribe.reference import number_of


@dataclass(frozen=True, slots=True)
class Product:
    """A model whose registers are known, for examples to refer to."""

    scope: Scope
    registers: dict[str, Register]
    commands: tuple[str, ...]

    def register(self, node: Value, name: str, *, at_key: bool = False) -> Register | None:
        """The register that `node` names; RS0301 or RS0302 where there is none."""
        entry = self.scope.register(node, name, at_key=at_key)
        return self.registers[entry.path] if entry else None


def examples_of(root: Value, products: list[Product]) -> tuple[Example, ...]:
    """All examples of a map; nothing if the map has no model."""
    nodes = elements_of(root, "examples") if products else []
    return tuple(_example(node, products) for node in nodes)


def _example(node: Value, products: list[Product]) -> Example:
    if node.child("timing"):
        return _timing(node)
    product = _product(node, products)
    return _frame(node, product) if node.child("frame") else _value(node, product)


def _product(node: Value, products: list[Product]) -> Product:
    """The model that the example names, or else the first that has all its registers."""
    told = node.child("model")
    if told:
        named = named_models([told], products[0].scope.models)
        return next((each for each in products if each.scope.model in named), products[0])
    names = [text_of(node, "register"), *(key for key, _ in items_of(node, "writes"))]
    return _with_registers([name for name in names if name], products)


def _with_registers(names: list[str], products: list[Product]) -> Product:
    """The first model that has all of these registers, else the first that has the first of them, else the first."""
    whole = [each for each in products if all(each.scope.find(name) for name in names)]
    part = [each for each in products if names and each.scope.find(names[0])]
    return (whole or part or products)[0]


def _state(node: Value, product: Product) -> tuple[tuple[str, Fraction], ...]:
    pairs = [_fact(key, value, product.scope) for key, value in items_of(node, "with")]
    return tuple(pair for pair in pairs if pair)


def _fact(key: str, value: Value, scope: Scope) -> tuple[str, Fraction] | None:
    """What a key of `with` is about: a register, a bit field, or a given (whose codes are those of its register)."""
    givens = scope.map.child("givens")
    given = givens.child(key) if givens and scope.find(key) is None else None
    if given and not value.is_text:
        return key, value.number()
    entry = scope.find(text_of(given, "register")) if given else None
    subject = Subject(key, entry) if entry else subject_of(value, key, scope)
    if subject is None:
        return None
    return key, code_of_text(value, subject, scope) if value.is_text else value.number()


def _value(node: Value, product: Product) -> ValueExample:
    name = node.child("register") or node
    register = product.register(name, name.text()) if name is not node else None
    fault, stored = node.child("fault"), node.child("stored")
    view = view_of(node.child("view"), register).name if register else text_of(node, "view", "base")
    value, flags = _reading(node.child("value"), register)
    return ValueExample(
        source=text_of(node, "source"),
        model=product.scope.model,
        register=register.path if register else text_of(node, "register"),
        view=view,
        words=unsigned(wholes_of(node, "words")),
        state=_state(node, product),
        stored=stored.number() if stored else None,
        value=_fault(fault, register) if fault else value,
        flags=flags,
        outcome=_outcome(node),
        lossy=truth_of(node, "lossy"),
        span=name.span,
    )


def _outcome(node: Value) -> Outcome:
    if node.child("fault"):
        return Outcome.FAULT
    return Outcome.SATURATED if truth_of(node, "saturated") else Outcome.VALUE


def _reading(node: Value | None, register: Register | None) -> tuple[Fraction | str | None, tuple[str, ...] | None]:
    if node is None or register is None:
        return None, None
    if node.is_list:
        return None, tuple(_flag(element, register) for element in node.elements())
    if node.is_text and register.kind in {Kind.STRING, Kind.VERSION}:
        return node.text(), None
    return named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER), None


def _flag(node: Value, register: Register) -> str:
    known = [each.id for each in register.fields if each.is_flag]
    if node.text() not in known:
        unknown(node, UNKNOWN_FLAG, "flag", node.text(), known, of=register.path)
    return node.text()


def _fault(node: Value, register: Register | None) -> str:
    known = {sentinel.id.lower(): sentinel.id for sentinel in register.sentinels} if register else {}
    if register and node.text().lower() not in known:
        unknown(node, UNKNOWN_SENTINEL, "sentinel", node.text(), known, of=register.path)
    return known.get(node.text().lower(), "")


def _frame(node: Value, product: Product) -> FrameExample:
    frame = _bytes(node)
    address, count, words = node.child("address"), node.child("count"), node.child("words")
    return FrameExample(
        source=text_of(node, "source"),
        model=product.scope.model,
        frame=frame,
        crc=truth_of(node, "crc", otherwise=True),
        answer=truth_of(node, "answer"),
        unit=whole_of(node, "unit", next(iter(frame), 0)),
        function=whole_of(node, "function", next(iter(frame[1:]), 0)),
        address=address.whole() if address else None,
        count=count.whole() if count else None,
        words=unsigned(wholes_of(node, "words")) if words else None,
        writes=tuple(_write(key, value, product) for key, value in items_of(node, "writes")),
        view=text_of(node, "view"),
        state=_state(node, product),
        command=_command(node, product),
        span=(node.child("frame") or node).span,
    )


def _bytes(node: Value) -> bytes:
    frame = node.child("frame")
    try:
        return bytes.fromhex(frame.text()) if frame else b""
    except ValueError:
        (frame or node).report(
            WRONG_SORT, "the frame is no hex text", remedy="write two hex digits a byte, as 9C 06 0F A9"
        )
        return b""


def _write(key: str, node: Value, product: Product) -> tuple[str, Fraction]:
    register = product.register(node, key, at_key=True)
    if register is None:
        return key, Fraction(0)
    value = named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER)
    number = number_of(register, value)
    if number is not None:
        return register.path, number
    node.report(WRONG_SORT, f"`{key}` is a text, not a number", remedy="give the `words` of the frame instead")
    return register.path, Fraction(0)


def _command(node: Value, product: Product) -> str:
    command = node.child("command")
    if command and command.text() not in product.commands:
        unknown(command, UNKNOWN_COMMAND, "command", command.text(), product.commands)
    return command.text() if command else ""


def _timing(node: Value) -> TimingExample:
    line = node.child("timing") or node
    return TimingExample(
        source=text_of(node, "source"),
        baud=whole_of(line, "baud"),
        format=text_of(line, "format"),
        function=whole_of(line, "function"),
        words=whole_of(line, "words"),
        gap=fraction_of(node, "gap"),
        earliest=fraction_of(node, "earliest"),
        latest=fraction_of(node, "latest"),
        span=line.key_span,
    )
