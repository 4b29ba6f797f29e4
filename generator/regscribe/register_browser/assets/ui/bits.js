/**
 * Words drawn bit by bit.
 */

/** The bits that a field takes, lowest first. */
const bitsOf = (field) =>
  field.bits ?? Array.from({ length: field.high - field.low + 1 }, (_, place) => field.low + place)

/** A picture of a word with its fields: the table of bits below says the same in words. */
function drawnBits(register) {
  if (!register.fields.length) return null
  const highest = Math.max(15, ...register.fields.flatMap(bitsOf))
  const cells = []
  for (let bit = highest; bit >= 0; bit -= 1) {
    const place = register.fields.findIndex((field) => bitsOf(field).includes(bit))
    const field = register.fields[place]
    cells.push(
      element(
        "li",
        {
          class: field ? `bit used tone${place % 6}` : "bit",
          title: field ? visibleText(`${field.label} (bit ${bit})`) : `bit ${bit}: not used`,
        },
        element("span", { class: "number" }, bit),
        element("span", { class: "label" }, field ? field.label : ""),
      ),
    )
  }
  return element("ol", { class: "bits", "aria-hidden": "true" }, cells)
}

/** Buttons for the bits of a word; each turns its own. */
function bitButtons(word, width, labels, isFixed, turn) {
  const bits = []
  for (let bit = width - 1; bit >= 0; bit -= 1) {
    const isOn = Boolean((word >>> bit) & 1)
    const label = labels[bit]
    bits.push(
      button(element("span", {}, isOn ? "1" : "0"), () => turn(bit), {
        class: bit % 4 === 0 && bit ? "toggle nibble" : "toggle",
        "aria-pressed": String(isOn),
        disabled: isFixed,
        "data-bit": bit,
        "aria-label": visibleText(label ? `Bit ${bit}: ${label}` : `Bit ${bit}`),
        title: visibleText(label ? `Bit ${bit}: ${label}` : `Bit ${bit}`),
      }),
    )
  }
  return element("div", { class: "toggles", role: "group", "aria-label": "Bits, the most significant first" }, bits)
}
