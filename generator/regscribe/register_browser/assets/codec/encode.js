/** The words that transmit a value, or why it has none. */

/**
 * The words that transmit a value. Throws nothing.
 * @param {string} text  a number, a text; of an enum also a member's id or label, of a number also a special value's
 * @param {{rounded?: boolean}} [how]  rounded: as the device rounds, where the value lies between two wire numbers
 * @returns {{words: number[]}|{refused: string, why: string, subject?: string}}  `refused` is the class of cause: range,
 *   resolution, member, bits, sentinel, type, condition, read_only, unknown, not_here (of these two, `subject` says what
 *   must be known, or cannot be computed); `why` says it in words. Whether a write is welcome now, `writable` tells.
 */
function encode(register, view, text, known, how = {}) {
  try {
    if (register.access === "r") throw new Refused("read_only", `${register.path} is read only`)
    return { words: encoded(register, view, valueOf(register, text, known), known, Boolean(how.rounded)) }
  } catch (error) {
    if (error instanceof Refused) return { refused: error.reason, why: error.message }
    if (error instanceof UnknownValue) return { refused: "unknown", why: error.message, subject: error.subject }
    if (error instanceof NotHere) return { refused: "not_here", why: error.message, subject: error.subject }
    throw error
  }
}

/** Whether a register may be written as things stand. @returns {boolean|{subject: string}} or what must be known to tell */
function writable(register, known) {
  if (register.access === "r") return false
  const exists = present(register, known)
  return exists === true && register.writable ? present(register.writable, known) : exists
}

const isText = (register) => register.kind === "version" || typeOf(register.views[0].type).octets

/** The number or text that people mean: an id or a label counts as its code. @returns {Rational|string} */
function valueOf(register, text, known) {
  if (isText(register)) return text
  const number = parse(text) ?? named(register, text.trim().toLowerCase(), known)
  if (!number) throw new Refused("type", `${text} is no number`)
  return number
}

function named(register, name, known) {
  const isIt = (one) => one.id?.toLowerCase() === name || one.label?.toLowerCase() === name
  const member = existingMembers(register, known).find(isIt)
  if (member) return stated(member.code)
  const special = register.specials.find(isIt)
  if (special) return special.means === undefined ? specialValue(register, special, known) : stated(special.means)
  if (register.kind === "boolean") return { true: ONE, false: ZERO, yes: ONE, no: ZERO, on: ONE, off: ZERO }[name]
  return register.kind === "flags" ? flagged(register, name) : undefined
}

function flagged(register, names) {
  const fields = names.split(/[|,\s]+/).map((name) => register.fields.find((one) => one.id.toLowerCase() === name))
  return fields.includes(undefined) ? undefined : ratio(fields.reduce((bits, one) => bits | maskOf(one), 0n))
}

function encoded(register, view, value, known, rounded) {
  const [order, factor] = [wordOrder(view, known), presentFactor(view, known)]
  if (!order || !factor) throw new Refused("condition", "the order of the words, or the factor of the view, is not known")
  const type = typeOf(view.type)
  if (type.octets) return encodedOctets(register, view, value, known, order)
  const number = checkedValue(register, register.kind === "version" ? versionNumber(register, value) : value, known)
  const found = isPattern(register) ? patternOf(type, number) : storedOf(register, number, known, rounded)
  const words = spelled(view, type, times(found, factor), order, rounded)
  const sent = wireNumber(type, words, order)
  if (sent !== null && presentSentinels(register, known).some((one) => isReported({ type, factor }, one, sent))) {
    throw new Refused("sentinel", `${show(found)} is how the device reports a fault`)
  }
  return words
}

function encodedOctets(register, view, text, known, order) {
  const raw = octetsOf(register, text, 2 * view.words)
  if (ofOctets(register, raw, known).meaning === "fault") {
    throw new Refused("sentinel", `${text} is how the device reports a fault`)
  }
  return wordsInOrder(raw, order)
}

/** The number that packs a version text; Refused for any other text. */
function versionNumber(register, text) {
  const digits = text.replaceAll(".", "")
  const number = /^\d+$/.test(digits) ? ratio(BigInt(digits)) : null
  if (number && versionText(register, number) === text) return number
  throw new Refused("type", `${text} is no version of ${register.version_digits} digits`)
}

/** A pattern of bits as a number of the view's type. */
function patternOf(type, number) {
  const size = 1n << type.bits
  if (number.n < 0n || number.n >= size) throw new Refused("type", `${show(number)} has more than ${type.bits} bits`)
  return number.n > type.maximum ? minus(number, ratio(size)) : number
}

/** The number to be scaled: the code of a special value, or a value that the register may be given. */
function checkedValue(register, value, known) {
  const code = specialCode(register, value, known)
  if (code) return code
  checkKind(register, value, known)
  if (!inRange(register, value, known) || !isValid(register, value, known)) {
    throw new Refused("range", `${show(value)} lies outside the range`)
  }
  return value
}

function checkKind(register, value, known) {
  const shown = show(value)
  if (register.kind === "boolean" && !equal(value, ZERO) && !equal(value, ONE)) {
    throw new Refused("type", `${shown} is neither 0 nor 1`)
  }
  if (!isMember(register, value, known)) throw new Refused("member", `${shown} is no member of ${register.enum.id}`)
  const isUnnamed = !isWhole(value) || value.n & ~namedBits(register)
  if (register.kind === "flags" && isUnnamed) throw new Refused("bits", `${shown} sets bits that mean nothing`)
  if (register.fields.length && isWhole(value) && value.n & missingBits(register, known)) {
    throw new Refused("bits", `${shown} sets bits of what does not exist`)
  }
  if (!isFractional(register) && !isWhole(value)) throw new Refused("type", `${shown} is no whole number`)
}

/** The code of the special value that a value is; null if it is none. */
function specialCode(register, value, known) {
  const codes = []
  for (const special of register.specials) {
    const code = specialValue(register, special, known)
    if (!code) throw new Refused("condition", "the decimals of special values are not known")
    if (equal(value, special.means === undefined ? code : stated(special.means))) return code
    codes.push(code)
  }
  if (codes.some((code) => equal(code, value))) {
    throw new Refused("range", `${show(value)} is a code that stands for another number`)
  }
  return null
}

function storedOf(register, value, known, rounded) {
  const found = choose(register.scale, known)
  const line = straight(found, known)
  if (!line) throw new Refused("condition", "no scale holds as things stand")
  return onStep(found.then ?? {}, line.stored(value), known, rounded)
}

function onStep({ step, places }, number, known, rounded) {
  const factor = decimalFactor(places, known)
  if (!factor) throw new Refused("condition", "nobody can tell how many decimals the device keeps")
  if (step === undefined) return number
  const size = over(stated(step), factor)
  const steps = over(number, size)
  if (isWhole(steps)) return number
  if (!rounded) throw new Refused("resolution", `${show(number)} is no multiple of ${show(size)}`)
  return times(size, ratio(floor(plus(steps, HALF))))
}
