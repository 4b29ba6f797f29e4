/** IEEE 754 numbers in exact arithmetic: bits to rationals and back, and the shortest decimal that reads back. */

/** Bits of the fraction, bits of the exponent, and how many decimal digits always tell two numbers apart. */
const FLOATS = {
  float16: { fraction: 10n, exponent: 5n, digits: 5 },
  float32: { fraction: 23n, exponent: 8n, digits: 9 },
  float64: { fraction: 52n, exponent: 11n, digits: 17 },
}

/** Any pattern that is no number, sent in place of a value. */
const NAN = Symbol("nan")

const biasOf = ({ fraction, exponent }) => (1n << (exponent - 1n)) - 1n + fraction
const powerOfTwo = (exponent) => (exponent < 0n ? ratio(1n, 1n << -exponent) : ratio(1n << exponent))

/** The exact number that bits spell; NAN, or null for an infinity. @returns {Rational|symbol|null} */
function ieeeNumber(bits, form) {
  const fraction = bits & ((1n << form.fraction) - 1n)
  const highest = (1n << form.exponent) - 1n
  const exponent = (bits >> form.fraction) & highest
  if (exponent === highest) return fraction ? NAN : null
  const steps = exponent ? fraction + (1n << form.fraction) : fraction
  const size = times(ratio(steps), powerOfTwo((exponent || 1n) - biasOf(form)))
  return bits >> (form.fraction + form.exponent) ? minus(ZERO, size) : size
}

/** The bits of the nearest IEEE number, ties to the even one; null if that is an infinity. @returns {bigint|null} */
function ieeeBits(number, form) {
  const above = number.n < 0n ? -number.n : number.n
  const bias = (1n << (form.exponent - 1n)) - 1n
  const lowest = 1n - bias
  const found = above ? exponentOf(above, number.d) : lowest
  const power = found > lowest ? found : lowest
  const steps = nearest(above, number.d, power - form.fraction)
  const exponent = steps >> form.fraction ? power + bias : 0n
  const bits = (exponent << form.fraction) + steps - (exponent ? 1n << form.fraction : 0n)
  if (bits >= ((1n << form.exponent) - 1n) << form.fraction) return null
  return number.n < 0n ? bits + (1n << (form.fraction + form.exponent)) : bits
}

/** The largest p with 2^p <= above/below. */
function exponentOf(above, below) {
  const power = BigInt(above.toString(2).length - below.toString(2).length)
  const fits = power >= 0n ? below << power <= above : below <= above << -power
  return fits ? power : power - 1n
}

/** above/below in steps of 2^power, rounded to the nearest whole number, a half to the even one. */
function nearest(above, below, power) {
  const over = power >= 0n ? above : above << -power
  const under = power >= 0n ? below << power : below
  return halfEven(over, under)
}

function halfEven(above, below) {
  const whole = above / below
  const twice = 2n * (above % below)
  return twice > below || (twice === below && whole % 2n) ? whole + 1n : whole
}

/** The decimal of fewest digits whose nearest IEEE number has these bits: 0x437A6666 is 250.4. @returns {Rational} */
function shortest(number, form) {
  const bits = ieeeBits(number, form)
  for (let digits = 1; digits <= form.digits; digits += 1) {
    for (const found of decimals(number, digits)) if (ieeeBits(found, form) === bits) return found
  }
  throw new Error(`${show(number)} is no number of this type`)
}

/** The nearest decimal of so many digits, then the next one away from zero: numbers below a power of two lie closer. */
function decimals(number, digits) {
  if (!number.n) return [ZERO]
  const above = number.n < 0n ? -number.n : number.n
  const exponent = leading(above, number.d) - digits + 1
  const over = exponent < 0 ? above * 10n ** BigInt(-exponent) : above
  const under = exponent < 0 ? number.d : number.d * 10n ** BigInt(exponent)
  const sign = number.n < 0n ? -1n : 1n
  const up = over % under ? over / under + 1n : over / under
  return [halfEven(over, under), up].map((found) => times(ratio(sign * found), power(10n, exponent)))
}

/** The largest e with 10^e <= above/below. */
function leading(above, below) {
  const guess = above.toString().length - below.toString().length
  const fits = guess < 0 ? above * 10n ** BigInt(-guess) >= below : above >= below * 10n ** BigInt(guess)
  return fits ? guess : guess - 1
}
