// SPDX-License-Identifier: MIT
// The bounces of light, in a thread of their own: the page goes on drawing while they run. Takes { open } once, then the page's
// { state }s, of which the latest counts, and buffers that the page is done with. Sends { progress }, { ready }, { lit } and { error }.
import { expanded } from './expand.js';
import { download } from './progress.js';
import { openTransport } from './transport.js';

const kBounceMs = 25; // of bounces between two lightmaps, at least one bounce
const kFirstMs = 3000; // until the first lightmap, which shows converged light unless that takes longer
const kMaxBounces = 1000; // after a change of light
const kTolerance = 1e-3;

let transport = null, state = null, isNew = false, scale = 1, wake = () => {}, buffers = [];
const shown = { sky: '', emission: new Map() };

/** Lets the messages in that have arrived. */
const channel = new MessageChannel();
const breath = () => new Promise((resolve) => { channel.port1.onmessage = resolve; channel.port2.postMessage(0); });
const message = () => new Promise((resolve) => { wake = resolve; });

function takeState() {
  isNew = false;
  transport.setLights(state.lights);
  const sky = state.sky.join();
  if (sky !== shown.sky) transport.setSky(transport.fileSky.map((v, k) => v * state.sky[k % 3]));
  shown.sky = sky;
  for (const [material, rgb] of state.emission) {
    if (shown.emission.get(material) === rgb.join()) continue;
    transport.scaleEmission(material, rgb);
    shown.emission.set(material, rgb.join());
  }
}

function send(bounces, ms, ended, early) {
  const map = transport.lightmap(scale), buffer = buffers.pop() ?? new ArrayBuffer(map.byteLength);
  new Uint16Array(buffer).set(map);
  const harmonics = state.gridPoints.map((point) => transport.gridHarmonics(point));
  postMessage({ lit: { serial: state.serial, buffer, harmonics, bounces, ms, ended, early, missing: transport.missing() } }, [buffer]);
}

async function relight() {
  let bounces = 0, ended = false, first = performance.now();
  for (;;) {
    if (isNew) {
      takeState();
      bounces = 0;
      ended = false;
    }
    if (ended) {
      await message();
      continue;
    }
    const begin = performance.now(), before = bounces;
    do bounces += transport.step(); while (!transport.converged() && performance.now() - begin < kBounceMs);
    const ms = (performance.now() - begin) / Math.max(bounces - before, 1), converged = transport.converged();
    ended = converged || bounces >= kMaxBounces;
    if (ended || performance.now() - first > kFirstMs || first === 0) {
      first = 0;
      send(bounces, ms, ended, ended && !converged);
    }
    await breath();
    while (buffers.length === 0 && !isNew && first === 0) await message(); // the page has not shown the latest one yet
  }
}

async function open({ wasm, file, bytes, mapScale, maxLights }) {
  scale = mapScale;
  const [program, packed] = await Promise.all([download(wasm), download(file, (arrived) => postMessage({ progress: arrived / bytes }))]);
  const begin = performance.now();
  transport = await openTransport(program, await expanded(packed), maxLights, kTolerance);
  const { width, height } = transport.counts;
  buffers = [0, 1].map(() => new ArrayBuffer(8 * width * height));
  postMessage({ ready: { openMs: performance.now() - begin } });
  while (!state) await message();
  await relight();
}

self.onmessage = ({ data }) => {
  if (data.open) open(data.open).catch((error) => postMessage({ error: error.message }));
  if (data.buffer) buffers.push(data.buffer);
  if (data.state) {
    state = data.state;
    isNew = true;
  }
  wake();
};
