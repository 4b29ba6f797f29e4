// The words (or bits) of one read as values: whole numbers beyond 2^53 as text, faults and what means nothing as null.

const whole = (bytes) => bytes.reduce((sum, byte) => sum * 256n + BigInt(byte), 0n)

function places(bytes, base, size) {
  let sum = 0n
  for (let at = 0; at < bytes.length * 8; at += size) {
    const digit = (whole(bytes) >> BigInt(bytes.length * 8 - at - size)) & ((1n << BigInt(size)) - 1n)
    if (digit >= base) return null
    sum = sum * base + digit
  }
  return sum
}

const NUMBERS = {
  bit: ([bit]) => BigInt(bit),
  uint: whole,
  int: (bytes) => BigInt.asIntN(8 * bytes.length, whole(bytes)),
  bcd: (bytes) => places(bytes, 10n, 4),
  mod10k: (bytes) => places(bytes, 10000n, 16),
  signmag: (bytes) => {
    const sign = 1n << BigInt(8 * bytes.length - 1)
    return whole(bytes) >= sign ? sign - whole(bytes) : whole(bytes)
  }
}

// The number on the wire: a ratio, 'nan', or null where the words spell none.
function numberOf(one, bytes) {
  if (one.type !== 'float') {
    const number = NUMBERS[one.type](bytes)
    return number === null ? null : [number, 1n]
  }
  const number = ieee(bytes)
  return Number.isNaN(number) ? 'nan' : Number.isFinite(number) ? shortest(number, 8 * bytes.length) : null
}

function fault(faults, number) {
  const found = (faults || []).find(([low, high]) =>
    number === 'nan' || number === null ? low === 'nan' && number === 'nan' : low !== 'nan' && within(number, low, high)
  )
  return found && found[2]
}

const NOTHING = 'not decodable'
const asNumber = (number, fractional) => {
  if (fractional) return Number(decimal(number))
  const plain = number[0] / number[1]
  return plain >= BigInt(Number.MIN_SAFE_INTEGER) && plain <= BigInt(Number.MAX_SAFE_INTEGER) ? Number(plain) : String(plain)
}

const labelled = (labels, code) => {
  const found = labels.find(([known]) => BigInt(known) === code)
  return found ? found[1] : null
}

function partOf(part, word) {
  const bits = BigInt.asUintN(part.width, word >> BigInt(part.low))
  const number = part.signed ? BigInt.asIntN(part.width, bits) : bits
  const broken = fault(part.faults, [number, 1n])
  if (broken) return { value: null, note: broken }
  if (part.labels) {
    const label = labelled(part.labels, number)
    return { value: label === null ? `unknown (${number})` : label, code: Number(number) }
  }
  if (part.flag) return { value: number === 1n }
  const value = plus(times([number, 1n], ratio(part.multiply)), ratio(part.add))
  if (part.valid && !inOne(value, [part.valid])) return { value: null, note: 'outside what is valid' }
  return { value: asNumber(value, !isWhole(value)) }
}

function pattern(one, bytes) {
  const found = one.parts.map((part) => [part, partOf(part, whole(bytes))])
  const notes = found.filter(([, part]) => part.note).map(([part, { note }]) => `${part.id}: ${note}`)
  const coded = found.filter(([, part]) => part.code !== undefined)
  return {
    value: Object.fromEntries(found.map(([part, { value }]) => [part.id, value])),
    code: coded.length ? Object.fromEntries(coded.map(([part, { code }]) => [part.id, code])) : undefined,
    note: notes.join('; ') || undefined
  }
}

function version(one, number) {
  const digits = String(number).padStart(one.digits, '0')
  if (number < 0n || digits.length > one.digits) return { value: null, note: NOTHING }
  return { value: digits.match(new RegExp(`.{1,${one.group}}`, 'g')).join('.') }
}

function ofNumber(one, bytes) {
  const number = numberOf(one, bytes)
  if (one.clips && number !== 'nan' && one.clips.some((end) => number !== null && equal(number, ratio(end)))) {
    return { value: null, note: 'beyond what is transmitted' }
  }
  const broken = fault(one.faults, number)
  if (broken) return { value: null, note: broken }
  if (number === null || number === 'nan') return { value: null, note: NOTHING }
  if (one.parts) return pattern(one, bytes)
  const special = (one.special || []).find(([wire]) => equal(number, ratio(wire)))
  if (special) return { value: asNumber(ratio(special[1]), one.fractional), note: special[2] }
  const value = plus(times(number, ratio(one.multiply)), ratio(one.add))
  if (one.kind === 'boolean' && !equal(value, [0n, 1n]) && !equal(value, [1n, 1n])) return { value: null, note: NOTHING }
  if (!one.fractional && !isWhole(value)) return { value: null, note: NOTHING }
  if (one.valid && !inOne(value, one.valid)) return { value: null, note: 'outside what is valid' }
  if (one.kind === 'boolean') return { value: value[0] !== 0n }
  if (one.kind === 'version') return version(one, value[0] / value[1])
  if (!one.labels) return { value: asNumber(value, one.fractional) }
  const label = labelled(one.labels, value[0] / value[1])
  return { value: label === null ? `unknown (${value[0] / value[1]})` : label, code: asNumber(value) }
}

function letters(one, bytes) {
  const kept = []
  const filled = (letter, byte) => letter.every((each) => each === byte)
  for (let at = 0; at < bytes.length; at += one.width) {
    const letter = bytes.slice(at, at + one.width)
    if (one.ends.some((end) => filled(letter, end))) break
    kept.push(letter)
  }
  while (one.padding !== 32 && kept.length && filled(kept[kept.length - 1], one.padding)) kept.pop()
  return kept
}

function textOf(one, bytes) {
  const kept = letters(one, bytes)
  let text
  if (typeof one.charset === 'object') {
    text = kept.map(([byte]) => one.charset.letters[byte] || '\ufffd').join('')
    if (text.includes('\ufffd')) return null
  } else {
    const raw = Buffer.from(kept.flatMap((letter) => (one.width === 2 ? [letter[1], letter[0]] : letter)))
    text = raw.toString(one.charset)
    if (!Buffer.from(text, one.charset).equals(raw) || /\p{Surrogate}/u.test(text)) return null
  }
  return text.replace(/ +$/, '')
}

const NAMES = { Y: 'year', y: 'year', M: 'month', D: 'day', h: 'hour', m: 'minute', s: 'second' }
const LAST = 253402300799 // the last second of the year 9999

function partOfMoment([letter, at, size, form, digits, after], bytes) {
  const raw = bytes.slice(at, at + size)
  const text = form === 'ascii' ? Buffer.from(raw).toString('latin1') : form === 'bcd' ? hex(raw) : String(whole(raw))
  if (!/^[0-9]+$/.test(text)) return letter === '_' && form === 'ascii' ? 0 : NaN
  const above = BigInt(text) / 10n ** BigInt(after)
  return Number(digits ? above % 10n ** BigInt(digits) : above)
}

function ofIec870(bytes) {
  const thousandths = bytes[6] * 256 + bytes[7]
  const year = bytes[1] & 127
  if (bytes[5] >> 7 || year > 99 || thousandths >= 60000) return null
  const parts = { year: 2000 + year, month: bytes[2] & 15, day: bytes[3] & 31, hour: bytes[4] & 31, minute: bytes[5] & 63 }
  return calendar({ ...parts, second: Math.floor(thousandths / 1000) }, thousandths % 1000)
}

// A moment of UTC, of which only the text counts; null where no calendar has it.
function calendar({ year, month, day, hour, minute, second }, thousandths = 0) {
  const moment = new Date(0)
  moment.setUTCFullYear(year, month - 1, day)
  moment.setUTCHours(hour, minute, second, thousandths)
  const found = [moment.getUTCFullYear(), moment.getUTCMonth() + 1, moment.getUTCDate(), moment.getUTCHours(), moment.getUTCMinutes(), moment.getUTCSeconds()]
  return year >= 1 && year <= 9999 && [year, month, day, hour, minute, second].every((part, at) => part === found[at]) ? moment : null
}

function momentOf(layout, bytes) {
  if (layout.iec870) return ofIec870(bytes)
  if (layout.step) {
    const seconds = whole(bytes) * BigInt(layout.step)
    const sum = seconds + BigInt(layout.epoch)
    return sum > BigInt(LAST) || (layout.daily && seconds >= 86400n) ? null : new Date(1000 * Number(sum))
  }
  const parts = { year: 2000, month: 1, day: 1, hour: 0, minute: 0, second: 0 }
  for (const one of layout.parts) {
    const number = partOfMoment(one, bytes)
    if (Number.isNaN(number) || (one[0] === 'y' && number > 99)) return null
    if (NAMES[one[0]]) parts[NAMES[one[0]]] = number + (one[0] === 'y' ? 2000 : 0)
  }
  return calendar(parts)
}

function momentText(one, bytes) {
  const moment = momentOf(one.layout, bytes)
  if (moment === null) return null
  const text = moment.toISOString().slice(0, moment.getUTCMilliseconds() ? 23 : 19).replace(/\.(...)$/, '.$1000')
  return one.kind === 'date' ? text.slice(0, 10) : one.kind === 'time' ? text.slice(11) : text
}

const hex = (bytes) => Buffer.from(bytes).toString('hex')
const BYTES = {
  string: textOf,
  bytes: (_, bytes) => hex(bytes),
  mac: (_, bytes) => bytes.map((byte) => hex([byte])).join(':'),
  ipv4: (_, bytes) => bytes.join('.'),
  datetime: momentText,
  date: momentText,
  time: momentText,
  ipv6: (_, bytes) => new URL(`http://[${hex(bytes).match(/..../g).join(':')}]`).hostname.slice(1, -1)
}

function ofBytes(one, bytes, raw) {
  const broken = fault(one.faults, [whole(raw), 1n])
  if (broken) return { value: null, note: broken }
  const value = BYTES[one.kind](one, bytes)
  return value === null ? { value, note: NOTHING } : { value }
}

function valueOf(one, data, octets) {
  if (one.bit !== undefined) {
    const bit = data[one.bit]
    return bit === undefined ? { value: null, note: 'not in the answer' } : ofNumber(one, [Number(bit)])
  }
  const picked = (places) => places.map((place) => octets[place])
  const bytes = picked(one.bytes)
  if (bytes.includes(undefined)) return { value: null, note: 'not in the answer' }
  return BYTES[one.kind] ? ofBytes(one, bytes, picked(one.raw || one.bytes)) : ofNumber(one, bytes)
}

// payload: values by path; codes: numbers behind labels; notes: why there is no value, or what a number means; units.
function decoded(registers, data) {
  const made = { payload: {}, codes: {}, notes: {}, units: {} }
  const octets = data.flatMap((word) => [(word >> 8) & 255, word & 255])
  for (const one of registers) {
    const { value, code, note } = valueOf(one, data, octets)
    made.payload[one.path] = value
    if (code !== undefined) made.codes[one.path] = code
    if (note !== undefined) made.notes[one.path] = note
    if (one.unit) made.units[one.path] = one.unit
  }
  return made
}
