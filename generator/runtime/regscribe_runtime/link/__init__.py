"""A connection: open, send, wait, be patient with late answers, one at a time."""
