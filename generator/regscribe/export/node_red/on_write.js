// A message with the path of a register as its topic and the value as its payload is checked, and sent on as words.

const wanted = registers.find(({ path }) => path === msg.topic)
if (!wanted) {
  node.error(`${JSON.stringify(msg.topic)} is none of the registers that this flow writes: ${registers.map(({ path }) => path).join(', ')}`, msg)
  return null
}
try {
  return { ...msg, payload: encoded(wanted, msg.payload, unit) }
} catch (error) {
  node.error(`${wanted.path}: ${error.message}`, msg)
  return null
}
