// SPDX-License-Identifier: BSD-3-Clause
// Reads an MCAP file by the libraries of Foxglove: node read_mcap.mjs FILE prints {messages, by_index, types, errors} as JSON.
import { readFile } from "node:fs/promises";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

const bytes = new Uint8Array(await readFile(process.argv[2]));
const decompressHandlers = await loadDecompressHandlers();
const errors = [];

/** Runs a reader to its end, or to its first error. */
async function attempt(name, read) {
  try {
    return await read();
  } catch (error) {
    errors.push(`${name}: ${error.message}`);
    return 0;
  }
}

const byIndex = await attempt("index", async () => {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.slice(Number(offset), Number(offset + length)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  let count = 0;
  for await (const message of reader.readMessages({ validateCrcs: true })) count += message.data.length > 0 ? 1 : 0;
  return count;
});

const types = new Set();
const messages = await attempt("stream", async () => {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  const schemas = new Map(), decoders = new Map();
  let count = 0;
  reader.append(bytes);
  for (let record = reader.nextRecord(); record !== undefined; record = reader.nextRecord()) {
    if (record.type === "Schema") {
      schemas.set(record.id, record);
    } else if (record.type === "Channel") {
      const schema = schemas.get(record.schemaId);
      types.add(schema.name);
      decoders.set(record.id, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
    } else if (record.type === "Message") {
      decoders.get(record.channelId).readMessage(record.data);
      ++count;
    }
  }
  if (!reader.done()) errors.push("stream: the file does not end where it should");
  return count;
});

console.log(JSON.stringify({ messages, by_index: byIndex, types: [...types].sort(), errors }));
