/**
 * The calculator: words to value and value to words, in a view, as things stand. It computes nothing itself.
 */

const MEANINGS = {
  value: "",
  unknown_member: "a code that the list does not have",
  saturated: "the view stops here: this is no value",
  fault: "a fault, no value",
  out_of_range: "outside the valid readings: a fault",
  not_decodable: "these words mean nothing",
  unknown: "cannot be told",
  not_present: "this does not exist as things stand",
  not_here: "cannot be computed in this page",
}
const WIDTHS = { coil: 1, discrete: 1, status: 8, enron: 32 }

/** The calculator of an item; what is chosen in it stays in `choice`. */
function shownCalculator(item, choice) {
  const { map, entry } = item
  const boxed = (parts) => element("section", { class: "calculator", "aria-label": "Calculator" }, parts)
  const box = boxed([])
  const again = (focus) => {
    const { model } = choice
    const register = registerOf(map, entry, model, choice.index)
    const view =
      register.views.find((one) => one.name === choice.view) ??
      register.views.find((one) => one.preferred) ??
      register.views[0]
    if (!view) return
    const state = { ...stateOf(item, choice, model, register, view), again, choice, item }
    renewCalculator(box, boxed(calculatorParts(state)))
    if (focus) box.querySelector(focus)?.focus()
  }
  again()
  return box
}

/** What is computed with: the register, its view, what is known, the words and what they mean. */
function stateOf(item, choice, model, register, view) {
  const asked = needs(register, view)
  const paths = [...asked.read, ...asked.write]
  const known = knownOf(item.map, model, paths)
  const count = view.space in { coil: 1, discrete: 1, status: 1 } ? 1 : view.words
  if (choice.words?.length !== count) choice.words = null
  if (!choice.words && !choice.text) choice.words = startWords(register, view, known, count)
  const sent = choice.text === null ? null : encodedText(register, view, choice.text, known, { rounded: choice.rounded })
  if (sent?.words) choice.words = sent.words
  const words = choice.words ?? Array(count).fill(0)
  return {
    model,
    register,
    view,
    asked: { paths, givens: asked.givens },
    known,
    words,
    sent,
    reading: decode(register, view, words, known),
  }
}

/** The words to begin with: those of the default, where there is one. */
function startWords(register, view, known, count) {
  if (register.default !== undefined && register.default !== null && register.access !== "r") {
    const text = typeof register.default === "string" ? register.default : show(stated(register.default))
    const found = encode(register, view, text, known)
    if (found.words) return found.words
  }
  return Array(count).fill(0)
}

function calculatorParts(state) {
  const { item, choice, register, view, again } = state
  return [
    element("h3", {}, "Calculator"),
    register.views.length > 1
      ? element(
          "div",
          { class: "choices" },
          labelled(
            "View",
            picker(
              register.views.map((one) => [one.name, `${one.name} at ${one.address}`]),
              view.name,
              (name) => {
                choice.view = name
                restart(choice)
                again("[data-choice=view]")
              },
              { "data-choice": "view" },
            ),
          ),
        )
      : null,
    surroundingFields(item.map, state.model, state.asked, again),
    element("div", { class: "sides" }, wordsSide(state), valueSide(state)),
    element("div", { class: "copies" }, copyLines(state)),
  ].filter(Boolean)
}

/** Begin with the words of the default again: another view has others. */
function restart(choice) {
  choice.words = null
  choice.text = null
}

/** Show what was computed again; the field that has the focus stays itself, or is followed by its like. */
function renewCalculator(box, made) {
  const field = box.contains(document.activeElement) ? document.activeElement : null
  const mark = ["known", "word", "value"].find((name) => field?.dataset[name] !== undefined)
  const twin = mark && made.querySelector(`[data-${mark}="${CSS.escape(field.dataset[mark])}"]`)
  if (twin && field.type === "text") {
    renew(box, made, field, twin)
    announceLater([...box.querySelectorAll(".reading, .refused, .trouble")].map((one) => one.innerText).join(" "))
  } else {
    box.replaceChildren(...made.childNodes)
    twin?.focus()
  }
}
