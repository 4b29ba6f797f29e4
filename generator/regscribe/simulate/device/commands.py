"""Commands as a device sees them: words that arrive at addresses, step by step."""

from collections.abc import Iterator, Sequence

from regscribe.model import Command, CommandStep, Condition, Register, Space
from regscribe.reference import Known, holds


class Commands:
    """Follows the commands of a model and remembers which were run; a wait between steps is not enforced.

    `run` are the ids of all that were ever run, `since_power` of those since the last power cycle.
    """

    __slots__ = ("_arguments", "_known", "_progress", "_steps", "_when", "run", "since_power")

    def __init__(self, commands: Sequence[Command], known: Known) -> None:
        self._known = known
        self._when = {command.id: command.when for command in commands}
        self._steps = {command.id: [step for step in command.steps if step.words] for command in commands}
        self._arguments = {command.id: dict(command.arguments) for command in commands}
        self._progress = dict.fromkeys(self._steps, 0)
        self.run: list[str] = []
        self.since_power: set[str] = set()

    def is_step(self, space: Space, address: int, words: Sequence[int], *, function: int | None = None) -> bool:
        """Whether words are a step of a command, so that the device must take them; with `function`, sent by that.

        Those of an argument are not: the device looks at them first.
        """
        steps = (step for steps in self._present() for step in steps if function in (None, step.function))
        return any(_matches(step, space, address, words) for step in steps if not step.argument)

    def argument(self, space: Space, address: int, words: Sequence[int], *, function: int) -> Register | None:
        """The argument of a command that words are sent as by a function; None if they are none."""
        for name, steps in self._steps.items():
            for step in steps:
                if step.argument and step.function == function and _matches(step, space, address, words):
                    return self._arguments[name][step.argument]
        return None

    def saw(self, space: Space, address: int, words: Sequence[int]) -> list[str]:
        """Note accepted words; returns the ids of the commands that they complete, now also in `run`."""
        completed = []
        for name, steps in self._steps.items():
            if not self._holds(self._when[name]):
                continue
            found = (_next(steps, start, space, address, words) for start in (self._progress[name], 0))
            behind = next(filter(None, found), 0)
            if behind and not any(self._holds(step.when) for step in steps[behind:]):
                completed.append(name)
            if behind:
                self._progress[name] = 0 if name in completed else behind
        self.run.extend(completed)
        self.since_power.update(completed)
        return completed

    def _holds(self, when: Condition) -> bool:
        return when.always or holds(when, self._known)

    def _present(self) -> Iterator[list[CommandStep]]:
        """The steps of the commands that exist now, as far as they are done now."""
        for name, steps in self._steps.items():
            if self._holds(self._when[name]):
                yield [step for step in steps if self._holds(step.when)]

    def forget(self) -> None:
        """Forget, as at a power cycle, which commands were begun or run since power came."""
        self._progress = dict.fromkeys(self._steps, 0)
        self.since_power.clear()


def _next(steps: Sequence[CommandStep], start: int, space: Space, address: int, words: Sequence[int]) -> int:
    """The place behind the step that words are: the next that is always done, or one before it; 0 if it is none."""
    for place, step in enumerate(steps[start:], start=start + 1):
        if _matches(step, space, address, words):
            return place
        if step.when.always:
            break
    return 0


def _matches(step: CommandStep, space: Space, address: int, words: Sequence[int]) -> bool:
    same_place = step.space is space and step.address == address
    if step.argument:
        return same_place and len(step.words) == len(words)
    return same_place and tuple(word & 0xFFFF for word in step.words) == tuple(words)
