"""Two versions of a map to the changes between them: what each means on the wire, for programs, and for readers.

Compiled models are compared, never texts, so another spelling of the same facts is no change. `compare` finds the
changes, `report` tells them; `rules` has an id for each kind of change.
"""

from regscribe.breaking.rules import RULES

__all__ = ["RULES"]
