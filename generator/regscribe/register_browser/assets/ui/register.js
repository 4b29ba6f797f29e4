/**
 * The details of a register or command, and of a map.
 */

/** All that is known of an item. */
function shownItem({ item, choice }) {
  const { map, entry, anchor } = item
  const said = entry.said ?? {}
  return [
    shownTitle(item.name, anchor, [
      button("Copy link", () => copyLink(map, anchor), { title: "Copy a link to this register" }),
    ]),
    element(
      "p",
      { class: "summary" },
      shownRuns(said.summary, map),
      browser.maps.length > 1 ? [" · ", element("a", { href: hashOfAnchor(map, "about") }, map.title)] : null,
    ),
    (said.danger ?? []).map((runs) =>
      element("p", { class: "danger" }, element("strong", {}, "Danger: "), shownRuns(runs, map)),
    ),
    (said.array ?? []).length
      ? element(
          "div",
          { class: "array" },
          said.array.map((runs) => element("p", {}, shownRuns(runs, map))),
        )
      : null,
    (said.paragraphs ?? []).map((runs) => element("p", {}, shownRuns(runs, map))),
    item.command
      ? shownFacts(said.facts ?? [], map)
      : shownRegister(item, choice, registerOf(map, entry, choice.model, choice.index)),
    (said.tables ?? []).filter((table) => !isInAddresses(table)).map((table) => shownTable(table, map)),
    (said.remarks ?? []).map((runs) => element("p", { class: "remark" }, shownRuns(runs, map))),
    (said.examples ?? []).map((table) => shownTable(table, map)),
    shownErrata("Errata about it", said.errata, map),
    shownErrata("Errata of its section, which need not concern it", errataOfSection(item), map),
    sourceLine(map),
  ]
}

/** The tables of errata under a heading that counts them. */
const shownErrata = (heading, tables, map, attributes = {}) =>
  (tables ?? []).map((table) => [
    element("h3", attributes, `${heading} (${table.rows.length})`),
    shownTable(table, map),
  ])

/** The table of the map's errata, with the rows of an item's section alone. */
const errataOfSection = ({ map, entry }) => {
  const places = entry.said?.section_errata ?? []
  return places.length ? map.about.errata.map((table) => ({ ...table, rows: places.map((place) => table.rows[place]) })) : []
}

/** Whether a table of the reference says nothing but what the table of addresses says. */
const isInAddresses = ({ title, headers }) =>
  /^Views\b/.test(plainText(title)) && !headers.some((head) => plainText(head) === "Transmitted")

/** Facts, addresses, bits and calculator of one register of one model. */
function shownRegister(item, choice, register) {
  const { map, entry } = item
  const isTold = entry.elements || entry.block // the table of addresses tells no formula and no block
  const { group = [] } = entry.said ?? {}
  const lines = group.flatMap((runs, place) => (place > 1 ? ["\n", ...runs] : place ? [" · ", ...runs] : runs))
  const facts = [...(entry.said?.facts ?? []), ...(lines.length ? [[["Group"], lines]] : [])].filter(
    ([label]) => isTold || plainText(label) !== "Wire address",
  )
  return [
    shownChoices(item, choice),
    addressTable(map, register),
    shownFacts(facts, map),
    drawnBits(register),
    browser.calculates ? shownCalculator(item, choice) : null,
  ]
}

function shownTitle(name, anchor, actions = []) {
  return element(
    "header",
    { class: "title", id: anchor },
    element("h2", { id: "opened", tabindex: "-1" }, name),
    element(
      "div",
      { class: "actions" },
      actions,
      button("Close", () => close(), { title: "Close (Esc)" }),
    ),
  )
}

async function copyLink(map, anchor) {
  await copyText(location.href.split("#")[0] + writeHash({ open: anchor, map: map.id }))
  announce("Copied the link")
}

/** Which manual it was transcribed from. */
function sourceLine(map) {
  const { title, number, date, publisher } = map.manual ?? {}
  const parts = [title, number, date, publisher].filter(Boolean)
  return element(
    "p",
    { class: "source" },
    `Transcribed from ${parts.join(", ").replace(/\.$/, "")}. Map ${map.id}, sha256 ${map.content_hash.slice(0, 16)}.`,
  )
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
  const lacks = (name) =>
    !models.includes(name) ? ": does not have it" : choice.having.includes(name) ? "" : ": not what was searched"
  const pickers = [
    map.models.length > 1 && (entry.variants || entry.elements || entry.models)
      ? labelled(
          "Model",
          picker(
            map.models.map(({ name }) => [name, `${name}${lacks(name)}`, !models.includes(name)]),
            choice.model,
            (model) => tell({ model }, "model"),
            { "data-choice": "model" },
          ),
        )
      : null,
    indices.length > 1
      ? labelled(
          "Element",
          picker(
            indices.map((one) => [String(one), one.join(", ")]),
            String(choice.index ?? indices[0]),
            (text) => tell({ index: text.split(",").map(Number) }, "element"),
            { "data-choice": "element" },
          ),
        )
      : null,
  ].filter(Boolean)
  return pickers.length ? element("div", { class: "choices" }, pickers) : null
}

/** What holds for a map as a whole. */
function shownMap(map) {
  const { paragraphs = [], tables = [], errata = [], programs = [] } = map.about ?? {}
  return [
    shownTitle(map.title, "about"),
    paragraphs.map((runs) => element("p", {}, shownRuns(runs, map))),
    tables.map((table) => shownTable(table, map)),
    shownErrata("Errata", errata, map, { id: "errata", tabindex: "-1", class: "target" }),
    programs.map((one) => [
      element("h3", { id: one.anchor }, one.name),
      shownFacts(one.facts ?? [], map),
      (one.tables ?? []).map((table) => shownTable(table, map)),
    ]),
    sourceLine(map),
  ]
}
