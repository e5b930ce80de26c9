// SPDX-License-Identifier: MIT
// Compressed files: gzip streams, and packed transport as docs/transport-format.md has it.

const kHeader = 24, kFileHeader = 64, kEntry = 32, kMaxWords = 16, kDifference = 0x80;

/** The bytes of a gzip stream, or the bytes themselves where a server has expanded them already. */
export async function expanded(bytes) {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const viewOf = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/** Bytes of the transport file that expanded bytes hold. */
export function unpackedBytes(packed) {
  const view = viewOf(packed), magic = [0x4c, 0x49, 0x4d, 0x4e, 0x50, 0x4b, 0x0d, 0x0a]; // LIMNPK CR LF
  if (packed.length < kHeader || magic.some((byte, k) => packed[k] !== byte) || view.getUint32(8, true) !== 1)
    throw new Error('The transport is not packed as this page expects');
  return Number(view.getBigUint64(16, true));
}

/** Writes that transport file to `file`, which is as long as unpackedBytes() says and 0. The runtime checks the sections' hashes. */
export function unpackTransport(packed, file) {
  const view = viewOf(packed), sections = view.getUint32(12, true), table = kFileHeader + kEntry * sections;
  const words = kHeader + table;
  file.set(packed.subarray(kHeader, words));
  let from = words + kMaxWords * sections;
  for (let k = 0; k < sections; ++k) {
    const entry = kHeader + kFileHeader + kEntry * k;
    const offset = Number(view.getBigUint64(entry + 8, true)), size = Number(view.getBigUint64(entry + 16, true));
    const list = [...packed.subarray(words + kMaxWords * k, words + kMaxWords * (k + 1))].filter((word) => word > 0);
    const element = list.reduce((sum, word) => sum + (word & ~kDifference), 0), count = element > 0 ? size / element : 0;
    if (!Number.isInteger(count) || offset + size > file.length || from + size > packed.length)
      throw new Error('The packed transport is damaged');
    let first = offset;
    for (const word of list) {
      const bytes = word & ~kDifference;
      for (let b = 0; b < bytes; ++b, from += count) placePlane(packed, from, file, first + b, element, count);
      if (word & kDifference) addUp(file, first, bytes, element, count);
      first += bytes;
    }
  }
}

function placePlane(packed, from, file, to, step, count) {
  for (let k = 0; k < count; ++k, to += step) file[to] = packed[from + k];
}

/** Sums differences of words of 1, 2 or 4 bytes, `step` bytes apart. */
function addUp(file, first, bytes, step, count) {
  let sum = 0;
  for (let k = 0, at = first; k < count; ++k, at += step) {
    let word = 0;
    for (let b = 0; b < bytes; ++b) word |= file[at + b] << (8 * b);
    sum = (sum + word) | 0;
    for (let b = 0; b < bytes; ++b) file[at + b] = sum >> (8 * b);
  }
}
