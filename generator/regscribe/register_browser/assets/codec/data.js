/**
 * The data of the page, opened: each fact in its place again.
 *
 * An entry of `map.registers` has the facts in which all its models agree, `models` where not all have it, `variants`
 * where models differ, and `elements` in an array. `registerOf` makes of it one register of one model.
 */

/** Facts of a register that are left out where they say the usual. */
const USUAL_REGISTER = {
  scale: [{}], special_scale: [{}], unit: [{}], range: [], valid: [], specials: [], sentinels: [], fields: [], views: [],
  aliases: [], default_cases: [], delivered_cases: [], follows: [], inferred: [], index: [],
  text: { encoding: "ascii", padding: 32, ends: [0] }, reading: { poll: 0, good_for: 0 },
  settle: 0, page: 0, version_digits: 0, version_group: 0, layout: "", description: "", section: "", symbol: "", group: "",
  enum: null, writable: null, when: {},
}
const USUAL_VIEW = {
  stride: 1, words: 1, factor: 1, rounding: "none", saturates: false, word_order: "big", byte_order: "big", functions: [],
  space: "holding", preferred: false, align: 1, region: null, times: null, file: null, queue: null, address: 0,
}

/**
 * The maps of a document, with shared values in their places.
 * @param {object} document  what the JSON of the page says
 * @returns {object[]} maps: id, title, manual, models [{name, ..}], registers (entries), groups, commands, ..
 */
function open(document) {
  const table = []
  const put = (value) => {
    if (Array.isArray(value)) return value.map(put)
    if (value === null || typeof value !== "object") return value
    if ("$" in value) return table[value.$]
    return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, put(each)]))
  }
  for (const value of document.shared) table.push(put(value))
  for (const [name, letters] of Object.entries(put(document.encodings))) learn(name, letters)
  return put(document.maps)
}

/** The names of the models that have an entry (register, group, command or computed value). @returns {string[]} */
const modelsOf = (map, entry) => entry.models ?? map.models.map((model) => model.name)

/** An entry as one model has it (the first that does, without a name). */
function versionOf(map, entry, model = modelsOf(map, entry)[0]) {
  const { variants, ...common } = entry
  const own = variants?.find((one) => one.models.includes(model))
  return own ? { ...common, ...own, models: entry.models ?? modelsOf(map, entry) } : common
}

/**
 * One register of one model, with the usual facts where data leave them out; of an array the element of this index.
 * @param {string} [model]  its name; else the first that has the register
 * @param {number[]} [index]  as in `elements.index`; else the first element
 */
function registerOf(map, entry, model, index) {
  const { elements, ...first } = versionOf(map, entry, model)
  const number = elements && index ? elements.index.findIndex((one) => String(one) === String(index)) : 0
  const found = number > 0 ? elementOf(first, elements, number) : first
  return { ...USUAL_REGISTER, ...found, views: (found.views ?? []).map((view) => ({ ...USUAL_VIEW, ...view })) }
}

function elementOf(first, { index, vary }, number) {
  const found = structuredClone(first)
  found.index = index[number]
  for (const [place, change] of Object.entries(vary)) {
    const keys = place.split("/")
    const last = keys.pop()
    const owner = keys.reduce((value, key) => value[key], found)
    owner[last] = changed(change, index[number], number)
  }
  return found
}

function changed(change, index, number) {
  if ("each" in change) return change.each[number]
  if ("as" in change) return change.as.replace(/\{(\d)\}/g, (_, place) => index[place])
  return change.from + change.step * number
}

/** The indices of the elements of an entry as a model has it; [[]] for one in no array. @returns {number[][]} */
const elementsOf = (map, entry, model) => versionOf(map, entry, model).elements?.index ?? [[]]

/** A register of a model by its path (`segments[3].ramp_time`); null if it has none of that name. */
function find(map, model, path) {
  const pattern = path.replace(/\[\d+\]/g, "[]")
  for (const entry of map.registers) {
    if (entry.path.replace(/\[\d+\]/g, "[]") !== pattern || !modelsOf(map, entry).includes(model)) continue
    for (const index of elementsOf(map, entry, model)) {
      const found = registerOf(map, entry, model, index)
      if (found.path === path) return found
    }
  }
  return null
}
