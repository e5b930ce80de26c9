// SPDX-License-Identifier: MIT
// Writes pictures of 32-bit floats as OpenEXR: scan lines without compression.

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
