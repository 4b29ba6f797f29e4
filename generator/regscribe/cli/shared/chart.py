"""Curves in the terminal."""

from collections.abc import Sequence
from functools import partial
from typing import Any

HEIGHT = 12
LEAST_WIDTH, MARGIN = 20, 20
"""Least columns of a curve, and columns of the scale beside it."""


def chart(title: str, seconds: Sequence[float], values: Sequence[float], *, unit: str, width: int) -> str:
    """The curve of `values` over `seconds` as text of at most `width` columns; "" without values."""
    if not values:
        return ""
    figure = empty_figure(max(width - MARGIN, LEAST_WIDTH), HEIGHT, digits=4)
    low, high = min(values), max(values)
    room = (high - low) * 0.05 or max(abs(high) * 0.05, 1.0)
    figure.set_y_limits(low - room, high + room)
    figure.set_x_limits(min(seconds), max(*seconds, min(seconds) + 1))
    figure.x_label, figure.y_label = "s", unit
    figure.plot(seconds, values)
    return f"{title}\n{figure.show()}\n"


def empty_figure(width: int, height: int, *, digits: int) -> Any:  # noqa: ANN401 - plotille ships no types
    """An empty figure of plotille without colours; its scales show numbers with that many significant digits."""
    import plotille  # type: ignore[import-untyped]  # noqa: PLC0415 - as above; only a curve needs it

    figure: Any = plotille.Figure()
    figure.width, figure.height = width, height
    figure.color_mode, figure.with_colors = "names", False
    figure.register_label_formatter(float, partial(_label, digits))
    return figure


def _label(digits: int, value: float, chars: int, delta: float, left: bool = False) -> str:  # noqa: ARG001, FBT001, FBT002 - as plotille calls it
    text = f"{value:.{digits}g}"
    return text.ljust(chars) if left else text.rjust(chars)
