// SPDX-License-Identifier: MIT
// node scenes.mjs OUT [SCENE...]: exports whole scenes to three.js, Babylon.js, PlayCanvas, Godot and Blender, renders their bounced light
// there, and the whole of them with lamps and sky, beside gathered pictures of `limn render` from the same camera, and prints the nRMSE.
// Pictures stay in OUT/scenes/SCENE.
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { openBrowser, serve, visit } from './browser.mjs';
import { decodeExr, encodeExr } from './exr.mjs';
import { pack } from './godot/pack.mjs';

const kFine = 3; // pixels of Limn's pictures along a side of an engine's
const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, '../..');
const shared = path.join(root, '../shared/scenes');
const known = {
    cornell: { file: 'cornell', harmonics: true }, atrium: { file: 'atrium', harmonics: true },
    sponza: { file: path.join(shared, 'sponza-crytek'), lights: ['--light', 'sun dir=-0.2,-1,0.1 lux=20'],
        view: { eye: [-9, 2, -0.3], target: [5, 3, -0.3], fov: 60 }, small: true },
    'living-room': { file: path.join(shared, 'living-room'), lights: ['--sky', path.join(shared, 'living-room/Sky_19.exr')], small: true },
    staircase: { file: path.join(shared, 'staircase'), small: true },
};
const [out, ...chosen] = process.argv.slice(2);
const limn = (...args) => execFileSync(path.join(root, 'build/release/limn'), args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 26 });

/** The scene's file, or null. */
function find({ file }) {
    if (!path.isAbsolute(file)) return file;
    const list = fs.existsSync(file) ? fs.readdirSync(file).filter((f) => /\.(gltf|glb)$/.test(f)) : [];
    return list.length > 0 ? path.join(file, list[0]) : null;
}
function compare(a, b) {
    const { nrmse, nrmse_without_worst_percent: most } = JSON.parse(limn('compare', a, b, '--json'));
    return { nrmse, most };
}
function report(scene, consumer, view, { nrmse, most }) {
    console.log(`| ${scene} | ${consumer.trim()} | limn render --view ${view} | ${nrmse.toFixed(4)} | ${most.toFixed(4)} |`);
}

/** Puts what was exported for Godot into a project that shows it. Godot takes exposures up to 16. */
function packGodot(folder, exported, from, [width, height]) {
    const settings = path.join(folder, 'godot-scene.json');
    fs.writeFileSync(settings, JSON.stringify({ width, height, from, exposures: [-4, -3, -2, -1, 0, 1, 2].map((k) => 4 ** k) }));
    const files = { 'scene.json': settings };
    for (const [name, file] of [['project.godot', 'project.godot'], ['main.tscn', 'scene.tscn'], ['scene.gd', 'scene.gd'], ['stage.gd', 'stage.gd']])
        files[name] = path.join(here, 'godot', file);
    for (const { name } of exported) files[name] = path.join(folder, name);
    pack(path.join(folder, 'godot.pck'), files);
}

const server = await serve({ '/node_modules/': path.join(here, 'node_modules') + '/', '/scenes/': path.resolve(out, 'scenes') + '/', '/': path.join(here, 'pages') + '/' });
const browser = await openBrowser(), address = `http://127.0.0.1:${server.address().port}`;
let failed = 0;
console.log('| scene | consumer | compared with | nRMSE | without the worst 1 % |\n|---|---|---|---|---|');
for (const name of chosen.length > 0 ? chosen : Object.keys(known)) {
    const file = find(known[name]);
    if (!file) {
        console.log(`${name}: skipped, ${known[name].file} is missing`);
        continue;
    }
    const folder = path.resolve(out, 'scenes', name), scene = [file, ...(known[name].lights ?? [])];
    const [width, height] = known[name].small ? [192, 144] : [384, 288]; // pixels
    fs.mkdirSync(folder, { recursive: true });
    const bake = path.join(folder, 'light.limnbake');
    if (!fs.existsSync(bake)) limn('bake', ...scene, '-o', bake);
    const { view: from } = known[name];
    const picture = (base64, stem) => { // of floats
        const bytes = Buffer.from(base64, 'base64'), rgb = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
        const file = path.join(folder, `${stem}.exr`);
        fs.writeFileSync(file, encodeExr(width, height, rgb));
        return file;
    };
    const eye = from ? ['--eye', from.eye.join(), '--target', from.target.join(), '--fov', from.fov] : [];
    const draw = (view, fine, file, ...more) => limn('render', ...scene, '--bake', bake, '--device', 'cpu', '--view', view, '--width', fine * width,
        '--height', fine * height, '--spp', 16, ...eye, ...more, '-o', path.join(folder, file));
    // Textures are filtered over an engine's pixel, but of surfaces without them one point of it is seen, its middle.
    draw('irradiance', kFine, 'limn-fine.exr');
    const fine = decodeExr(fs.readFileSync(path.join(folder, 'limn-fine.exr'))), middle = (kFine - 1) / 2;
    const rgb = Float32Array.from({ length: 3 * width * height }, (_, i) => {
        const pixel = Math.floor(i / 3), x = pixel % width, y = Math.floor(pixel / width);
        return fine.rgb[3 * ((kFine * y + middle) * fine.width + kFine * x + middle) + i % 3];
    });
    fs.writeFileSync(path.join(folder, 'limn-irradiance.exr'), encodeExr(width, height, rgb));
    for (const view of ['indirect', 'lit']) draw(view, 1, `limn-${view}.exr`);
    draw('lit', 1, 'limn-lit.png', '--tonemap', 'none');
    for (const [engine, view, options] of [
        ['three', 'irradiance', ['--encoding', 'ktx2-half']], ['three', 'irradiance', ['--lightmap-bands', 3]], ['babylon', 'indirect', []],
        ['playcanvas', null, []], ['godot', 'irradiance', []], ['godot', 'irradiance', ['--lightmap-bands', 2]]]) {
        if (options.includes('--lightmap-bands') && !known[name].harmonics) continue;
        const { files } = JSON.parse(limn('export', ...scene, '--bake', bake, '--format', engine, ...options, ...(engine === 'godot' ? [] : ['--paths', 0]), '--json', '-o', path.join(folder, `${engine}.gltf`)));
        if (engine === 'godot') packGodot(folder, files, from, [width, height]);
        const url = `${address}/scene-${engine}.html?folder=/scenes/${name}&width=${width}&height=${height}${from ? `&from=${JSON.stringify(from)}` : ''}`;
        const result = await visit(browser, url, path.join(folder, `${engine}.png`), { timeout: 600000, keep: true, width, height });
        if (!result.ok) {
            ++failed;
            console.error(`${name}, ${engine}: ${result.error}\n${result.log.join('\n')}`);
            continue;
        }
        const consumer = `${engine} ${options.join(' ')}`;
        if (result.rgb) report(name, consumer, view, compare(picture(result.rgb, `${engine}-${view}`), path.join(folder, `limn-${view}.exr`)));
        report(name, consumer, 'lit', compare(picture(result.whole, `${engine}-lit`), path.join(folder, 'limn-lit.exr')));
    }
    limn('export', ...scene, '--bake', bake, '--format', 'blender', '--paths', 0, '-o', path.join(folder, 'blender.gltf'));
    try {
        console.log(`${name}: ${execFileSync('node', [path.join(here, 'validate.mjs'), path.join(folder, 'three.gltf')], { encoding: 'utf8' }).trim()}`);
    } catch (e) {
        ++failed;
        console.error(e.stdout);
    }
    const bounced = path.join(folder, 'blender-indirect.exr'), whole = path.join(folder, 'blender-lit.exr');
    const rendered = spawnSync('blender', ['-b', '-noaudio', '--python', path.join(here, 'blender_scene.py'), '--', path.join(folder, 'blender'),
        bounced, whole, width, height, ...(from ? [JSON.stringify(from)] : [])], { encoding: 'utf8' });
    if (rendered.error) console.log(`${name}, Blender: ${rendered.error.message}`);
    else if (!fs.existsSync(bounced)) {
        ++failed;
        console.error(`${name}, Blender:\n${rendered.stdout.slice(-2000)}${rendered.stderr.slice(-2000)}`);
    } else {
        report(name, 'blender', 'indirect', compare(bounced, path.join(folder, 'limn-indirect.exr')));
        report(name, 'blender', 'lit', compare(whole, path.join(folder, 'limn-lit.exr')));
    }
}
await browser.close();
server.close();
process.exit(failed > 0 ? 1 : 0);
