// SPDX-License-Identifier: MIT
// Loads a grid of light that Limn exported into three.js (WebGLRenderer), where it lights every Lambert, Phong, Standard and
// Physical material within its bounds. Needs an import map for "three" and "three/addons/".
//
//     import { loadLimnGrid } from './ROOM-three.js';
//     scene.add(await loadLimnGrid('ROOM.json', renderer));
//
// three.js looks half a cell along the surface's normal, which keeps light from leaking through walls.
import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { LightProbeGridWebGL } from 'three/addons/lighting/LightProbeGridWebGL.js';

const beside = (uri, url) => new URL(uri, new URL(url, document.baseURI)).href;

async function json(url) {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status}`);
    return response.json();
}

async function ktx2(url, renderer) {
    const loader = new KTX2Loader().detectSupport(renderer);
    const texture = await loader.loadAsync(url);
    loader.dispose();
    texture.minFilter = texture.magFilter = THREE.LinearFilter; // the loader asks for the nearest texel of 3D textures
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
}

/** The grid described by the JSON file at `url`. */
export async function loadLimnGrid(url, renderer) {
    const { bounds, size, origin, texture } = await json(url);
    const extent = bounds.upper.map((v, i) => v - bounds.lower[i]);
    const grid = new LightProbeGridWebGL(...extent, ...size);
    grid.position.set(...extent.map((v, i) => origin[i] + bounds.lower[i] + v / 2));
    grid.updateBoundingBox();
    grid.texture = await ktx2(beside(texture, url), renderer);
    return grid;
}

/** A LightProbe with the mean light of that grid, for scenes that one probe suffices for. */
export async function loadLimnProbe(url) {
    const probe = new THREE.LightProbe();
    probe.sh.fromArray((await json(url)).mean.flat());
    return probe;
}

