/** What a user of the generated driver writes: members, flags and words by the names of their classes. */

/** `input_type` as `InputType`, as the driver names a class after an id. */
const camel = (id) =>
  id
    .split(/[^A-Za-z0-9]+/)
    .map((part) => part.slice(0, 1).toUpperCase() + part.slice(1))
    .join("")

/** The class of an enum, a word or special values; empty where it cannot be told. */
const pythonClass = (register, key, id) => register.python?.[key] ?? camel(id)

/** A value as Python of a driver; null where only its words can be written. */
function pythonValue(register, { value, special, meaning }, known) {
  if (meaning !== "value") return null
  if (typeof value === "string") return /^(?:string|version)$/.test(register.kind) ? JSON.stringify(value) : null
  if (special) return pythonSpecial(register, special)
  const write = PYTHON_VALUES[register.kind]
  return write ? write(register, value, known) : null
}

const plainNumber = (register, value) => (/^-?[0-9.]+$/.test(show(value)) ? show(value) : null)

const PYTHON_VALUES = {
  number: plainNumber,
  integer: plainNumber,
  raw: plainNumber,
  boolean: (register, value) => (value.n ? "True" : "False"),
  enum: (register, value, known) => {
    const listed = register.enum.cases ? told(() => choose(register.enum.cases, known))?.then : register.enum
    return listed?.members ? pythonMember(register, listed, value) : null
  },
  flags: (register, { n }) => {
    const name = pythonClass(register, "word", register.id)
    const set = register.fields.filter((one) => n & maskOf(one)).map((one) => `${name}.${one.id.toUpperCase()}`)
    return set.join(" | ") || `${name}(0)`
  },
  fields: (register, { n }) => `${pythonClass(register, "word", register.id)}(0x${n.toString(16).toUpperCase()})`,
}

function pythonMember(register, { id, members }, value) {
  const name = pythonClass(register, `enum ${id}`, id)
  const member = members.find((one) => equal(stated(one.code), value))
  return name && member ? `${name}.${member.id.toUpperCase()}` : null
}

function pythonSpecial(register, id) {
  const special = register.specials.find((one) => one.id === id)
  if (special.means !== undefined) return plainNumber(register, stated(special.means))
  return `${pythonClass(register, "special", `${register.id}_special`)}.${id.toUpperCase()}`
}
