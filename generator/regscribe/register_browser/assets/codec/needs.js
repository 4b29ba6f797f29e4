/** What decides about a register. */

/**
 * What decides what a register means, or which values it takes.
 * @returns {{read: string[], write: string[], givens: string[]}}  paths of registers (what `write` names besides `read`
 *   limits its values), and the ids of givens; each first where it counts first
 */
function needs(register, view) {
  const found = { registers: new Set(), givens: new Set() }
  const ofScales = register.scale.map(({ when, then }) => ({ when, then: { ...then, places: undefined } }))
  collect([register.when, view.word_order, view.byte_order, view.times, ofScales, register.special_scale], found)
  collect([register.sentinels.map((one) => one.when), register.valid], found)
  collect([register.enum?.members?.map((one) => one.when), register.fields.map((one) => one.when)], found)
  collect(register.unit, found)
  const read = [...found.registers]
  collect([register.writable?.when, register.range, register.scale], found)
  return { read, write: [...found.registers].slice(read.length), givens: [...found.givens] }
}

/** Gather registers and givens from conditions, cases, terms and limits. */
function collect(value, found) {
  if (Array.isArray(value)) for (const each of value) collect(each, found)
  else if (value !== null && typeof value === "object") {
    if (typeof value.register === "string" && value.register) found.registers.add(value.register)
    if (typeof value.given === "string" && value.given) found.givens.add(value.given)
    for (const each of Object.values(value)) collect(each, found)
  }
}
