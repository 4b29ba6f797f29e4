"""Numbers such as 40001 and 400001, whose leading digit is that of a space: whether a column has them."""

from collections.abc import Sequence

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.address_rule import FROM_ZERO, Rule, counted_from, has_region, is_plain
from regscribe.importers.table.cells.notations import Printed
from regscribe.importers.table.cells.spaces import REGIONS
from regscribe.model import Space


def modicon_rule(
    known: Sequence[Printed],
    read: Sequence[Printed | Unclear | None],
    header: str,
    spaces: Sequence[Space | None],
    said: set[str],
    words: Sequence[bool],
) -> Rule | None:
    """The rule where numbers begin with the digit of a space; None where they do not.

    `words` are the rows whose type takes whole words: those have no address of a bit.
    """
    plain = [one for one in known if is_plain(one)]
    long = [one for one in plain if len(one.digits) == 6 and has_region(one)]  # noqa: PLR2004 - six digits
    with_region = [one for one in plain if has_region(one)]
    if not with_region or said & {"0", "1"} or (FROM_ZERO.search(header) and not long):
        return None
    length = 6 if long else 5
    others = [one for one in known if not (has_region(one) and len(one.digits) == length)]
    if long or "modicon" in said:
        return _regions(f"numbers such as {with_region[0].digits} begin with the digit of a space", others, length)
    if others:
        return _mixed(with_region, others)
    contrary = sum(
        isinstance(one, Printed) and has_region(one) and _contradicted(REGIONS[int(one.digits[0])], space, of_words)
        for one, space, of_words in zip(read, spaces, words, strict=False)
    )
    if contrary * 2 > len(with_region):
        return None
    digits = "".join(sorted({one.digits[0] for one in with_region}))
    evidence = f"all numbers have five digits and begin with that of a space ({', '.join(digits)})"
    return _regions(f"{evidence}, so 40001 is the wire address 0: --base 0 if they are sent as printed", (), 5)


def _contradicted(digit: Space, beside: Space | None, of_words: bool) -> bool:  # noqa: FBT001 - a fact of the row
    """Whether the space or the type of a row says that the leading digit of its number is none of a space."""
    return (of_words and digit.is_bits) if beside is None else beside is not digit


def _regions(evidence: str, others: Sequence[Printed], length: int) -> Rule:
    def unclear(one: Printed) -> str:
        plain = is_plain(one) and not (has_region(one) and len(one.digits) == length)
        return f"is no number of {length} digits that begins with that of a space, as others are" if plain else ""

    return Rule(notation="modicon", evidence=evidence, regions=True, unclear=unclear if others else None)


def _mixed(with_region: Sequence[Printed], others: Sequence[Printed]) -> Rule | None:
    """Numbers such as 40001 beside others: plain, if the others show it; else they are unclear."""
    numbers = [one.number(10) for one in others if is_plain(one)]
    leading = {one.digits[0] for one in with_region if not one.digits.startswith("0")}
    if any(number >= 10000 for number in numbers) or not leading - {"1"} or not numbers:  # noqa: PLR2004 - five digits
        return None

    def unclear(one: Printed) -> str:
        if not is_plain(one) or one.digits.startswith("0"):
            return ""
        other = f"others are as low as {min(numbers)}" if has_region(one) else f"others are {with_region[0].digits}"
        return f"may count in its space or be a plain address: {other} (--base modicon or --base 0)"

    base, why, assumed = counted_from(numbers, "", set())
    return Rule(evidence=why, base=base, assumed=assumed, unclear=unclear)
