/**
 * The calculator: words to value and value to words, in a view, as things stand. It computes nothing itself.
 */

const MEANINGS = {
  value: "", unknown_member: "a code that the list does not have", saturated: "the view stops here: this is no value",
  fault: "a fault, no value", out_of_range: "outside the valid readings: a fault", not_decodable: "these words mean nothing",
  unknown: "cannot be told",
}
const WIDTHS = { coil: 1, discrete: 1, status: 8, enron: 32 }

/** The calculator of an item; what is chosen in it stays in `choice`. */
function shownCalculator(item, choice) {
  const { map, entry } = item
  const box = element("section", { class: "calculator", "aria-label": "Calculator" })
  const again = (focus) => {
    const { model } = choice
    const register = registerOf(map, entry, model, choice.index)
    const view = register.views.find((one) => one.name === choice.view) ?? register.views.find((one) => one.preferred) ?? register.views[0]
    if (!view) return
    const state = { ...stateOf(item, choice, model, register, view), again, choice, item }
    box.replaceChildren(...calculatorParts(state))
    if (focus) box.querySelector(focus)?.focus()
  }
  again()
  return box
}

/** What is computed with: the register, its view, what is known, the words and what they mean. */
function stateOf(item, choice, model, register, view) {
  const asked = needs(register, view)
  const paths = [...asked.read, ...asked.write]
  const known = knownOf(item.map, model, paths)
  const count = view.space in { coil: 1, discrete: 1, status: 1 } ? 1 : view.words
  if (choice.words?.length !== count) choice.words = null
  if (!choice.words && !choice.text) choice.words = startWords(register, view, known, count)
  const sent = choice.text === null ? null : encode(register, view, choice.text, known, { rounded: choice.rounded })
  if (sent?.words) choice.words = sent.words
  const words = choice.words ?? Array(count).fill(0)
  return { model, register, view, asked: { paths, givens: asked.givens }, known, words, sent, reading: decode(register, view, words, known) }
}

/** The words to begin with: those of the default, where there is one. */
function startWords(register, view, known, count) {
  if (register.default !== undefined && register.default !== null && register.access !== "r") {
    const text = typeof register.default === "string" ? register.default : show(stated(register.default))
    const found = encode(register, view, text, known)
    if (found.words) return found.words
  }
  return Array(count).fill(0)
}

function calculatorParts(state) {
  const { item, choice, register, view, again } = state
  return [
    element("h3", {}, "Calculator"),
    register.views.length > 1 ? element("div", { class: "choices" }, labelled("View", picker(register.views.map((one) => [one.name, `${one.name} at ${one.address}`]), view.name, (name) => { choice.view = name; restart(choice); again("[data-choice=view]") }, { "data-choice": "view" }))) : null,
    surroundingFields(item.map, state.model, state.asked, () => refresh(state)),
    element("div", { class: "sides" }, wordsSide(state), valueSide(state)),
    element("div", { class: "copies" }, copyLines(state)),
  ].filter(Boolean)
}

/** Begin with the words of the default again: another view has others. */
function restart(choice) {
  choice.words = null
  choice.text = null
}

/** Compute again after a change of what is known, without touching the field that is written into. */
function refresh(state) {
  const focused = document.activeElement?.getAttribute("data-known")
  const [from, to] = [document.activeElement?.selectionStart, document.activeElement?.selectionEnd]
  state.again(focused ? `[data-known="${CSS.escape(focused)}"]` : null)
  if (focused && typeof from === "number") document.activeElement.setSelectionRange?.(from, to)
}

/** The words as they stand on the wire: in hexadecimal, in decimal and bit by bit. */
function wordsSide(state) {
  const { words, view } = state
  const width = WIDTHS[view.space] ?? 16
  return element("div", { class: "words" },
    element("h4", {}, width === 16 ? "Words on the wire" : "Bits on the wire"),
    words.map((word, place) => wordRow(state, word, place, width)))
}

function wordRow(state, word, place, width) {
  const { view, words } = state
  const name = words.length > 1 ? `word ${place + 1}` : "word"
  const address = view.address + (view.offsets?.[place] ?? place)
  const set = (number, focus) => {
    state.choice.words = words.map((one, at) => (at === place ? number : one))
    state.choice.text = null
    state.again(focus)
  }
  return element("div", { class: "word" },
    element("span", { class: "at" }, `${address}`),
    wordField(`Hexadecimal, ${name}`, "0x" + word.toString(16).toUpperCase().padStart(width / 4, "0"), /^(?:0x|\$)?([0-9a-f]+)h?$/i, 16, width, set, `[data-word="16-${place}"]`),
    wordField(`Decimal, ${name}`, String(word), /^(-?[0-9]+)$/, 10, width, set, `[data-word="10-${place}"]`),
    bitButtons(word, width, bitLabels(state, width), false, (bit) => set((word ^ (1 << bit)) >>> 0, `.word:nth-of-type(${place + 1}) [data-bit="${bit}"]`)))
}

/** What the bits of the only word are called. */
function bitLabels({ register, words }, width) {
  const labels = {}
  if (words.length > 1 || width > 16) return labels
  for (const field of register.fields) for (const bit of bitsOf(field)) labels[bit] = field.label
  return labels
}

function wordField(label, text, form, base, width, set, focus) {
  const field = element("input", { type: "text", class: base === 16 ? "hex" : "decimal", "aria-label": label, "data-word": focus.slice(12, -2), autocomplete: "off", spellcheck: "false",
    on: { change: () => {
      const found = form.exec(field.value.trim())
      const number = found ? parseInt(found[1], base) : NaN
      const top = 2 ** width
      if (number >= -top / 2 && number < top) set(number < 0 ? number + top : number, focus)
      else { field.setAttribute("aria-invalid", "true"); announce(`${field.value} is no word of ${width} bits`) }
    } } })
  field.value = text
  return field
}

/** The value that the words mean, and a field to write another. */
function valueSide(state) {
  const { register, reading, known, sent, choice } = state
  const said = describe(register, reading, known)
  return element("div", { class: "value" },
    element("h4", {}, "Value"),
    element("output", { class: `reading ${reading.meaning}`, "aria-live": "polite" }, readingNodes(reading, said)),
    said.fields ? fieldList(said.fields) : null,
    register.access === "r" ? element("p", { class: "hint" }, "Read only: a value has no words to write.") : valueFields(state),
    sent?.refused ? element("p", { class: "refused", role: "status" }, element("strong", {}, "Refused: "), reasonOf(sent)) : null,
    choice.text !== null && sent?.words ? element("p", { class: "hint", role: "status" }, `Written as ${hexWords(sent.words)}`) : null)
}

function readingNodes(reading, said) {
  const { member, special, fault, text, unit } = said
  if (reading.meaning === "unknown") return [element("strong", {}, "?"), ` ${MEANINGS.unknown}: ${reading.subject} is not known`]
  if (fault) return [element("strong", {}, fault.label || fault.id), ` (${MEANINGS.fault})`]
  const isValue = reading.value !== undefined
  const name = member ? ` = ${member.label || member.id}` : special ? ` = ${special.label}` : ""
  return [
    isValue ? element("strong", {}, text === "" ? "(empty text)" : text) : null,
    isValue && unit && !member && !special ? ` ${unit}` : null,
    name,
    MEANINGS[reading.meaning] ? element("span", { class: "meaning" }, isValue ? `: ${MEANINGS[reading.meaning]}` : MEANINGS[reading.meaning]) : null,
  ]
}

function fieldList(fields) {
  return element("ul", { class: "parts" }, fields.filter((one) => one.exists !== false).map(({ field, text, set, member, fault }) =>
    element("li", { class: set ? "set" : null }, element("span", {}, field.label || field.id), " ",
      element("strong", {}, fault ? fault.label || text : member ? `${text} = ${member.label}` : bitsOf(field).length === 1 ? (set ? "on" : "off") : text))))
}

function valueFields(state) {
  const { register, choice, again, known, reading } = state
  const tell = (text, focus) => {
    choice.text = text.trim() === "" ? null : text
    again(focus)
  }
  const members = register.enum?.members ?? register.enum?.cases?.flatMap((one) => one.then.members) ?? []
  const pick = members.length
    ? labelled("Pick a member", picker([["", "…"], ...members.map(({ code, label, id }) => [show(stated(code)), `${show(stated(code))} = ${label || id}`])],
        choice.text ?? textOf(register, reading, known), (code) => tell(code, "[data-value=pick]"), { "data-value": "pick" })) : null
  const field = element("input", { type: "text", "data-value": "text", autocomplete: "off", spellcheck: "false", placeholder: hintOf(register),
    on: { input: () => { const at = field.selectionStart; tell(field.value, "[data-value=text]"); document.activeElement.setSelectionRange?.(at, at) } } })
  field.value = choice.text ?? ""
  const round = element("input", { type: "checkbox", "data-value": "round", on: { change: () => { choice.rounded = round.checked; again("[data-value=round]") } } })
  round.checked = Boolean(choice.rounded)
  return element("div", { class: "write" }, pick, labelled("Value to write", field),
    register.kind === "number" ? element("label", { class: "check" }, round, " round to what the view can hold") : null)
}

const hintOf = (register) => (register.enum ? "code, id or label" : register.kind === "flags" ? "number or names" : register.kind === "number" ? "150.5" : "")

const textOf = (register, reading, known) => (reading.value === undefined ? "" : describe(register, reading, known).text)

const reasonOf = ({ refused, why, subject }) => [why, refused === "unknown" && subject ? ": say it above" : ""]

const hexWords = (words) => words.map((word) => word.toString(16).toUpperCase().padStart(4, "0")).join(" ")
