// SPDX-License-Identifier: MIT
// node live.mjs OUT: exports the live page of Cornell, adds a lamp, drags it with real mouse events in headless Chromium and changes its
// colour, and compares the bounced light each time with `limn render`. Then it removes the lamp, hangs up forty, and opens the page on a
// phone. Needs the runtime in build/web (.ci/wasm). Pictures stay in OUT/live.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { openBrowser, serve } from './browser.mjs';
import { encodeExr } from './exr.mjs';

const root = path.join(path.dirname(fileURLToPath(import.meta.url)), '../..');
const folder = path.resolve(process.argv[2], 'live'), site = path.join(folder, 'cornell'), width = 720, height = 400;
const limn = (...args) => execFileSync(path.join(root, 'build/release/limn'), args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 26 });
fs.mkdirSync(folder, { recursive: true });
const bake = path.join(folder, 'cornell.limnbake');
limn('bake', 'cornell', '-o', bake);
limn('export', 'cornell', '--bake', bake, '--format', 'web', '--three', path.join(root, 'tests/export/node_modules/three'), '-o', site);
const bytes = fs.readdirSync(site, { recursive: true }).reduce((sum, f) => sum + fs.statSync(path.join(site, f)).size, 0);

const server = await serve({ '/': site + '/' }), browser = await openBrowser(), page = await browser.newPage();
const problems = [];
await page.setViewport({ width, height });
page.on('console', (m) => { if (m.type() === 'error' || m.type() === 'warning' && !/GPU stall/.test(m.text())) problems.push(m.text()); });
page.on('pageerror', (e) => problems.push(e.message));
page.on('response', (r) => { if (r.status() >= 400) problems.push(`${r.status()} ${r.url()}`); });
const settled = () => page.waitForFunction('window.limn?.settled()', { timeout: 240000 });

/** Irradiance of bounced light at every pixel, from the page's own lightmap, upper row first: the mean of 16 points, as limn has it. */
async function irradiance() {
    const base64 = await page.evaluate((width, height) => {
        const { THREE, scene, camera, renderer, lamps } = limn, lightmap = limn.lightmap(), kept = [], lit = lamps.map((l) => l.object.visible);
        lamps.forEach((l) => { l.object.visible = false; });
        camera.clearViewOffset();
        camera.fov = Math.atan(limn.wanted.high) * 360 / Math.PI;
        camera.updateProjectionMatrix();
        scene.traverse((o) => {
            if (!o.isMesh || !o.geometry.attributes.uv1) return;
            kept.push([o, o.material]);
            o.material = new THREE.MeshLambertMaterial({ color: 0xffffff, lightMap: lightmap, lightMapIntensity: o.material.lightMapIntensity });
        });
        const fine = 4, w = fine * width, h = fine * height; // points per pixel along each side
        const target = new THREE.WebGLRenderTarget(w, h, { type: THREE.FloatType }), rgba = new Float32Array(4 * w * h);
        const tone = renderer.toneMapping, background = scene.background;
        renderer.toneMapping = THREE.NoToneMapping;
        scene.background = null;
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        renderer.readRenderTargetPixels(target, 0, 0, w, h, rgba);
        renderer.setRenderTarget(null);
        renderer.toneMapping = tone;
        scene.background = background;
        kept.forEach(([o, m]) => { o.material = m; });
        lamps.forEach((l, k) => { l.object.visible = lit[k]; });
        dispatchEvent(new Event('resize')); // the page's own view again
        const rgb = new Float32Array(3 * width * height);
        for (let y = 0; y < h; ++y) for (let x = 0; x < w; ++x) for (let c = 0; c < 3; ++c)
            rgb[3 * (Math.floor(y / fine) * width + Math.floor(x / fine)) + c] += Math.PI / fine ** 2 * rgba[4 * ((h - 1 - y) * w + x) + c];
        let text = '';
        const all = new Uint8Array(rgb.buffer);
        for (let k = 0; k < all.length; k += 32768) text += String.fromCharCode(...all.subarray(k, k + 32768));
        return btoa(text);
    }, width, height);
    const buffer = Buffer.from(base64, 'base64');
    return new Float32Array(buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.length));
}

/** nRMSE against limn with the page's lamps and camera, and without the worst 1 % of pixels. */
async function compared(name) {
    const { lamps, camera } = await page.evaluate(() => ({
        lamps: limn.lamps.map((l) => l.lights[0]),
        camera: { eye: limn.camera.position.toArray(), target: limn.orbit.target.toArray(), fov: Math.atan(limn.wanted.high) * 360 / Math.PI } }));
    const mine = path.join(folder, `${name}.exr`), theirs = path.join(folder, `${name}-limn.exr`);
    fs.writeFileSync(mine, encodeExr(width, height, await irradiance()));
    limn('render', 'cornell', '--bake', bake, '--view', 'irradiance', '--device', 'cpu', '--near-rays', 0, '--gather-rays', 0, '--width', width, '--height', height,
        '--eye', camera.eye.join(), '--target', camera.target.join(), '--fov', camera.fov,
        ...lamps.flatMap((l) => ['--light', `point pos=${l.position.join()} cd=${l.strength} color=${l.color.join()}`]), '-o', theirs);
    const { nrmse, nrmse_without_worst_percent: most, bias } = JSON.parse(limn('compare', mine, theirs, '--json'));
    console.log(`| ${name} | ${nrmse.toFixed(4)} | ${most.toFixed(4)} | ${bias.toFixed(4)} |`);
    return most;
}

let failed = 0;
try {
    await page.goto(`http://127.0.0.1:${server.address().port}/index.html`);
    await settled();
    console.log('| bounced light in the page, against limn render | nRMSE | without the worst 1 % | bias |\n|---|---|---|---|');
    const errors = [await compared('panel')];
    await page.screenshot({ path: path.join(folder, 'panel.png') });
    const [button] = await page.$$('#controls button.wide');
    await button.click();
    await page.mouse.click(width / 2, height / 2); // on the back wall or a block
    if (await page.evaluate('limn.lamps.length') !== 1) problems.push('no lamp hangs where it was put');
    await settled();
    errors.push(await compared('lamp'));
    await page.screenshot({ path: path.join(folder, 'lamp.png') });
    const at = () => page.evaluate(() => {
        const v = limn.lamps.at(-1).handle.position.clone().project(limn.camera);
        return [(v.x + 1) / 2 * innerWidth, (1 - v.y) / 2 * innerHeight];
    });
    const [x, y] = await at(), kSteps = 20;
    await page.mouse.move(x, y);
    await page.mouse.down();
    const start = Date.now(), frames = await page.evaluate('limn.state.frames');
    for (let k = 1; k <= kSteps; ++k) {
        await page.mouse.move(x - 5 * k, y - 3 * k);
        await new Promise((resolve) => setTimeout(resolve, 50));
    }
    const seconds = (Date.now() - start) / 1000, drawn = await page.evaluate('limn.state.frames') - frames;
    await page.mouse.up();
    await settled();
    const [nowX, nowY] = await at();
    errors.push(await compared('dragged'));
    await page.screenshot({ path: path.join(folder, 'dragged.png') });
    // The light of each source alone: another strength and colour then need no bounce.
    await page.waitForFunction('limn.light.kept[1] > 0 && limn.light.kept[0] === limn.light.kept[1]', { timeout: 240000 });
    await page.evaluate(() => {
        const lamp = limn.lamps.at(-1);
        for (const l of lamp.lights) { l.strength *= 3; l.color = [0.4, 0.7, 1]; }
        lamp.update();
        limn.sendLights();
    });
    await settled();
    const mixed = await page.evaluate('limn.light.latest');
    errors.push(await compared('mixed'));
    await page.screenshot({ path: path.join(folder, 'mixed.png') });
    if (!mixed.mixed || mixed.bounces !== 0) problems.push('another strength and colour of a lamp took bounces');
    console.log(`another strength and colour: ${mixed.ms.toFixed(2)} ms for all bounces`);
    const state = await page.evaluate('limn.state'), openMs = await page.evaluate('limn.light.openMs');
    console.log(`opened in ${openMs.toFixed(0)} ms, ${state.lightMs.toFixed(1)} ms per bounce, ${(drawn / seconds).toFixed(1)} frames/s while dragged, ${(bytes / 1e6).toFixed(1)} MB`);
    if (Math.hypot(nowX - (x - 5 * kSteps), nowY - (y - 3 * kSteps)) > 3) problems.push(`the lamp is at ${nowX}, ${nowY}`);
    if (drawn < 2) problems.push('nothing was drawn while the lamp was dragged');
    const brightness = (p) => p.evaluate(() => { // mean of the picture as it is shown, [0, 255]
        const { renderer, scene, camera } = limn, gl = renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
        const rgba = new Uint8Array(4 * w * h);
        renderer.render(scene, camera);
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
        return rgba.reduce((sum, v, k) => sum + (k % 4 < 3 ? v : 0), 0) / (3 * w * h);
    });
    await page.keyboard.press('Delete');
    await settled();
    if (await page.evaluate('limn.lamps.length') !== 0) problems.push('the lamp is not removed');
    const dark = await brightness(page);
    await page.evaluate(() => { while (limn.lamps.length < 40) limn.addLamp(); });
    await settled();
    if (!(await brightness(page) > dark + 20)) problems.push('forty lamps do not shine');
    await page.screenshot({ path: path.join(folder, 'forty.png') });
    await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
    await page.reload();
    await settled();
    const phone = await page.evaluate(() => {
        const { THREE, scene, camera } = limn, box = new THREE.Box3().setFromObject(scene), panel = document.getElementById('panel');
        const seen = [box.min, box.max].map((p) => p.clone().project(camera));
        return { wide: document.documentElement.scrollWidth, top: panel.getBoundingClientRect().top, seen: Math.max(...seen.map((p) => Math.abs(p.x))) };
    });
    if (phone.wide > 390 || phone.top < 700 || !(phone.seen < 1.01)) problems.push(`a phone shows ${JSON.stringify(phone)}`);
    await page.screenshot({ path: path.join(folder, 'phone.png') });
    if (errors.some((e) => !(e < 0.005))) problems.push('bounced light differs from that of limn render by more than 0.5 %');
} catch (e) {
    problems.push(e.message);
}
for (const problem of problems) {
    ++failed;
    console.error(`live page: ${problem}`);
}
await browser.close();
server.close();
process.exit(failed > 0 ? 1 : 0);
