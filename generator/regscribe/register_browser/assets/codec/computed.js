/** Numbers that follow from several registers, from the words that each of these holds. */

/**
 * What is known once a register is read, behind those that decide what it means.
 * @param {object} known  made by `surroundings`; changed
 */
function take(register, words, known) {
  const reading = without(register, known) ?? heldReading(register, words, known)
  if (reading.meaning === "not_present") known.absent.add(register.path)
  const { value } = reading
  if (typeof value === "string") known.texts.set(register.path, value)
  else if (value) {
    known.values.set(register.path, value)
    for (const one of register.fields) {
      known.values.set(`${register.path}.${one.id}`, ratio((value.n & maskOf(one)) >> lowOf(one)))
    }
    if (isCoded(register, value, known)) known.coded.add(register.path)
  }
  return reading
}

function heldReading(register, words, known) {
  const reading = decode(register, register.views[0], words, known)
  return reading.meaning === "unknown" ? NOT_DECODABLE : reading
}

function isCoded(register, value, known) {
  const isIt = (one) => one.means === undefined && equal(specialValue(register, one, known) ?? NAN, value)
  return Boolean(register.enum) || register.specials.some(isIt)
}

/**
 * What a computed value of a map is, of what registers hold: codes and special values are not computed with.
 * @returns {Reading}
 */
function compute(computed, known) {
  try {
    const nothing = without(computed, known)
    if (nothing) return nothing
    const isCoded = [...referred([computed.term, computed.valid])].some((path) => known.coded.has(path))
    return isCoded ? NOT_DECODABLE : numberOf(computed, known)
  } catch (error) {
    if (error instanceof UnknownValue) return { meaning: "unknown", subject: error.subject }
    if (error instanceof Refused) return NOT_DECODABLE
    throw error
  }
}

function numberOf(computed, known) {
  const value = amount(computed.term, known)
  if (!value) return NOT_DECODABLE
  const valid = choose(computed.valid, known)
  const isWithin = !valid || within(limitsNow(valid.then ?? {}, known), value)
  return isWithin ? { meaning: "value", value } : { meaning: "out_of_range" }
}

/** That a thing does not exist, or that nobody knows; null if it exists. */
function without({ when }, known) {
  const found = told(() => holds(when, known))
  if (found === true) return null
  if (found === false) return { meaning: "not_present" }
  const asked = leavesOf(when).map((test) => test.register)
  return { meaning: asked.some((path) => known.absent.has(path)) ? "not_present" : "not_decodable" }
}

const leavesOf = (condition) =>
  (condition?.tests ?? []).flatMap((test) => (test.conditions ? test.conditions.flatMap(leavesOf) : [test]))

/** The registers whose values stand in terms or limits, those of conditions left out. */
function* referred(value) {
  if (Array.isArray(value)) for (const each of value) yield* referred(each)
  else if (value !== null && typeof value === "object") {
    if (typeof value.register === "string") yield value.register
    for (const [key, each] of Object.entries(value)) if (key !== "when" && key !== "decimals") yield* referred(each)
  }
}
