"""Registers that a library declares for several maps."""

from regscribe_runtime.registers.register import Register


class RegisterSet:
    """Registers of a library. A subclass tells of all of them what the map that uses them says.

    `section` is where the map's own manual describes them, `persistence` where its devices keep them; what is left out
    stays as the library has it. A subclass that tells nothing changes nothing.
    """

    def __init_subclass__(cls, *, section: str | None = None, persistence: str | None = None) -> None:
        if section is None and persistence is None:
            return
        for base in reversed(cls.__mro__[1:]):
            for name, register in vars(base).items():
                if isinstance(register, Register):
                    setattr(cls, name, register.told(cls.__module__, section=section, persistence=persistence))
