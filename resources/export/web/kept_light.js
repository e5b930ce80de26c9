// SPDX-License-Identifier: MIT
// The light of single sources: lamps, the sky, and materials that glow. Light adds up, so that another colour or strength of a source is
// another factor of what it brings alone, with all bounces at once.
import { kMaxKept } from './transport.js';

const kMaxBytes = 64 << 20; // of kept light
const kMaxBounces = 1000; // of one source

const isDark = (rgb) => rgb.every((v) => v === 0);

/**
 * The sources of a state of live_worker.js: a key, a factor of 3 numbers, and what lights the scene by the source alone at factor 1:
 * lights, sky (3 numbers) and glow(material). `apart`: colours do not mix, so that sources are white.
 */
function sourcesOf(state, apart) {
  const lamps = new Map(); // lights of one lamp change together
  for (const light of state.lights) {
    const key = [light.source, light.on, light.strength, ...light.color].join();
    lamps.set(key, [...(lamps.get(key) ?? []), light]);
  }
  const listed = new Set(state.emission.map(([material]) => material)), no = () => [0, 0, 0];
  const lampSource = (lights) => {
    const { color, strength, on } = lights[0], brightest = Math.max(...color);
    const tint = apart || brightest === 0 ? [1, 1, 1] : color.map((v) => v / brightest), factor = on ? strength : 0;
    const units = lights.map((l) => ({ ...l, on: true, color: tint, strength: 1, source: 0 }));
    return { key: JSON.stringify(units), rgb: apart ? color.map((v) => v * factor) : Array(3).fill(brightest * factor), lights: units, sky: no(), glow: no };
  };
  const tinted = (key, rgb, rest) => {
    const brightest = Math.max(...rgb), tint = apart || brightest === 0 ? [1, 1, 1] : rgb.map((v) => v / brightest);
    return { key: `${key} ${tint}`, rgb: apart ? rgb : Array(3).fill(brightest), lights: [], sky: no(), glow: no, ...rest(tint) };
  };
  return [
    ...[...lamps.values()].map(lampSource),
    tinted('sky', state.sky, (tint) => ({ sky: tint })),
    ...state.emission.map(([material, rgb]) => tinted(`glow ${material}`, rgb, (tint) => ({ glow: (m) => m === material ? tint : no() }))),
    { key: `glow of all but ${[...listed].sort()}`, rgb: [1, 1, 1], lights: [], sky: no(), glow: (m) => listed.has(m) ? no() : [1, 1, 1] },
  ];
}

/** Keeps light beside `transport`, of openTransport(), as far as memory allows. */
export function keptLight(transport) {
  const { counts, fileSky } = transport, apart = counts.chromaBands === counts.bands;
  const maxSlots = Math.min(kMaxKept, Math.floor(kMaxBytes / (counts.caches * (4 + 6 * counts.bands ** 2))));
  let scene = null, slots = 0, finding = null, sources = [];
  const kept = new Map(); // slots by key, the one that was used last at the end

  /** Opens the scene with room for twice the sources, so that some that change need not push out others. */
  const open = () => {
    scene?.close();
    kept.clear();
    finding = null;
    slots = Math.min(2 * sources.length, maxSlots);
    scene = transport.again(slots);
  };
  const freeSlot = () => {
    if (kept.size < slots) return kept.size;
    const [key, slot] = [...kept].find(([key]) => !sources.some((s) => s.key === key));
    kept.delete(key);
    return slot;
  };
  const begin = (source) => {
    finding = { source, bounces: 0 };
    scene.reset();
    scene.setLights(source.lights);
    scene.setSky(fileSky.map((v, k) => v * source.sky[k % 3]));
    for (let m = 0; m < counts.materials; ++m) scene.scaleEmission(m, source.glow(m));
  };

  return {
    /** The scene whose light mix() sets. */
    get scene() { return scene; },
    take(state) { sources = sourcesOf(state, apart); },
    /** How many of the sources are kept, and of how many. */
    progress() { return [sources.filter((s) => kept.has(s.key)).length, sources.length]; },
    /** Sums the light of all sources. Returns false where the light of one is not kept. */
    mix() {
      const shining = sources.filter((s) => !isDark(s.rgb));
      if (!scene || !shining.every((s) => kept.has(s.key))) return false;
      const rgb = new Float32Array(3 * Math.max(kept.size, 1));
      for (const { key, rgb: factor } of shining) {
        const slot = kept.get(key);
        kept.delete(key);
        kept.set(key, slot);
        rgb.set(factor, 3 * slot);
      }
      scene.mix(rgb);
      return true;
    },
    /** One bounce of a source whose light is not kept yet. Returns false where there is none, or no room for all. */
    find() {
      if (sources.length > maxSlots) return false;
      if (sources.length > slots) open();
      if (!finding || !sources.some((s) => s.key === finding.source.key)) {
        const wanted = sources.filter((s) => !kept.has(s.key)), next = wanted.find((s) => !isDark(s.rgb)) ?? wanted[0];
        if (!next) return false;
        begin(next);
      }
      finding.bounces += scene.step();
      if (!scene.converged() && finding.bounces < kMaxBounces) return true;
      const slot = freeSlot();
      scene.keep(slot);
      kept.set(finding.source.key, slot);
      finding = null;
      return true;
    },
  };
}
