// SPDX-License-Identifier: MIT
// The glTF scene as the page shows it: materials that read the lightmap or the grid, what casts shadows, and the camera.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Casters } from './shadow_maps.js';

/** The glTF file at `url`, without its lights, which scene.json has. */
export async function loadScene(url) {
  const gltf = await new GLTFLoader().loadAsync(url), lights = [];
  gltf.scene.traverse((o) => { if (o.isLight) lights.push(o); });
  for (const light of lights) light.removeFromParent();
  gltf.scene.updateMatrixWorld(true);
  const origin = new THREE.Vector3().setFromMatrixPosition(gltf.scene.getObjectByName('Limn')?.matrixWorld ?? new THREE.Matrix4());
  gltf.scene.position.sub(origin); // the transport file counts from the scene's own origin
  gltf.scene.updateMatrixWorld(true);
  const casters = new Casters();
  gltf.scene.traverse((o) => { if (o.isMesh) casters.add(o); });
  return { root: gltf.scene, cameras: gltf.cameras, casters, bounds: new THREE.Box3().setFromObject(gltf.scene) };
}

/** The light of objects that the lightmap does not light: harmonics of the grid around each. */
function lightFromGrid(mesh, lampLight) {
  const harmonics = { value: Array.from({ length: 9 }, () => new THREE.Vector3()) };
  mesh.material = mesh.material.clone();
  lampLight.light(mesh.material, (shader) => {
    shader.uniforms.gridHarmonics = harmonics;
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        uniform vec3 gridHarmonics[9];
        vec3 gridIrradiance(vec3 n) {
          vec3 e = 0.8862269 * gridHarmonics[0]
            + 1.0233267 * (gridHarmonics[1] * n.y + gridHarmonics[2] * n.z + gridHarmonics[3] * n.x)
            + 0.8580855 * (gridHarmonics[4] * n.x * n.y + gridHarmonics[5] * n.y * n.z + gridHarmonics[7] * n.x * n.z)
            + 0.2477080 * gridHarmonics[6] * (3.0 * n.z * n.z - 1.0) + 0.4290428 * gridHarmonics[8] * (n.x * n.x - n.y * n.y);
          return max(e, vec3(0.0));
        }`)
      .replace('#include <lights_fragment_maps>', `#include <lights_fragment_maps>
        irradiance += gridIrradiance(inverseTransformDirection(geometryNormal, viewMatrix));`);
  }, '-grid');
  const centre = new THREE.Box3().setFromObject(mesh).getCenter(new THREE.Vector3());
  return { point: centre.toArray(), show: (list) => list?.forEach((rgb, i) => harmonics.value[i].set(...rgb)) };
}

/** Makes the scene's materials show `map`, or the grid where an object has no lightmap. */
export function lightScene(root, map, lampLight) {
  const materials = new Set(), grid = [], users = new Map(); // material: names of its objects
  root.traverse((o) => {
    if (!o.isMesh) return;
    if (o.geometry.attributes.uv1 && map) {
      o.material.lightMap = map;
      lampLight.light(o.material);
    } else grid.push(lightFromGrid(o, lampLight));
    materials.add(o.material);
    const named = o.name || !o.parent ? o : o.parent;
    users.set(o.material, [...(users.get(o.material) ?? []), named.userData.name ?? named.name]);
  });
  return { materials: [...materials], grid, users };
}

/** Materials that emit light, by their number in the transport file: the materials of the page, and the objects that have them. */
export function emissive({ materials, users }) {
  const found = new Map();
  for (const m of materials) {
    const number = m.userData.limn?.material;
    if (number === undefined || !m.emissive || m.emissive.getHex() === 0 || !(m.emissiveIntensity > 0)) continue;
    const entry = found.get(number) ?? { number, materials: [], objects: [] };
    entry.materials.push(m);
    entry.objects.push(...users.get(m).filter((name) => name && !entry.objects.includes(name)));
    found.set(number, entry);
  }
  return [...found.values()];
}

/**
 * Puts the camera where the file's first one stands, or outside of the scene. Returns the tangents of half of the view that it should show:
 * `high`, and at least `wide`, which is all of the scene where the camera stands outside of it.
 */
export function placeCamera(camera, target, { root, cameras, bounds }) {
  const extent = bounds.getSize(new THREE.Vector3()).length(), [shown] = cameras;
  if (shown) {
    shown.updateWorldMatrix(true, false);
    camera.position.setFromMatrixPosition(shown.matrixWorld);
    const ahead = new THREE.Vector3(0, 0, -1).transformDirection(shown.matrixWorld);
    const hit = new THREE.Raycaster(camera.position, ahead).intersectObject(root, true)[0];
    target.copy(camera.position).addScaledVector(ahead, hit?.distance ?? extent / 2);
  } else {
    bounds.getCenter(target);
    camera.position.copy(target).add(new THREE.Vector3(0.4, 0.3, 0.8).multiplyScalar(extent));
  }
  camera.lookAt(target);
  camera.updateMatrixWorld();
  const high = Math.tan((shown?.fov ?? camera.fov) * Math.PI / 360), kWidest = 2;
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new THREE.Vector3(k & 1 ? bounds.max.x : bounds.min.x, k & 2 ? bounds.max.y : bounds.min.y,
    k & 4 ? bounds.max.z : bounds.min.z).applyMatrix4(camera.matrixWorldInverse));
  const outside = corners.every((p) => p.z < 0), all = Math.max(...corners.map((p) => Math.abs(p.x / p.z)));
  return { high, wide: outside ? Math.min(Math.max(1.03 * all, high), kWidest * high) : high };
}

/** Shows what `wanted` of placeCamera() says in the part of a window that a panel at its right or lower edge leaves free [pixels]. */
export function frameView(camera, { high, wide }, width, height, right, below) {
  const freeWidth = Math.max(width - right, width / 4), freeHeight = Math.max(height - below, height / 4);
  const half = Math.max(high, wide * freeHeight / freeWidth) * height / freeHeight;
  camera.fov = Math.min(Math.atan(half) * 360 / Math.PI, 150);
  camera.aspect = width / height;
  camera.setViewOffset(width, height, right / 2, below / 2, width, height); // updates the projection
}
