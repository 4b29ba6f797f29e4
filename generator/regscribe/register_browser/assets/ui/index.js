/**
 * What is searched: every register and command of all maps once, with its names and with all addresses of all its views.
 *
 * @typedef {object} Item
 * @property {object} map
 * @property {object} entry  a register or command as the data have it
 * @property {string} anchor
 * @property {string} name
 * @property {string} path  with letters for indices
 * @property {{kind: string, text: string, words: string[], models: string[]}[]} texts  what search looks at, in lower case
 * @property {Place[]} places
 * @property {Object<string, string[]>} facets  values by facet
 *
 * @typedef {object} Place  one address of one view of one element
 * @property {string} view
 * @property {string} space
 * @property {number} address  of its first word
 * @property {number[]} offsets  of its words
 * @property {string} path  of the element
 * @property {boolean} alias
 * @property {string[]} models  that have it
 */

const LETTERS = "ijkmn"

/** A path with letters for its indices: `segments[i].ramp_time`. */
const letteredPath = (path) => {
  let place = 0
  return path.replace(/\[-?\d+\]/g, () => `[${LETTERS[place++] ?? "n"}]`)
}

/** The words of a text, in lower case. */
const wordsOf = (text) =>
  text
    .toLowerCase()
    .split(/[^\p{L}\p{N}.%°]+/u)
    .filter(Boolean)

/** @returns {Item[]} */
function indexOf(maps) {
  return maps.flatMap((map) => [
    ...map.registers.map((entry) => registerItem(map, entry)),
    ...(map.commands ?? []).map((entry) => commandItem(map, entry)),
  ])
}

/** The versions of an entry that differ. */
const variantsOf = (map, entry) =>
  (entry.variants ?? [{ models: modelsOf(map, entry) }]).map((one) => ({
    ...versionOf(map, entry, one.models[0]),
    models: one.models,
  }))

function registerItem(map, entry) {
  const variants = variantsOf(map, entry)
  const first = variants[0]
  return {
    map,
    entry,
    anchor: entry.anchor,
    name: nameOf(first),
    path: letteredPath(entry.path),
    texts: searchedTexts(map, variants),
    places: variants.flatMap(placesOf),
    facets: facetsOf(map, entry, variants),
  }
}

function commandItem(map, entry) {
  const variants = variantsOf(map, entry)
  const texts = variants.flatMap((one) => [
    ["name", one.name],
    ["id", entry.id],
    ["section", one.section],
    ["description", one.description],
  ])
  const models = modelsOf(map, entry)
  return {
    map,
    entry,
    anchor: entry.anchor,
    name: variants[0].name,
    path: `commands.${entry.id}`,
    command: true,
    texts: preparedTexts(texts, models),
    places: variants.flatMap((one) =>
      (one.steps ?? []).map((step) => ({
        view: "",
        space: step.space ?? "holding",
        address: step.address,
        offsets: [...(step.words ?? [0])].map((_, place) => place),
        path: entry.id,
        alias: false,
        models: one.models,
      })),
    ),
    facets: { ...commonFacets(map, entry), kind: ["command"] },
  }
}

/** The name of a register; of one in an array that of all elements: `Ramp Time 1 … 8`. */
function nameOf(version) {
  const { name, elements } = version
  const change = elements?.vary.name
  if (!change) return name
  const count = elements.index.length
  const last = changed(change, elements.index[count - 1], count - 1).split(" ")
  const words = name.split(" ")
  const same = last.findIndex((word, place) => word !== words[place])
  return `${name} … ${last.slice(Math.max(same, 0)).join(" ")}`
}

const groupName = (map, id) => map.groups?.find((one) => one.id === id)?.name ?? id ?? ""

function searchedTexts(map, variants) {
  const textsOf = (one) => [
    ["name", one.name],
    ["id", one.path],
    ["symbol", one.symbol],
    ["symbol", one.printed],
    ["section", one.section],
    ["group", groupName(map, one.group)],
    ...(one.views ?? []).map((view) => ["space", view.space ?? "holding"]),
    ["kept in", KEPT_WORDS[one.persistence] ?? one.persistence],
    ["endurance", enduranceText(one)],
    ["endurance", one.endurance && `endurance ${one.endurance}`],
    ["description", one.description],
    ...membersOf(one).flatMap((member) => [
      ["value", member.label],
      ["value", member.id],
    ]),
    ...(one.fields ?? []).flatMap((field) => [
      ["bit", field.label],
      ["bit", field.id],
    ]),
    ...(one.specials ?? []).map((special) => ["value", special.label]),
    ...(one.sentinels ?? []).map((sentinel) => ["value", sentinel.label]),
  ]
  return preparedTexts([
    ...variants.flatMap((one) => textsOf(one).map(([kind, text]) => [kind, text, one.models])),
    ...erratumTexts(variants[0].said?.errata),
  ], variants.flatMap((one) => one.models))
}

/** What errata say, each as one text. */
const erratumTexts = (tables = []) =>
  tables.flatMap(({ rows }) => rows.map((cells) => ["erratum", cells.map(plainText).join("; ")]))

/** The members of all enums of a version: those of its cases, and of its fields. */
function membersOf(version) {
  const enums = [version.enum, ...(version.fields ?? []).map((field) => field.enum)].filter(Boolean)
  return enums.flatMap((one) => [
    ...(one.members ?? []),
    ...(one.cases ?? []).flatMap((each) => each.then?.members ?? []),
  ])
}

/** Texts of a kind, each once, with the models that have them: `every` where none are said. */
function preparedTexts(texts, every) {
  const found = new Map()
  for (const [kind, text, models = every] of texts) {
    if (!text) continue
    const known = found.get(`${kind} ${text}`)
    if (known) known.models = [...known.models, ...models]
    else found.set(`${kind} ${text}`, { kind, text, lower: text.toLowerCase(), words: wordsOf(text), models })
  }
  return [...found.values()]
}

/** Every address of a version: of each element, each view, and each further address of the first view. */
function placesOf(version) {
  const { elements, views = [], aliases = [], path } = version
  const found = []
  const count = elements?.index.length ?? 1
  for (let number = 0; number < count; number += 1) {
    const now = (place, usual) =>
      elements?.vary[place] ? changed(elements.vary[place], elements.index[number], number) : usual
    const element = now("path", path)
    views.forEach((view, place) =>
      found.push(placeOf(view, now(`views/${place}/address`, view.address), element, false)),
    )
    aliases.forEach((alias, place) => found.push(placeOf(views[0], now(`aliases/${place}`, alias), element, true)))
  }
  return found.map((one) => ({ ...one, models: version.models }))
}

function placeOf(view, address, path, alias) {
  const offsets = view.offsets?.length ? view.offsets : [...Array(view.words ?? 1).keys()]
  return { view: view.name, space: view.space ?? "holding", address, offsets, path, alias }
}
