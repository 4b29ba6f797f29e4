"""The register browser: one HTML file with all registers of maps, their search, and a calculator raw <-> value."""

from regscribe.register_browser.data import document
from regscribe.register_browser.page import page

__all__ = ["document", "page"]
