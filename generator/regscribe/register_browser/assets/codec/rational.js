/**
 * Exact numbers. No JavaScript number ever stands between words and text.
 * @typedef {{n: bigint, d: bigint}} Rational  in lowest terms, d > 0
 */

const gcd = (a, b) => {
  while (b) [a, b] = [b, a % b]
  return a < 0n ? -a : a
}

/** A rational number of two integers. @returns {Rational} */
function ratio(n, d = 1n) {
  if (d < 0n) [n, d] = [-n, -d]
  const common = gcd(n, d)
  return common > 1n ? { n: n / common, d: d / common } : { n, d }
}

const ZERO = ratio(0n)
const ONE = ratio(1n)

/** The number that data state: an integer, or both halves as texts. @returns {Rational} */
const stated = (value) => (typeof value === "object" ? ratio(BigInt(value.n), BigInt(value.d)) : ratio(BigInt(value)))

const plus = (a, b) => ratio(a.n * b.d + b.n * a.d, a.d * b.d)
const minus = (a, b) => ratio(a.n * b.d - b.n * a.d, a.d * b.d)
const times = (a, b) => ratio(a.n * b.n, a.d * b.d)
const over = (a, b) => ratio(a.n * b.d, a.d * b.n)
/** Below 0, 0 or above 0, as a is below, equal to or above b. */
const compare = (a, b) => {
  const difference = a.n * b.d - b.n * a.d
  return difference < 0n ? -1 : difference > 0n ? 1 : 0
}
const equal = (a, b) => a.n === b.n && a.d === b.d
const isWhole = (a) => a.d === 1n
const power = (base, exponent) => (exponent < 0 ? ratio(1n, base ** BigInt(-exponent)) : ratio(base ** BigInt(exponent)))

/** The largest integer that is not above. @returns {bigint} */
const floor = (a) => (a.n >= 0n || a.n % a.d === 0n ? a.n / a.d : a.n / a.d - 1n)

/** What is left of a division whose quotient is rounded down: never negative. */
const modulo = (a, size) => ((a % size) + size) % size

const NUMBER = /^\s*([+-]?)(?:(\d+)(?:\.(\d*))?|\.(\d+))(?:[eE]([+-]?\d{1,4}))?\s*$/
const RATIO = /^\s*([+-]?\d+)\/(\d*[1-9]\d*)\s*$/
const HEXADECIMAL = /^\s*0[xX][0-9a-fA-F]+\s*$/
const MOST_DIGITS = 400

/** The number that a text spells: decimal, with an exponent, as a fraction (1/3) or 0x..; null for any other text. */
function parse(text) {
  if (text.length > 3 * MOST_DIGITS) return null
  if (HEXADECIMAL.test(text)) return ratio(BigInt(text.trim()))
  const parts = RATIO.exec(text)
  if (parts) return ratio(BigInt(parts[1]), BigInt(parts[2]))
  const found = NUMBER.exec(text)
  if (!found) return null
  const behind = found[3] ?? found[4] ?? ""
  const exponent = Number(found[5] ?? 0) - behind.length
  if (Math.abs(exponent) > MOST_DIGITS) return null
  const whole = ratio(BigInt(`${found[2] ?? ""}${behind}` || "0") * (found[1] === "-" ? -1n : 1n))
  return times(whole, power(10n, exponent))
}

/** The number as decimal text without exponent, or a/b where no decimal text is exact. @param {Rational} a */
function show(a) {
  if (isWhole(a)) return String(a.n)
  let digits = 0
  let size = 1n
  while (size % a.d) {
    digits += 1
    size *= 10n
    if (digits > 4 * a.d.toString(2).length) return `${a.n}/${a.d}`
  }
  const text = String(((a.n < 0n ? -a.n : a.n) * size) / a.d).padStart(digits + 1, "0")
  return `${a.n < 0n ? "-" : ""}${text.slice(0, -digits)}.${text.slice(-digits)}`
}
