"""Facts of a map in plain text: conditions, ranges, scales, units, labels; shared by all emitters of texts.

An emitter that needs more than plain text (escaping, links) passes its own `Wording`.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

from regscribe.model import (
    BOTTOM,
    TOP,
    Access,
    AnyOf,
    BitField,
    ByCase,
    Case,
    Cases,
    Condition,
    Conversion,
    Decimals,
    Enum,
    Given,
    GivenKind,
    GivenRef,
    Interval,
    Is,
    Largest,
    Limit,
    Member,
    Model,
    Number,
    Open,
    Order,
    OrderCases,
    Power,
    Product,
    Range,
    Ref,
    Register,
    Rounding,
    Sentinel,
    Smallest,
    Special,
    Sum,
    Term,
    WordOrder,
    show,
)
from regscribe.model.identifiers import OPEN
from regscribe_runtime.values.versions import version_of_key

ACCESS = {Access.READ: "read only", Access.READ_WRITE: "read and write", Access.WRITE: "write only"}
ORDER = {Order.BIG: "most significant word first", Order.LITTLE: "least significant word first"}
ROUNDING = {
    Rounding.HALF_UP: "rounded to nearest, halves upward",
    Rounding.HALF_AWAY: "rounded to nearest, halves away from zero",
    Rounding.HALF_EVEN: "rounded to nearest, halves to even",
    Rounding.DOWN: "fraction dropped",
    Rounding.NONE: "",
}
OTHERWISE = "otherwise"
LETTERS = "ijklmn"
"""Stand for the indices of arrays, from the outermost on."""

T = TypeVar("T")


def _condition_name(condition: Condition) -> str:
    return condition.name or condition_words(condition)


def spelled(path: str) -> str:
    """Return the path of a register with letters for indices that are those of the referring register."""
    first, *rest = path.split(OPEN)
    return first + "".join(f"[{letter}]{part}" for letter, part in zip(LETTERS, rest, strict=False))


@dataclass(frozen=True, slots=True)
class Wording:
    """Formatting of the parts of a phrase that come from the map: free text, register paths, conditions."""

    text: Callable[[str], str] = str
    register: Callable[[str], str] = spelled
    condition: Callable[[Condition], str] = _condition_name


PLAIN = Wording()


def one_line(text: str) -> str:
    """Return the text with every run of white space (line ends too) as one blank, none at the ends."""
    return " ".join(text.split())


def listed(parts: Sequence[str], last: str = "or") -> str:
    """Join as a list in a sentence: `a`, `a or b`, `a, b or c`."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} {last} {parts[-1]}" if parts else ""


def span_words(first: int | str, last: int | str, between: str = " to ") -> str:
    """Return an interval of addresses, bits or numbers: `40`, `40 to 49`."""
    return str(first) if first == last else f"{first}{between}{last}"


Codes = tuple[Number, Number]
"""From the first code to the last."""


def fold(codes: Iterable[Codes]) -> tuple[Codes, ...]:
    """Sort the ranges and join those that follow each other without a gap of a whole number."""
    folded: list[Codes] = []
    for low, high in sorted(codes):
        if folded and low <= folded[-1][1] + 1:
            folded[-1] = (folded[-1][0], max(folded[-1][1], high))
        else:
            folded.append((low, high))
    return tuple(folded)


def codes_words(codes: Iterable[Codes], labels: Mapping[int, str] | None = None, last: str = "or") -> str:
    """Return codes as `0 to 12, 14 or off (20)`: a single code has its label, if there is one."""
    parts = []
    for low, high in fold(codes):
        label = (labels or {}).get(int(low)) if low == high and low.denominator == 1 else None
        parts.append(f"{one_line(label)} ({show(low)})" if label else span_words(show(low), show(high)))
    return listed(parts, last)


def member_words(member: Member, enum: Enum) -> str:
    """Return what the manual says of a member: each cell with the head of its column, then its description."""
    cells = (f"{column}: {cell}" for column, cell in zip(enum.columns, member.cells, strict=False))
    return "; ".join(one_line(part) for part in (*cells, member.description) if part)


def labels_of(enum: Enum | None) -> dict[int, str]:
    """Return the labels of an enum's members by code; empty without an enum."""
    return enum.labels if enum else {}


def _labels(test: Is, model: Model | None) -> dict[int, str]:
    try:
        register = model.register(test.register) if model else None
    except KeyError:
        return {}
    if register is None:
        return {}
    enum = next((item.enum for item in register.fields if item.id == test.field), None) if test.field else register.enum
    return labels_of(enum)


def words_of_test(test: Is | AnyOf, model: Model | None = None, wording: Wording = PLAIN) -> str:
    """Return one test: `input_type is 0 to 12`, `inpt is one of linear_inputs`; labels come from the model's enums."""
    if isinstance(test, AnyOf):
        inside = " or ".join(condition_words(each, model, wording) for each in test.conditions)
        return f"not ({inside})" if test.negated else f"({inside})"
    given = wording.text(test.given)
    if not test.register and not test.codes:
        return f"not {given}" if test.negated else given
    if not test.register:
        return f"{given} is {'not ' if test.negated else ''}{wording.text(ends_words(test))}"
    subject = wording.register(test.register) + (wording.text(f".{test.field}") if test.field else "")
    if test.given:
        return f"{subject} is {'none' if test.negated else 'one'} of {given}"
    ended = test.version or any(low == BOTTOM or high == TOP for low, high in test.codes)
    codes = wording.text(ends_words(test) if ended else codes_words(test.codes, _labels(test, model)))
    return f"{subject} is {'not ' if test.negated else ''}{codes}"


def given_words(given: Given) -> str:
    """Return what is to be given: `True or False`, `number, 1 to 5`, `"inside" or "outside"`, with its default."""
    forms = {GivenKind.CODES: "set of codes", GivenKind.BOOLEAN: "True or False", GivenKind.NUMBER: "number"}
    form = forms.get(given.kind) or listed([f'"{choice}"' for choice in given.choices])
    if given.low is not None and given.high is not None:
        form += f", {span_words(show(given.low), show(given.high))}"
    if given.default is None:
        return form
    return f"{form}; default {given.default if isinstance(given.default, str) else show(given.default)}"


def ends_words(test: Is) -> str:
    """Return codes with open ends, versions or choices: `at least 1.2.0 or at most 3`."""
    return listed([_span_of(test, *ends) for ends in test.codes])


def _span_of(test: Is, low: Number | str, high: Number | str) -> str:
    first, last = (_end_words(test, end) for end in (low, high))
    if low == BOTTOM:
        return f"at most {last}"
    return f"at least {first}" if high == TOP else span_words(first, last)


def _end_words(test: Is, end: Number | str) -> str:
    if isinstance(end, str):
        return end
    return version_of_key(int(end)) if test.version else show(end)


def condition_words(condition: Condition, model: Model | None = None, wording: Wording = PLAIN) -> str:
    """Return all tests of a condition joined by `and`; `always` without tests."""
    return " and ".join(words_of_test(test, model, wording) for test in condition.tests) or "always"


def cases_words(cases: Cases[str], wording: Wording = PLAIN) -> str:
    """Return cases as `condition: text; condition: text; otherwise: text`; the text alone without a condition."""
    if len(cases) == 1 and cases[0].when.always:
        return cases[0].then
    return "; ".join(f"{when_words(case.when, wording)}: {case.then}" for case in cases if case.then)


def when_words(condition: Condition, wording: Wording = PLAIN) -> str:
    """Return the condition of a case among several: its name or its words, `otherwise` for a case that always holds."""
    return OTHERWISE if condition.always else wording.condition(condition)


def divisor_words(decimals: Decimals | None, wording: Wording = PLAIN) -> str:
    """Return `/10^dp`, `/10^min(dp, 3)`, or an empty text."""
    if decimals is None:
        return ""
    register = wording.register(decimals.register)
    return f"/10^{register}" if decimals.at_most is None else f"/10^min({register}, {decimals.at_most})"


def limit_words(limit: Limit, wording: Wording = PLAIN, decimals: Decimals | None = None) -> str:
    """Return a limit: its number, the term that it is, or `open (why)`."""
    match limit:
        case Open():
            return f"open ({wording.text(one_line(limit))})"
        case int() | Fraction() as number:
            return show(number) + (divisor_words(decimals, wording) if number else "")
    return term_words(limit, wording)


def term_words(term: Term, wording: Wording = PLAIN) -> str:
    """Return a term as a formula: `0.1`, `ct`, `10^w_sf`, `0.1*ct*vt/2`, `high - low`, `(wye: 1; otherwise: 2)`."""
    match term:
        case Ref(register):
            words = wording.register(register)
        case GivenRef(given):
            words = wording.text(given)
        case Power(exponent):
            words = f"10^{_factor(exponent, wording, apart=True)}"
        case Product(factors, divisors):
            over = "*".join(_factor(each, wording) for each in factors) or "1"
            words = "/".join([over, *(_factor(each, wording, apart=True) for each in divisors)])
        case Sum(terms):
            words = _joined([term_words(each, wording) for each in terms])
        case Largest(terms) | Smallest(terms):
            inside = ", ".join(term_words(each, wording) for each in terms)
            words = f"{'largest' if isinstance(term, Largest) else 'smallest'} of ({inside})"
        case ByCase(cases):
            words = f"({cases_words(map_cases(cases, lambda each: term_words(each, wording)), wording)})"
        case _:
            words = show(term)
    return words


def _factor(term: Term, wording: Wording = PLAIN, *, apart: bool = False) -> str:
    """A factor, in brackets where they are needed; `apart`: behind a sign of division."""
    words = term_words(term, wording)
    return f"({words})" if isinstance(term, Sum) or (apart and isinstance(term, Product)) else words


def _joined(terms: Sequence[str]) -> str:
    """Terms joined by their signs: `high - low + 10`."""
    first, *others = (f"-{text[3:]}" if text.startswith("-1*") else text for text in terms)
    return first + "".join(f" - {text[1:]}" if text.startswith("-") else f" + {text}" for text in others)


def interval_words(interval: Interval, wording: Wording = PLAIN, decimals: Decimals | None = None) -> str:
    """Return `low to high`, one limit where both are equal."""
    low, high = (limit_words(limit, wording, decimals) for limit in (interval.low, interval.high))
    return span_words(low, high)


def range_words(limits: Range, wording: Wording = PLAIN) -> str:
    """Return a range: its intervals joined by `or`."""
    return listed([interval_words(interval, wording, limits.decimals) for interval in limits.intervals])


def plain_interval(cases: Cases[Range]) -> tuple[Number, Number] | None:
    """Return the two numbers of a range that is one interval between numbers under no condition, else None."""
    if len(cases) != 1 or not cases[0].when.always:
        return None
    limits = cases[0].then
    match limits.intervals:
        case (Interval(int() | Fraction() as low, int() | Fraction() as high),) if limits.decimals is None:
            return low, high
    return None


def conversion_words(conversion: Conversion) -> str:
    """Return the formula of the value for the stored number x: `x/10`, `0.1*x - 1999.9`, `x/10^dp`, `x*10^w_sf`."""
    divisor = divisor_words(conversion.decimals)
    scaled = _scaled(conversion.multiply)
    linear = _joined([scaled, term_words(conversion.add)]) if conversion.add else scaled
    formula = f"({linear}){divisor}" if divisor and conversion.add else linear + divisor
    return formula + step_words(conversion)


def step_words(conversion: Conversion, wording: Wording = PLAIN) -> str:
    """Return `, x in steps of 1/10^dp`, or an empty text."""
    if conversion.step is None:
        return ""
    return f", x in steps of {show(conversion.step)}{divisor_words(conversion.places, wording)}"


def _scaled(multiply: Term) -> str:
    """Return x times a term: `x`, `x/10`, `0.1*x`, `x*10^w_sf`, `0.1*x*ct_ratio`."""
    if isinstance(multiply, Product):
        number, factors = Fraction(1), multiply.factors
        if isinstance(factors[0], Number):
            number, factors = Fraction(factors[0]), factors[1:]
        rest = [f"*{_factor(each)}" for each in factors] + [
            f"/{_factor(each, apart=True)}" for each in multiply.divisors
        ]
        return _scaled(number) + "".join(rest)
    if not isinstance(multiply, Number):
        return f"x*{_factor(multiply)}"
    if multiply == 1:
        return "x"
    if multiply.numerator == 1 and set(str(multiply.denominator)[1:]) <= {"0"} and str(multiply.denominator)[0] == "1":
        return f"x/{multiply.denominator}"
    return f"{show(multiply)}*x"


def map_cases(cases: Cases[T], words: Callable[[T], str]) -> Cases[str]:
    """Return the same cases with what they hold in words."""
    return tuple(Case(case.when, words(case.then)) for case in cases)


def special_words(special: Special, wording: Wording = PLAIN) -> str:
    """Return `0 = off`, with the number that it stands for: `0 = shortest (reads as 0.2)`."""
    means = f" (reads as {show(special.means)})" if special.means is not None else ""
    return f"{show(special.code)} = {wording.text(one_line(special.label))}{means}"


def sentinel_words(sentinel: Sentinel, wording: Wording = PLAIN) -> str:
    """Return `-32768 = sensor low`: a stored number that reports a fault, with the condition of its case."""
    low, _, high = sentinel.spelled.partition("..")
    when = "" if sentinel.when.always else f" ({wording.condition(sentinel.when)})"
    return f"{span_words(low, high or low)} = {wording.text(one_line(sentinel.label))}{when}"


def value_words(register: Register, value: Fraction | str | None, wording: Wording = PLAIN) -> str:
    """Return a default: text, a number, or a code with its label (`3 = off`); empty where the manual gives none."""
    if value is None:
        return ""
    if isinstance(value, str):
        return wording.text(one_line(value))
    if register.enum:
        label = labels_of(register.enum).get(int(value), "")
    else:
        label = {special.value: special.label for special in register.specials}.get(value, "")
    return f"{show(value)} = {wording.text(one_line(label))}" if label else show(value)


def default_words(
    register: Register, default: Fraction | str | None, cases: Cases[Fraction | str], wording: Wording = PLAIN
) -> str:
    """Return a default, or its cases: `celsius: 25; otherwise: 77`."""
    if default is not None:
        return value_words(register, default, wording)
    return cases_words(map_cases(cases, lambda value: value_words(register, value, wording)), wording)


def order_words(order: WordOrder | OrderCases, wording: Wording = PLAIN) -> str:
    """Return the word order: itself, by the codes of the register that sets it, or by cases."""
    if not isinstance(order, OrderCases):
        return _order_word(order)
    by_code = order.by_code()
    if by_code is None:
        return cases_words(map_cases(order.cases, _order_word), wording)
    codes = ", ".join(f"{show(code)} = {_order_word(meaning)}" for code, meaning in by_code[1])
    return f"set by {wording.register(by_code[0])}: {codes}"


def _order_word(order: WordOrder) -> str:
    """Return `most significant first`, or the places of all words: `most significant to least at 3, 4, 1, 2`."""
    return ORDER[order] if isinstance(order, Order) else f"from the most significant at {', '.join(map(str, order))}"


def part_words(field: BitField) -> str:
    """Return what is said of the number of a part: `x/10 °C, x signed, -40 to 125, 127 = none`; perhaps nothing."""
    formula = conversion_words(Conversion(field.multiply, field.add)) if field.is_scaled else ""
    parts = [
        f"{formula} {field.unit}".strip() if formula != "x" else field.unit,
        "x signed" if field.signed else "",
        span_words(show(field.range[0]), show(field.range[1])) if field.range else "",
        f"valid {span_words(show(field.valid[0]), show(field.valid[1]))}" if field.valid else "",
        *map(sentinel_words, field.sentinels),
    ]
    return ", ".join(filter(None, parts))


def bits_words(field: BitField) -> str:
    """Return the bits of a field: `3` or `8..11`."""
    return span_words(field.low, field.high, "..")
