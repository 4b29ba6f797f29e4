"""Importers: forms of other programs and of people, each to a draft of a map (docs/import.md)."""
