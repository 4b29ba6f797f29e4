/** Texts, addresses and raw bytes: what bytes say, as text, and back. Dates and times are in `moments`. */

const NOTHING = null
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
