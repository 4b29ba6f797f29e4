"""The rules of meaning: what `lower` finds wrong. Each has a bad and a good map in `examples/`."""

from regscribe.model import Rule

UNKNOWN_REGISTER = "RS0301"
OTHER_MODELS = "RS0302"
UNKNOWN_FIELD = "RS0303"
UNKNOWN_ENUM = "RS0304"
UNKNOWN_MEMBER = "RS0305"
UNKNOWN_VIEWS = "RS0306"
UNKNOWN_CONDITION = "RS0307"
TYPE_BESIDE_VIEWS = "RS0308"
UNKNOWN_SCALE = "RS0309"
UNKNOWN_DECIMALS = "RS0310"
UNKNOWN_UNIT = "RS0311"
UNKNOWN_GIVEN = "RS0312"
UNKNOWN_COMMAND = "RS0313"
UNKNOWN_MODEL = "RS0314"
REVERSED = "RS0315"
BAD_BITS = "RS0316"
NO_IDENTIFIER = "RS0317"
TWO_SCALES = "RS0318"
NO_ACCESS = "RS0319"
IDLE_VARIANT = "RS0320"
ON_NO_MODEL = "RS0321"
BAD_DEFAULT = "RS0322"
UNKNOWN_VIEW = "RS0323"
UNKNOWN_FLAG = "RS0324"
UNKNOWN_SENTINEL = "RS0325"
NOT_CONSTANT = "RS0326"
BAD_MATCHER = "RS0327"
NO_ENDS = "RS0328"
BAD_VERSION = "RS0329"
WRONG_SORT = "RS0330"
TOO_MANY_ELEMENTS = "RS0331"
UNKNOWN_GROUP = "RS0332"
UNKNOWN_SET = "RS0333"
SET_IN_ITSELF = "RS0334"
NO_MODULE = "RS0335"
IDLE_LENGTH = "RS0336"
DIVIDED = "RS0337"
IDLE_KEY = "RS0338"
IDLE_DEFAULT = "RS0339"
UNKNOWN_BLOCK = "RS0360"
UNKNOWN_CHAIN = "RS0361"
SAME_BLOCK = "RS0362"
NO_MARKER = "RS0363"
IDLE_BLOCK = "RS0364"
ENDLESS = "RS0365"
NOT_PACKED = "RS0366"
SEVERAL_CODES = "RS0367"
UNKNOWN_ARGUMENT = "RS0345"
NO_PART = "RS0340"
BAD_LAYOUT = "RS0341"
CONDITION_IN_ITSELF = "RS0368"

_NAMES = "A name must mean something, or the driver would look up what does not exist."

RULES: tuple[Rule, ...] = (
    Rule(UNKNOWN_REGISTER, "Unknown register", _NAMES),
    Rule(OTHER_MODELS, "Register of other models only", "The driver of a model reaches the registers of that model."),
    Rule(UNKNOWN_FIELD, "Unknown bit field", _NAMES),
    Rule(UNKNOWN_ENUM, "Unknown enum", _NAMES),
    Rule(UNKNOWN_MEMBER, "Unknown enum member or special value", "A code by name must be one that the map gives."),
    Rule(UNKNOWN_VIEWS, "Unknown view set", _NAMES),
    Rule(UNKNOWN_CONDITION, "Unknown condition", _NAMES),
    Rule(
        TYPE_BESIDE_VIEWS,
        "Type, order or functions beside views",
        "Each view has a type, orders and functions of its own; others beside the view set would not count.",
    ),
    Rule(UNKNOWN_SCALE, "Unknown scale", _NAMES),
    Rule(UNKNOWN_DECIMALS, "Unknown decimals rule", _NAMES),
    Rule(UNKNOWN_UNIT, "Unknown unit", "A mistyped unit would be believed, so a map declares units that are uncommon."),
    Rule(UNKNOWN_GIVEN, "Unknown given, or one of another type", _NAMES),
    Rule(UNKNOWN_COMMAND, "Unknown command", _NAMES),
    Rule(UNKNOWN_ARGUMENT, "Unknown argument of a command", _NAMES),
    Rule(UNKNOWN_MODEL, "Unknown model", "A mistyped model would silently lose or keep a register."),
    Rule(REVERSED, "Reversed range", "A range whose lower end is above its upper end allows nothing."),
    Rule(BAD_BITS, "No such bit", "Bits count from 0, the least significant, to 1999 where `length` is 125."),
    Rule(
        NO_IDENTIFIER, "No identifier", "Names become identifiers of the driver; some names need an `id` beside them."
    ),
    Rule(TWO_SCALES, "Two scales", "A value is scaled once: by `scale`, by `decimals`, or by `multiply` and `add`."),
    Rule(NO_ACCESS, "Register without access", "Whether a register can be written must be said, never assumed."),
    Rule(IDLE_VARIANT, "Variant for a model without the register", "A variant that never counts hides a mistake."),
    Rule(ON_NO_MODEL, "Register on no model", "What no model has is in no driver."),
    Rule(BAD_DEFAULT, "Default that names nothing", "A default is a number, or the name of a member or special value."),
    Rule(UNKNOWN_VIEW, "Unknown view of a register", _NAMES),
    Rule(UNKNOWN_FLAG, "Unknown flag in an example", _NAMES),
    Rule(UNKNOWN_SENTINEL, "Unknown sentinel in an example", _NAMES),
    Rule(NOT_CONSTANT, "Value of a step that is not constant", "The words of a command depend on nothing else."),
    Rule(BAD_MATCHER, "Malformed matcher", "Codes in a list are alternatives; `not`, `in` and `not_in` stand alone."),
    Rule(NO_ENDS, "Scale from end to end of a type without ends", "The ends are at the lowest and highest raw code."),
    Rule(BAD_VERSION, "Malformed version pattern", "A version packs decimal digits in groups of equal length."),
    Rule(WRONG_SORT, "Value of another sort", "A number cannot be made of a text, nor the other way round."),
    Rule(TOO_MANY_ELEMENTS, "Array beyond the address space", "There are 65536 addresses, and no more elements."),
    Rule(UNKNOWN_GROUP, "Unknown group", _NAMES),
    Rule(UNKNOWN_SET, "Unknown set", _NAMES),
    Rule(SET_IN_ITSELF, "Set that contains itself", "A set within itself would have no end."),
    Rule(NO_MODULE, "Map id with a Python keyword", "Python cannot import a module that has the name of a keyword."),
    Rule(
        IDLE_LENGTH,
        "Length of a number, or none of a text",
        "A type tells the words of a number, the map those of a text.",
    ),
    Rule(
        DIVIDED,
        "Condition on a special value that decimals divide",
        "With each number of decimals it is another number, and a condition compares numbers.",
    ),
    Rule(
        IDLE_KEY, "Key without effect", "What has no effect would be believed: the map says it, and no driver does it."
    ),
    Rule(
        IDLE_DEFAULT,
        "Default without effect",
        "A default that means nothing to any of its registers would be believed.",
    ),
    Rule(BAD_LAYOUT, "Layout of no date or time", "What no word tells cannot be read; what tells it twice may differ."),
    Rule(UNKNOWN_BLOCK, "Unknown block", _NAMES),
    Rule(UNKNOWN_CHAIN, "Unknown chain", _NAMES),
    Rule(SAME_BLOCK, "Two blocks at one header", "Under two names its registers would have two meanings."),
    Rule(NO_MARKER, "Chain at several addresses without a marker", "Only a marker tells where a chain begins."),
    Rule(ENDLESS, "Array to the end of no block", "Only the length of a block tells where it ends."),
    Rule(
        NOT_PACKED,
        "Packed array that cannot be",
        "Addresses can follow a count where it is read first: in a block, from a register outside all arrays.",
    ),
    Rule(IDLE_BLOCK, "Chain or block without use", "What no register stands in is never looked for."),
    Rule(
        SEVERAL_CODES,
        "Name that depends on its case",
        "A condition compares codes; where a code has another meaning in another case, it would hold there too.",
    ),
    Rule(CONDITION_IN_ITSELF, "Condition that asks for itself", "What it is could not be told."),
    Rule(NO_PART, "Record of no file, or value of no queue", "Its address is the file's (or queue's) and its own."),
)

DEPENDS_ON_MAP = frozenset(
    {
        *(UNKNOWN_REGISTER, OTHER_MODELS, UNKNOWN_GIVEN, UNKNOWN_MODEL, NO_ACCESS),
        *(IDLE_VARIANT, ON_NO_MODEL, IDLE_BLOCK),
    }
)
"""Rules that cannot be judged in a library alone: what it lacks may stand in the maps that use it."""
