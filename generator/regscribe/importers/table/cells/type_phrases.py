"""Types in so many words: `Unsigned 16-bit Integer`, `Entier 16 bits signé`, `WORD (2's complement)`."""

import re

from regscribe.importers.table.cells.dialects import Dialect

_MEANINGS = {
    "unsigned": r"unsigned|non signée?|sans signe|vorzeichenlose?[rs]?|ohne vorzeichen|sin signo|senza segno|无符号",
    "signed": r"signed|signée?|avec signe|vorzeichenbehaftete?[rs]?|mit vorzeichen|con signo|con segno"
    r"|(?:two|2)'?s? complement|有符号",
    "int": r"integers?|int|entier|ganzzahl|entero|intero|heltal|geheel getal|整数|整型",
    "float": r"floating[ -]point|float|flottant|réel|(?:gleit|fließ|fliess)komma(?:zahl)?|flotante|virgola mobile"
    r"|flyttal|浮点数?",
    "dword": r"double mot|mot double|doppelwort|doble palabra|doppia parola|double word|dword",
    "word": r"word|mot|wort|palabra|parola",
    "bool": r"booléen|booleano|boolesch|boolean|bool",
    "byte": r"octets?|bytes?",
    "bit": r"bits?|位",
    "": r"numbers?|values?|register|data|type|zahl|nombre",
}
"""Words of types in several languages, by what they mean (nothing, for those that say nothing)."""

_WORD = re.compile("|".join(rf"(?P<w{at}>{words})" for at, words in enumerate(_MEANINGS.values())), re.IGNORECASE)
_TOKEN = re.compile(rf"\s*[,()\-/]*\s*(?:(?:{_WORD.pattern})(?![a-z])|(?P<n>[0-9]{{1,3}}))[\s,()\-/]*", re.IGNORECASE)


def phrase(plain: str, dialect: Dialect, sized: int) -> str:
    """The name of the type that words say together, `sized` bits beside them (0: not said); empty if they say none."""
    meant, numbers = _meant(plain)
    counted = not numbers or meant & {"bit", "byte", "int", "float"}  # `16 words` are no type
    if len(numbers) > 1 or not meant or not counted:
        return ""
    if "bool" in meant:
        return "bit" if meant == {"bool"} else ""
    bits = _bits(meant, numbers, dialect) or sized
    signs = meant & {"signed", "unsigned"}
    if "float" in meant:
        return f"float{bits or dialect.float_bits}" if not signs - {"signed"} and "int" not in meant else ""
    if len(signs) == 1 and bits:
        return f"{'int' if signs == {'signed'} else 'uint'}{bits}"
    return f"uint{bits}" if not signs and meant in ({"word"}, {"dword"}) else ""


def _bits(meant: set[str], numbers: list[int], dialect: Dialect) -> int:
    if numbers:
        return numbers[0] * 8 if "byte" in meant and "bit" not in meant else numbers[0]
    return 2 * dialect.word_bits if "dword" in meant else dialect.word_bits if "word" in meant else 0


def _meant(plain: str) -> tuple[set[str], list[int]]:
    """What the words mean and the numbers among them; nothing if one of them is not known."""
    meant: set[str] = set()
    numbers: list[int] = []
    at = 0
    while at < len(plain):
        found = _TOKEN.match(plain, at)
        if not found:
            return set(), []
        at = found.end()
        if found["n"]:
            numbers.append(int(found["n"]))
        else:
            meant |= {word for number, word in enumerate(_MEANINGS) if found[f"w{number}"]} - {""}
    return meant, numbers
