/**
 * Lines to copy: words, Python, the command line, and requests as bytes.
 */

/** What can be copied of a calculation. */
function copyLines(state) {
  const { item, register, view, words, reading, known, sent } = state
  const unit = item.map.default_unit ?? 1
  const isMeant = reading.meaning === "value" || reading.meaning === "unknown_member"
  const reads = register.access !== "w"
  const writes = register.access !== "r" && !sent?.refused && isMeant
  const lines = [
    ["Words", hexWords(words)],
    reads && ["Python, read", pythonRead(register, view)],
    writes && ["Python, write", pythonWrite(register, view, words, reading, known)],
    reads && ["Command line, read", `regscribe read DEVICE ${shellWord(register.path)}`],
    writes && ["Command line, write", shellWrite(register, view, reading, known)],
    reads && frameLine("RTU request, read", frame(item.map, register, view, unit)),
    writes && frameLine("RTU request, write", frame(item.map, register, view, unit, words)),
  ].filter(Boolean)
  return element(
    "dl",
    { class: "lines" },
    lines.map(([label, text, isPlain]) => [
      element("dt", {}, label),
      element("dd", {}, isPlain ? text : [element("code", {}, text), " ", copyButton(text, label)]),
    ]),
  )
}

const frameLine = (label, found) =>
  found.refused
    ? [label, found.refused, true]
    : [label, found.frame.map((byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ")]

/** The expression of a register in Python: an element of an array is reached by its index. */
const pythonPath = (register) => `controller.${register.path}`

const viewArgument = (register, view) =>
  register.views.length > 1 && !isPreferred(register, view) ? `view=${quoted(view.name)}` : ""

const isPreferred = (register, view) => view === (register.views.find((one) => one.preferred) ?? register.views[0])

const pythonRead = (register, view) => `${pythonPath(register)}.read(${viewArgument(register, view)})`

/** A value is written as such, with the consent that a dangerous write needs; what has no name and is no number, by words. */
function pythonWrite(register, view, words, reading, known) {
  const value = pythonValue(register, reading, known)
  const written = value === null ? `write_raw((${words.join(", ")},)` : `write(${value}`
  const options = [viewArgument(register, view), value !== null && register.danger ? "confirm=True" : ""].filter(Boolean)
  return `${pythonPath(register)}.${[written, ...options].join(", ")})`
}

function shellWrite(register, view, reading, known) {
  const { member, text } = describe(register, reading, known)
  const isOther = register.views.length > 1 && !isPreferred(register, view)
  const options = `${isOther ? `--view ${shellWord(view.name)} ` : ""}${register.danger ? "--confirm " : ""}`
  const value = member ? member.id : text
  return `regscribe write ${options}${value.startsWith("-") ? "-- " : ""}DEVICE ${shellWord(register.path)} ${shellWord(value)}`
}

/** A text as one word of a shell. */
const shellWord = (text) => (/^[\w.+-]+$/.test(text) ? text : `'${text.replaceAll("'", `'"'"'`)}'`)

const quoted = (text) => JSON.stringify(text)
