"""Evidence for a map: it is held against other transcriptions, and what it covers is counted. Nothing here prints."""
