/**
 * Lets the functions of a register browser answer: words are decoded, texts encoded.
 *
 * A job is about registers of a map: `places` are pairs of a model and a path. Its `cases` have a `view`, what is known
 * (`state` and `givens`, or `held`: the words that all registers hold, by path), `decode` (lists of words) and `encode`
 * (pairs of a text, and whether it may be rounded). Of registers that are the same to the codec the first one answers.
 */
(codec, maps, jobs) => {
  "use strict"
  const shown = (value) => (value === undefined ? null : typeof value === "string" ? value : codec.show(value))

  /** Values of use of all registers, worked out as they are asked for. */
  class Held {
    constructor(map, model, words, known) {
      Object.assign(this, { map, model, words, seen: new Map() })
      const texts = { has: (path) => this.text(path) !== null, get: (path) => this.text(path) }
      this.known = { ...known, values: this, texts }
      this.given = known.texts
    }
    reading(path) {
      if (this.seen.has(path)) return this.seen.get(path)
      this.seen.set(path, {})
      this.seen.set(path, this.read(path))
      return this.seen.get(path)
    }
    read(path) {
      const register = codec.find(this.map, this.model, path)
      if (register === null) return this.part(path)
      if (codec.present(register, this.known) !== true) return {}
      const view = register.views.find((one) => one.preferred) ?? register.views[0]
      const { value } = codec.decode(register, view, this.words[path], this.known)
      if (typeof value !== "string") return { number: value }
      return register.kind === "version" ? { number: codec.parse(value.replaceAll(".", "")), text: value } : { text: value }
    }
    part(path) {
      const [owner, name] = path.split(/\.([^.]*)$/)
      const register = codec.find(this.map, this.model, owner)
      const { number } = this.reading(owner)
      const field = register?.fields.find((one) => one.id === name)
      if (!field || !number) return {}
      const bits = (number.n >> BigInt(field.low ?? 0)) & ((1n << BigInt((field.high ?? 0) - (field.low ?? 0) + 1)) - 1n)
      return { number: codec.parse(String(bits)) }
    }
    has(path) {
      return Boolean(this.reading(path).number)
    }
    get(path) {
      return this.reading(path).number
    }
    text(path) {
      return path.startsWith("given.") ? (this.given.get(path) ?? null) : (this.reading(path).text ?? null)
    }
  }

  const knownOf = (map, model, { state, givens, held }) => {
    const known = codec.surroundings(state ?? {}, givens ?? {}, map, model)
    return held ? new Held(map, model, held, known).known : known
  }

  const answer = (register, known, { view, decode = [], encode = [] }) => {
    const way = register.views.find((one) => one.name === view)
    return {
      present: codec.present(register, known),
      writable: codec.writable(register, known),
      decode: decode.map((words) => {
        const reading = codec.decode(register, way, words, known)
        const { member, fields } = codec.describe(register, reading, known)
        const parts = fields?.map((one) => [one.field.id, one.fault?.id ?? one.text, one.exists && one.valid, one.set])
        return { ...reading, value: shown(reading.value), member: member?.id, fields: parts }
      }),
      encode: encode.map(([text, rounded]) => codec.encode(register, way, text, known, { rounded })),
    }
  }

  const seen = ({ id, path, name, said, anchor, index, models, description, section, symbol, aliases, views, ...rest }) =>
    JSON.stringify([rest, views.map(({ address, ...view }) => view)])

  return jobs.map(({ map: id, places, cases }) => {
    const map = maps.find((one) => one.id === id)
    const found = new Map()
    for (const [model, path] of places) {
      const register = codec.find(map, model, path)
      if (!found.has(seen(register))) found.set(seen(register), [model, path, register])
    }
    return [...found.values()].map(([model, path, register]) => ({
      place: [model, path],
      cases: cases.map((each) => answer(register, knownOf(map, model, each), each)),
    }))
  })
}
