/**
 * The list of what was found.
 */

const MOST_ROWS = 100
const LONG_WHY = 3

/** A row of the list: a link that opens the register. */
function shownRow({ item, why, path }) {
  const { map, entry, anchor } = item
  const isOpen = browser.open?.item === item
  const first = item.places[0]
  const models = entry.models ? [element("span", { class: "models" }, entry.models.join(", "))] : []
  return element(
    "li",
    {},
    element(
      "a",
      { href: hashOfAnchor(map, anchor, path), class: "row", "aria-current": isOpen ? "true" : null },
      element("span", { class: "place" }, first ? placeSpan(first, item) : ""),
      element("span", { class: "name" }, item.name),
      element("code", { class: "path" }, item.path),
      element(
        "span",
        { class: "notes" },
        ACCESS_SHORT[entry.access] ? element("span", { class: "access" }, ACCESS_SHORT[entry.access]) : null,
        item.facets.unit?.length ? element("span", { class: "unit" }, item.facets.unit.join(" / ")) : null,
        models,
        browser.maps.length > 1 ? element("span", { class: "map" }, map.title) : null,
      ),
      why.length ? element("span", { class: "why" }, whyText(why)) : null,
    ),
  )
}

const ACCESS_SHORT = { r: "R", rw: "R/W", w: "W" }
const SPACE_SHORT = { input: "input ", coil: "coil ", discrete: "discrete ", holding: "" }

const placeSpan = (place, item) =>
  `${SPACE_SHORT[place.space] ?? `${place.space} `}${place.address}${item.entry.elements ? " …" : ""}`

const whyText = (why) =>
  (why.length > LONG_WHY ? [...why.slice(0, LONG_WHY), `${why.length - LONG_WHY} more`] : why).join("; ")

/** Links to the errata of maps that say what was searched, whichever register they are about. */
const errataLinks = (query) =>
  browser.maps.flatMap((map) => {
    const count = errataWith(map, query)
    const words = `${count} ${count === 1 ? "erratum" : "errata"} of ${map.title} with these words`
    return count ? [element("p", {}, element("a", { href: hashOfAnchor(map, "errata") }, words))] : []
  })

/** Show what was found, the first rows of many. */
function showResults(found, query) {
  const list = document.getElementById("results")
  const isMore = browser.most < found.length
  list.replaceChildren(...found.slice(0, browser.most).map(shownRow))
  document.getElementById("more").replaceChildren(
    ...(isMore
      ? [
          button(`Show all ${found.length}`, () => {
            browser.most = Infinity
            render()
          }),
        ]
      : []),
    ...errataLinks(query),
  )
}

/** Chips of what an address can mean. */
function showReadings(readings) {
  document
    .getElementById("readings")
    .replaceChildren(
      ...readings.map(({ text, count }) =>
        element(
          "li",
          { class: count ? "chip" : "chip none" },
          `${text}: `,
          count ? `${count} ${count === 1 ? "register" : "registers"}` : "nothing there",
        ),
      ),
    )
}

/** Arrow keys move between search and rows. */
function moveFocus(event) {
  if (!["ArrowDown", "ArrowUp", "Home", "End"].includes(event.key) || event.altKey || event.ctrlKey || event.metaKey)
    return
  const rows = [...document.querySelectorAll("#results .row")]
  const at = rows.indexOf(document.activeElement)
  const isSearch = document.activeElement?.id === "search"
  if (at < 0 && !(isSearch && event.key === "ArrowDown")) return
  event.preventDefault()
  const next = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: rows.length - 1 }[event.key]
  const target = next < 0 ? document.getElementById("search") : rows[next]
  target?.focus()
}
