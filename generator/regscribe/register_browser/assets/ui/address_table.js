/** Addresses in every notation, to copy. */

/** The addresses of every view in every notation. */
function addressTable(map, register) {
  const places = register.views.flatMap((view, place) => [
    [view, view.address, view.name],
    ...(place ? [] : register.aliases.map((alias) => [view, alias, "also at"])),
  ])
  const columns = addressColumns(map, places)
  const heads = ["View", ...columns.map((one) => one.heads.join(", ")), "Type"].map((text) =>
    element("th", { scope: "col" }, text),
  )
  const rows = places.map(([view, , name], row) =>
    addressRow(
      view,
      name,
      columns.map((one) => one.cells[row]),
    ),
  )
  return element(
    "div",
    { class: "scrolls addresses", tabindex: "0", role: "region", "aria-label": "Addresses" },
    element("table", {}, element("thead", {}, element("tr", {}, heads)), element("tbody", {}, rows)),
  )
}

/** The numbers of addresses by notation; notations that agree in all share a column. */
function addressColumns(map, places) {
  const notations = map.notations ?? []
  const all = [
    ["Wire", (_, address) => String(address)],
    ["Hex", (_, address) => hexadecimalAddress(address)],
    ["Modicon", modiconNumber],
    ...[...new Set(notations.map((one) => one.name))].map((name) => [
      name,
      (space, address) => Object.fromEntries(printedAddresses(notations, space, address))[name] ?? "",
    ]),
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
  return element(
    "tr",
    {},
    element(
      "th",
      { scope: "row" },
      label,
      view.preferred ? element("span", { class: "preferred" }, " preferred") : null,
    ),
    numbers.map((text) => element("td", {}, text ? [element("code", {}, text), copyButton(text)] : "")),
    element("td", {}, view.words > 1 ? `${view.type}, ${view.words} words` : view.type),
  )
}
