/**
 * The page: its state is in its address; what is chosen in a calculator is not.
 */

const browser = {
  maps: [], items: [], book: new Map(), state: { query: "", chosen: {}, open: "", map: "", element: "" }, open: null, opened: new Set(matchMedia("(min-width: 1101px)").matches ? ["model", "access"] : []),
  said: new Map(), choices: new Map(), most: MOST_ROWS, calculates: true,
}

/** Open the data and show what the address says. */
function start() {
  browser.maps = open(JSON.parse(document.getElementById("data").textContent))
  browser.items = indexOf(browser.maps)
  browser.book = addressBook(browser.items)
  listen()
  browser.state = readHash(location.hash)
  document.getElementById("search").value = browser.state.query
  render()
  if (browser.open) reveal()
}

function listen() {
  const field = document.getElementById("search")
  field.addEventListener("input", () => go({ ...browser.state, query: field.value }, true))
  document.getElementById("theme").addEventListener("click", changeTheme)
  document.addEventListener("keydown", onKey)
  window.addEventListener("popstate", follow)
  window.addEventListener("hashchange", follow)
  window.addEventListener("beforeprint", openAll)
  window.addEventListener("afterprint", render)
}

/** Show what the address of the page says: after a link, Back or Forward. */
function follow() {
  const state = readHash(location.hash)
  if (writeHash(state) === writeHash(browser.state)) return
  const isOther = ["open", "map", "element"].some((name) => state[name] !== browser.state[name])
  browser.state = state
  const field = document.getElementById("search")
  if (field.value !== state.query) field.value = state.query
  render()
  if (isOther && browser.open) reveal()
}

/** Go to a state; typing replaces the last one, everything else can be undone by Back. */
function go(state, isTyping = false) {
  browser.most = MOST_ROWS
  browser.state = state
  history[isTyping ? "replaceState" : "pushState"](null, "", writeHash(state))
  render()
}

/** Close what is open; the focus goes back to its row. */
function close() {
  const row = document.querySelector('#results [aria-current="true"]')
  const href = row?.getAttribute("href")
  go({ ...browser.state, open: "", map: "", element: "" })
  const again = [...document.querySelectorAll("#results .row")].find((one) => one.getAttribute("href")?.endsWith(href?.split("open=").pop() ?? "\n"))
  ;(again ?? document.getElementById("search")).focus()
}

/** Put the focus on what was opened, or on the part of it that a link leads to. */
function reveal() {
  const target = document.getElementById(browser.state.open)
  const isPart = target && target.classList.contains("target")
  const heading = isPart ? target : document.getElementById("opened")
  heading?.focus({ preventScroll: !isPart })
  if (isPart) target.scrollIntoView()
  else document.getElementById("details").scrollTop = 0
}

/** What the state opens: an item, or a map with the anchor of one of its tables. */
function openedOf({ open: anchor, map: id, element: path }) {
  if (!anchor) return null
  const isThere = (map) => !id || map.id === id
  const item = browser.items.find((one) => one.anchor === anchor && isThere(one.map))
  if (item) return { item, choice: choiceOf(item, path) }
  const map = browser.maps.find(isThere)
  return map && /^(?:about|condition-|unit-|program-)/.test(anchor) ? { map } : null
}

/** What is chosen of an item: at first the model that the list is filtered by, and the element that was found. */
function choiceOf(item, path = "") {
  const { map, entry, anchor } = item
  const key = `${map.id} ${anchor} ${path}`
  if (!browser.choices.has(key)) {
    const models = modelsOf(map, entry)
    const model = models.find((one) => browser.state.chosen.model?.includes(one)) ?? models[0]
    const index = path ? elementsOf(map, entry, model).find((one) => registerOf(map, entry, model, one).path === path) : undefined
    browser.choices.set(key, { model, index, view: "", words: null, text: null })
  }
  return browser.choices.get(key)
}

/** Show the state. */
function render() {
  const { query, chosen } = browser.state
  const { items, readings } = search(query)
  const found = items.filter(({ item }) => isChosen(item, chosen))
  browser.open = openedOf(browser.state)
  showReadings(readings)
  document.getElementById("facets").replaceChildren(...Object.keys(FACETS).map((name) => shownFacet(name, items.map((one) => one.item), chosen)).filter(Boolean), ...clearButton(chosen))
  showResults(found)
  document.getElementById("count").textContent = countText(found.length)
  showOpened()
}

/** Show what is open. */
function showOpened() {
  document.body.classList.toggle("opened", Boolean(browser.open))
  document.getElementById("details").replaceChildren(...flat(browser.open ? (browser.open.item ? shownItem(browser.open) : shownMap(browser.open.map)) : shownWelcome()))
}

const flat = (nodes) => nodes.flat(Infinity).filter(Boolean)

const countText = (count) => `${count} of ${browser.items.length} ${browser.items.length === 1 ? "register" : "registers and commands"}`

const clearButton = (chosen) =>
  Object.values(chosen).some((values) => values.length) ? [button("Clear filters", () => { go({ ...browser.state, chosen: {} }); document.getElementById("search").focus() }, { class: "clear" })] : []

/** What stands beside the list while nothing is open. */
function shownWelcome() {
  const maps = browser.maps.map((map) => element("li", {}, element("a", { href: hashOfAnchor(map, "about") }, map.title), ` ${map.registers.length} registers, ${map.models.map((one) => one.name).join(", ")}`))
  return [element("h2", { class: "welcome" }, "Choose a register"),
    element("p", {}, "Search takes names, ids, symbols, labels of values and bits, sections, and addresses in every notation: 4049, 0xFD1, FD1h, 44050. An address of any view, alias or word of a register finds it."),
    element("ul", { class: "maps" }, maps),
    element("p", { class: "hint" }, element("kbd", {}, "/"), " search · ", element("kbd", {}, "↓"), " ", element("kbd", {}, "↑"), " results · ", element("kbd", {}, "Enter"), " open · ", element("kbd", {}, "Esc"), " close")]
}

function onKey(event) {
  const isField = /^(?:INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)
  if (event.key === "/" && !isField) {
    event.preventDefault()
    const field = document.getElementById("search")
    field.focus()
    field.select()
  } else if (event.key === "Escape" && browser.open) {
    event.preventDefault()
    close()
  } else if (event.key === "Enter" && event.target.id === "search") {
    document.querySelector("#results .row")?.click()
  } else moveFocus(event)
}

/** Light or dark: what the system prefers, until the button was used. */
function changeTheme() {
  const isDark = document.documentElement.dataset.theme ? document.documentElement.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches
  document.documentElement.dataset.theme = isDark ? "light" : "dark"
  announce(isDark ? "Light" : "Dark")
}

/** Open every register of the list for print. */
function openAll() {
  const { items } = search(browser.state.query)
  const found = items.filter(({ item }) => isChosen(item, browser.state.chosen))
  browser.calculates = false
  document.getElementById("details").replaceChildren(...flat((browser.open ? [browser.open] : found.map(({ item }) => ({ item, choice: choiceOf(item) })))
    .map((one) => element("article", {}, flat(one.item ? shownItem(one) : shownMap(one.map))))))
  browser.calculates = true
}


document.addEventListener("DOMContentLoaded", start)
