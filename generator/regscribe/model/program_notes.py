"""What documents a setpoint program, beside the facts that a driver declares."""

from dataclasses import dataclass

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe.model.register import Inferred


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramNotes:
    """The manual's remarks on a program, what was concluded about it, and where it stands in the map."""

    description: str = ""
    inferred: tuple[Inferred, ...] = ()
    span: Span = NOWHERE
