/** Terms and scales under present values: what a map gives by registers and givens, as exact numbers. */

const MOST_EXPONENT = 10n
const MOST_DECIMALS = 9n

/** The number of a term; null if it has none as things stand. @returns {Rational|null} */
function amount(term, known) {
  if (typeof term === "number" || "n" in term) return stated(term)
  if (term.register) return lookUp(known.values, term.register)
  if (term.given) return lookUp(known.numbers, term.given)
  if (term.cases) {
    const chosen = choose(term.cases, known)
    return chosen && amount(chosen.then, known)
  }
  if ("exponent" in term) return powerOfTen(amount(term.exponent, known))
  if (term.factors || term.divisors) return quotient(amounts(term.factors, known), amounts(term.divisors, known))
  if (term.largest_of || term.smallest_of) return outermost(term, known)
  return amounts(term.terms, known)?.reduce(plus, ZERO) ?? null
}

function amounts(terms, known) {
  const found = (terms ?? []).map((one) => amount(one, known))
  return found.includes(null) ? null : found
}

function powerOfTen(exponent) {
  if (!exponent || !isWhole(exponent) || exponent.n > MOST_EXPONENT || exponent.n < -MOST_EXPONENT) return null
  return power(10n, Number(exponent.n))
}

function quotient(factors, divisors) {
  if (!factors || !divisors || divisors.some((one) => !one.n)) return null
  return divisors.reduce(over, factors.reduce(times, ONE))
}

function outermost(term, known) {
  const several = amounts(term.largest_of ?? term.smallest_of, known)?.sort(compare)
  return several?.at(term.largest_of ? -1 : 0) ?? null
}

/** 10 to the power of the decimals register; null if that is no number of decimals. @returns {Rational|null} */
function decimalFactor(decimals, known) {
  if (!decimals) return ONE
  const count = lookUp(known.values, decimals.register)
  if (!isWhole(count) || count.n < 0n || count.n > MOST_DECIMALS) return null
  return power(10n, Math.min(Number(count.n), decimals.at_most ?? Infinity))
}

/** The factor of a view as things stand; null if that is no number above 0. */
function presentFactor(view, known) {
  const factor = stated(view.factor)
  if (!view.times && view.times !== 0) return factor
  const more = amount(view.times, known)
  return more && more.n > 0n ? times(factor, more) : null
}

/** A scale as things stand, value = slope x stored + offset; null without one, or where it makes no number. */
function straight(found, known) {
  if (!found) return null
  const conversion = found.then ?? {}
  const factor = decimalFactor(conversion.decimals, known)
  if (!factor) return null
  const [multiply, add] = [amount(conversion.multiply ?? 1, known), amount(conversion.add ?? 0, known)]
  if (!multiply || !multiply.n || !add) return null
  const [slope, offset] = [over(multiply, factor), over(add, factor)]
  return { value: (number) => plus(times(slope, number), offset), stored: (value) => over(minus(value, offset), slope) }
}
