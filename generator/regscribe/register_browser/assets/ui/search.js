/**
 * Search: each word of a query must be found; a word may be an address in any notation.
 */

const WEIGHTS = { name: 60, id: 55, symbol: 65, section: 40, group: 15, value: 25, bit: 25, space: 8, "kept in": 8, endurance: 8, description: 5, erratum: 4 }
const WHOLE = 30
const EXACT_ADDRESS = 200
const LESS_PLAIN = 5
const FEWEST_DIGITS = 2

/** Where every address stands. @returns {Map<number, {item: Item, place: Place, word: number}[]>} */
function addressBook(items) {
  const found = new Map()
  for (const item of items) {
    for (const place of item.places) {
      place.offsets.forEach((offset, word) => {
        const address = place.address + offset
        if (!found.has(address)) found.set(address, [])
        found.get(address).push({ item, place, word })
      })
    }
  }
  return found
}

/**
 * @returns {{items: {item: Item, rank: number, why: string[], path?: string, models?: string[]}[], readings: {text: string, count: number}[]}}
 *   the best first, with the path of the element that was meant, and the models that have what was found; readings are the meanings of what looks like an address, with the registers that each has
 */
function search(query) {
  if (browser.searched?.query !== query) browser.searched = { query, ...searched(query) }
  return browser.searched
}

function searched(query) {
  const tokens = query.toLowerCase().split(/\s+/).filter(Boolean)
  const readings = []
  let found = browser.items.map((item) => ({ item, rank: 0, why: [] }))
  for (const token of tokens) {
    const places = addressHits(token, readings)
    found = found.map((hit) => joined(hit, places.get(hit.item) ?? textHit(hit.item, token))).filter(Boolean)
  }
  if (tokens.length > 1)
    for (const hit of found) if (hit.item.name.toLowerCase().startsWith(query.toLowerCase().trim())) hit.rank += WHOLE
  if (tokens.length) found.sort((a, b) => b.rank - a.rank)
  return { items: found, readings }
}

const joined = (hit, more) =>
  more && {
    item: hit.item,
    rank: hit.rank + more.rank,
    why: [...hit.why, ...more.why],
    path: more.path ?? hit.path,
    models: hit.models?.filter((one) => !more.models || more.models.includes(one)) ?? more.models,
  }

/** The items at the addresses that a token can mean; `readings` gets each meaning. */
function addressHits(token, readings) {
  const found = new Map()
  for (const [place, reading] of meaningsOf(token).entries()) {
    const hits = (browser.book.get(reading.address) ?? []).filter((hit) => fits(hit, reading))
    readings.push({ text: readingText(reading), count: new Set(hits.map((hit) => hit.item)).size })
    for (const hit of hits) {
      const known = found.get(hit.item) ?? {
        rank: EXACT_ADDRESS - hit.word - LESS_PLAIN * place,
        why: [],
        models: [],
        path: hit.item.entry.elements ? hit.place.path : undefined,
      }
      const why = placeText(hit)
      if (!known.why.includes(why)) known.why.push(why)
      known.models.push(...hit.place.models)
      found.set(hit.item, known)
    }
  }
  return found
}

const fits = ({ item, place }, { space, map }) => (!space || place.space === space) && (!map || item.map === map)

/** All meanings: those of every manual, and those that only the notation of one map gives. */
function meaningsOf(token) {
  const found = addressReadings(token)
  const isKnown = (one) =>
    found.some((other) => other.address === one.address && (!other.space || other.space === one.space) && !other.map)
  for (const map of browser.maps) {
    found.push(
      ...notationReadings(token, map.notations ?? [])
        .filter((one) => !isKnown(one))
        .map((one) => ({ ...one, map })),
    )
  }
  return merged(found).filter((one) => isCommon(one) || isSomewhere(one))
}

const isCommon = ({ notation }) => ["decimal", "hexadecimal", "Modicon"].includes(notation)

const isSomewhere = (reading) => (browser.book.get(reading.address) ?? []).some((hit) => fits(hit, reading))

/** A meaning that all maps with such a notation share, once. */
function merged(readings) {
  const found = []
  for (const one of readings) {
    const like = found.find(
      (other) => other.address === one.address && other.space === one.space && other.notation === one.notation,
    )
    if (like) delete like.map
    else found.push({ ...one })
  }
  return found
}

const readingText = ({ address, space, notation }) =>
  `${space ?? "wire"} ${address}${notation === "decimal" ? "" : notation === "hexadecimal" ? ` (${hexadecimalAddress(address)})` : ` (${notation})`}`

/** `x10 at 1049`, `word 2 of 2 of ieee at 8005`. */
function placeText({ item, place, word }) {
  const { view, address, offsets, path, alias } = place
  const part = offsets.length > 1 ? `word ${word + 1} of ${offsets.length} of ` : ""
  const element = /\[-?\d+\]/.test(path) ? `${path}, ` : ""
  if (item.command) return `writes ${address + offsets[word]}`
  return `${element}${part}${alias ? "alias" : view === "base" ? "base view" : `${view} view`} at ${address + offsets[word]}`
}

/** How well a token fits the texts of an item; null if not at all. */
function textHit(item, token) {
  let best = null
  for (const text of item.texts) {
    const rank = textRank(text, token)
    if (rank && rank === best?.rank) best.models = [...best.models, ...text.models]
    if (rank && (!best || rank > best.rank))
      best = {
        rank,
        why: text.kind === "name" || text.kind === "id" ? [] : [`${text.kind}: ${text.text}`],
        models: text.models,
      }
  }
  if (!best && item.map.title.toLowerCase().includes(token)) return { rank: 1, why: [] }
  return best ?? startHit(item, token)
}

function textRank({ kind, lower, words }, token) {
  const weight = WEIGHTS[kind]
  if (lower === token) return weight + WHOLE
  if (kind === "section") return lower.startsWith(`${token}.`) ? weight : 0
  if (lower.startsWith(token)) return weight + WHOLE / 2
  if (words.some((word) => word.startsWith(token))) return weight
  return (kind === "name" || kind === "id") && lower.includes(token) ? weight / 2 : 0
}

/** How many errata of a map have all words of a query. */
function errataWith(map, query) {
  const tokens = query.toLowerCase().split(/\s+/).filter(Boolean)
  const texts = preparedTexts(erratumTexts(map.about?.errata), [])
  return tokens.length ? texts.filter((text) => tokens.every((token) => textRank(text, token))).length : 0
}

/** An address of which the token is the beginning. */
function startHit(item, token) {
  if (token.length < FEWEST_DIGITS || !/^\d+$/.test(token)) return null
  const place = item.places.find((one) => String(one.address).startsWith(token))
  return place ? { rank: 2, why: [placeText({ item, place, word: 0 })] } : null
}
