"""Changes of some flags or fields of a word, as people type them: those that are named; the others stay as they are."""

from collections.abc import Mapping
from typing import Any

from regscribe.tools.live.reading import left_out
from regscribe.tools.live.value_text import FALSE, TRUE, WORDS, flag_of, whole_of, with_part
from regscribe_runtime import Flags, Register, ValueRefused, Word
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers.enums import unnamed_bits


def names_parts(register: Register[Any], text: str) -> bool:
    """Whether a text names parts of a word that can be read, and no whole word.

    Of fields that cannot be read it must name all: ValueRefused if it does not.
    """
    if register.kind not in WORDS or whole_of(text.strip()) is not None:
        return False
    if register.kind == "fields" and not register.access.readable:
        _check_all_named(register, text)
    return register.access.readable


def part_text(register: Register[Any], part: str, value: str) -> str:
    """What `write` takes of the word for one part of it: `run=true`; ValueRefused for a value that no part has."""
    if not register.access.readable:
        raise ValueRefused(
            register.path, f"it cannot be read, so `{part}` cannot be written alone: write the whole word"
        )
    whole = f"{register.path}.{part}"
    if register.kind == "flags" and value.strip().casefold() not in TRUE | FALSE:
        raise ValueRefused(whole, f"`{value[:60]}` is neither true nor false")
    if "," in value:
        raise ValueRefused(whole, f"`{value[:60]}` is more than one value")
    return f"{part}={value.strip()}"


def _check_all_named(register: Register[Any], text: str) -> None:
    named = {one.partition("=")[0].strip() for one in text.split(",")}
    if left := [part for part in register.value_type.make(0).parts if part not in named]:
        message = f"it cannot be read, so all its parts must be named: {', '.join(left)} lacks"
        raise ValueRefused(register.path, message)


def change_parts(
    register: Register[Any], text: str, *, view: str | None, confirm: bool, verify: bool | None
) -> Task[Any]:
    """Read a word, change the parts that a text names, and write it; the word that was written."""

    def task(session: Session) -> Operation[Any]:
        def how(before: Any) -> Any:  # noqa: ANN401 - flags or a word of the register
            absent = left_out(register, before, session.memory, session.givens)
            return changed(register, before, text, absent)

        return (yield from tasks.change(register, how, view=view, confirm=confirm, verify=verify)(session))

    return task


def changed(register: Register[Any], word: Any, text: str, absent: Mapping[str, str]) -> Any:  # noqa: ANN401 - as above
    """The word with the parts set that a text names; those that are `absent` are refused with the reason."""
    named = [one.strip() for one in text.split(",") if one.strip()]
    if not named:
        raise ValueRefused(register.path, "no part is named")
    for one in named:
        word = _flag_set(register, word, one, absent) if isinstance(word, Flags) else _part_set(register, word, one)
    return word


def _flag_set(register: Register[Any], word: Flags, text: str, absent: Mapping[str, str]) -> Flags:
    """The word with `FLAG` or `FLAG=on` set, `FLAG=off` cleared, or with no flag that has a name for `none`."""
    if text.casefold() in {"none", type(word).label_of_none().casefold()}:
        return type(word)(unnamed_bits(word))
    name, _, state = text.rpartition("=")
    if not name or state.strip().casefold() not in TRUE | FALSE:
        name, state = text, "on"
    flag = flag_of(register.path, type(word), name.strip())
    if (why := absent.get(str(flag.name))) is not None:
        raise ValueRefused(register.path, f"{flag.name}: {why}")
    value = type(word)(int(word) & ~int(flag) | (0 if state.strip().casefold() in FALSE else int(flag)))
    if unnamed_bits(value) != unnamed_bits(word):
        raise ValueRefused(register.path, f"`{text[:60]}` has no meaning in the manual, so it stays as it is")
    return value


def _part_set(register: Register[Any], word: Word, text: str) -> Word:
    """The word with one part set by `part=value`, or with the bits of no part by `rest=0x8000`."""
    name, _, value = text.partition("=")
    rest = whole_of(value) if name == "rest" else None
    if rest is None:
        return with_part(register, word, text)  # type: ignore[no-any-return] # a word of the register
    parts = sum(word.mask(part) for part in word.parts)
    if rest & parts:
        raise ValueRefused(register.path, f"rest=0x{rest:X} has bits of parts (0x{rest & parts:X}): name those")
    return type(word)(int(word) & parts | rest).lacking(word.absent)
