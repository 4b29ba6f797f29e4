/**
 * The panel of what decides about a register: other registers and what a driver must be told.
 */

/** What the reader has said of a map so far; it stays while registers are looked at. */
function saidOf(map) {
  if (!browser.said.has(map.id)) browser.said.set(map.id, { values: {}, wrong: {}, givens: {}, written: {} })
  return browser.said.get(map.id)
}

/** What is known: what the reader said, else the defaults. @param {string[]} paths */
function knownOf(map, model, paths) {
  const said = saidOf(map)
  const values = {}
  for (const path of paths) {
    const value = said.values[path] ?? defaultOf(map, model, path)
    if (value !== "") values[path] = value
  }
  return surroundings(values, said.givens, map, model)
}

/** The register that a path names, also one of `register.field`; null if the model has none. */
function subjectOf(map, model, path) {
  const register = find(map, model, path)
  if (register) return { register, field: null }
  const owner = find(map, model, path.slice(0, path.lastIndexOf(".")))
  const field = owner?.fields.find((one) => one.id === path.slice(path.lastIndexOf(".") + 1))
  return field ? { register: owner, field } : null
}

/** The default of a register as text; empty where the map states none. */
function defaultOf(map, model, path) {
  const found = subjectOf(map, model, path)
  const value = found && !found.field ? found.register.default : undefined
  if (value === undefined || value === null) return ""
  return typeof value === "string" ? value : show(stated(value))
}

/** Fields for all of `paths` and of the givens; `changed` is called after each change. */
function surroundingFields(map, model, { paths, givens }, changed) {
  const fields = [
    ...paths.map((path) => registerField(map, model, path, changed)),
    ...givens.map((id) => givenField(map, id, changed)),
  ].filter(Boolean)
  if (!fields.length) return null
  return element("fieldset", { class: "known" }, element("legend", {}, "While"), fields)
}

function registerField(map, model, path, changed) {
  const found = subjectOf(map, model, path)
  const said = saidOf(map)
  const value = said.values[path] ?? defaultOf(map, model, path)
  const tell = (text) => {
    const isImpossible = impossible(found, text)
    said.wrong[path] = isImpossible ? text : undefined
    said.values[path] = isImpossible ? "" : text
    changed()
  }
  const members = found?.field ? found.field.enum?.members : found?.register.enum?.members
  const name = found ? (found.field ? `${found.register.name}: ${found.field.label}` : found.register.name) : path
  const control = members?.length ? memberPicker(members, value, tell) : numberField(said.wrong[path] ?? value, tell)
  return knownField(name, path, control, impossible(found, said.wrong[path] ?? ""))
}

/** A field of what is known, with what is wrong with what stands in it. */
function knownField(name, key, control, reason) {
  const id = `trouble-known-${key}`
  control.setAttribute("data-known", key)
  for (const [attribute, value] of Object.entries(troubleAttributes(id, reason)))
    if (value) control.setAttribute(attribute, value)
  return element(
    "div",
    {},
    labelled(element("span", {}, name, " ", element("code", {}, key)), control),
    troubleNote(id, reason),
  )
}

/** Why a register can have no such value, whatever the others have; empty where it can, and for no text. */
function impossible(found, text) {
  if (!text || (found && isText(found.register))) return ""
  if (!parse(text)) return `${text} is no number`
  if (!found || found.field) return ""
  const [view] = found.register.views
  const writable = { ...found.register, access: "rw", range: [], valid: [] }
  const { refused, why } = encode(writable, view, text, surroundings())
  return refused === "type" ? why : ""
}

function memberPicker(members, value, tell) {
  const options = members.map(({ code, label, id }) => [show(stated(code)), `${show(stated(code))} = ${label || id}`])
  if (value !== "" && !options.some(([code]) => code === value)) options.push([value, `${value} = no member`])
  return picker([["", "not known"], ...options], value, tell)
}

/** A list to pick from: values, their texts, and whether one cannot be picked. */
function picker(options, value, tell, attributes = {}) {
  const made = element(
    "select",
    { ...attributes, on: { change: () => tell(made.value) } },
    options.map(([one, text, isOff]) => element("option", { value: one, selected: one === value, disabled: isOff }, text)),
  )
  return made
}

function numberField(value, tell) {
  const made = element("input", {
    type: "text",
    inputmode: "decimal",
    autocomplete: "off",
    spellcheck: "false",
    placeholder: "not known",
    on: { input: () => tell(made.value.trim()) },
  })
  made.value = value
  return made
}

function givenField(map, id, changed) {
  const given = (map.givens ?? []).find((one) => one.id === id)
  if (!given) return null
  const { givens, written } = saidOf(map)
  const tell = (value, text = value) => {
    written[id] = text
    if (value === "") delete givens[id]
    else givens[id] = value
    changed()
  }
  const control = {
    boolean: () =>
      picker(
        [
          ["", "not known"],
          ["true", "yes"],
          ["false", "no"],
        ],
        String(givens[id] ?? ""),
        tell,
      ),
    choice: () =>
      picker([["", "not known"], ...(given.choices ?? []).map((one) => [one, one])], givens[id] ?? "", tell),
    codes: () => numberField(written[id] ?? "", (text) => tell(codesOf(text), text)),
    number: () => numberField(written[id] ?? "", (text) => tell(parse(text) ? text : "", text)),
  }[given.kind]()
  return knownField(given.description.replaceAll("`", ""), id, control, givenTrouble(given, written[id] ?? ""))
}

/** What is wrong with what was written for a given; empty where nothing is. */
function givenTrouble({ kind }, text) {
  if (kind === "number") return text && !parse(text) ? `${text} is no number` : ""
  const wrong = kind === "codes" && text.split(/[,\s]+/).find((part) => part && !codesOf(part).length)
  return wrong ? `${wrong} is no code, and no stretch such as 4..6` : ""
}

/** The codes of a list `1, 4..6`; empty for no text. */
function codesOf(text) {
  if (!text.trim()) return ""
  return text
    .split(/[,\s]+/)
    .filter(Boolean)
    .flatMap((part) => {
      const [low, high = low] = part.split("..").map(Number)
      return Number.isInteger(low) && Number.isInteger(high) && high - low < 1000
        ? Array.from({ length: Math.max(high - low + 1, 0) }, (_, place) => String(low + place))
        : []
    })
}
