"""How often an array repeats: between two indices, or from one up to what the device has."""

from regscribe.lower.node import Value
from regscribe.lower.rules import ENDLESS, REVERSED
from regscribe.lower.texts import whole_ends


def indices(repeat: Value | None) -> tuple[int, int]:
    """The first index and the greatest that there may be; RS0315 where the first is above it."""
    if repeat is None or not repeat.is_mapping:
        return whole_ends(repeat, (1, 1))
    first, most = repeat.whole_of("from"), repeat.whole_of("most")
    if first > most:
        repeat.report(REVERSED, f"`most` is {most}, below the first index {first}", remedy="correct one of them")
        return most, first
    return first, most


def counter_of(repeat: Value | None) -> Value | None:
    """What names the register or the given that says how many elements there are; None where nothing does."""
    to = repeat.child("to") if repeat and repeat.is_mapping else None
    return to if to and not to.child("block") else None


def goes_to_end(repeat: Value | None, block: str, *, nested: bool) -> bool:
    """Whether there are as many elements as the block has room for; RS0365 in no block, or in another array."""
    to = repeat.mapping_of("to").child("block") if repeat and repeat.is_mapping else None
    if to is None:
        return False
    if not block or nested:
        message = "it is to repeat to the end of its block, but it stands in " + ("another array" if nested else "none")
        to.report(ENDLESS, message, remedy="give a register that counts the elements, or the last index")
    return True
