"use strict";
// Speaks Modbus with the modbus-serial package: one JSON request a line on standard input, one JSON answer a line.
// node talk.js tcp|rtu-tcp HOST PORT, or node talk.js rtu|ascii DEVICE. Ends when standard input does.

const readline = require("readline");
const ModbusRTU = require("modbus-serial");

const client = new ModbusRTU();
const SERIAL = { baudRate: 115200, parity: "none" };

function connected() {
    const [transport, target, port] = process.argv.slice(2);
    switch (transport) {
        case "tcp": return client.connectTCP(target, { port: Number(port) });
        // connectTcpRTUBuffered sends MBAP all the same; what it calls telnet is plain RTU on a socket.
        case "rtu-tcp": return client.connectTelnet(target, { port: Number(port) });
        case "rtu": return client.connectRTUBuffered(target, SERIAL);
        case "ascii": return client.connectAsciiSerial(target, SERIAL);
        default: throw new Error("unknown transport " + transport);
    }
}

const READS = { 1: "readCoils", 2: "readDiscreteInputs", 3: "readHoldingRegisters", 4: "readInputRegisters" };

// The bytes of a number whose words come in the other order.
function turned(buffer) {
    return Buffer.concat([buffer.subarray(2, 4), buffer.subarray(0, 2)]);
}

async function write(asked) {
    const [first] = asked.words;
    switch (asked.function) {
        case 5: {
            const answer = await client.writeCoil(asked.address, Boolean(first));
            return { written: answer === undefined || answer.state === Boolean(first) ? 1 : 0 };
        }
        case 6: {
            const answer = await client.writeRegister(asked.address, first);
            return { written: answer === undefined || answer.value === first ? 1 : 0 };
        }
        case 15: return { written: (await client.writeCoils(asked.address, asked.words.map(Boolean))).length };
        default: return { written: (await client.writeRegisters(asked.address, asked.words)).length };
    }
}

async function answer(asked) {
    const count = asked.count;
    switch (asked.do) {
        case "read": {
            const { data } = await client[READS[asked.function]](asked.address, count);
            return { values: data.slice(0, count).map(Number) };
        }
        case "signed": {
            const { buffer } = await client.readHoldingRegisters(asked.address, count);
            return { values: Array.from({ length: count }, (_, at) => buffer.readInt16BE(2 * at)) };
        }
        case "floats": {
            const { buffer } = await client.readHoldingRegisters(asked.address, 2 * count);
            const parts = Array.from({ length: count }, (_, at) => buffer.subarray(4 * at, 4 * at + 4));
            return { values: parts.map((part) => (asked.swapped ? turned(part) : part).readFloatBE(0)) };
        }
        case "text": {
            const { buffer } = await client.readHoldingRegisters(asked.address, count);
            return { text: buffer.toString("latin1") };
        }
        case "write": return write(asked);
        case "write_float": {
            const buffer = Buffer.alloc(4);
            buffer.writeFloatBE(asked.number, 0);
            await client.writeRegisters(asked.address, asked.swapped ? turned(buffer) : buffer);
            return {};
        }
        case "custom": {
            const { buffer } = await client.customFunction(asked.function, asked.data);
            return { data: Array.from(buffer) };
        }
        default: throw new Error("unknown request " + asked.do);
    }
}

function problem(error) {
    if (error.modbusCode) return { exception: error.modbusCode };
    if (error.errno === "ETIMEDOUT") return { silent: true };
    return { problem: String(error.message || error) };
}

async function main() {
    await connected();
    for await (const line of readline.createInterface({ input: process.stdin })) {
        const asked = JSON.parse(line);
        client.setID(asked.unit);
        client.setTimeout(asked.patience);
        let said;
        try {
            said = await answer(asked);
        } catch (error) {
            said = problem(error);
        }
        process.stdout.write(JSON.stringify(said) + "\n");
    }
    process.exit(0);
}

main().catch((error) => {
    process.stdout.write(JSON.stringify(problem(error)) + "\n");
    process.exit(1);
});
