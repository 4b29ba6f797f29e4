/** Conditions on the values of other registers and on what is given. */

/** A needed value is not known: `subject` is the register, `register.field` or given. */
class UnknownValue extends Error {
  constructor(subject) {
    super(`${subject} is not known`)
    this.subject = subject
  }
}

/** What of the language the page cannot compute: `subject` names it. */
class NotHere extends Error {
  constructor(subject) {
    super(`this page cannot compute ${subject}`)
    this.subject = subject
  }
}

/** A value that has no words: `reason` is the class of cause, the message has the numbers. */
class Refused extends Error {
  constructor(reason, message) {
    super(message)
    this.reason = reason
  }
}

/**
 * What is known besides the words: values of use of registers by path (or `register.field`), and what is given.
 * @param {Object<string, string|Rational>} values  decimal texts or numbers; of registers that hold a text, the text
 * @param {Object<string, string|boolean|string[]>} givens  by id: a number or a choice as text, yes or no, or codes
 * @param {object} [map]  whose givens have defaults, which count where none is given
 * @param {string} [model]  whose registers tell which texts are versions
 */
function surroundings(values = {}, givens = {}, map = {}, model = "") {
  const known = {
    values: new Map(), texts: new Map(), codes: new Map(), facts: new Map(), numbers: new Map(),
    absent: new Set(), coded: new Set(),
  }
  for (const [path, value] of Object.entries(values)) {
    const isVersion = model && find(map, model, path)?.kind === "version"
    const number = typeof value !== "string" ? value : parse(isVersion ? value.replaceAll(".", "") : value)
    if (number) known.values.set(path, number)
    if (typeof value === "string") known.texts.set(path, value)
  }
  for (const one of map.givens ?? []) {
    const value = Object.hasOwn(givens, one.id) ? givens[one.id] : one.default
    if (value !== undefined && value !== null) give(known, one, value)
  }
  return known
}

function give(known, { id, kind }, value) {
  if (kind === "number") {
    const number = typeof value === "string" ? parse(value) : stated(value)
    if (number) known.numbers.set(id, number)
  } else if (kind === "choice") known.texts.set(`given.${id}`, String(value))
  else if (kind === "codes") known.codes.set(id, value.map((one) => parse(String(one))).filter(Boolean))
  else known.facts.set(id, value === true || value === "true")
}

function lookUp(map, subject) {
  if (!map.has(subject)) throw new UnknownValue(subject)
  return map.get(subject)
}

/** Whether all tests of a condition are true; one that is not settles it, whatever is not known. */
function holds(condition, known) {
  return decided(condition?.tests ?? [], known, isTrue, false)
}

function decided(several, known, judge, by) {
  let unknown = null
  for (const one of several) {
    try {
      if (judge(one, known) === by) return by
    } catch (error) {
      if (!(error instanceof UnknownValue)) throw error
      unknown = error
    }
  }
  if (unknown) throw unknown
  return !by
}

function isTrue(test, known) {
  const negated = Boolean(test.negated)
  if (test.conditions) return decided(test.conditions, known, holds, true) !== negated
  const subject = !test.register ? `given.${test.given}` : test.field ? `${test.register}.${test.field}` : test.register
  if (test.given && !test.codes) return ofGiven(test, subject, known) !== negated
  if (test.version) {
    const found = versionKey(lookUp(known.texts, subject))
    return (found !== null && liesIn(test.codes, found, versionKey, compareKeys)) !== negated
  }
  if (!test.register && known.numbers.has(test.given)) return isListed(test, known.numbers.get(test.given)) !== negated
  if (typeof test.codes?.[0]?.low !== "string") return isListed(test, lookUp(known.values, subject)) !== negated
  return liesIn(test.codes, lookUp(known.texts, subject), (text) => text, compareKeys) !== negated
}

const compareKeys = (a, b) => (a < b ? -1 : a > b ? 1 : 0)
const isListed = (test, value) => liesIn(test.codes ?? [], value, stated, compare)

/** Whether a value lies in one of the stretches; an end that is left out is open. */
function liesIn(codes, value, endOf, order) {
  return codes.some(
    ({ low, high }) =>
      (low === undefined || order(endOf(low), value) <= 0) && (high === undefined || order(value, endOf(high)) <= 0),
  )
}

function ofGiven(test, subject, known) {
  if (!test.register) return lookUp(known.facts, test.given)
  const value = lookUp(known.values, subject)
  return lookUp(known.codes, test.given).some((code) => equal(code, value))
}

/** The first dotted number of a text, behind letters and blanks only, as one that is in order as versions are. */
function versionKey(text) {
  const found = /^[A-Za-z ]*(\d{1,6}(?:\.\d{1,6}){0,3})/.exec(text)
  if (!found) return null
  const parts = found[1].split(".")
  return [0, 1, 2, 3].reduce((key, place) => key * 1000000n + BigInt(parts[place] ?? 0), 0n)
}

/** The first case that holds; null if none does. */
function choose(cases, known) {
  return (cases ?? []).find((one) => holds(one.when, known)) ?? null
}
