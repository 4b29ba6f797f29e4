/** The page as its state says. */

/** What the state opens: an item, or a map with the anchor of one of its tables. */
function openedOf({ open: anchor, map: id, element: path }) {
  if (!anchor) return null
  const isThere = (map) => !id || map.id === id
  const item = browser.items.find((one) => one.anchor === anchor && isThere(one.map))
  if (item) return { item, choice: choiceOf(item, path) }
  const map = browser.maps.find(isThere)
  return map && /^(?:about|errata|condition-|unit-|program-)/.test(anchor) ? { map } : null
}

/** What is chosen of an item: at first a model that has what was searched and is in the filter, and the element found. */
function choiceOf(item, path = "") {
  const { map, entry, anchor } = item
  const key = `${map.id} ${anchor} ${path}`
  const choice = browser.choices.get(key) ?? { model: "", view: "", words: null, text: null }
  const { query } = browser.state
  if (choice.query !== query) {
    const having = havingModels(item, query)
    if (!having.includes(choice.model)) {
      const model = having.find((one) => browser.state.chosen.model?.includes(one)) ?? having[0]
      const isIt = (one) => registerOf(map, entry, model, one).path === path
      const index = path ? elementsOf(map, entry, model).find(isIt) : undefined
      Object.assign(choice, { model, index, words: null, text: null })
    }
    Object.assign(choice, { query, having })
  }
  browser.choices.set(key, choice)
  return choice
}

/** The models of an item that have what a query finds in it; all if it is not found so. */
function havingModels(item, query) {
  const models = modelsOf(item.map, item.entry)
  const found = query && search(query).items.find((one) => one.item === item)?.models
  const having = models.filter((one) => !found || found.includes(one))
  return having.length ? having : models
}

/** Show the state. */
function render() {
  const { query, chosen } = browser.state
  const { items, readings } = search(query)
  const found = items.filter(({ item }) => isChosen(item, chosen))
  browser.open = openedOf(browser.state)
  showReadings(readings)
  document.getElementById("facets").replaceChildren(
    ...Object.keys(FACETS)
      .map((name) =>
        shownFacet(
          name,
          items.map((one) => one.item),
          chosen,
        ),
      )
      .filter(Boolean),
    ...clearButton(chosen),
  )
  showResults(found, query)
  document.getElementById("count").textContent = countText(found.length, query, chosen)
  showOpened()
}

/** Show what is open. */
function showOpened() {
  document.body.classList.toggle("opened", Boolean(browser.open))
  document
    .getElementById("details")
    .replaceChildren(
      ...flat(
        browser.open ? (browser.open.item ? shownItem(browser.open) : shownMap(browser.open.map)) : shownWelcome(),
      ),
    )
}

const flat = (nodes) => nodes.flat(Infinity).filter(Boolean)

const countText = (count, query, chosen) => {
  if (!count && query) {
    const limits = isFiltered(chosen) ? ", as far as the filters let it show" : ""
    return `Nothing is called or stands at “${visibleText(query)}”${limits}${addressTrouble(query.trim())}`
  }
  return `${count} of ${browser.items.length} ${browser.items.length === 1 ? "register" : "registers and commands"}`
}

const isFiltered = (chosen) => Object.values(chosen).some((values) => values.length)

const clearButton = (chosen) =>
  isFiltered(chosen)
    ? [
        button(
          "Clear filters",
          () => {
            go({ ...browser.state, chosen: {} })
            document.getElementById("search").focus()
          },
          { class: "clear" },
        ),
      ]
    : []

/** What stands beside the list while nothing is open. */
function shownWelcome() {
  const maps = browser.maps.map((map) =>
    element(
      "li",
      {},
      element("a", { href: hashOfAnchor(map, "about") }, map.title),
      ` ${map.registers.length} registers, ${map.models.map((one) => one.name).join(", ")}`,
    ),
  )
  return [
    element("h2", { class: "welcome" }, "Choose a register"),
    element(
      "p",
      {},
      "Search takes names, ids, symbols, labels of values and bits, sections, and addresses in every notation: 4049, 0xFD1, FD1h, 44050. An address of any view, alias or word of a register finds it.",
    ),
    element("ul", { class: "maps" }, maps),
    element(
      "p",
      { class: "hint" },
      element("kbd", {}, "/"),
      " search · ",
      element("kbd", {}, "↓"),
      " ",
      element("kbd", {}, "↑"),
      " results · ",
      element("kbd", {}, "Enter"),
      " open · ",
      element("kbd", {}, "Esc"),
      " close",
    ),
  ]
}

/** Open every register of the list for print. */
function openAll() {
  const { items } = search(browser.state.query)
  const found = items.filter(({ item }) => isChosen(item, browser.state.chosen))
  browser.calculates = false
  document
    .getElementById("details")
    .replaceChildren(
      ...flat(
        (browser.open ? [browser.open] : found.map(({ item }) => ({ item, choice: choiceOf(item) }))).map((one) =>
          element("article", {}, flat(one.item ? shownItem(one) : shownMap(one.map))),
        ),
      ),
    )
  browser.calculates = true
}
