"""Numbers and choices that are given to a driver's constructor, checked."""

from fractions import Fraction

from regscribe_runtime.values.numbers import Number, brief, exact, show


class Fact:
    """Checks of what is given."""

    @staticmethod
    def number(name: str, value: float | Fraction, low: Number | None = None, high: Number | None = None) -> Fraction:
        """The exact number; ValueError for what is none, and outside `low` to `high`."""
        found = exact(value)
        if (low is not None and found < low) or (high is not None and found > high):
            ends = " to ".join("..." if end is None else show(end) for end in (low, high))
            message = f"{name}: {brief(value)} lies outside {ends}"
            raise ValueError(message)
        return found

    @staticmethod
    def choice(name: str, value: str, *choices: str) -> str:
        """The choice; ValueError for what is none of `choices`."""
        if value not in choices:
            message = f"{name}: {brief(value)} is none of {', '.join(choices)}"
            raise ValueError(message)
        return value
