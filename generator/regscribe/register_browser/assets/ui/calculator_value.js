/** The half of the calculator that has the value. */

/** The value that the words mean, and a field to write another. */
function valueSide(state) {
  const { register, reading, known, sent, choice } = state
  const said = describe(register, reading, known)
  return element(
    "div",
    { class: "value" },
    element("h4", {}, "Value"),
    element("output", { class: `reading ${reading.meaning}`, "aria-live": "off" }, readingNodes(reading, said)),
    said.fields ? fieldList(said.fields) : null,
    register.access === "r"
      ? element("p", { class: "hint" }, "Read only: a value has no words to write.")
      : valueFields(state),
    stateHint(register, known),
    choice.text !== null && sent?.words
      ? element("p", { class: "hint" }, `Written as ${hexWords(sent.words)}`)
      : null,
  )
}

/** What to know of a register that does not exist, or takes no write, as things stand. */
function stateHint(register, known) {
  if (present(register, known) === false)
    return element("p", { class: "refused" }, "As things stand the register does not exist.")
  if (register.access === "r" || writable(register, known) !== false) return null
  return element("p", { class: "refused" }, "As things stand the device takes no write of it: see Access.")
}

function readingNodes(reading, said) {
  const { member, special, fault, text, unit } = said
  if (reading.meaning === "unknown" || reading.meaning === "not_here") {
    const lacking = reading.meaning === "unknown" ? `${reading.subject} is not known` : reading.subject
    return [element("strong", {}, "?"), ` ${MEANINGS[reading.meaning]}: ${lacking}`]
  }
  if (fault) return [element("strong", {}, fault.label || fault.id), ` (${MEANINGS.fault})`]
  const isValue = reading.value !== undefined
  const name = member ? ` = ${member.label || member.id}` : special ? ` = ${special.label}` : ""
  return [
    isValue ? element("strong", {}, text === "" ? "(empty text)" : text) : null,
    isValue && unit && !member && !special ? ` ${unit}` : null,
    name,
    MEANINGS[reading.meaning]
      ? element("span", { class: "meaning" }, isValue ? `: ${MEANINGS[reading.meaning]}` : MEANINGS[reading.meaning])
      : null,
  ]
}

function fieldList(fields) {
  return element(
    "ul",
    { class: "parts" },
    fields
      .filter((one) => one.exists !== false)
      .map(({ field, text, set, member, fault }) =>
        element(
          "li",
          { class: set ? "set" : null },
          element("span", {}, field.label || field.id),
          " ",
          element(
            "strong",
            {},
            fault
              ? fault.label || text
              : member
                ? `${text} = ${member.label}`
                : bitsOf(field).length === 1
                  ? set
                    ? "on"
                    : "off"
                  : text,
          ),
        ),
      ),
  )
}

function valueFields(state) {
  const { register, choice, again, known, reading, sent } = state
  const tell = (text, focus) => {
    choice.text = text.trim() === "" ? null : text
    again(focus)
  }
  const members = register.enum?.members ?? register.enum?.cases?.flatMap((one) => one.then.members) ?? []
  const pick = members.length
    ? labelled(
        "Pick a member",
        picker(
          [
            ["", "…"],
            ...members.map(({ code, label, id }) => [show(stated(code)), `${show(stated(code))} = ${label || id}`]),
          ],
          choice.text ?? textOf(register, reading, known),
          (code) => tell(code, "[data-value=pick]"),
          { "data-value": "pick" },
        ),
      )
    : null
  const field = element("input", {
    type: "text",
    "data-value": "text",
    autocomplete: "off",
    spellcheck: "false",
    placeholder: hintOf(register, unitOf(register, known)),
    ...troubleAttributes("trouble-value", sent?.refused),
    on: { input: () => tell(field.value) },
  })
  field.value = choice.text ?? ""
  const round = element("input", {
    type: "checkbox",
    "data-value": "round",
    on: {
      change: () => {
        choice.rounded = round.checked
        again("[data-value=round]")
      },
    },
  })
  round.checked = Boolean(choice.rounded)
  return element(
    "div",
    { class: "write" },
    pick,
    labelled("Value to write", field),
    element("p", { class: sent?.refused ? "refused" : "hidden", id: "trouble-value" }, sent?.refused ? refusal(state) : null),
    register.kind === "number" ? element("label", { class: "check" }, round, " round to what the view can hold") : null,
  )
}

const hintOf = (register, unit) =>
  register.enum
    ? "code, id or label"
    : register.kind === "flags"
      ? "number or names"
      : register.kind === "number"
        ? unit
          ? `150.5 or 150.5 ${unit}`
          : "150.5"
        : ""

const textOf = (register, reading, known) =>
  reading.value === undefined ? "" : describe(register, reading, known).text

const hexWords = (words) => words.map((word) => word.toString(16).toUpperCase().padStart(4, "0")).join(" ")
