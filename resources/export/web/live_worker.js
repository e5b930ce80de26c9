// SPDX-License-Identifier: MIT
// The bounces of light, in a thread of their own: the page goes on drawing while they run. Takes { open } once, then the page's
// { state }s, of which the latest counts, and buffers that the page is done with. Sends { progress }, { ready }, { lit }, { kept } and
// { error }. While nothing else is to be done, it finds the light of each source alone: what changes colours and strengths then needs no
// bounce.
import { expanded } from './expand.js';
import { keptLight } from './kept_light.js';
import { download } from './progress.js';
import { openTransport } from './transport.js';

const kBounceMs = 25; // of bounces between two lightmaps, at least one bounce
const kFirstMs = 3000; // until the first lightmap, which shows converged light unless that takes longer
const kMaxBounces = 1000; // after a change of light
const kTolerance = 1e-3;

let transport = null, kept = null, state = null, isNew = false, scale = 1, wake = () => {}, buffers = [];
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

/** Sends the light of `scene`; `rest` goes with it. */
function send(scene, rest) {
  const map = scene.lightmap(scale), buffer = buffers.pop() ?? new ArrayBuffer(map.byteLength);
  new Uint16Array(buffer).set(map);
  const harmonics = state.gridPoints.map((point) => scene.gridHarmonics(point));
  postMessage({ lit: { serial: state.serial, buffer, harmonics, ...rest } }, [buffer]);
}

/** Shows the latest state by kept light, if that is there. */
function mixed() {
  const begin = performance.now();
  kept.take(state);
  if (!kept.mix()) return false;
  const ms = performance.now() - begin;
  send(kept.scene, { bounces: 0, ms, ended: true, early: false, missing: 0, mixed: true });
  return true;
}

async function relight() {
  let bounces = 0, ended = false, shown = false, first = performance.now();
  for (;;) {
    if (isNew) {
      shown = mixed();
      if (shown) first = 0;
      takeState(); // bounces go on behind kept light, for what it cannot show
      bounces = 0;
      ended = false;
    }
    if (ended) {
      const [before] = kept.progress();
      if (!kept.find()) await message();
      else await breath();
      if (kept.progress()[0] !== before) postMessage({ kept: kept.progress() });
      continue;
    }
    const begin = performance.now(), before = bounces;
    do bounces += transport.step(); while (!transport.converged() && performance.now() - begin < kBounceMs);
    const ms = (performance.now() - begin) / Math.max(bounces - before, 1), converged = transport.converged();
    ended = converged || bounces >= kMaxBounces;
    if (!shown && (ended || performance.now() - first > kFirstMs || first === 0)) {
      first = 0;
      send(transport, { bounces, ms, ended, early: ended && !converged, missing: transport.missing(), mixed: false });
    }
    await breath();
    while (!shown && buffers.length === 0 && !isNew && first === 0) await message(); // the page has not shown the latest one yet
  }
}

async function open({ wasm, file, bytes, mapScale, maxLights }) {
  scale = mapScale;
  const [program, packed] = await Promise.all([download(wasm), download(file, (arrived) => postMessage({ progress: arrived / bytes }))]);
  const begin = performance.now();
  transport = await openTransport(program, await expanded(packed), maxLights, kTolerance);
  kept = keptLight(transport);
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
