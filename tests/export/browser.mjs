// SPDX-License-Identifier: MIT
// Serves folders to headless Chromium with a software rasteriser, and opens pages that hand over what they measured.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { Readable } from 'node:stream';
import puppeteer from 'puppeteer-core';

const types = {
    '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.json': 'application/json',
    '.wasm': 'application/wasm', '.png': 'image/png', '.gltf': 'model/gltf+json',
};

/** The bytes of a stream at the pace of a line { bytesPerSecond, free, sent }, which all downloads share. */
async function* paced(stream, line) {
    for await (const chunk of stream) {
        line.free = Math.max(line.free, performance.now()) + chunk.length / line.bytesPerSecond * 1000;
        await new Promise((resolve) => setTimeout(resolve, line.free - performance.now()));
        line.sent += chunk.length;
        yield chunk;
    }
}

/** Serves `folders`, an object of URL prefix to folder, over `line` if it is given. Returns the server; its port is free. */
export async function serve(folders, line) {
    const server = http.createServer((request, response) => {
        const url = decodeURIComponent(new URL(request.url, 'http://x').pathname);
        const prefix = Object.keys(folders).find((p) => url.startsWith(p));
        const file = prefix && path.join(folders[prefix], url.slice(prefix.length));
        const inside = file && file.startsWith(folders[prefix]) && fs.existsSync(file) && fs.statSync(file).isFile();
        if (!inside) {
            response.writeHead(url === '/favicon.ico' ? 204 : 404);
            response.end();
            return;
        }
        response.writeHead(200, { 'Content-Type': types[path.extname(file)] ?? 'application/octet-stream', 'Cache-Control': 'no-store' });
        const bytes = fs.createReadStream(file);
        if (line) Readable.from(paced(bytes, line)).pipe(response);
        else bytes.pipe(response);
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
    return server;
}

export async function openBrowser(flags = []) {
    return puppeteer.launch({
        executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true,
        args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', ...flags],
    });
}

/** Opens a page and returns its window.result, or { error }. A picture is kept at `screenshot` if the result is not ok. */
export async function visit(browser, url, screenshot, { timeout = 180000, keep = false, width = 512, height = 512 } = {}) {
    const page = await browser.newPage();
    const log = [];
    await page.setViewport({ width, height });
    page.on('console', (m) => { if (m.type() === 'error' || m.type() === 'log') log.push(m.text()); });
    page.on('pageerror', (e) => log.push(`error: ${e.message}`));
    page.on('response', (r) => { if (r.status() >= 400 && !/favicon/.test(r.url())) log.push(`${r.status()} ${r.url()}`); });
    let result;
    try {
        await page.goto(url);
        await page.waitForFunction('window.result !== undefined', { timeout });
        result = await page.evaluate('window.result');
    } catch (e) {
        result = { error: e.message };
    }
    result.ok = Boolean(result.ok) && !result.error;
    if (!result.ok || keep) {
        fs.mkdirSync(path.dirname(screenshot), { recursive: true });
        await page.screenshot({ path: screenshot }).catch(() => {});
    }
    if (!result.ok) result.log = log;
    await page.close();
    return result;
}
