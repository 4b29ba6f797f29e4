// Exact numbers: [numerator, denominator] of whole numbers without a limit (BigInt), the denominator above 0.

function ratio(text) {
  const [above, below = '1'] = text.split('/')
  return [BigInt(above), BigInt(below)]
}

const plus = ([a, b], [c, d]) => [a * d + c * b, b * d]
const minus = (one, [c, d]) => plus(one, [-c, d])
const times = ([a, b], [c, d]) => [a * c, b * d]
const through = (one, [c, d]) => times(one, c < 0n ? [-d, -c] : [d, c])
const equal = ([a, b], [c, d]) => a * d === c * b
const atMost = ([a, b], [c, d]) => a * d <= c * b
const within = (one, low, high) => (low === null || atMost(ratio(low), one)) && (high === null || atMost(one, ratio(high)))
const inOne = (one, intervals) => intervals.some(([low, high]) => within(one, low, high))
const isWhole = ([a, b]) => a % b === 0n

// Decimal text: exact where it ends within 40 digits, which is more than a number of JavaScript tells apart.
function decimal([above, below]) {
  let rest = above < 0n ? -above : above
  let text = `${above < 0n ? '-' : ''}${rest / below}`
  rest %= below
  let digits = rest ? '.' : ''
  for (let significant = 0; rest && significant < 40; ) {
    rest *= 10n
    digits += rest / below
    significant += significant || rest >= below ? 1 : 0
    rest %= below
  }
  return text + digits
}

// The number of a decimal text, as people and JavaScript write it: 12.5, -3, 1e-7; null for any other text.
function parsed(text) {
  const found = /^\s*([+-]?)([0-9]{1,400})(?:\.([0-9]{0,400}))?(?:e([+-]?[0-9]{1,3}))?\s*$/i.exec(text)
  if (!found) return null
  const [, sign, whole, after = '', exponent = '0'] = found
  const digits = BigInt(sign + whole + after)
  const shift = Number(exponent) - after.length
  return shift < 0 ? [digits, 10n ** BigInt(-shift)] : [digits * 10n ** BigInt(shift), 1n]
}

// Which number of 16 bits is nearest, of two the even one.
function half(number) {
  if (number === 0) return number
  const step = 2 ** (Math.max(-14, Math.floor(Math.log2(Math.abs(number)))) - 10)
  const steps = number / step
  const below = Math.floor(steps)
  const up = steps - below > 0.5 || (steps - below === 0.5 && below % 2 !== 0)
  return (below + (up ? 1 : 0)) * step
}

const NEAREST = { 16: half, 32: Math.fround, 64: (number) => number }

// The decimal of fewest digits whose nearest number of so many bits is this one: 0x437A6666 is 250.4.
function shortest(number, bits) {
  for (let digits = 0; digits < 17; digits++) {
    const [mantissa, exponent] = number.toExponential(digits).split('e')
    const whole = BigInt(mantissa.replace('.', ''))
    for (const near of [whole, whole + (number < 0 ? -1n : 1n)]) {
      const text = `${near}e${Number(exponent) - digits}`
      if (NEAREST[bits](Number(text)) === number) return parsed(text)
    }
  }
  return parsed(String(number))
}

function ieee(bytes) {
  const raw = Buffer.from(bytes)
  if (bytes.length === 8) return raw.readDoubleBE(0)
  if (bytes.length === 4) return raw.readFloatBE(0)
  const bits = raw.readUInt16BE(0)
  const exponent = (bits >> 10) & 31
  const fraction = bits & 1023
  const size = exponent === 31 ? (fraction ? NaN : Infinity) : exponent ? (1024 + fraction) * 2 ** (exponent - 25) : fraction * 2 ** -24
  return bits >> 15 ? -size : size
}
