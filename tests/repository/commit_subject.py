"""Refuse a commit message whose subject is longer than 72 characters or runs into its body: for pre-commit."""

import sys
from pathlib import Path

LONGEST = 72


def fault(message: str) -> str:
    """Return what is wrong with a commit message, or nothing; lines of comments do not count."""
    lines = [line for line in message.splitlines() if not line.startswith("#")]
    subject = lines[0] if lines else ""
    if not subject.strip():
        return "the subject is empty"
    if len(subject) > LONGEST:
        return f"the subject has {len(subject)} characters, {LONGEST} are allowed: {subject}"
    return "an empty line must part subject and body" if len(lines) > 1 and lines[1].strip() else ""


def main(path: str) -> int:
    """Tell the fault of a message in a file; 1 if it has one."""
    found = fault(Path(path).read_text(encoding="utf-8"))
    if found:
        print(found, file=sys.stderr)  # noqa: T201 (a command)
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
