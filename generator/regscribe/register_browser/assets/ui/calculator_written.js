/** What people write as a value: with its unit, and what decides where it is refused. */

const QUANTITY = /^\s*([+-]?(?:\d+(?:\.\d*)?|\.\d+))\s*([^\s\d.,;:+-].*?)\s*$/

/** As `encode`, of a text that may also end in the unit that the register has as things stand, and in no other. */
function encodedText(register, view, text, known, how) {
  const found = encode(register, view, text, known, how)
  const [, number, written] = QUANTITY.exec(text) ?? []
  const isPlain = found.refused !== "type" || isText(register) || parse(text) || /^\s*0x/i.test(text)
  if (isPlain || !written || !register.unit.some((one) => one.then)) return found
  const unit = unitOf(register, known)
  if (written === unit) return encode(register, view, number, known, how)
  return { refused: "unit", why: unit ? `the unit is ${unit} here, not ${written}` : `as things stand there is no unit ${written}` }
}

/** The facts of a register that a class of refusals comes from, as things stand. */
const CAUSES = {
  resolution: (register, view, known) => [choose(register.scale, known), view.times],
  range: (register, view, known) => [choose(register.range, known), choose(register.valid, known), register.special_scale],
  member: (register) => register.enum,
  bits: (register) => register.fields.map((one) => one.when),
  condition: (register, view) => [register.scale, register.range, register.valid, register.special_scale, view],
  unit: (register) => register.unit,
}

/** What is said above of the registers and givens that decided a refusal. @returns {string[]} their keys */
function decidersOf({ register, view, known, sent, asked }) {
  const found = { registers: new Set([sent.subject]), givens: new Set() }
  collect(CAUSES[sent.refused]?.(register, view, known), found)
  const keys = [...found.registers, ...found.givens]
  return keys.filter((key) => asked.paths.includes(key) || asked.givens.includes(key))
}

/** Why a value is refused, and the way to what decided that. */
function refusal(state) {
  const { sent, register } = state
  const links = decidersOf(state).map((key) => wayTo(`[data-known="${CSS.escape(key)}"]`, deciderText(state, key)))
  if (sent.refused === "resolution" && register.views.length > 1)
    links.push(wayTo("[data-choice=view]", `view = ${state.view.name}`))
  return [
    element("strong", {}, "Refused: "),
    sent.why,
    links.length ? [". Decided above by ", element("span", { class: "ways" }, links)] : null,
  ]
}

const wayTo = (selector, text) => button(text, () => document.querySelector(selector)?.focus(), { class: "way" })

/** `Decimals = 1`, `Input Type = RTD`. */
function deciderText({ item, model }, key) {
  const { map } = item
  const { values, givens } = saidOf(map)
  const found = subjectOf(map, model, key)
  const value = found ? (values[key] ?? defaultOf(map, model, key)) : givens[key]
  const members = (found?.field ?? found?.register)?.enum?.members ?? []
  const member = members.find(({ code }) => show(stated(code)) === value)
  const name = !found ? key : found.field ? `${found.register.name}: ${found.field.label}` : found.register.name
  return `${name} = ${member ? member.label || member.id : (value ?? "") === "" ? "not known" : value}`
}
