/** What the page shows to others, and its tests ask. */
globalThis.regscribe = Object.freeze({
  open, modelsOf, versionOf, registerOf, elementsOf, find, parse, show, surroundings, decode, encode, present, writable,
  describe, needs, take, compute, frame, partValue,
})
