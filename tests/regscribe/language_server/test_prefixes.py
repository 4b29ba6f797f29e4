"""Every prefix of a map, as it is while it is typed: all requests answer, whatever the text."""

from regscribe.language_server.completion import complete
from regscribe.language_server.fixes import fixes
from regscribe.language_server.hover import hover
from regscribe.language_server.lenses import other_addresses, read_examples
from regscribe.language_server.navigation import named_at, outline, references, targets
from regscribe.language_server.session import compile_text

from .conftest import At
from .texts import HEAD

TEXT = HEAD + "examples:\n  - {register: setpoint, words: [1505], value: 150.5}\n"


def test_every_prefix_of_a_map_is_answered(at: At) -> None:
    last = None
    for end in range(len(TEXT) + 1):
        files, file, line, column = at(f"{TEXT[:end]}│")
        found = complete(files, file, line, column)
        assert all(one.place.line <= line for one in found)
        outline(file)
        targets(files, file, line, column)
        if declared := named_at(files, file, line, column):
            references(files, file, declared[1], [])
        if end % 8 == 0 or end == len(TEXT):
            compiled = compile_text(file.path, files.unsaved, file)
            last = compiled.map or last
            assert all(list(fixes(files, file, one)) is not None for one in compiled.diagnostics)
        hover(files, file, line, column, last)
        if last:
            assert len(list(read_examples(file, last))) + len(list(other_addresses(file, last))) >= 0
    assert last is not None
