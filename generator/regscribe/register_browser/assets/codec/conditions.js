/**
 * What is known besides the words: values of use of registers by path (or `register.field`), and what is given.
 * @param {Object<string, string|Rational>} values  decimal texts or numbers
 * @param {Object<string, string|boolean|string[]>} givens  by id: a number or a choice as text, yes or no, or codes
 * @param {object[]} [stated]  the map's `givens`, whose defaults count where none is given
 */
function surroundings(values = {}, givens = {}, stated = []) { return {} }
