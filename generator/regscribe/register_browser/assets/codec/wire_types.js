/** Types of numbers on the wire, and whole numbers in the bits of their words. */

/** Numbers of places: bit patterns of a place, how many of them are digits, and how many places there are. */
const PLACES = {
  bcd16: [16n, 10n, 4], bcd32: [16n, 10n, 8], bcd48: [16n, 10n, 12], bcd64: [16n, 10n, 16],
  mod10k_2: [1n << 16n, 10n ** 4n, 2], mod10k_3: [1n << 16n, 10n ** 4n, 3], mod10k_4: [1n << 16n, 10n ** 4n, 4],
}
const OCTETS = ["string", "bytes", "ipv4", "ipv6", "eui48", "eui64", "datetime", "date", "time"]
const SIZES = { ipv4: 4, ipv6: 16, eui48: 6, eui64: 8 }
const INTEGER = /^(u?)int(\d+)$/
const FIXED = /^(u?)q(\d+)(?:\.(\d+))?$/

const TYPES = new Map()

/**
 * What a type is: whether it is `float`, `octets` or an integer, its `words` and `bits`, and of integers both limits.
 * @returns {{words: number, bits: bigint, minimum: bigint, maximum: bigint, float: ?object, octets: boolean}}
 */
function typeOf(name) {
  if (!TYPES.has(name)) TYPES.set(name, { name, octets: false, float: null, ...rowOf(name) })
  return TYPES.get(name)
}

function rowOf(name) {
  if (OCTETS.includes(name)) return { octets: true, words: 1, bits: 0n }
  if (name in FLOATS) return { float: FLOATS[name], words: Number(name.slice(5)) / 16, bits: BigInt(name.slice(5)) }
  if (name in PLACES) {
    const [patterns, base, places] = PLACES[name]
    return { words: patterns === 16n ? places / 4 : places, bits: 0n, minimum: 0n, maximum: base ** BigInt(places) - 1n }
  }
  if (name === "bit") return { words: 1, bits: 1n, minimum: 0n, maximum: 1n }
  if (name.startsWith("signmag")) {
    const sign = 1n << BigInt(name.slice(7)) - 1n
    return { words: Number(name.slice(7)) / 16, bits: 0n, minimum: 1n - sign, maximum: sign - 1n, sign }
  }
  const whole = INTEGER.exec(name)
  if (whole) return complement(BigInt(whole[2]), whole[1] !== "u")
  const fixed = FIXED.exec(name)
  if (fixed) return complement(fixed[3] ? BigInt(fixed[2]) + BigInt(fixed[3]) : BigInt(fixed[2]) + 1n, fixed[1] !== "u")
  throw new NotHere(`the type ${name}`)
}

function complement(bits, signed) {
  const size = 1n << bits
  const words = Number((bits + 15n) / 16n)
  return { words, bits, minimum: signed ? -size / 2n : 0n, maximum: (signed ? size / 2n : size) - 1n }
}

/** The number that the bits of all words spell; null if they are no number of the type. @returns {Rational|null} */
function wholeNumber(bits, type) {
  if (type.name in PLACES) return ofPlaces(bits, ...PLACES[type.name])
  if (type.sign) return ratio(bits & type.sign ? type.sign - bits : bits)
  const number = bits & ((1n << type.bits) - 1n)
  return ratio(number <= type.maximum ? number : number - (1n << type.bits))
}

function ofPlaces(bits, patterns, base, places) {
  let number = 0n
  for (let place = places - 1; place >= 0; place -= 1) {
    const digit = (bits / patterns ** BigInt(place)) % patterns
    if (digit >= base) return null
    number = number * base + digit
  }
  return ratio(number)
}

/** The bits of all words that spell a number within the limits of the type. */
function wholeBits(number, type) {
  if (type.name in PLACES) {
    const [patterns, base, places] = PLACES[type.name]
    let bits = 0n
    for (let place = places - 1; place >= 0; place -= 1) bits = bits * patterns + ((number / base ** BigInt(place)) % base)
    return bits
  }
  if (type.sign) return number < 0n ? type.sign - number : number
  const own = type.name === "int8" || type.name === "uint8" // the other byte may be somebody else's: it is sent as 0
  return modulo(number, 1n << (own ? type.bits : BigInt(16 * type.words)))
}
