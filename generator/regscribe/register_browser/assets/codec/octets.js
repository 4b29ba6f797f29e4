/** Texts, addresses and raw bytes: what bytes say, as text, and back. Dates and times are in `moments`. */

/** What of the language the page cannot compute: `subject` names it. */
class NotHere extends Error {
  constructor(subject) {
    super(`this page cannot compute ${subject}`)
    this.subject = subject
  }
}

const NOTHING = null
const HALF_A_PAIR = /\p{Surrogate}/u
const isMoment = (kind) => kind === "datetime" || kind === "date" || kind === "time"

/** What bytes (the first letter, or the most significant, first) say; null where that is nothing. */
function meaningOf(register, raw) {
  if (register.kind === "string") return textOf(register.text, raw)
  if (register.kind === "bytes") return hexadecimal(raw).join("")
  if (isMoment(register.kind)) return momentOf(register, raw)
  const size = SIZES[register.views[0].type]
  const packed = raw.length === 2 * size ? raw.filter((_, place) => place % 2) : raw.slice(raw.length - size)
  if (register.kind === "mac") return hexadecimal(packed).join(":")
  return packed.length === 4 ? packed.join(".") : ipv6Of(packed)
}

/** The bytes, so many, that say a text; Refused where none do. */
function octetsOf(register, said, size) {
  const raw = rawOf(register, said, size)
  const back = raw && raw.length === size ? meaningOf(register, raw) : NOTHING
  const same = register.kind === "string" ? said.replace(/ +$/, "") : said
  if (back === same) return raw
  const other = back === NOTHING ? "" : ` would be read back as ${back}: it`
  throw new Refused("type", `${said} in ${size} bytes${other} is no value of this kind`)
}

function rawOf(register, said, size) {
  if (register.kind === "string") return lettersOf(register.text, said, size)
  if (register.kind === "bytes") return bytesOfHex(said)
  if (isMoment(register.kind)) return momentBytes(register, said)
  const packed = register.kind === "mac" ? bytesOfHex(said.replaceAll(":", "")) : addressOf(said)
  if (!packed) return NOTHING
  if (size === 2 * packed.length) return packed.flatMap((byte) => [0, byte])
  return [...new Array(Math.max(0, size - packed.length)).fill(0), ...packed]
}

const hexadecimal = (bytes) => bytes.map((byte) => byte.toString(16).padStart(2, "0"))

function bytesOfHex(text) {
  if (!/^([0-9a-fA-F]{2})*$/.test(text)) return NOTHING
  return Array.from({ length: text.length / 2 }, (_, place) => parseInt(text.slice(2 * place, 2 * place + 2), 16))
}

// -- addresses of networks --------------------------------------------------------------------------------------------

/** The address in its usual form: the longest run of zeros is left out, of several the first. */
function ipv6Of(packed) {
  const groups = Array.from({ length: 8 }, (_, place) => 256 * packed[2 * place] + packed[2 * place + 1])
  let [start, length] = [0, 0]
  groups.forEach((_, first) => {
    let end = first
    while (end < 8 && !groups[end]) end += 1
    if (end - first > length) [start, length] = [first, end - first]
  })
  const shown = (several) => several.map((group) => group.toString(16)).join(":")
  if (length < 2) return shown(groups)
  return `${shown(groups.slice(0, start))}::${shown(groups.slice(start + length))}`
}

function addressOf(text) {
  const four = /^(\d{1,3})\.(\d{1,3})\.(\d{1,3})\.(\d{1,3})$/.exec(text)
  if (four) {
    const bytes = four.slice(1).map(Number)
    return bytes.every((byte) => byte < 256) ? bytes : NOTHING
  }
  const [head, tail, more] = text.split("::")
  if (more !== undefined) return NOTHING
  const groupsOf = (part) => (part ? part.split(":") : [])
  const [first, last] = [groupsOf(head), groupsOf(tail)]
  const missing = 8 - first.length - last.length
  if (tail === undefined ? missing !== 0 : missing < 1) return NOTHING
  const groups = [...first, ...new Array(missing).fill("0"), ...last]
  if (!groups.every((group) => /^[0-9a-fA-F]{1,4}$/.test(group))) return NOTHING
  return groups.map((group) => parseInt(group, 16)).flatMap((group) => [group >> 8, group & 255])
}

// -- texts ------------------------------------------------------------------------------------------------------------

/** What letters of an encoding are, by its name, besides those below; `open` fills it from the data. */
const ENCODINGS = new Map()

function textOf(form, raw) {
  const letters = form.per_register ? raw.filter((_, place) => place % 2 === Number(form.per_register === "low")) : raw
  const width = form.encoding === "utf-16" ? 2 : 1
  const isAll = (letter, byte) => letter.length === width && letter.every((one) => one === byte)
  const kept = []
  for (let place = 0; place < letters.length; place += width) {
    const letter = letters.slice(place, place + width)
    if ((form.ends ?? []).some((end) => isAll(letter, end))) break
    kept.push(letter)
  }
  while (form.padding !== 32 && kept.length && isAll(kept.at(-1), form.padding)) kept.pop()
  return decodedText(form.encoding, kept.flat())?.replace(/ +$/, "") ?? NOTHING
}

function lettersOf(form, said, size) {
  const width = form.encoding === "utf-16" ? 2 : 1
  const letters = said.includes("\0") ? NOTHING : encodedText(form.encoding, said)
  if (!letters) return NOTHING
  const filling = form.padding === 32 ? encodedText(form.encoding, " ") : new Array(width).fill(form.padding)
  const room = form.per_register ? Math.floor(size / 2) : size
  while (letters.length < room) letters.push(...filling)
  if (!form.per_register) return letters
  return letters.flatMap((letter) => (form.per_register === "low" ? [0, letter] : [letter, 0]))
}

function decodedText(encoding, bytes) {
  if (encoding === "utf-16") return decodedPairs(bytes)
  if (encoding === "utf-8") return decodedUtf8(bytes)
  const highest = { ascii: 127, "latin-1": 255 }[encoding]
  if (highest === undefined) return decodedByTable(tableOf(encoding), bytes)
  return bytes.every((byte) => byte <= highest) ? String.fromCharCode(...bytes) : NOTHING
}

function encodedText(encoding, text) {
  if (HALF_A_PAIR.test(text)) return NOTHING
  if (encoding === "utf-8") return [...new TextEncoder().encode(text)]
  const units = Array.from({ length: text.length }, (_, place) => text.charCodeAt(place))
  if (encoding === "utf-16") return units.flatMap((unit) => [unit >> 8, unit & 255])
  const highest = { ascii: 127, "latin-1": 255 }[encoding]
  if (highest === undefined) return encodedByTable(tableOf(encoding), text)
  return units.every((unit) => unit <= highest) ? units : NOTHING
}

function decodedUtf8(bytes) {
  try {
    return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(Uint8Array.from(bytes))
  } catch {
    return NOTHING
  }
}

function decodedPairs(bytes) {
  if (bytes.length % 2) return NOTHING
  const units = Array.from({ length: bytes.length / 2 }, (_, place) => 256 * bytes[2 * place] + bytes[2 * place + 1])
  const text = String.fromCharCode(...units)
  return HALF_A_PAIR.test(text) ? NOTHING : text
}

function tableOf(encoding) {
  if (!ENCODINGS.has(encoding)) throw new NotHere(`texts in ${encoding}`)
  return ENCODINGS.get(encoding)
}

const NO_LETTER = "\uFFFD"

/** Keep the letters of an encoding, as `encodings` of the data has them. */
function learn(encoding, { one, two, spelled }) {
  const decoded = new Map()
  const add = (first, letters) => {
    for (let byte = 0; byte < 256; byte += 1) {
      if (letters[byte] !== NO_LETTER) decoded.set(first + byte.toString(16).padStart(2, "0"), letters[byte])
    }
  }
  add("", one)
  for (const [first, letters] of Object.entries(two)) add(first, letters)
  const encoded = new Map([...decoded].map(([bytes, letter]) => [letter, bytes]))
  for (const [letter, bytes] of Object.entries(spelled)) encoded.set(letter, bytes)
  ENCODINGS.set(encoding, { decoded, encoded })
}

function decodedByTable({ decoded }, bytes) {
  let text = ""
  for (let place = 0; place < bytes.length; ) {
    const [one, two] = [1, 2].map((count) => hexadecimal(bytes.slice(place, place + count)).join(""))
    const found = decoded.has(one) ? one : two
    if (!decoded.has(found)) return NOTHING
    text += decoded.get(found)
    place += found.length / 2
  }
  return text
}

function encodedByTable({ encoded }, text) {
  const letters = [...text]
  return letters.every((letter) => encoded.has(letter)) ? letters.flatMap((letter) => bytesOfHex(encoded.get(letter))) : NOTHING
}
