// SPDX-License-Identifier: MIT
// Pictures of 32-bit floats in OpenEXR: writes scan lines without compression, and reads what Limn writes, ZIP of red, green and blue.
import zlib from 'node:zlib';

/** `rgb`: Float32Array of width * height * 3, row 0 at the top. */
export function encodeExr(width, height, rgb) {
    const parts = [Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0])];
    const words = (...values) => { const b = Buffer.alloc(4 * values.length); values.forEach((v, i) => b.writeInt32LE(v, 4 * i)); return b; };
    const floats = (...values) => { const b = Buffer.alloc(4 * values.length); values.forEach((v, i) => b.writeFloatLE(v, 4 * i)); return b; };
    const attribute = (name, type, value) => parts.push(Buffer.from(`${name}\0${type}\0`), words(value.length), value);
    const channel = (name) => Buffer.concat([Buffer.from(`${name}\0`), words(2, 0, 1, 1)]); // 2: float
    attribute('channels', 'chlist', Buffer.concat([channel('B'), channel('G'), channel('R'), Buffer.from([0])]));
    attribute('compression', 'compression', Buffer.from([0]));
    attribute('dataWindow', 'box2i', words(0, 0, width - 1, height - 1));
    attribute('displayWindow', 'box2i', words(0, 0, width - 1, height - 1));
    attribute('lineOrder', 'lineOrder', Buffer.from([0]));
    attribute('pixelAspectRatio', 'float', floats(1));
    attribute('screenWindowCenter', 'v2f', floats(0, 0));
    attribute('screenWindowWidth', 'float', floats(1));
    parts.push(Buffer.from([0]));
    const head = Buffer.concat(parts), line = 8 + width * 12, offsets = Buffer.alloc(8 * height), rows = [];
    for (let y = 0; y < height; ++y) {
        offsets.writeBigUInt64LE(BigInt(head.length + 8 * height + y * line), 8 * y);
        const row = Buffer.alloc(line);
        row.writeInt32LE(y, 0);
        row.writeInt32LE(width * 12, 4);
        for (let x = 0; x < width; ++x)
            for (let c = 0; c < 3; ++c) row.writeFloatLE(rgb[3 * (y * width + x) + 2 - c], 8 + 4 * (c * width + x));
        rows.push(row);
    }
    return Buffer.concat([head, offsets, ...rows]);
}

/** Lines of a block of ZIP, whose bytes are differences, the even ones first. */
function unzipped(block, size) {
    if (block.length === size) return block;
    const packed = zlib.inflateSync(block), bytes = Buffer.alloc(size), half = Math.ceil(size / 2);
    for (let i = 1; i < size; ++i) packed[i] = packed[i - 1] + packed[i] - 128;
    for (let i = 0; i < size; ++i) bytes[i] = packed[i % 2 === 0 ? i / 2 : half + (i - 1) / 2];
    return bytes;
}

/** Reads what `limn` wrote: { width, height, rgb }, as encodeExr() takes them. */
export function decodeExr(file) {
    let i = 8, width = 0, height = 0;
    while (file[i] !== 0) {
        const nameEnd = file.indexOf(0, i), typeEnd = file.indexOf(0, nameEnd + 1), size = file.readInt32LE(typeEnd + 1);
        if (file.toString('latin1', i, nameEnd) === 'dataWindow') [width, height] = [8, 12].map((k) => file.readInt32LE(typeEnd + 5 + k) + 1);
        i = typeEnd + 5 + size;
    }
    const lines = 16, rgb = new Float32Array(3 * width * height);
    for (let block = 0; block * lines < height; ++block) {
        const offset = Number(file.readBigUInt64LE(i + 1 + 8 * block)), rows = Math.min(lines, height - block * lines);
        const bytes = unzipped(file.subarray(offset + 8, offset + 8 + file.readInt32LE(offset + 4)), rows * width * 12);
        for (let row = 0; row < rows; ++row)
            for (let c = 0; c < 3; ++c) // blue, green, red
                for (let x = 0; x < width; ++x)
                    rgb[3 * ((block * lines + row) * width + x) + 2 - c] = bytes.readFloatLE(4 * ((3 * row + c) * width + x));
    }
    return { width, height, rgb };
}
