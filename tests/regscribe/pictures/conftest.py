"""The maps that the pages are tested with."""

from ..emit.markdown.conftest import load, oven, oven_path  # noqa: TID252 (test folders are no packages)

__all__ = ["load", "oven", "oven_path"]
