/**
 * The details of a register or command, and of a map.
 */

/** All that is known of an item. */
function shownItem({ item, choice }) {
  const { map, entry, anchor } = item
  const said = entry.said ?? {}
  return [
    shownTitle(item.name, anchor, [button("Copy link", () => copyLink(map, anchor), { title: "Copy a link to this register" })]),
    element("p", { class: "summary" }, shownRuns(said.summary, map), browser.maps.length > 1 ? [" · ", element("a", { href: hashOfAnchor(map, "about") }, map.title)] : null),
    (said.danger ?? []).map((runs) => element("p", { class: "danger" }, element("strong", {}, "Danger: "), shownRuns(runs, map))),
    (said.array ?? []).length ? element("div", { class: "array" }, said.array.map((runs) => element("p", {}, shownRuns(runs, map)))) : null,
    (said.paragraphs ?? []).map((runs) => element("p", {}, shownRuns(runs, map))),
    item.command ? shownFacts(said.facts ?? [], map) : shownRegister(item, choice, registerOf(map, entry, choice.model, choice.index)),
    (said.tables ?? []).map((table) => shownTable(table, map)),
    (said.remarks ?? []).map((runs) => element("p", { class: "remark" }, shownRuns(runs, map))),
    (said.examples ?? []).map((table) => shownTable(table, map)),
    (said.errata ?? []).map((table) => [element("h3", {}, "Errata of its section, or that name it"), shownTable(table, map)]),
    sourceLine(map),
  ]
}

/** Facts, addresses, bits and calculator of one register of one model. */
function shownRegister(item, choice, register) {
  const { map, entry } = item
  const isTold = entry.elements || entry.block  // the table of addresses tells no formula and no block
  const facts = (entry.said?.facts ?? []).filter(([label]) => isTold || plainText(label) !== "Wire address")
  return [
    shownChoices(item, choice), addressTable(map, register), shownFacts(facts, map), drawnBits(register),
    browser.calculates ? shownCalculator(item, choice) : null,
  ]
}

function shownTitle(name, anchor, actions = []) {
  return element("header", { class: "title", id: anchor }, element("h2", { id: "opened", tabindex: "-1" }, name),
    element("div", { class: "actions" }, actions, button("Close", () => close(), { title: "Close (Esc)" })))
}

async function copyLink(map, anchor) {
  await copyText(location.href.split("#")[0] + writeHash({ open: anchor, map: map.id }))
  announce("Copied the link")
}

/** Which manual it was transcribed from. */
function sourceLine(map) {
  const { title, number, date, publisher } = map.manual ?? {}
  const parts = [title, number, date, publisher].filter(Boolean)
  return element("p", { class: "source" }, `Transcribed from ${parts.join(", ")}. Map ${map.id}, sha256 ${map.content_hash.slice(0, 16)}.`)
}

/** Which model, and which element of an array, is shown. */
function shownChoices({ map, entry }, choice) {
  const models = modelsOf(map, entry)
  const indices = elementsOf(map, entry, choice.model)
  const tell = (change, name) => {
    Object.assign(choice, change, { words: null, text: null })
    showOpened()
    document.querySelector(`[data-choice="${name}"]`)?.focus()
  }
  const pickers = [
    models.length > 1 && (entry.variants || entry.elements)
      ? labelled("Model", picker(models.map((one) => [one, one]), choice.model, (model) => tell({ model }, "model"), { "data-choice": "model" })) : null,
    indices.length > 1
      ? labelled("Element", picker(indices.map((one) => [String(one), one.join(", ")]), String(choice.index ?? indices[0]),
        (text) => tell({ index: text.split(",").map(Number) }, "element"), { "data-choice": "element" })) : null,
  ].filter(Boolean)
  return pickers.length ? element("div", { class: "choices" }, pickers) : null
}

/** The addresses of every view in every notation. */
function addressTable(map, register) {
  const places = register.views.flatMap((view, place) => [[view, view.address, view.name],
    ...(place ? [] : register.aliases.map((alias) => [view, alias, "also at"]))])
  const columns = addressColumns(map, places)
  const heads = ["View", ...columns.map((one) => one.heads.join(", "))].map((text) => element("th", { scope: "col" }, text))
  const rows = places.map(([view, , name], row) => addressRow(view, name, columns.map((one) => one.cells[row])))
  return element("div", { class: "scrolls addresses", tabindex: "0", role: "region", "aria-label": "Addresses" },
    element("table", {}, element("thead", {}, element("tr", {}, heads)), element("tbody", {}, rows)))
}

/** The numbers of addresses by notation; notations that agree in all share a column. */
function addressColumns(map, places) {
  const notations = map.notations ?? []
  const all = [
    ["Wire", (_, address) => String(address)], ["Hex", (_, address) => hexadecimalAddress(address)], ["Modicon", modiconNumber],
    ...[...new Set(notations.map((one) => one.name))].map((name) => [name, (space, address) => Object.fromEntries(printedAddresses(notations, space, address))[name] ?? ""]),
  ]
  const columns = []
  for (const [head, numberOf] of all) {
    const cells = places.map(([view, address]) => numberOf(view.space, address))
    const like = columns.find((one) => String(one.cells) === String(cells))
    if (like) like.heads.push(head)
    else if (cells.some(Boolean)) columns.push({ heads: [head], cells })
  }
  return columns
}

function addressRow(view, name, numbers) {
  const label = view.space === "holding" ? name : `${name} (${view.space})`
  return element("tr", {}, element("th", { scope: "row" }, label, view.preferred ? element("span", { class: "preferred" }, " preferred") : null),
    numbers.map((text) => element("td", {}, text ? [element("code", {}, text), copyButton(text)] : "")))
}

/** What holds for a map as a whole. */
function shownMap(map) {
  const { paragraphs = [], tables = [], programs = [] } = map.about ?? {}
  return [
    shownTitle(map.title, "about"),
    paragraphs.map((runs) => element("p", {}, shownRuns(runs, map))),
    tables.map((table) => shownTable(table, map)),
    programs.map((one) => [element("h3", { id: one.anchor }, one.name), shownFacts(one.facts ?? [], map), (one.tables ?? []).map((table) => shownTable(table, map))]),
    sourceLine(map),
  ]
}
