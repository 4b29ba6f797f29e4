/**
 * The details of a register or command, and of a map.
 */

/** All that is known of an item. */
function shownItem({ item, choice }) {
  const { map, entry, anchor } = item
  const said = entry.said ?? {}
  return [
    element("header", { class: "title", id: anchor },
      element("h2", { id: "opened", tabindex: "-1" }, item.name),
      element("div", { class: "actions" }, button("Copy link", () => copyText(location.href.split("#")[0] + writeHash({ open: anchor, map: map.id })).then(() => announce("Copied the link")), { title: "Copy a link to this register" }),
        button("Close", () => close(), { class: "close", "aria-label": "Close details", title: "Close (Esc)" }))),
    element("p", { class: "summary" }, shownRuns(said.summary, map), browser.maps.length > 1 ? [" · ", element("a", { href: hashOfAnchor(map, "about") }, map.title)] : null),
    (said.danger ?? []).map((runs) => element("p", { class: "danger" }, element("strong", {}, "Danger: "), shownRuns(runs, map))),
    (said.array ?? []).length ? element("div", { class: "array" }, said.array.map((runs) => element("p", {}, shownRuns(runs, map)))) : null,
    (said.paragraphs ?? []).map((runs) => element("p", {}, shownRuns(runs, map))),
    item.command ? null : addressTable(item, choice),
    said.facts?.length ? shownFacts(said.facts, map) : null,
    item.command ? null : drawnBits(registerOf(map, entry, choice.model, choice.index)),
    item.command || !browser.calculates ? null : shownCalculator(item, choice),
    (said.tables ?? []).map((table) => shownTable(table, map)),
    (said.remarks ?? []).map((runs) => element("p", { class: "remark" }, shownRuns(runs, map))),
    (said.examples ?? []).map((table) => shownTable(table, map)),
    (said.errata ?? []).map((table) => [element("h3", {}, "Errata of its section, or that name it"), shownTable(table, map)]),
    sourceLine(map),
  ]
}

/** Which manual it was transcribed from. */
function sourceLine(map) {
  const { title, number, date, publisher } = map.manual ?? {}
  const parts = [title, number, date, publisher].filter(Boolean)
  return element("p", { class: "source" }, `Transcribed from ${parts.join(", ")}. Map ${map.id}, sha256 ${map.content_hash.slice(0, 16)}.`)
}

/** The addresses of every view in every notation; of an array those of the chosen element. */
function addressTable(item, choice) {
  const { map, entry } = item
  const box = element("div", { class: "addresses" })
  const again = () => {
    const register = registerOf(map, entry, choice.model, choice.addressIndex)
    const places = register.views.flatMap((view, place) => [[view, view.address, view.name],
      ...(place ? [] : register.aliases.map((alias) => [view, alias, "also at"]))])
    const columns = addressColumns(map, places)
    const heads = ["View", ...columns.map((one) => one.heads.join(", "))].map((text) => element("th", { scope: "col" }, text))
    const rows = places.map(([view, , name], row) => addressRow(view, name, columns.map((one) => one.cells[row])))
    box.replaceChildren(...[addressElement(item, choice, again),
      element("div", { class: "scrolls", tabindex: "0", role: "region", "aria-label": "Addresses" },
        element("table", {}, element("thead", {}, element("tr", {}, heads)), element("tbody", {}, rows)))].filter(Boolean))
  }
  again()
  return box
}

function addressElement({ map, entry }, choice, again) {
  const indices = elementsOf(map, entry, choice.model ?? modelsOf(map, entry)[0])
  if (indices.length < 2) return null
  return labelled("Addresses of element", picker(indices.map((one) => [String(one), one.join(", ")]), String(choice.addressIndex ?? indices[0]),
    (text) => { choice.addressIndex = text.split(",").map(Number); again(); document.querySelector("[data-choice=address]")?.focus() }, { "data-choice": "address" }))
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
    element("header", { class: "title" }, element("h2", { id: "opened", tabindex: "-1" }, map.title),
      element("div", { class: "actions" }, button("Close", () => close(), { class: "close", "aria-label": "Close details", title: "Close (Esc)" }))),
    paragraphs.map((runs) => element("p", {}, shownRuns(runs, map))),
    tables.map((table) => shownTable(table, map)),
    programs.map((one) => [element("h3", { id: one.anchor }, one.name), shownFacts(one.facts ?? [], map), (one.tables ?? []).map((table) => shownTable(table, map))]),
    sourceLine(map),
  ]
}
