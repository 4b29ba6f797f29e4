globalThis.regscribe = Object.freeze({
  open, modelsOf, versionOf, registerOf, elementsOf, find, parse, show, surroundings, decode, encode, present, describe,
  needs, compute, frame,
})
