// SPDX-License-Identifier: MIT
// The textures of bounced light: the one in the light that the scene begins with, and the one that the runtime writes.
import * as THREE from 'three';

const kFilter = { channel: 1, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, generateMipmaps: false };

/** From words with a shared exponent. */
export function firstLightmap(words, width, height) {
  const map = new THREE.DataTexture(words, width, height, THREE.RGBFormat, THREE.UnsignedInt5999Type);
  Object.assign(map, kFilter, { needsUpdate: true });
  return map;
}

/** Of half floats, which every graphics card filters. show() takes a buffer of them and returns the one shown before. */
export function liveLightmap(width, height) {
  const map = new THREE.DataTexture(new Uint16Array(4 * width * height), width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  Object.assign(map, kFilter);
  return {
    map,
    show(buffer) {
      const before = map.image.data.buffer;
      map.image.data = new Uint16Array(buffer);
      map.needsUpdate = true;
      return before;
    },
  };
}
