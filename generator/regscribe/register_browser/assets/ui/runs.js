/**
 * Runs of text, as the data have what the reference says: a text, or `{text, code, strong, to, id}`.
 */

/** The nodes that show runs; links lead to their anchors in `map`. */
const shownRuns = (runs, map) => (runs ?? []).map((run) => shownRun(run, map))

function shownRun(run, map) {
  if (typeof run === "string") return run.split("\n").flatMap((line, place) => (place ? [element("br"), line] : [line]))
  if (run.id) return element("span", { id: run.id, tabindex: "-1", class: "target" })
  const inner = run.code ? element("code", {}, run.text) : run.strong ? element("strong", {}, run.text) : run.text
  return run.to ? element("a", { href: hashOfAnchor(map, run.to) }, inner) : inner
}

/** A table that is as wide as it needs, in a frame that scrolls. */
function shownTable(table, map) {
  const heads = table.headers.map((head) => element("th", { scope: "col" }, shownRuns(head, map)))
  const rows = table.rows.map((row) =>
    element(
      "tr",
      {},
      row.map((cell) => element("td", {}, shownRuns(cell, map))),
    ),
  )
  const body = [element("thead", {}, element("tr", {}, heads)), element("tbody", {}, rows)]
  const title = plainText(table.title)
  return element(
    "section",
    { class: "table" },
    title ? element("h3", {}, shownRuns(table.title, map)) : null,
    element(
      "div",
      { class: "scrolls", tabindex: "0", role: "region", "aria-label": visibleText(title || "Table") },
      element("table", {}, body),
    ),
  )
}

/** Pairs of label and value. */
const shownFacts = (rows, map) =>
  element(
    "dl",
    {},
    rows.map(([label, value]) => [element("dt", {}, shownRuns(label, map)), element("dd", {}, shownRuns(value, map))]),
  )

/** The text of runs alone. */
const plainText = (runs) => (runs ?? []).map((run) => (typeof run === "string" ? run : (run.text ?? ""))).join("")
