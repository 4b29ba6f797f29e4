"""The kinds of changes between two versions of a map, each with an id that stays and the reason why it matters."""

from regscribe.model import Rule, Severity


def _rule(number: int, title: str, why: str) -> Rule:
    return Rule(f"RS07{number:02}", title, why, Severity.WARNING)


ADDRESS = _rule(1, "Address changed", "Whoever asks at the old address reads and writes something else.")
ALIAS = _rule(2, "Further address added or removed", "Clients may use any address at which a value stands.")
TYPE = _rule(3, "Wire type or length changed", "The same words mean other numbers, at least for some values.")
ORDER = _rule(4, "Order of words or bytes changed", "Values are silently wrong for whoever keeps the old order.")
VIEW_SET = _rule(5, "View added or removed", "A view is a way to ask for a value; clients and programs name it.")
VIEW = _rule(6, "View changed", "The words, the functions or the rounding of a way to transmit a value are others.")
REACH = _rule(7, "Way to reach a register changed", "The block or the page that leads to its address is another one.")
ARRAY = _rule(8, "Array of another shape", "Elements that clients count on are gone, moved or numbered otherwise.")
KIND = _rule(10, "Kind of value changed", "Programs get and give values of another type.")
SCALE = _rule(11, "Scale changed", "The same words stand for another value.")
UNIT = _rule(12, "Unit changed", "The same number is another quantity.")
NARROWED = _rule(13, "Limits narrowed", "Values that were written before are refused; what is read shrinks only.")
WIDENED = _rule(14, "Limits widened", "Readers may see values that did not occur before.")
LIMITS = _rule(15, "Limits changed", "Some values are new and some are refused, or it depends on the device.")
DEFAULT = _rule(16, "Default changed", "A new device, and one that is reset, holds another value than before.")
CODE_ADDED = _rule(17, "Code added", "Programs that handle each code meet one that they do not know.")
CODE_REMOVED = _rule(18, "Code removed", "A name is gone from programs, and the device may refuse the code.")
CODE_RENAMED = _rule(19, "Code renamed", "Programs use the name, whatever the code is.")
CODE_MEANING = _rule(
    20, "Code with another meaning", "The worst of all: the same name, or the same code, acts otherwise."
)
SPECIAL = _rule(21, "Special value changed", "A number beside the range that has a meaning of its own.")
FAULT_ADDED = _rule(22, "Fault code added", "What was taken for a value is an error from now on.")
FAULT_REMOVED = _rule(23, "Fault code removed", "What was an error looks like a value from now on.")
BITS = _rule(24, "Bits of a part changed", "Clients that mask the old bits read and write another part of the word.")
PART_ADDED = _rule(25, "Part of a word added", "Bits that had no meaning have one.")
PART_REMOVED = _rule(26, "Part of a word removed", "Programs that name it break; its bits have no meaning any more.")
FORM = _rule(27, "Form of a text, date or version changed", "The same bytes are read as another text or moment.")
ACCESS_NARROWED = _rule(30, "Access narrowed", "What was read or written is refused, and the method is gone.")
ACCESS_WIDENED = _rule(31, "Access widened", "More can be done; nothing that worked is lost.")
EXISTENCE = _rule(32, "Condition changed", "Whether something exists, or which case counts, depends on other values.")
WRITING = _rule(33, "Condition of writing changed", "A write needs something before, after or around it, or no more.")
PERSISTENCE = _rule(34, "Memory changed", "A value that is written often wears out a lasting memory.")
READING = _rule(35, "Way of reading changed", "How often, when and whether at all a value is read along.")
RELATION = _rule(36, "Relation to others changed", "What a write does besides, or where a value comes from.")
ADDED = _rule(40, "Register added", "New, and nobody relies on it yet.")
REMOVED = _rule(41, "Register removed", "Clients are refused, and programs that name it break.")
RENAMED = _rule(
    42, "Register renamed", "The path in drivers, and what follows from it: unique ids, metrics, histories."
)
MOVED_GROUP = _rule(43, "Register in another group", "Reading or restoring a group takes other registers.")
UNCERTAIN = _rule(
    44, "Perhaps the same register", "Too much differs to say that one took the place of the other: judge it."
)
MODEL_ADDED = _rule(45, "Model added", "New, and nobody relies on it yet.")
MODEL_REMOVED = _rule(46, "Model removed", "Its driver is gone.")
MODEL_RENAMED = _rule(47, "Model renamed", "Links, configurations and backups name the model.")
MAP_ADDED = _rule(48, "Map added", "New, and nobody relies on it yet.")
MAP_REMOVED = _rule(49, "Map removed", "All its drivers are gone.")
MAP_RENAMED = _rule(50, "Map renamed", "The id is the name of the driver's module.")
THING_ADDED = _rule(51, "Group, command, computed value, program or block added", "New, and nobody relies on it yet.")
THING_REMOVED = _rule(52, "Group, command, computed value, program or block removed", "Programs that name it break.")
THING_RENAMED = _rule(53, "Group, command, computed value, program, given or part renamed", "Programs use the name.")
COMMAND = _rule(55, "Command changed", "It sends something else, needs something else or does something else.")
COMPUTED = _rule(56, "Computed value changed", "The same name gives another number.")
PROGRAM = _rule(57, "Setpoint program changed", "Programs are stored, started or read otherwise.")
PROCESS = _rule(58, "Process changed", "A simulated device controls otherwise.")
WRITE_ORDER = _rule(59, "Order of writing changed", "Restoring settings writes the groups in another order.")
GIVEN_ADDED = _rule(60, "Given added", "A constructor that needs one argument more breaks each program that calls it.")
GIVEN_REMOVED = _rule(61, "Given removed", "A constructor refuses an argument that it does not know.")
GIVEN_CHANGED = _rule(62, "Given changed", "A constructor takes other values for an argument.")
LIMIT_LOWERED = _rule(
    63, "Limit of requests lowered", "Requests as long as before are refused; drivers send more of them."
)
LIMIT_RAISED = _rule(64, "Limit of requests raised", "Longer requests are possible.")
FUNCTIONS = _rule(65, "Function codes changed", "A client that sends a function that is gone is refused.")
UNIT_IDS = _rule(66, "Unit ids changed", "A device answers at other unit ids, or drivers ask at another one.")
ANSWERS = _rule(67, "Answers to bad requests changed", "Exceptions, silence and unused addresses, as clients see them.")
LINE = _rule(68, "Line or timing changed", "Speed, format, framing, latencies: how and how fast a device is asked.")
IDENTITY = _rule(69, "Identification changed", "`identify` takes other devices for the model, or none.")
MEMORY = _rule(70, "Care of memory changed", "Whether a write of what is held already wears the memory.")
NAME_REMOVED = _rule(71, "Name of the driver module gone", "Programs that import the class break.")
NAME_ADDED = _rule(72, "Name of the driver module added", "New, and nobody relies on it yet.")
TEXT = _rule(73, "Text changed", "Readers see another name, label or description; nothing else differs.")
EVIDENCE = _rule(74, "Evidence changed", "Examples, errata, notes or the manual itself, on which the map rests.")

RULES: tuple[Rule, ...] = tuple(
    sorted((rule for rule in dict(globals()).values() if isinstance(rule, Rule)), key=lambda rule: rule.id)
)
"""All rules of this room."""
