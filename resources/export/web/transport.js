// SPDX-License-Identifier: MIT
// The relighting runtime, compiled to WebAssembly, behind a few functions. The interface is that of limn_runtime.h, which states
// units and ranges.

import { unpackedBytes, unpackTransport } from './expand.js';

export const LightKind = { directional: 0, point: 1, spot: 2, rectangle: 3 };
export const kMaxLights = 256; // of a page, or as many as its scene has
export const kMaxKept = 64; // slots of kept light
const kLightWords = 20, kLightOff = 1;

/** The lights in a section LGHT, which lies in `buffer` from `offset` on, a multiple of 4. */
export function lightsIn(buffer, offset, count) {
  const lights = [];
  for (let k = 0; k < count; ++k) {
    const at = offset + 4 * kLightWords * k, words = new Uint32Array(buffer, at, kLightWords), f = new Float32Array(buffer, at, kLightWords);
    lights.push({ kind: words[0], on: !(words[1] & kLightOff), position: [...f.slice(2, 5)], direction: [...f.slice(5, 8)],
      color: [...f.slice(8, 11)], strength: f[11], range: f[12], innerAngle: f[13], outerAngle: f[14], width: f[15], height: f[16],
      roll: f[17], source: words[18] });
  }
  return lights;
}

/**
 * Opens a packed transport file, expanded, with the runtime in `wasm`. Throws an Error that says why not. `maxLights`: lights at
 * most; `tolerance`: share of the light that may be missing when bounces end.
 */
export async function openTransport(wasm, packed, maxLights, tolerance) {
  const { instance } = await WebAssembly.instantiate(wasm, { env: { emscripten_notify_memory_growth() {} } });
  const rt = instance.exports;
  rt._initialize?.();
  const bytesAt = (at, size) => new Uint8Array(rt.memory.buffer, at, size);
  const wordsAt = (at, count) => new Uint32Array(rt.memory.buffer, at, count);
  const floatsAt = (at, count) => new Float32Array(rt.memory.buffer, at, count);
  const textAt = (at) => {
    const bytes = bytesAt(at, rt.memory.buffer.byteLength - at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  };
  const allocate = (size) => {
    const at = rt.malloc(size);
    if (!at) throw new Error(`There is no memory for ${size} bytes`);
    return at;
  };

  const size = unpackedBytes(packed), base = (allocate(size + 16) + 15) & ~15;
  unpackTransport(packed, bytesAt(base, size).fill(0));
  const error = allocate(512), options = allocate(28);
  const openScene = (maxKept) => {
    wordsAt(options, 7).set([0, maxLights, 0, maxKept, 0, 0, 0]);
    const scene = rt.limnrt_open(base, size, options, error, 512);
    if (!scene) throw new Error(textAt(error));
    rt.limnrt_set_tolerance(scene, tolerance);
    return scene;
  };

  const first = openScene(0), countsAt = allocate(104);
  rt.limnrt_get_counts(first, countsAt);
  const names = ['surfels', 'skyCells', 'nodes', 'caches', 'lightmapCaches', 'materials', 'lights', 'maxLights', 'triangles', 'bands',
    'chromaBands', 'width', 'height'];
  const counts = Object.fromEntries(names.map((name, k) => [name, wordsAt(countsAt, 16)[k]]));

  const lightsAt = allocate(4 * kLightWords * counts.maxLights), rgbAt = allocate(12), pointAt = allocate(24), shAt = allocate(16 * 64);
  const skyAt = allocate(Math.max(12 * counts.skyCells, 4));
  const mapAt = allocate(16 * counts.width * counts.height), mixAt = allocate(12 * kMaxKept);
  const fileSky = counts.skyCells ? floatsAt(rt.limnrt_file_sky(first), 3 * counts.skyCells).slice() : new Float32Array();
  const check = (ok, what) => { if (!ok) throw new Error(`The runtime refuses ${what}`); };

  const methods = (scene) => ({
    counts, fileSky,

    setLights(lights) {
      lights.forEach((l, k) => {
        const at = lightsAt + 4 * kLightWords * k;
        floatsAt(at, kLightWords).set([0, 0, ...l.position, ...l.direction, ...l.color, l.strength, l.range, l.innerAngle, l.outerAngle,
          l.width, l.height, l.roll, 0, 0]);
        wordsAt(at, 2).set([l.kind, l.on ? 0 : kLightOff]);
        wordsAt(at, kLightWords)[18] = l.source;
      });
      check(rt.limnrt_set_lights(scene, lightsAt, lights.length), 'a light');
    },

    /** Radiance of each sky cell, 3 numbers each [nits]. */
    setSky(rgb) {
      if (counts.skyCells === 0) return;
      floatsAt(skyAt, rgb.length).set(rgb);
      check(rt.limnrt_set_sky(scene, skyAt), 'a sky');
    },

    /** What a material emits, as a factor of what it emits in the file. */
    scaleEmission(material, rgb) {
      floatsAt(rgbAt, 3).set(rgb);
      check(rt.limnrt_scale_material_emission(scene, material, rgbAt), 'an emission');
    },

    /** One bounce. Whether another one would change anything to speak of is what converged() says. */
    step() { return rt.limnrt_converge(scene, 1); },
    converged() { return rt.limnrt_converged(scene) === 1; },
    /** Share of all light that may still be missing, [0, 1]. */
    missing() { return rt.limnrt_missing(scene); },
    /** Forgets bounced light. */
    reset() { rt.limnrt_reset(scene); },

    /** Keeps the present light in a slot below the maxKept it was opened with. */
    keep(slot) { check(rt.limnrt_keep(scene, slot), 'to keep light'); },
    /** Until the next bounce, the light is that of slots 0, 1, ... times their factors, 3 numbers each. */
    mix(rgb) {
      floatsAt(mixAt, rgb.length).set(rgb);
      check(rt.limnrt_mix(scene, mixAt, rgb.length / 3), 'to mix light');
    },

    /** Irradiance [W m^-2] times `scale`, RGBA in half floats, the upper row first: a view that the next call makes invalid. */
    lightmap(scale) {
      rt.limnrt_lightmap_irradiance_half(scene, 0, scale, mapAt);
      return new Uint16Array(rt.memory.buffer, mapAt, 4 * counts.width * counts.height);
    },

    /** Radiance harmonics of three bands at a point of a moving object, 9 times RGB; null without grid. */
    gridHarmonics(position) {
      floatsAt(pointAt, 6).set([...position, 0, 1, 0]);
      if (!rt.limnrt_sample_grid_sh(scene, pointAt, pointAt + 12, shAt)) return null;
      const rgba = floatsAt(shAt, 36), rgb = [];
      for (let i = 0; i < 9; ++i) rgb.push([rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]]);
      return rgb;
    },

    close() { rt.limnrt_close(scene); },

    /** The same scene once more, with light of its own, which keeps light in `maxKept` slots, kMaxKept at most. */
    again(maxKept) { return methods(openScene(maxKept)); },
  });
  return methods(first);
}
