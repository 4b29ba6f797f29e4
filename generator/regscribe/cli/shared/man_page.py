"""Manual pages of commands, in roff, from what their help is made of."""

import re
from collections.abc import Iterator

import click

from regscribe import __version__
from regscribe.cli.shared.exit_codes import EXIT_CODES

BLOCK = "\b"
"""How click marks a paragraph whose lines stay as they are."""


def escaped(text: str) -> str:
    """Text for roff: a backslash is one, a minus is no hyphen, and no line begins as a request."""
    plain = text.replace("\\", "\\e").replace("-", "\\-").replace('"', "\\(dq")
    return "\n".join(f"\\&{line}" if line.startswith((".", "'")) else line for line in plain.split("\n"))


def pages(root: click.Group) -> Iterator[tuple[str, str]]:
    """Name and text of the page of a group, and of each command in it and below."""
    with click.Context(root, info_name="regscribe", **root.context_settings) as context:
        yield from _pages(root, context)


def _pages(command: click.Command, context: click.Context) -> Iterator[tuple[str, str]]:
    below = []
    if isinstance(command, click.Group):
        below = [(name, one) for name in command.list_commands(context) if (one := command.get_command(context, name))]
    yield f"{_name(context)}.1", "\n".join(_page(command, context, below)) + "\n"
    for name, one in below:
        with click.Context(one, info_name=name, parent=context) as inner:
            yield from _pages(one, inner)


def _name(context: click.Context) -> str:
    return context.command_path.replace(" ", "-")


def _page(command: click.Command, context: click.Context, below: list[tuple[str, click.Command]]) -> Iterator[str]:
    name = _name(context)
    yield f'.TH "{escaped(name.upper())}" 1 "" "regscribe {escaped(__version__)}" "regscribe"'
    yield f".SH NAME\n{escaped(name)} \\- {escaped(command.get_short_help_str(limit=200).rstrip('.'))}"
    usage = " ".join(command.collect_usage_pieces(context))
    yield f".SH SYNOPSIS\n.B {escaped(context.command_path)}\n{escaped(usage)}"
    yield ".SH DESCRIPTION"
    yield from _paragraphs(command.help or "")
    if below:
        yield ".SH COMMANDS"
        for one, what in below:
            about = escaped(what.get_short_help_str(limit=200))
            yield f".TP\n.B {escaped(one)}\n{about} See {escaped(f'{name}-{one}')}(1)."
    yield ".SH OPTIONS"
    for option in command.get_params(context):
        record = option.get_help_record(context) if isinstance(option, click.Option) else None
        if record is not None:
            yield f".TP\n.B {escaped(record[0])}\n{escaped(' '.join(record[1].split()) or '(no more is to be said)')}"
    if command.epilog:
        yield ".SH EXAMPLES AND EXIT CODES"
        yield from _paragraphs(command.epilog)
    if context.parent is None:
        yield from (
            ".SH EXIT CODES OF ALL COMMANDS",
            *(f".TP\n.B {code}\n{escaped(about)}" for code, about in EXIT_CODES.items()),
        )
    else:
        yield f".SH SEE ALSO\n{escaped(_name(context.parent))}(1)"


def _paragraphs(text: str) -> Iterator[str]:
    """The paragraphs of a help text; one that click keeps line by line stays so."""
    for number, paragraph in enumerate(re.split(r"\n\s*\n", text.strip())):
        if number:
            yield ".PP"
        if paragraph.lstrip().startswith(BLOCK):
            kept = paragraph.lstrip().removeprefix(BLOCK).strip("\n")
            yield f".nf\n{escaped(kept)}\n.fi"
        else:
            yield escaped(" ".join(paragraph.split()))
