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
  const set = (number, focus) => {
    state.choice.words = words.map((one, at) => (at === place ? number : one))
    state.choice.text = null
    state.again(focus)
  }
  return element(
    "div",
    { class: "word" },
    element("span", { class: "at" }, `${address}`),
    wordField(
      `Hexadecimal, ${name}`,
      "0x" +
        word
          .toString(16)
          .toUpperCase()
          .padStart(width / 4, "0"),
      /^(?:0x|\$)?([0-9a-f]+)h?$/i,
      16,
      width,
      set,
      `[data-word="16-${place}"]`,
    ),
    wordField(`Decimal, ${name}`, String(word), /^(-?[0-9]+)$/, 10, width, set, `[data-word="10-${place}"]`),
    bitButtons(word, width, bitLabels(state, width), false, (bit) =>
      set((word ^ (1 << bit)) >>> 0, `.word:nth-of-type(${place + 1}) [data-bit="${bit}"]`),
    ),
  )
}

/** What the bits of the only word are called. */
function bitLabels({ register, words }, width) {
  const labels = {}
  if (words.length > 1 || width > 16) return labels
  for (const field of register.fields) for (const bit of bitsOf(field)) labels[bit] = field.label
  return labels
}

function wordField(label, text, form, base, width, set, focus) {
  const field = element("input", {
    type: "text",
    class: base === 16 ? "hex" : "decimal",
    "aria-label": label,
    "data-word": focus.slice(12, -2),
    autocomplete: "off",
    spellcheck: "false",
    on: {
      change: () => {
        const found = form.exec(field.value.trim())
        const number = found ? parseInt(found[1], base) : NaN
        const top = 2 ** width
        if (number >= -top / 2 && number < top) set(number < 0 ? number + top : number, focus)
        else {
          field.setAttribute("aria-invalid", "true")
          announce(`${field.value} is no word of ${width} bits`)
        }
      },
    },
  })
  field.value = text
  return field
}
