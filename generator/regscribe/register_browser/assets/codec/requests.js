/** The requests that read and write a register. */

const READING = { holding: 3, input: 4, coil: 1, discrete: 2, status: 7 }
const WRITING = { holding: [6, 16], coil: [5, 15] }

/**
 * The request of a register's view, as bytes of an RTU frame with its CRC.
 * @param {number[]|null} words  what is written; null to read
 * @returns {{frame: number[], function: number}|{refused: string}}
 */
function frame(map, register, view, unit, words = null) {
  const why = whyNoRequest(map, register, view, words)
  if (why) return { refused: why }
  const code = codesOf(map, view, words)[0]
  const body = [unit, code, ...bodyOf(code, view, words)]
  const crc = crcOf(body)
  return { frame: [...body, crc & 255, crc >> 8], function: code }
}

function whyNoRequest({ protocol = {} }, register, view, words) {
  const isApart = Array.isArray(view.word_order) && view.word_order.length < view.words
  const most = words ? protocol.write_words : protocol.read_words // bits come one by one
  if (!Object.hasOwn(READING, view.space)) return `this page makes no requests for the space ${view.space}`
  if (register.block) return `where the block ${register.block} stands, only the device tells`
  if (register.page) return `page ${register.page} must be selected first`
  if (words && isApart) return "other things stand between its words"
  if (view.words > most) return `one request has ${most} words at most, and these are ${view.words}`
  return codesOf({ protocol }, view, words).length ? "" : `no function ${words ? "writes" : "reads"} this view`
}

/** The functions that may read a view, or write words to it. */
function codesOf({ protocol }, view, words) {
  const may = (code) => [view.functions, protocol?.functions ?? []].every((codes) => !codes.length || codes.includes(code))
  if (!words) return [READING[view.space]].filter(may)
  const [single, several] = WRITING[view.space] ?? []
  return [...(words.length === 1 ? [single] : []), several].filter((code) => code !== undefined && may(code))
}

const pairOf = (word) => [(word >> 8) & 255, word & 255]

function bodyOf(code, view, words) {
  if (code === 7) return []
  const place = pairOf(view.address)
  if (!words) return [...place, ...pairOf(view.words)]
  if (code === 6) return [...place, ...pairOf(words[0])]
  if (code === 5) return [...place, words[0] ? 255 : 0, 0]
  if (code === 15) return [...place, 0, words.length, 1, words.reduce((bits, bit, number) => bits | (bit << number), 0)]
  return [...place, ...pairOf(words.length), 2 * words.length, ...words.flatMap(pairOf)]
}

/** The checksum of a frame (polynomial A001, from FFFF), which is sent low byte first. */
function crcOf(bytes) {
  let crc = 0xffff
  for (const byte of bytes) {
    crc ^= byte
    for (let bit = 0; bit < 8; bit += 1) crc = crc & 1 ? (crc >> 1) ^ 0xa001 : crc >> 1
  }
  return crc
}
