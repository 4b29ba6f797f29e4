/** Dates and times: what bytes say in a layout, as ISO 8601 text without a zone, and back. */

const SECONDS_OF_DAY = 86400n
const UNITS = { unix: [1n, 2], unix64: [1n, 4], seconds: [1n, 2], minutes: [60n, 1] }
const PARTS = { Y: "year", y: "year", M: "month", D: "day", h: "hour", m: "minute", s: "second" }
const RUNS = /(.)\1*/g

/** Days since 1970-01-01, by the rule of 400 years of 146097 days. */
function daysOf({ year, month, day }) {
  const shifted = month <= 2 ? year - 1 : year
  const era = Math.floor(shifted / 400)
  const ofEra = shifted - 400 * era
  const ofYear = Math.floor((153 * (month + (month > 2 ? -3 : 9)) + 2) / 5) + day - 1
  return 146097 * era + 365 * ofEra + Math.floor(ofEra / 4) - Math.floor(ofEra / 100) + ofYear - 719468
}

function dateOf(days) {
  const shifted = days + 719468
  const era = Math.floor(shifted / 146097)
  const ofEra = shifted - 146097 * era
  const years = ofEra - Math.floor(ofEra / 1460) + Math.floor(ofEra / 36524) - Math.floor(ofEra / 146096)
  const year = Math.floor(years / 365)
  const ofYear = ofEra - (365 * year + Math.floor(year / 4) - Math.floor(year / 100))
  const month = Math.floor((5 * ofYear + 2) / 153)
  const day = ofYear - Math.floor((153 * month + 2) / 5) + 1
  const real = month < 10 ? month + 3 : month - 9
  return { year: year + 400 * era + (real <= 2 ? 1 : 0), month: real, day }
}

/** 1 is Monday. */
const weekdayOf = (moment) => Number(modulo(BigInt(daysOf(moment) + 3), 7n)) + 1

/** The moment, if the calendar and the clock have it. */
function checked(moment) {
  const { year, month, day, hour, minute, second } = moment
  const fits = year >= 1 && year <= 9999 && month >= 1 && month <= 12 && day >= 1 && hour < 24 && minute < 60 && second < 60
  if (!fits || hour < 0 || minute < 0 || second < 0) return null
  const next = month === 12 ? { year: year + 1, month: 1, day: 1 } : { year, month: month + 1, day: 1 }
  return day <= daysOf(next) - daysOf({ year, month, day: 1 }) ? moment : null
}

const digitsOf = (number, width) => String(number).padStart(width, "0")

function momentOf(register, raw) {
  const found = momentIn(register.layout, raw)
  if (!found) return null
  const date = `${digitsOf(found.year, 4)}-${digitsOf(found.month, 2)}-${digitsOf(found.day, 2)}`
  const clock = [found.hour, found.minute, found.second].map((part) => digitsOf(part, 2)).join(":")
  const time = found.thousandth ? `${clock}.${digitsOf(found.thousandth, 3)}000` : clock
  return register.kind === "date" ? date : register.kind === "time" ? time : `${date}T${time}`
}

/** The moment from which a layout counts in days, the seconds of its unit and its words; null if it does not count. */
function countOf(layout) {
  const [name, epoch] = layout.split(" ")
  if (!Object.hasOwn(UNITS, name)) return null
  const [year, month, day] = (epoch ?? "1970-01-01").split("-").map(Number)
  return { name, unit: UNITS[name][0], words: UNITS[name][1], start: BigInt(daysOf({ year, month, day })) * SECONDS_OF_DAY }
}

function momentIn(layout, raw) {
  const count = countOf(layout)
  if (count) return momentAfter(count, bitsOf(raw) * count.unit)
  if (layout === "iec870") return iec870Of(raw)
  const moment = { year: 2000, month: 1, day: 1, hour: 0, minute: 0, second: 0 }
  const parts = partsOf(layout, raw)
  if (!parts || parts.some(([letter, part]) => letter === "y" && part > 99)) return null
  for (const [letter, part] of parts) if (PARTS[letter]) moment[PARTS[letter]] = part + (letter === "y" ? 2000 : 0)
  return checked(moment)
}

function momentAfter({ name, start }, seconds) {
  if ((name === "minutes" || name === "seconds") && seconds >= SECONDS_OF_DAY) return null
  const since = start + seconds
  const days = floor(ratio(since, SECONDS_OF_DAY))
  if (days > 4000000n) return null
  const rest = Number(since - days * SECONDS_OF_DAY)
  const clock = { hour: Math.floor(rest / 3600), minute: Math.floor(rest / 60) % 60, second: rest % 60 }
  return checked({ ...dateOf(Number(days)), ...clock })
}

/** How the digits of a layout stand (bcd, ascii, or nothing special), and what is in its words. */
function tokensOf(layout) {
  const words = layout.split(" ")
  return ["bcd", "ascii"].includes(words[0]) ? [words[0], words.slice(1)] : ["", words]
}

/** Pairs of the letters of a layout and the numbers that stand for them; null for impossible digits. */
function partsOf(layout, raw) {
  const [form, tokens] = tokensOf(layout)
  const found = form === "ascii" ? charactersOf(tokens.join(""), raw) : []
  let place = 0
  for (const token of form === "ascii" ? [] : tokens) {
    const cells = raw.slice(place, place + (token.length > 4 ? 4 : 2))
    place += cells.length
    found.push(...wordParts(token, cells, form === "bcd"))
  }
  return found.some(([, part]) => part === null) ? null : found
}

function wordParts(token, cells, bcd) {
  if (token.length === 1) return [[token, wholeOf(cells, bcd)]]
  if (token.length === 2 && token[0] !== token[1]) return cells.map((cell, place) => [token[place], wholeOf([cell], bcd)])
  const digits = digitsOf(wholeOf(cells, false), token.length)
  if (digits.length > token.length) return [["", null]]
  return [...token.matchAll(RUNS)].map((run) => [run[1], Number(digits.slice(run.index, run.index + run[0].length))])
}

function charactersOf(letters, raw) {
  return [...letters.matchAll(RUNS)].map((run) => {
    const text = String.fromCharCode(...raw.slice(run.index, run.index + run[0].length))
    return [run[1], run[1] === "_" ? 0 : /^\d+$/.test(text) ? Number(text) : null]
  })
}

function wholeOf(cells, bcd) {
  if (!bcd) return cells.reduce((number, cell) => 256 * number + cell, 0)
  const digits = hexadecimal(cells).join("")
  return /^\d+$/.test(digits) ? Number(digits) : null
}

const MOMENT = /^(?:(\d{4})-(\d\d)-(\d\d))?(T)?(?:(\d\d):(\d\d):(\d\d)(?:\.(\d{3})\d{3})?)?$/

/** The moment that a text spells: a date has midnight, a time the day from which its layout counts. */
function spelledMoment(register, said) {
  const found = MOMENT.exec(said)
  const has = found && { date: Boolean(found[1]), time: Boolean(found[5]) }
  if (!has || Boolean(found[4]) !== (has.date && has.time)) return null
  if (!has.date && register.kind !== "time") return null
  const [year, month, day, , hour, minute, second, thousandth] = found.slice(1).map((part) => Number(part ?? 0))
  const date = register.kind === "time" ? { year: 1970, month: 1, day: 1 } : { year, month, day }
  return checked({ ...date, hour, minute, second, thousandth })
}

function momentBytes(register, said) {
  const moment = spelledMoment(register, said)
  if (!moment) return null
  const count = countOf(register.layout)
  if (count) return countedBytes(register, moment, count)
  return register.layout === "iec870" ? iec870Bytes(moment) : layoutBytes(register.layout, moment)
}

function countedBytes(register, moment, { unit, words, start }) {
  const clock = BigInt(3600 * moment.hour + 60 * moment.minute + moment.second)
  const since = register.kind === "time" ? clock : BigInt(daysOf(moment)) * SECONDS_OF_DAY + clock - start
  const number = floor(ratio(since, unit))
  return number < 0n || number >> BigInt(16 * words) ? null : bytesOf(number, 2 * words)
}

function layoutBytes(layout, moment) {
  const numbers = { ...Object.fromEntries(Object.entries(PARTS).map(([letter, name]) => [letter, moment[name]])) }
  Object.assign(numbers, { y: moment.year - 2000, w: weekdayOf(moment), _: 0 })
  const [form, tokens] = tokensOf(layout)
  const spell = (letters) => [...letters.matchAll(RUNS)].map((run) => digitsOf(numbers[run[1]], run[0].length)).join("")
  if (form === "ascii") return [...spell(tokens.join(""))].map((digit) => digit.charCodeAt(0))
  const raw = tokens.flatMap((token) => tokenBytes(token, numbers, spell, form === "bcd"))
  return raw.includes(null) ? null : raw
}

function tokenBytes(token, numbers, spell, bcd) {
  const apart = token.length === 1 || (token.length === 2 && token[0] !== token[1])
  if (!apart) return numberBytes(spell(token), token.length > 4 ? 4 : 2, 10)
  return [...token].flatMap((letter) => numberBytes(String(numbers[letter]), 2 / token.length, bcd ? 16 : 10))
}

function numberBytes(digits, size, base) {
  const number = /^\d+$/.test(digits) ? parseInt(digits, base) : Infinity
  return number < 256 ** size ? bytesOf(BigInt(number), size) : [null]
}

function iec870Of(raw) {
  if (raw[5] >> 7 || raw[1] % 128 > 99) return null
  const thousandths = 256 * raw[6] + raw[7]
  const [year, month, day] = [2000 + (raw[1] % 128), raw[2] % 16, raw[3] % 32]
  const [second, thousandth] = [Math.floor(thousandths / 1000), thousandths % 1000]
  return checked({ year, month, day, hour: raw[4] % 32, minute: raw[5] % 64, second, thousandth })
}

function iec870Bytes(moment) {
  const thousandths = 1000 * moment.second + moment.thousandth
  const raw = [0, moment.year - 2000, moment.month, 32 * weekdayOf(moment) + moment.day, moment.hour, moment.minute]
  const bytes = [...raw, thousandths >> 8, thousandths & 255]
  return bytes.every((byte) => byte >= 0 && byte < 256) ? bytes : null
}
