"""Masks of words as the bits that they leave."""


def bits_of(mask: int) -> tuple[int, int] | None:
    """Return the first and the last bit of a mask whose bits stand together; None for others and for 0."""
    if mask <= 0:
        return None
    low = (mask & -mask).bit_length() - 1
    high = mask.bit_length() - 1
    return (low, high) if mask == ((1 << (high - low + 1)) - 1) << low else None
