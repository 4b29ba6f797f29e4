/**
 * Lines to copy: words, Python, the command line, and requests as bytes.
 */

/** What can be copied of a calculation. */
function copyLines(state) {
  const { item, register, view, words, reading, known, model, sent } = state
  const unit = item.map.default_unit ?? 1
  const isWritable = register.access !== "r" && !sent?.refused
  const lines = [
    ["Words", hexWords(words)],
    ...(register.access === "w" ? [] : [["Python, read", pythonRead(register, view)]]),
    ...(isWritable ? [["Python, write", pythonWrite(register, view, words, reading, known)]] : []),
    ...(register.access === "w" ? [] : [["Command line, read", `regscribe read DEVICE ${register.path}`]]),
    ...(isWritable && reading.value !== undefined ? [["Command line, write", shellWrite(register, view, reading, known)]] : []),
    ...(register.access === "w" ? [] : [frameLine("RTU request, read", frame(item.map, register, view, unit))]),
    ...(isWritable ? [frameLine("RTU request, write", frame(item.map, register, view, unit, words))] : []),
  ]
  return element("dl", { class: "lines" }, lines.map(([label, text, isPlain]) => [
    element("dt", {}, label),
    element("dd", {}, isPlain ? text : [element("code", {}, text), " ", copyButton(text, label)])]))
}

const frameLine = (label, found) =>
  found.refused ? [label, found.refused, true] : [label, found.frame.map((byte) => byte.toString(16).toUpperCase().padStart(2, "0")).join(" ")]

/** The expression of a register in Python: an element of an array is reached by its index. */
const pythonPath = (register) => `controller.${register.path}`

const viewArgument = (register, view) => (register.views.length > 1 && !isPreferred(register, view) ? `view=${quoted(view.name)}` : "")

const isPreferred = (register, view) => view === (register.views.find((one) => one.preferred) ?? register.views[0])

const pythonRead = (register, view) => `${pythonPath(register)}.read(${viewArgument(register, view)})`

function pythonWrite(register, view, words, reading, known) {
  const options = viewArgument(register, view)
  const behind = options && `, ${options}`
  const isNumber = (register.kind === "number" || register.kind === "integer" || register.kind === "raw") && reading.meaning === "value"
  const text = textOf(register, reading, known)
  if (isNumber && /^-?[0-9.]+$/.test(text) && !reading.special) return `${pythonPath(register)}.write(${text}${behind})`
  return `${pythonPath(register)}.write_raw((${words.join(", ")},)${behind})`
}

function shellWrite(register, view, reading, known) {
  const { member, text } = describe(register, reading, known)
  const value = member ? member.id : text
  const options = register.views.length > 1 && !isPreferred(register, view) ? ` --view ${view.name}` : ""
  return `regscribe write DEVICE ${register.path} ${shellWord(value)}${options}`
}

const shellWord = (text) => (/^[\w.+-]+$/.test(text) && !text.startsWith("-") ? text : text.startsWith("-") ? `-- ${text}` : `'${text.replaceAll("'", `'"'"'`)}'`)

const quoted = (text) => JSON.stringify(text)
