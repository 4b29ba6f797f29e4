/** Limits of a register under present values, and whether a value keeps to them. */

/** Lowest and highest value of each interval; null where nothing limits. */
function limitsNow({ intervals, decimals }, known) {
  const factor = decimalFactor(decimals, known)
  if (!factor) throw new Refused("condition", `${decimals.register} holds no number of decimals`)
  return (intervals ?? []).map(({ low, high }) => [limitOf(low, factor, known), limitOf(high, factor, known)])
}

function limitOf(limit, factor, known) {
  if (limit === undefined || "text" in limit) return null
  if ("value" in limit) return over(stated(limit.value), factor)
  const found = amount(limit.term ?? limit, known)
  if (!found) throw new Refused("condition", "a limit of the range has no value as things stand")
  return found
}

const within = (limits, value) =>
  limits.some(([low, high]) => (!low || compare(low, value) <= 0) && (!high || compare(value, high) <= 0))

/** Whether a value lies in the range that holds now; a register without range takes all. */
function inRange(register, value, known) {
  if (!register.range.length) return true
  const found = choose(register.range, known)
  if (!found) throw new Refused("condition", "no range holds as things stand")
  return within(limitsNow(found.then ?? {}, known), value)
}

/** Whether a value lies in what is valid now; where no case holds, everything is. */
function isValid(register, value, known) {
  const found = choose(register.valid, known)
  return !found || within(limitsNow(found.then ?? {}, known), value)
}
