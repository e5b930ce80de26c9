// SPDX-License-Identifier: MIT
// node run.mjs OUT [PAGE...]: shows what write_known_light wrote into OUT/known to its consumers in headless Chromium and prints, for
// each, the factor with which light arrives and the largest error. Pictures of failures stay in OUT/failed.
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { openBrowser, serve, visit } from './browser.mjs';
import { pack } from './godot/pack.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const [out, ...chosen] = process.argv.slice(2);
const pages = chosen.length > 0 ? chosen : ['three', 'three-webgpu', 'babylon', 'playcanvas', 'filament', 'godot'];
const server = await serve({
    '/node_modules/': path.join(here, 'node_modules') + '/', '/known/': path.resolve(out, 'known') + '/',
    '/out/': path.resolve(out) + '/', '/': path.join(here, 'pages') + '/',
});
if (pages.includes('godot')) {
    const files = Object.fromEntries(['project.godot', 'main.tscn', 'main.gd', 'stage.gd'].map((f) => [f, path.join(here, 'godot', f)]));
    const exported = [...Array(9).keys()].map((i) => `probe-${i}/godot`).concat('probe-0/godot-directional');
    for (const stem of exported) for (const end of ['.gltf', '-geometry.bin', '.tres', '-godot.gd'])
        files[stem + end] = path.join(out, 'known', stem + end);
    pack(path.join(out, 'godot.pck'), files);
}
const plain = await openBrowser(), address = `http://127.0.0.1:${server.address().port}`;
let failed = 0;
const number = (v) => (Math.abs(v) < 1e-3 ? v.toExponential(0) : v.toFixed(3));
const range = (list) => {
    const low = Math.min(...list).toFixed(3), high = Math.max(...list).toFixed(3);
    return low === high ? low : `${low} to ${high}`;
};
console.log('| consumer | what | factor | error |\n|---|---|---|---|');
for (const name of pages) {
    const gpu = name.includes('webgpu') && await openBrowser(['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader']);
    const result = await visit(gpu || plain, `${address}/${name}.html`, path.join(out, 'failed', `${name}.png`));
    for (const r of result.rows ?? [])
        console.log(`| ${r.consumer} | ${r.what} | ${range(r.factors)} | ${number(r.error)} |${r.ok ? '' : ' FAILED'}`);
    if (!result.ok) {
        ++failed;
        console.error(`${name}: failed\n${result.error ?? ''}\n${(result.log ?? []).join('\n')}`);
    }
    if (gpu) await gpu.close();
}
await plain.close();
server.close();
process.exit(failed > 0 ? 1 : 0);
