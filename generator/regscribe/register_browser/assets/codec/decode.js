/**
 * What words mean, step by step as the map language defines it.
 *
 * @typedef {object} Reading
 * @property {string} meaning  value, unknown_member, saturated, fault, out_of_range, not_decodable, not_present, unknown
 *   or not_here
 * @property {Rational|string} [value]  a number (an enum's code, the bits of a word), or a text
 * @property {string} [fault]  the id of the sentinel
 * @property {string} [subject]  with `unknown`: the register, `register.field` or given that must be known; with
 *   `not_here`: what the page cannot compute
 */

const NOT_DECODABLE = Object.freeze({ meaning: "not_decodable" })
const isPattern = (register) => register.kind === "flags" || register.kind === "fields"

/**
 * What `words`, read from a view, mean. Throws nothing.
 * @param {object} register  made by `registerOf`
 * @param {object} view  one of `register.views`
 * @param {number[]} words  as they stand on the wire
 * @param {object} known  made by `surroundings`
 * @returns {Reading}
 */
function decode(register, view, words, known) {
  return told(() => decoded(register, view, words, known))
}

/** What a function gives, or that a value must be known, or that the page cannot compute it. */
function told(compute) {
  try {
    return compute()
  } catch (error) {
    if (error instanceof UnknownValue) return { meaning: "unknown", subject: error.subject }
    if (error instanceof NotHere) return { meaning: "not_here", subject: error.subject }
    throw error
  }
}

function decoded(register, view, words, known) {
  if (words.length !== view.words) return NOT_DECODABLE
  const [order, factor] = [wordOrder(view, known), presentFactor(view, known)]
  if (!order || !factor) return NOT_DECODABLE
  const type = typeOf(view.type)
  if (type.octets) return ofOctets(register, bytesInOrder(words, order), known)
  return ofNumber(register, { view, type, factor }, wireNumber(type, words, order), known)
}

/** The sentinels of the first case that holds. */
function presentSentinels(register, known) {
  const first = register.sentinels.find((one) => holds(one.when, known))
  const same = (one) => JSON.stringify(one.when ?? {}) === JSON.stringify(first.when ?? {})
  return first ? register.sentinels.filter(same) : []
}

function ofOctets(register, raw, known) {
  const number = ratio(bitsOf(raw))
  for (const one of presentSentinels(register, known)) {
    const [low, high] = [stated(one.stored), stated(one.high ?? one.stored)]
    if (compare(low, number) <= 0 && compare(number, high) <= 0) return { meaning: "fault", fault: one.id }
  }
  const text = meaningOf(register, raw)
  return text === null ? NOT_DECODABLE : { meaning: "value", value: text }
}

function ofNumber(register, way, number, known) {
  const { view, type } = way
  const isEnd = () => number && isWhole(number) && (number.n === type.minimum || number.n === type.maximum)
  if (view.saturates && !type.float && isEnd()) return { meaning: "saturated" }
  const fault = number !== null && presentSentinels(register, known).find((one) => isReported(way, one, number))
  if (fault) return { meaning: "fault", fault: fault.id }
  if (number === null || number === NAN) return NOT_DECODABLE
  if (isPattern(register)) {
    missingBits(register, known) // what decides which of its bits have a meaning must be known
    return { meaning: "value", value: ratio(modulo(number.n, 1n << type.bits)) }
  }
  return meaningOfNumber(register, way, number, known)
}

/** The wire number by which a view reports a fault; null if it cannot. */
function sentinelNumber({ type, factor }, sentinel) {
  return sentinel.stored === "nan" ? NAN : carried(type, times(stated(sentinel.stored), factor))
}

/** Whether a number on the wire of a view reports a fault. */
function isReported(way, sentinel, number) {
  const low = sentinelNumber(way, sentinel)
  if (low === NAN || number === NAN || low === null) return low === number
  if (sentinel.high === undefined) return equal(low, number)
  const high = carried(way.type, times(stated(sentinel.high), way.factor))
  if (high === null) return false
  const [least, most] = compare(low, high) <= 0 ? [low, high] : [high, low]
  return compare(least, number) <= 0 && compare(number, most) <= 0
}

/** The code of a special value as a value of use; null if no scale holds or its decimals are no number. */
function specialValue(register, special, known) {
  const found = choose(register.special_scale, known)
  const factor = found && decimalFactor(found.then?.decimals, known)
  return factor && over(stated(special.code), factor)
}

function meaningOfNumber(register, way, number, known) {
  const line = straight(choose(register.scale, known), known)
  if (!line) return NOT_DECODABLE
  for (const special of register.specials) {
    const named = specialValue(register, special, known)
    if (!named) return NOT_DECODABLE
    const sent = carried(way.type, times(line.stored(named), way.factor))
    if (sent && equal(sent, number)) {
      const value = special.means === undefined ? named : stated(special.means)
      return { meaning: "value", value, special: special.id }
    }
  }
  const value = line.value(over(number, way.factor))
  const reading = ofKind(register, value, known)
  if (reading === NOT_DECODABLE || !register.valid.length) return reading
  try {
    return isValid(register, value, known) ? reading : { meaning: "out_of_range" }
  } catch (error) {
    if (error instanceof Refused) return NOT_DECODABLE
    throw error
  }
}

/** The members of a register's enum that exist as things stand. */
const existingMembers = (register, known) => (register.enum?.members ?? []).filter((one) => holds(one.when, known))

const isMember = (register, value, known) =>
  !register.enum || existingMembers(register, known).some((one) => equal(stated(one.code), value))

const lowOf = (field) => BigInt(field.low ?? 0)
const widthOf = (field) => BigInt((field.high ?? 0) - (field.low ?? 0) + 1)
const maskOf = (field) => ((1n << widthOf(field)) - 1n) << lowOf(field)

/** The bits of flags and parts that do not exist as things stand. */
function missingBits(register, known) {
  return register.fields.filter((one) => !holds(one.when, known)).reduce((bits, one) => bits + maskOf(one), 0n)
}

const namedBits = (register) => register.fields.reduce((bits, one) => bits + maskOf(one), 0n)

/** Whether a value may have a fraction: a number, or a float whose scale the manual does not state. */
const isFractional = (register) =>
  register.kind === "number" || (register.kind === "raw" && register.views.some((view) => typeOf(view.type).float))

function ofKind(register, value, known) {
  if (register.kind === "version") {
    const text = versionText(register, value)
    return text === null ? NOT_DECODABLE : { meaning: "value", value: text }
  }
  const found = { meaning: "value", value }
  if (register.kind === "boolean") return equal(value, ZERO) || equal(value, ONE) ? found : NOT_DECODABLE
  if (isFractional(register)) return ieeeBits(value, FLOATS.float64) === null ? NOT_DECODABLE : found
  if (!isWhole(value)) return NOT_DECODABLE
  return { meaning: isMember(register, value, known) ? "value" : "unknown_member", value }
}

/** A version as text (13100 with six digits in groups of two: 01.31.00); null for what does not fit. */
function versionText(register, number) {
  const digits = register.version_digits
  if (!isWhole(number) || number.n < 0n || number.n >= 10n ** BigInt(digits)) return null
  const text = String(number.n).padStart(digits, "0")
  const size = register.version_group || digits
  const groups = Array.from({ length: Math.ceil(digits / size) }, (_, place) => text.slice(place * size, (place + 1) * size))
  return groups.join(".")
}

/** The number of use in the bits of a field, or the sentinel of the fault that they report. @param {bigint} word */
function partValue(field, word) {
  const size = 1n << widthOf(field)
  let number = (word >> lowOf(field)) & (size - 1n)
  if (field.signed && number >= size / 2n) number -= size
  const stretch = ({ stored, high }) => [{ low: stored, high: high ?? stored }]
  const isIn = (one) => one.stored !== "nan" && liesIn(stretch(one), ratio(number), stated, compare)
  const fault = (field.sentinels ?? []).find(isIn)
  return fault ?? plus(times(stated(field.multiply ?? 1), ratio(number)), stated(field.add ?? 0))
}

/** Whether a register (part, flag, member ..) exists as things stand. @returns {boolean|{subject: string}} */
function present(one, known) {
  const found = told(() => holds(one.when, known))
  return typeof found === "boolean" ? found : { subject: found.subject }
}
