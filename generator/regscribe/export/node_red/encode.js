// What is to be written as words, or an error that says why not: only what is exact and within the range is sent.

function refuse(why) {
  throw new RangeError(why)
}

function asRatio(value) {
  const number = typeof value === 'bigint' ? [value, 1n] : /^(number|string)$/.test(typeof value) ? parsed(String(value)) : null
  return number || refuse(`${JSON.stringify(value)} is no number`)
}

function truth(value) {
  if (value === true || value === 'true' || value === 1) return [1n, 1n]
  if (value === false || value === 'false' || value === 0) return [0n, 1n]
  return refuse(`${JSON.stringify(value)} is neither true nor false`)
}

function memberCode(one, value) {
  const isCode = typeof value !== 'string' || (/^-?[0-9]{1,40}$/.test(value) && one.labels.every(([, label]) => label !== value))
  const known = () => one.labels.map(([code, label]) => `${label} (${code})`).join(', ')
  const found = one.labels.filter(([code, label]) => (isCode ? Number.isInteger(Number(value)) && BigInt(code) === BigInt(value) : label === value))
  if (found.length > 1) refuse(`${JSON.stringify(value)} are several codes: write one of ${found.map(([code]) => code).join(', ')}`)
  return found.length ? [BigInt(found[0][0]), 1n] : refuse(`${JSON.stringify(value)} is none of ${known()}`)
}

const ends = (intervals) => intervals.map(([low, high]) => `${low === null ? '' : decimal(ratio(low))}..${high === null ? '' : decimal(ratio(high))}`).join(', ')

// The number on the wire of a value: a special one as it stands, any other checked and scaled.
function unscaled(one, value) {
  const named = (one.special || []).find((each) => each[2] === value)
  if (named) return ratio(named[0])
  const number = one.labels ? memberCode(one, value) : one.kind === 'boolean' ? truth(value) : asRatio(value)
  const special = (one.special || []).find((each) => equal(number, ratio(each[1])))
  if (special) return ratio(special[0])
  if ((one.special || []).some((each) => equal(number, ratio(each[3])))) refuse(`${decimal(number)} is a code that stands for another number`)
  if (!one.fractional && !isWhole(number)) refuse(`${decimal(number)} is no whole number`)
  for (const intervals of [one.ranges, one.valid]) {
    if (intervals && !inOne(number, intervals)) refuse(`${decimal(number)} lies outside ${ends(intervals)}`)
  }
  const wire = through(minus(number, ratio(one.add)), ratio(one.multiply))
  if (one.step && !isWhole(through(wire, ratio(one.step)))) refuse(`${decimal(number)} lies between two steps`)
  return wire
}

const split = (number, size) => Array.from({ length: size }, (_, at) => Number((number >> BigInt(8 * (size - 1 - at))) & 255n))

function joined(number, base, bits, count) {
  let sum = 0n
  for (let at = 0; at < count; at++) {
    sum |= (number % base) << BigInt(bits * at)
    number /= base
  }
  return sum
}

function floatBytes(one, wire) {
  const size = one.bytes.length
  const nearest = NEAREST[8 * size](Number(decimal(wire)))
  if (!Number.isFinite(nearest) || (8 * size === 16 && Math.abs(nearest) > 65504)) refuse(`${decimal(wire)} is beyond what ${8 * size} bits hold`)
  if (!equal(shortest(nearest, 8 * size), wire) && decimal(wire) !== exactly(nearest)) refuse(`${decimal(wire)} is finer than a float of ${8 * size} bits`)
  const raw = Buffer.alloc(size)
  if (size === 8) raw.writeDoubleBE(nearest)
  else if (size === 4) raw.writeFloatBE(nearest)
  else raw.writeUInt16BE(halfBits(nearest))
  return [...raw]
}

// The decimal text of a number of JavaScript, whose denominator is a power of two.
function exactly(number) {
  let below = 1n
  while (!Number.isInteger(number)) {
    number *= 2
    below *= 2n
  }
  return decimal([BigInt(number), below])
}

function halfBits(number) {
  const size = Math.abs(number)
  const exponent = size < 2 ** -14 ? 0 : Math.floor(Math.log2(size)) + 15
  const fraction = exponent ? size / 2 ** (exponent - 25) - 1024 : size / 2 ** -24
  return (number < 0 || Object.is(number, -0) ? 0x8000 : 0) + (exponent << 10) + fraction
}

function wholeBytes(one, wire) {
  if (!isWhole(wire)) refuse(`${decimal(wire)} on the wire is no whole number: the value lies between two steps`)
  const number = wire[0] / wire[1]
  if (number < BigInt(one.lowest) || number > BigInt(one.highest)) refuse(`${number} on the wire lies outside ${one.lowest}..${one.highest}`)
  const size = one.bytes.length
  if (one.type === 'bcd') return split(joined(number, 10n, 4, 2 * size), size)
  if (one.type === 'mod10k') return split(joined(number, 10000n, 16, size / 2), size)
  if (one.type === 'signmag') return split(number < 0n ? (1n << BigInt(8 * size - 1)) - number : number, size)
  return split(BigInt.asUintN(one.bits, number), size)
}

// What modbus-flex-write sends for a value.
function encoded(one, value, unit) {
  const wire = unscaled(one, value)
  const request = { fc: one.fc, unitid: unit, address: one.address, quantity: one.quantity }
  if (one.coil) {
    const [bit] = wholeBytes(one, wire)
    return { ...request, value: one.fc === 5 ? bit === 1 : [bit === 1] }
  }
  const bytes = one.type === 'float' ? floatBytes(one, wire) : wholeBytes(one, wire)
  const broken = fault(one.faults, numberOf(one, one.read.map((place) => bytes[place])))
  if (broken) refuse(`${decimal(wire)} on the wire is how the device reports: ${broken}`)
  const octets = []
  one.bytes.forEach((place, at) => (octets[place] = bytes[at]))
  const words = Array.from({ length: one.quantity }, (_, at) => 256 * octets[2 * at] + octets[2 * at + 1])
  return { ...request, value: one.fc === 6 ? words[0] : words }
}
