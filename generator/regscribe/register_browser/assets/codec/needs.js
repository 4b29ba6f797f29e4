/**
 * What decides what a register means, or which values it takes.
 * @returns {{read: string[], write: string[], givens: string[]}}  paths of registers (what `write` names besides `read`
 *   limits its values), and the ids of givens
 */
function needs(register, view) { return { read: [], write: [], givens: [] } }

/**
 * The requests of a register's view, as bytes of an RTU frame with its CRC.
 * @param {number[]|null} words  what is written; null to read
 * @returns {{frame: number[], function: number}|{refused: string}}
 */
function frame(map, register, view, unit, words = null) { return { refused: "not yet" } }
