/**
 * What registers are filtered by, with counts: a value chosen twice in one facet means either, in two facets both.
 */

const FACETS = {
  map: "Map",
  model: "Model",
  group: "Group",
  access: "Access",
  space: "Space",
  kind: "Kind",
  unit: "Unit",
  persistence: "Kept in",
  endurance: "Endurance",
  condition: "Depends on others",
  erratum: "Errata",
}
/** Facets that only tell something where there are two values. */
const TELLING = ["map", "model", "space"]
const ACCESS_WORDS = { r: "read only", rw: "read and write", w: "write only" }
const KEPT_WORDS = { ram: "RAM", eeprom: "EEPROM", both: "RAM and EEPROM" }

const enduranceText = (version) =>
  version.endurance ? `${version.endurance.toLocaleString("en")} writes` : ""

const commonFacets = (map, entry) => ({
  map: [map.title],
  model: modelsOf(map, entry),
  erratum: entry.said?.errata ? ["about it"] : [],
})

/** The values of a register by facet. */
function facetsOf(map, entry, variants) {
  const all = (values) => [...new Set(variants.flatMap(values).filter(Boolean))]
  return {
    ...commonFacets(map, entry),
    group: all((one) => [groupName(map, one.group)]),
    access: all((one) => [ACCESS_WORDS[one.access] ?? one.access]),
    space: all((one) => (one.views ?? []).map((view) => view.space ?? "holding")),
    kind: all((one) => [one.kind]),
    unit: all((one) => (one.unit ?? []).map((each) => each.then)),
    persistence: all((one) => [KEPT_WORDS[one.persistence] ?? one.persistence]),
    endurance: all((one) => [enduranceText(one)]),
    condition: variants.some(asksOthers) ? ["by condition"] : [],
  }
}

/** Whether a fact of a register depends on another register or a given: a test, or a number taken from one. */
function asksOthers(version) {
  const { said, elements, variants, ...facts } = version
  return /"(?:tests|register|given)":/.test(JSON.stringify(facts))
}

/** Whether an item has, in each facet but `except`, one of the chosen values. */
const isChosen = (item, chosen, except = "") =>
  Object.entries(chosen).every(
    ([name, values]) => name === except || !values.length || values.some((value) => item.facets[name]?.includes(value)),
  )

/** How many items have each value of a facet. @returns {[string, number][]} the most frequent first */
function countsOf(items, name) {
  const found = new Map()
  for (const item of items) for (const value of item.facets[name] ?? []) found.set(value, (found.get(value) ?? 0) + 1)
  return [...found].sort(([a, many], [b, few]) => few - many || a.localeCompare(b))
}

/** The panel of a facet. */
function shownFacet(name, found, chosen) {
  const values = chosen[name] ?? []
  const counts = countsOf(
    found.filter((item) => isChosen(item, chosen, name)),
    name,
  )
  const kept = [
    ...counts,
    ...values.filter((value) => !counts.some(([one]) => one === value)).map((value) => [value, 0]),
  ]
  if (kept.length < 2 && !values.length && TELLING.includes(name)) return null
  if (!kept.length) return null
  return element(
    "details",
    {
      class: "facet",
      open: values.length || browser.opened.has(name),
      on: { toggle: (event) => remember(name, event.target.open) },
    },
    element("summary", {}, FACETS[name], values.length ? element("span", { class: "badge" }, values.length) : null),
    element(
      "ul",
      {},
      kept.map(([value, count]) => element("li", {}, facetChoice(name, value, count, values.includes(value)))),
    ),
  )
}

const remember = (name, open) => browser.opened[open ? "add" : "delete"](name)

function facetChoice(name, value, count, isOn) {
  const box = element("input", {
    type: "checkbox",
    "data-facet": name,
    "data-value": value,
    on: { change: () => chooseFacet(name, value, box.checked) },
  })
  box.checked = isOn
  return element(
    "label",
    {},
    box,
    element("span", { class: "value" }, value),
    element("span", { class: "number" }, count),
  )
}

/** Choose a value of a facet, or let it go. */
function chooseFacet(name, value, isOn) {
  const others = (browser.state.chosen[name] ?? []).filter((one) => one !== value)
  const chosen = { ...browser.state.chosen, [name]: isOn ? [...others, value] : others }
  go({ ...browser.state, chosen })
  document.querySelector(`[data-facet="${CSS.escape(name)}"][data-value="${CSS.escape(value)}"]`)?.focus()
}
