/** Readings in the words of people. */

/**
 * A reading in the words of people.
 * @returns {{text: string, unit: string, member?: object, special?: object, fault?: object,
 *   fields?: {field: object, text: string, set: boolean, bits: bigint, exists: boolean, valid: boolean,
 *     member?: object, fault?: object}[]}}
 *   `text` is the value alone; `unit` the one that holds now; members, specials, sentinels and fields as data have them
 */
function describe(register, reading, known) {
  const { value } = reading
  const found = { text: textOfReading(reading), unit: unitOf(register, known) }
  const fault = register.sentinels.find((one) => one.id === reading.fault)
  if (fault) return { ...found, fault }
  if (value === undefined || typeof value === "string") return found
  const member = told(() => existingMembers(register, known).find((one) => equal(stated(one.code), value)))
  if (member?.id) found.member = member
  const special = register.specials.find((one) => one.id === reading.special)
  if (special) found.special = special
  if (register.fields.length) found.fields = register.fields.map((field) => describePart(field, value.n, known))
  return found
}

function textOfReading({ value, meaning }) {
  if (value === undefined) return meaning
  return typeof value === "string" ? value : show(value)
}

function unitOf(register, known) {
  const found = told(() => choose(register.unit, known))
  return found?.meaning ? "" : (found?.then ?? "")
}

function describePart(field, word, known) {
  const bits = (word & maskOf(field)) >> lowOf(field)
  const exists = present(field, known) === true
  const part = partValue(field, word)
  const text = "n" in part ? show(part) : (part.label ?? part.id)
  const found = { field, bits, set: bits > 0n, exists, valid: true, text }
  if (!("n" in part)) return { ...found, fault: part }
  found.valid = !field.valid || liesIn([{ low: field.valid[0], high: field.valid[1] }], part, stated, compare)
  const member = told(() => existingMembers(field, known).find((one) => equal(stated(one.code), part)))
  return member?.id ? { ...found, member } : found
}
