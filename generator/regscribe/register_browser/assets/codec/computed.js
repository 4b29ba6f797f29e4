/** What a computed value of a map is, of what registers hold. @returns {Reading} also `not_present` */
function compute(computed, known) { return { meaning: "not_decodable" } }
