/**
 * What words mean, step by step as the map language defines it.
 *
 * @typedef {object} Reading
 * @property {"value"|"unknown_member"|"saturated"|"fault"|"out_of_range"|"not_decodable"|"unknown"} meaning
 * @property {Rational|string} [value]  a number (an enum's code, the bits of a word), or a text
 * @property {string} [fault]  the id of the sentinel
 * @property {string} [subject]  with `unknown`: the register, `register.field` or given that must be known
 */

/**
 * What `words`, read from a view, mean. Throws nothing.
 * @param {object} register  made by `registerOf`
 * @param {object} view  one of `register.views`
 * @param {number[]} words  as they stand on the wire
 * @param {object} known  made by `surroundings`
 * @returns {Reading}
 */
function decode(register, view, words, known) { return { meaning: "not_decodable" } }

/** Whether a register exists as things stand. @returns {true|false|{subject: string}} or what must be known to tell */
function present(register, known) { return true }

/**
 * A reading in the words of people.
 * @returns {{text: string, unit: string, member?: object, special?: object, fault?: object,
 *   fields?: {field: object, text: string, set: boolean, member?: object, fault?: object}[]}}
 *   `text` is the value alone; `unit` the one that holds now; members, specials, sentinels and fields as data have them
 */
function describe(register, reading, known) { return { text: reading.meaning, unit: "" } }
