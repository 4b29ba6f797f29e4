/**
 * Elements, made by `setAttribute` and text nodes alone: no text of a map is ever read as HTML.
 */

/** Characters that show as nothing or turn the direction of their neighbours. */
const UNSEEN = /[\p{Cc}\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb\ufffe\uffff\p{Cs}]/gu

/** A text with such characters as `U+202E`. */
const visibleText = (text) =>
  String(text).replace(UNSEEN, (found) =>
    found === "\n" ? found : `U+${found.codePointAt(0).toString(16).toUpperCase().padStart(4, "0")}`,
  )

/**
 * An element.
 * @param {string} tag
 * @param {object} attributes  by name; `on` has listeners by event, null and false leave one out
 * @param {...(Node|string|number|null|Array)} children
 */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "on") for (const [event, listener] of Object.entries(value)) made.addEventListener(event, listener)
    else if (value !== null && value !== false && value !== undefined)
      made.setAttribute(name, value === true ? "" : value)
  }
  made.append(
    ...children
      .flat(Infinity)
      .filter((child) => child !== null && child !== undefined)
      .map(nodeOf),
  )
  return made
}

const nodeOf = (child) => (child instanceof Node ? child : document.createTextNode(visibleText(child)))

/** A button that does something. */
const button = (label, action, attributes = {}) =>
  element("button", { type: "button", on: { click: action }, ...attributes }, label)

/** A button that copies a text and says so. */
function copyButton(text, what = text) {
  const made = button(
    "",
    async () => {
      await copyText(text)
      made.classList.add("done")
      announce(`Copied ${visibleText(text)}`)
      setTimeout(() => made.classList.remove("done"), 1500)
    },
    { class: "copy", "aria-label": visibleText(`Copy ${what}`), title: visibleText(`Copy ${what}`) },
  )
  return made
}

/** Put a text on the clipboard; where a page from disk may not, by a selection. */
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text)
  } catch {
    const area = element("textarea", { "aria-hidden": "true", class: "hidden" })
    area.value = text
    const focused = document.activeElement
    document.body.append(area)
    area.select()
    document.execCommand("copy")
    area.remove()
    focused?.focus()
  }
}

let waiting = 0

/** Let a screen reader say a text when nothing was typed for a while: not at each key. */
function announceLater(text) {
  clearTimeout(waiting)
  waiting = setTimeout(() => announce(text), 800)
}

/** What is wrong with what stands in a field, beside it; empty where nothing is. */
const troubleNote = (id, reason = "") => element("span", { class: "trouble", id }, reason)

/** Attributes of a field that such a note is about. */
const troubleAttributes = (id, reason) => ({ "aria-describedby": id, "aria-invalid": reason ? "true" : null })

/** Say what is wrong with what is being typed, or that nothing is. */
function tellTrouble(field, reason) {
  document.getElementById(field.getAttribute("aria-describedby")).textContent = visibleText(reason)
  field.toggleAttribute("aria-invalid", false)
  if (reason) field.setAttribute("aria-invalid", "true")
  announceLater(visibleText(reason))
}

/**
 * Put new children into a box, but leave the field that is typed into: it keeps focus, caret, and what undo knows.
 * @param {Element} field  in `old`, of which `twin` is the new version in `made`
 */
function renew(old, made, field, twin) {
  for (const { name, value } of [...made.attributes]) old.setAttribute(name, value)
  for (const { name } of [...old.attributes]) if (!made.hasAttribute(name)) old.removeAttribute(name)
  if (old === field) return
  const kept = [...old.childNodes].find((one) => one.contains(field))
  const like = [...made.childNodes].find((one) => one.contains(twin))
  for (const one of [...old.childNodes]) if (one !== kept) one.remove()
  const parts = [...made.childNodes]
  kept.before(...parts.slice(0, parts.indexOf(like)))
  kept.after(...parts.slice(parts.indexOf(like) + 1))
  renew(kept, like, field, twin)
}

/** Let a screen reader say a text. */
function announce(text) {
  clearTimeout(waiting)
  document.getElementById("said").textContent = text
}

/** A labelled value: a label and what it is for, in one block. */
const labelled = (label, control, attributes = {}) =>
  element("label", { class: "field", ...attributes }, element("span", { class: "label" }, label), control)
