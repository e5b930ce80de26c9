// SPDX-License-Identifier: MIT

/**
 * Reads a KTX2 file that Limn wrote in half floats or floats, without Zstandard.
 * Returns width, height, images (layers or slices, 1 at least), half (else float) and data: RGBA, row 0 at the top.
 */
export function readKtx2(buffer) {
    const view = new DataView(buffer);
    if (view.getUint32(0, true) !== 0x58544bab) throw new Error('not a KTX2 file');
    const word = (k) => view.getUint32(12 + 4 * k, true);
    const format = word(0), half = format === 97;
    if (!half && format !== 109) throw new Error(`KTX2: format ${format}; export half floats or floats`);
    if (word(8) !== 0) throw new Error('KTX2: compressed; export without Zstandard');
    const offset = Number(view.getBigUint64(80, true)), bytes = Number(view.getBigUint64(88, true));
    const data = half ? new Uint16Array(buffer, offset, bytes / 2) : new Float32Array(buffer, offset, bytes / 4);
    return { width: word(2), height: word(3), images: word(4) || word(5) || 1, half, data };
}

