"""Keys of what a module declares: equal for what would be the same lines, whichever module they stand in."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from regscribe.emit.python.constants import Pool
from regscribe.emit.python.enum_classes import Content, NamedClasses
from regscribe.emit.python.expressions import Specs
from regscribe.emit.python.formatting import Expression, flat
from regscribe.emit.python.offer import Declared, marked
from regscribe.emit.python.register_lines import Declarations, about, command_call, command_text
from regscribe.model import Array, Command, Model, Register


class _Inline(Pool):
    """A pool that defines nothing: every constant stays where it is used."""

    def share(self, name: str, expression: Expression, comment: str = "") -> str:  # noqa: ARG002 (nothing gets a name)
        return flat(expression)


@dataclass(frozen=True, slots=True)
class _ByContent:
    """Classes under their content instead of a name."""

    named: NamedClasses

    def name(self, wanted: str, content: Content) -> str:  # noqa: ARG002 (content alone counts)
        return f"<{self.named.keys[content]}>"


@dataclass(frozen=True, slots=True)
class Keys:
    """Keys of the items of one model."""

    model: Model
    named: NamedClasses

    def of(self, item: Register | Array) -> Declared:
        """What a register or array is."""
        return self._array(item) if isinstance(item, Array) else self._register(item)

    def _register(self, register: Register) -> Declared:
        bare = replace(register, section="", persistence="")
        declarations = Declarations(Specs(self.model, _Inline()), _ByContent(self.named))
        key = f"{flat(declarations.call(bare))} {about(bare)}"
        return Declared(key, declarations.type(bare), register.section, register.persistence)

    def element(self, array: Array) -> str:
        """The key of an array's element class."""
        members = " ".join(f"{member.id}={self.of(member).whole}" for member in array.members)
        return f"{array.id} {array.name} {marked(array.section)} {members}"

    def _array(self, array: Array) -> Declared:
        element = self.element(array)
        return Declared(f"{array.first} {array.count} {array.stride} {element}", f"array of {element}")


def command_key(command: Command) -> Declared:
    """What a command is."""
    bare = replace(command, section="")
    return Declared(f"{flat(command_call(bare))} {command_text(bare)} {marked(command.section)}", "Command")


def arrays(members: Sequence[Register | Array]) -> list[Array]:
    """All arrays among the members and in them."""
    found = []
    for member in members:
        if isinstance(member, Array):
            found += [member, *arrays(member.members)]
    return found
