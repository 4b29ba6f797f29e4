// A message for each answer: its payload has the values by the paths of the registers.

const registers = env.get('registers')
const made = decoded(registers, msg.payload)
const missing = registers.filter(({ path }) => made.payload[path] === null).length
node.status(missing ? { fill: 'yellow', shape: 'ring', text: `${missing} of ${registers.length} without a value` } : { fill: 'green', shape: 'dot', text: `${registers.length} values` })
return { topic: msg.topic, ...made }
