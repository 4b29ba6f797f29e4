/**
 * The words that transmit a value. Throws nothing.
 * @param {string} text  a number, a text; of an enum also a member's id or label, of a number also a special value's
 * @param {{rounded?: boolean}} [how]  rounded: as the device rounds, where the value lies between two wire numbers
 * @returns {{words: number[]}|{refused: string, why: string, subject?: string}}  `refused` is the class of cause: range,
 *   resolution, member, bits, sentinel, type, condition, read_only, unknown (then `subject` must be known); `why` says it
 */
function encode(register, view, text, known, how = {}) { return { refused: "type", why: "not yet" } }
