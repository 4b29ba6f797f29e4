/**
 * Addresses as people write them; the same grammar as `regscribe.model.address_text` has.
 */

const MODICON_DIGITS = { 0: "coil", 1: "discrete", 3: "input", 4: "holding" }
const LAST_ADDRESS = 0xffff
const SHORT_NUMBER = 5

/**
 * All meanings of a written address, the plainest first; none for what is no address.
 * @returns {{address: number, space: string|null, notation: string}[]}  a wire address; space null: any
 */
function addressReadings(written) {
  const text = written.trim()
  const hexadecimal = /^(?:(?:0x|\$)([0-9a-f]+)|([0-9a-f]*[0-9][0-9a-f]*)h)$/i.exec(text)
  if (hexadecimal) {
    const address = parseInt(hexadecimal[1] ?? hexadecimal[2], 16)
    return address <= LAST_ADDRESS ? [{ address, space: null, notation: "hexadecimal" }] : []
  }
  if (!/^[0-9]{1,6}$/.test(text)) return []
  const plain = Number(text) <= LAST_ADDRESS ? [{ address: Number(text), space: null, notation: "decimal" }] : []
  return [...plain, ...modiconReadings(text)]
}

/** Why a text that looks like an address is none, to be said behind others; empty for what does not look like one. */
function addressTrouble(text) {
  const digits = /^(?:(?:0x|\$)(.*)|([0-9]+))$/i.exec(text)
  if (!digits) return ""
  const number = digits[2] ? Number(text) : Number(`0x${digits[1]}`)
  return number <= LAST_ADDRESS ? "" : `: ${text} is ${number > LAST_ADDRESS ? `more than ${LAST_ADDRESS}` : "no number"}`
}

function modiconReadings(text) {
  const number = Number(text.slice(1))
  const space = MODICON_DIGITS[text[0]]
  if (text.length < SHORT_NUMBER || !space || number < 1 || number > LAST_ADDRESS + 1) return []
  return [{ address: number - 1, space, notation: "Modicon" }]
}

/** Modicon's number of a wire address, long where the short has too few digits; empty for other spaces. */
function modiconNumber(space, address) {
  const digit = Object.keys(MODICON_DIGITS).find((one) => MODICON_DIGITS[one] === space)
  if (digit === undefined || address < 0 || address > LAST_ADDRESS) return ""
  return digit + String(address + 1).padStart(SHORT_NUMBER - 1, "0")
}

/** A wire address in hexadecimal digits: `0xFD1`. */
const hexadecimalAddress = (address) => `0x${address.toString(16).toUpperCase()}`

/** What a number means in the notations of a manual. @returns the same as `addressReadings` */
function notationReadings(text, notations) {
  const found = []
  for (const { name, space = "holding", offset, base = 10 } of notations) {
    const digits = text.trim().replace(base === 16 ? /^(0x|\$)|h$/gi : /^$/, "")
    if (!(base === 16 ? /^[0-9a-f]{1,6}$/i : /^[0-9]{1,6}$/).test(digits)) continue
    const address = parseInt(digits, base) - offset
    if (address >= 0 && address <= LAST_ADDRESS) found.push({ address, space, notation: name })
  }
  return found
}

/** An address as the manual's notations of its space print it. @returns {[string, string][]} pairs of name and number */
const printedAddresses = (notations, space, address) =>
  notations
    .filter((one) => (one.space ?? "holding") === space)
    .map(({ name, offset, base = 10 }) => [
      name,
      base === 16 ? `0x${(address + offset).toString(16).toUpperCase().padStart(4, "0")}` : String(address + offset),
    ])
