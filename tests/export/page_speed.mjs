// SPDX-License-Identifier: MIT
// node page_speed.mjs FOLDER [OUT]: measures a live page in headless Chromium with a software rasteriser: bytes and seconds to the first
// picture and to live light over a line of 50 Mbit/s, frames per second while a lamp is dragged by mouse and by touch, and with forty
// lamps. Pictures of a desktop's and a phone's window go to OUT, if it is given. Prints a table; measures time, so it is no test.
import fs from 'node:fs';
import path from 'node:path';
import { openBrowser, serve } from './browser.mjs';

const [site, out] = process.argv.slice(2).map((p) => path.resolve(p));
if (out) fs.mkdirSync(out, { recursive: true });
const kWait = { timeout: 240000, polling: 50 };
const line = { bytesPerSecond: 50e6 / 8, free: 0, sent: 0 };
const server = await serve({ '/': site + '/' }, line), browser = await openBrowser();
const address = `http://127.0.0.1:${server.address().port}/index.html`;
const rows = [], problems = [];
const say = (what, value) => { rows.push([what, value]); console.log(`| ${what} | ${value} |`); };

/** Opens the page, waits for its first picture and for live light, and says what each took. */
async function opened(width, height, touch) {
    const page = await browser.newPage();
    await page.setViewport({ width, height, hasTouch: touch, isMobile: touch, deviceScaleFactor: 1 });
    page.on('pageerror', (e) => problems.push(e.message));
    page.on('console', (m) => { if (m.type() === 'error') problems.push(m.text()); });
    const start = Date.now();
    line.sent = 0;
    await page.goto(address, { waitUntil: 'domcontentloaded' });
    await page.waitForFunction('window.limn?.state.frames > 0', kWait);
    const picture = { bytes: line.sent, seconds: (Date.now() - start) / 1000 };
    if (out) await page.screenshot({ path: path.join(out, `first-${width}x${height}.png`) });
    await page.waitForFunction('limn.state.live !== false', kWait);
    const live = { bytes: line.sent, seconds: (Date.now() - start) / 1000 };
    await page.waitForFunction('limn.settled()', kWait);
    if (out) await page.screenshot({ path: path.join(out, `live-${width}x${height}.png`) });
    return { page, picture, live };
}

const place = (page) => page.evaluate(() => {
    const v = limn.lamps.at(-1).handle.position.clone().project(limn.camera);
    return [(v.x + 1) / 2 * innerWidth, (1 - v.y) / 2 * innerHeight];
});

/** Frames and changes of bounced light per second while the last lamp is dragged for four seconds. */
async function dragged(page, touch) {
    const [x, y] = await place(page), start = Date.now(), kSeconds = 4;
    if (touch) await page.touchscreen.touchStart(x, y);
    else {
        await page.mouse.move(x, y);
        await page.mouse.down();
    }
    const before = await page.evaluate('({ frames: limn.state.frames, lit: limn.state.lit })');
    for (let k = 1; Date.now() - start < kSeconds * 1000; ++k) {
        const to = [x + 40 * Math.sin(k / 20), y - 30 * Math.sin(k / 13)];
        if (touch) await page.touchscreen.touchMove(...to);
        else await page.mouse.move(...to);
        await new Promise((resolve) => setTimeout(resolve, 16));
    }
    const seconds = (Date.now() - start) / 1000, after = await page.evaluate('({ frames: limn.state.frames, lit: limn.state.lit })');
    if (touch) await page.touchscreen.touchEnd();
    else await page.mouse.up();
    await page.waitForFunction('limn.settled()', kWait);
    const light = after.lit === undefined ? 'the same' : ((after.lit - before.lit) / seconds).toFixed(1);
    return `${((after.frames - before.frames) / seconds).toFixed(1)} frames/s, bounced light ${light}`;
}

/** Milliseconds until bounced light has settled, and the bounces that took, after all lamps' strengths have changed by `factor`. */
const settles = (page, factor) => page.evaluate(async (factor) => {
    const frame = () => new Promise(requestAnimationFrame), start = performance.now();
    for (const lamp of limn.lamps) {
        for (const l of lamp.lights) l.strength *= factor;
        lamp.update(false);
    }
    const before = limn.state.allBounces ?? 0;
    limn.sendLights();
    do await frame(); while (!limn.settled());
    return `${Math.round(performance.now() - start)} ms, ${(limn.state.allBounces ?? NaN) - before} bounces`;
}, factor);

try {
    const { page, picture, live } = await opened(1280, 720, false);
    const told = ({ bytes, seconds }) => `${(bytes / 1e6).toFixed(1)} MB, ${seconds.toFixed(1)} s`;
    say('first picture', told(picture));
    say('live light', told(live));
    if (await page.evaluate('!limn.lamps.some((l) => l.handle)')) await page.evaluate(() => limn.addLamp ? limn.addLamp() : document.querySelector('#controls button').click());
    await page.waitForFunction('limn.settled()', kWait);
    say('settled again after lamps became brighter', await settles(page, 1.5));
    say('dragged by mouse, 1280 x 720', await dragged(page, false));
    await page.evaluate(() => {
        while (limn.lamps.length < 40) limn.addLamp ? limn.addLamp() : document.querySelector('#controls button').click();
    });
    await page.waitForFunction('limn.settled()', kWait);
    if (out) await page.screenshot({ path: path.join(out, 'forty.png') });
    say('forty lamps, dragged by mouse', await dragged(page, false));
    await page.close();
    const phone = await opened(390, 844, true);
    if (await phone.page.evaluate('!limn.lamps.some((l) => l.handle)')) await phone.page.evaluate(() => limn.addLamp ? limn.addLamp() : document.querySelector('#controls button').click());
    await phone.page.waitForFunction('limn.settled()', kWait);
    say('dragged by touch, 390 x 844', await dragged(phone.page, true));
    if (out) await phone.page.screenshot({ path: path.join(out, 'touched.png') });
} catch (e) {
    problems.push(e.message);
}
for (const problem of new Set(problems)) console.error(`live page: ${problem}`);
await browser.close();
server.close();
process.exit(problems.length > 0 ? 1 : 0);
