// SPDX-License-Identifier: MIT
// A Godot 4 resource pack, format 2, without encryption.
import crypto from 'node:crypto';
import fs from 'node:fs';

const u32 = (v) => { const b = Buffer.alloc(4); b.writeUInt32LE(v); return b; };
const u64 = (v) => { const b = Buffer.alloc(8); b.writeBigUInt64LE(BigInt(v)); return b; };
const aligned = (at) => Math.ceil(at / 32) * 32;

/** Packs `files`, an object of resource path to file, into `out`. */
export function pack(out, files) {
    let at = 0;
    const entries = Object.entries(files).map(([name, file]) => {
        const data = fs.readFileSync(file), entry = { name: Buffer.from(`res://${name}`), data, at };
        at = aligned(at + data.length);
        return entry;
    });
    const directory = Buffer.concat([u32(entries.length), ...entries.flatMap(({ name, data, at: offset }) => {
        const padding = (4 - name.length % 4) % 4;
        return [u32(name.length + padding), name, Buffer.alloc(padding), u64(offset), u64(data.length),
            crypto.createHash('md5').update(data).digest(), u32(0)];
    })]);
    const headSize = 5 * 4 + 4 + 8 + 16 * 4, base = aligned(headSize + directory.length);
    const head = Buffer.concat([Buffer.from('GDPC'), u32(2), u32(4), u32(0), u32(0), u32(0), u64(base), Buffer.alloc(16 * 4)]);
    const body = Buffer.alloc(at);
    for (const entry of entries) entry.data.copy(body, entry.at);
    fs.writeFileSync(out, Buffer.concat([head, directory, Buffer.alloc(base - head.length - directory.length), body]));
}
