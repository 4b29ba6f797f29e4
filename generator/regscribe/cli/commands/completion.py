"""`regscribe completion`: the script that lets a shell complete commands, devices, models and registers."""

import click
from click.shell_completion import get_completion_class

from regscribe.cli.shared.output import refuse, tell

WHERE = {
    "bash": 'eval "$(regscribe completion bash)"      # in ~/.bashrc',
    "zsh": 'eval "$(regscribe completion zsh)"       # in ~/.zshrc',
    "powershell": "regscribe completion powershell | Out-String | Invoke-Expression   # in $PROFILE",
    "fish": "regscribe completion fish > ~/.config/fish/completions/regscribe.fish",
}


@click.command(
    epilog="Example: regscribe completion bash\n\n\b\nSwitch it on:\n"
    + "\n".join(f"  {line}" for line in WHERE.values()),
)
@click.argument("shell", type=click.Choice(list(WHERE)))
@click.pass_context
def command(context: click.Context, *, shell: str) -> None:
    """Print the script that makes SHELL complete the names of commands, devices, models and registers."""
    kind = get_completion_class(shell)
    if kind is None:
        refuse(f"the click that is installed completes nothing for {shell}: pip install 'click>=8.5'")
    root = context.find_root()
    tell(kind(root.command, {}, "regscribe", "_REGSCRIBE_COMPLETE").source())
