/** Words to wire numbers and back: order of words and bytes, rounding. */

const HALF = ratio(1n, 2n)

/** The whole number that a device of this rounding makes of a number; half up where the map does not say. */
function roundBy(rounding, number) {
  const halfUp = (one) => floor(plus(one, HALF))
  if (rounding === "down") return number.n / number.d
  if (rounding === "half_away" && number.n < 0n) return -halfUp(minus(ZERO, number))
  if (rounding !== "half_even") return halfUp(number)
  const below = floor(number)
  const isHalf = equal(minus(number, ratio(below)), HALF)
  return isHalf ? below + modulo(below, 2n) : halfUp(number)
}

/** The present order of words and bytes; null if what sets one of them sets it to none. */
function wordOrder(view, known) {
  const words = view.words > 1 ? orderNow(view.word_order, known) : "big"
  const bytes = orderNow(view.byte_order, known)
  return words === null || bytes === null ? null : { words, bytes }
}

function orderNow(order, known) {
  if (typeof order === "string" || Array.isArray(order)) return order
  if (order.cases) return choose(order.cases, known)?.then ?? null
  const value = lookUp(known.values, order.register)
  return order.codes.find(([code]) => equal(stated(code), value))?.[1] ?? null
}

/** Where on the wire each word stands, the most significant (or the first letters) first. */
function placesOf(order, count) {
  if (Array.isArray(order.words)) return order.words.map((place) => place - 1)
  const places = Array.from({ length: count }, (_, place) => place)
  return order.words === "big" ? places : places.reverse()
}

/** The bytes of words on the wire, the most significant (or the first letter) first. */
function bytesInOrder(words, order) {
  return placesOf(order, words.length).flatMap((place) => {
    const pair = [words[place] >> 8, words[place] & 255]
    return order.bytes === "big" ? pair : pair.reverse()
  })
}

/** The words on the wire of bytes that stand the most significant (or the first letter) first. */
function wordsInOrder(raw, order) {
  const places = placesOf(order, raw.length / 2)
  const words = new Array(Math.max(-1, ...places) + 1).fill(0) // some that stand apart have others between them
  places.forEach((place, number) => {
    const [first, second] = raw.slice(2 * number, 2 * number + 2)
    words[place] = order.bytes === "big" ? 256 * first + second : 256 * second + first
  })
  return words
}

const bitsOf = (bytes) => bytes.reduce((bits, byte) => (bits << 8n) | BigInt(byte), 0n)

function bytesOf(bits, count) {
  return Array.from({ length: count }, (_, place) => Number((bits >> BigInt(8 * (count - 1 - place))) & 255n))
}

const wordsOfBits = (type, bits, order) => wordsInOrder(bytesOf(bits, 2 * type.words), order)

/** The number in the words: NAN for patterns of no number, null for infinity and impossible digits. */
function wireNumber(type, words, order) {
  const bits = bitsOf(bytesInOrder(words, order))
  if (!type.float) return wholeNumber(bits, type)
  const number = ieeeNumber(bits, type.float)
  return number === NAN || number === null ? number : shortest(number, type.float)
}

/** The number that reading `number` from the wire gives; null if the type cannot carry it. */
function carried(type, number) {
  if (type.float) {
    const bits = ieeeBits(number, type.float)
    return bits === null ? null : shortest(ieeeNumber(bits, type.float), type.float)
  }
  return isWhole(number) && type.minimum <= number.n && number.n <= type.maximum ? number : null
}

/** The words of a wire number; Refused if the view cannot carry it. */
function spelled(view, type, number, order, rounded) {
  if (type.float) return wordsOfBits(type, floatBits(type, number, rounded), order)
  if (!isWhole(number) && !rounded) throw new Refused("resolution", `${show(number)} is no whole number on the wire`)
  const whole = roundBy(view.rounding, number)
  const within = view.saturates ? 1n : 0n
  const [lowest, highest] = [type.minimum + within, type.maximum - within]
  if (whole < lowest || whole > highest) {
    throw new Refused("type", `${whole} lies outside ${lowest} to ${highest} of ${type.name}`)
  }
  return wordsOfBits(type, wholeBits(whole, type), order)
}

function floatBits(type, number, rounded) {
  const bits = ieeeBits(number, type.float)
  if (bits === null) throw new Refused("type", `${show(number)} is beyond ${type.name}`)
  const there = ieeeNumber(bits, type.float)
  if (!rounded && !equal(number, there) && !equal(number, shortest(there, type.float))) {
    throw new Refused("resolution", `${show(number)} is finer than ${type.name}`)
  }
  return bits
}
