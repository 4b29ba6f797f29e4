/** The half of the calculator that has the words. */

/** The words as they stand on the wire: in hexadecimal, in decimal and bit by bit. */
function wordsSide(state) {
  const { words, view } = state
  const width = WIDTHS[view.space] ?? 16
  return element(
    "div",
    { class: "words" },
    element("h4", {}, width === 16 ? "Words on the wire" : "Bits on the wire"),
    words.map((word, place) => wordRow(state, word, place, width)),
  )
}

function wordRow(state, word, place, width) {
  const { view, words } = state
  const name = words.length > 1 ? `word ${place + 1}` : "word"
  const address = view.address + (view.offsets?.[place] ?? place)
  const trouble = `trouble-word-${place}`
  const set = (number, focus) => {
    state.choice.words = (state.choice.words ?? words).map((one, at) => (at === place ? number : one))
    state.choice.text = null
    state.again(focus)
  }
  return element(
    "div",
    { class: "word" },
    element("span", { class: "at" }, `${address}`),
    wordField(`Hexadecimal, ${name}`, word, 16, width, set, `16-${place}`, trouble),
    wordField(`Decimal, ${name}`, word, 10, width, set, `10-${place}`, trouble),
    bitButtons(word, width, bitLabels(state, width), false, (bit) =>
      set((word ^ (1 << bit)) >>> 0, `.word:nth-of-type(${place + 1}) [data-bit="${bit}"]`),
    ),
    troubleNote(trouble),
  )
}

/** What the bits of the only word are called. */
function bitLabels({ register, words }, width) {
  const labels = {}
  if (words.length > 1 || width > 16) return labels
  for (const field of register.fields) for (const bit of bitsOf(field)) labels[bit] = field.label
  return labels
}

const FORMS = { 10: /^(-?[0-9]+)$/, 16: /^(?:0x|\$)?([0-9a-f]+)h?$/i }

const spelledWord = (word, base, width) =>
  base === 10
    ? String(word)
    : `0x${word
        .toString(16)
        .toUpperCase()
        .padStart(width / 4, "0")}`

/** A field for a word, which counts while it is typed; at the end it is spelled as usual. */
function wordField(label, word, base, width, set, mark, trouble) {
  const field = element("input", {
    type: "text",
    class: base === 16 ? "hex" : "decimal",
    "aria-label": label,
    "data-word": mark,
    autocomplete: "off",
    spellcheck: "false",
    ...troubleAttributes(trouble),
    on: {
      input: () => {
        const { number, reason } = wordOf(field.value.trim(), base, width)
        if (reason) tellTrouble(field, reason)
        else set(number)
      },
      change: () => {
        const { number, reason } = wordOf(field.value.trim(), base, width)
        if (!reason) field.value = spelledWord(number, base, width)
      },
    },
  })
  field.value = spelledWord(word, base, width)
  return field
}

/** The word that a text spells. @returns {{number: number}|{reason: string}} */
function wordOf(text, base, width) {
  const found = FORMS[base].exec(text)
  if (!text) return { reason: "Empty: a word needs a number" }
  if (!found) return { reason: `${text} is no ${base === 16 ? "hexadecimal" : "whole"} number` }
  const number = parseInt(found[1], base)
  const top = 2 ** width
  if (number >= top) return { reason: `${text} is more than ${spelledWord(top - 1, base, width)}` }
  if (number < -top / 2) return { reason: `${text} is less than ${-top / 2}` }
  return { number: number < 0 ? number + top : number }
}
