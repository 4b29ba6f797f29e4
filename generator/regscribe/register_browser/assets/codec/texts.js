/** Texts in bytes: encodings, padding, ends. */

const HALF_A_PAIR = /\p{Surrogate}/u

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
  for (const [letter, bytes] of spelled) encoded.set(letter, bytes)
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
  if (!letters.every((letter) => encoded.has(letter))) return NOTHING
  return letters.flatMap((letter) => bytesOfHex(encoded.get(letter)))
}
