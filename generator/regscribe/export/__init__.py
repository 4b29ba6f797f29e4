"""What a map says, for other programs: a spreadsheet, any language, collectd; each a plug-in (docs/export.md)."""
