/**
 * The state of the page in its address: `#register-input_type`, or `#q=alarm&access=read+only&open=athena/series-c/register-..`.
 */

const ANCHOR = /^(?:register|command|condition|unit|group|program)-[a-z0-9_-]+$|^(?:about|errata)$/

/** @returns {{query: string, chosen: Object<string, string[]>, open: string, map: string, element: string}}
 *   map: the id, if it is said; element: the path of one of an array */
function readHash(hash) {
  const text = hash.replace(/^#/, "")
  if (ANCHOR.test(text)) return { query: "", chosen: {}, open: text, map: "", element: "" }
  const found = new URLSearchParams(text)
  const chosen = {}
  for (const name of Object.keys(FACETS)) if (found.has(name)) chosen[name] = found.getAll(name)
  const [, map = "", open = ""] = /^(?:(.*)\/)?([^/]*)$/.exec(found.get("open") ?? "") ?? []
  return { query: found.get("q") ?? "", chosen, open, map, element: found.get("element") ?? "" }
}

/** The hash of a state, as short as it can be. */
function writeHash({ query = "", chosen = {}, open: anchor = "", map = "", element: path = "" }) {
  const found = new URLSearchParams()
  if (query) found.set("q", query)
  for (const [name, values] of Object.entries(chosen)) for (const value of values) found.append(name, value)
  const isOnly = !map || browser.maps.length === 1
  if (path) found.set("element", path)
  if (anchor && isOnly && !String(found)) return `#${anchor}`
  if (anchor) found.set("open", isOnly ? anchor : `${map}/${anchor}`)
  return `#${found}`
}

/** The hash that opens an anchor of a map and leaves search and filters as they are. */
const hashOfAnchor = (map, anchor, path = "") =>
  writeHash({ ...browser.state, open: anchor, map: map.id, element: path })
