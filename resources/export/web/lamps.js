// SPDX-License-Identifier: MIT
// The lamps of the page: what a visitor takes hold of, and the rectangles, whose direct light three.js draws, without shadows.
import * as THREE from 'three';
import { LightKind } from './transport.js';

/** Rotation whose -Z axis is `direction`, as lights of three.js shine, turned by `roll` about it. */
function facing(direction, roll) {
  const d = new THREE.Vector3(...direction), up = Math.abs(d.y) > 0.9999 ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0, 1, 0);
  const m = new THREE.Matrix4().lookAt(new THREE.Vector3(), d, up);
  return new THREE.Quaternion().setFromRotationMatrix(m).multiply(new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), roll));
}

/** What rectangles of three.js need; loaded where a scene has one. */
export async function prepareRectangles(lights) {
  if (!lights.some((l) => l.kind === LightKind.rectangle)) return;
  const { RectAreaLightUniformsLib } = await import('three/addons/lights/RectAreaLightUniformsLib.js');
  RectAreaLightUniformsLib.init();
}

/** `lights` in the runtime's terms, several for one lamp where a rectangle was divided. `extent` [m] is the scene's. */
export function makeLamp(name, lights, extent) {
  const object = new THREE.Group(), first = lights[0], hasPlace = first.kind !== LightKind.directional;
  const drawn = first.kind === LightKind.rectangle ? lights.map((l) => new THREE.RectAreaLight(0xffffff, 1, l.width, l.height)) : [];
  const handle = hasPlace ? new THREE.Mesh(new THREE.SphereGeometry(extent * 0.008, 24, 12), new THREE.MeshBasicMaterial({ toneMapped: false })) : null;
  for (const part of [handle, ...drawn]) if (part) object.add(part);

  const lamp = {
    name, lights, object, handle, hasPlace,
    /** Brings what is drawn of the lamp itself up to the state of `lights`. */
    update() {
      drawn.forEach((light, k) => {
        const l = lights[k];
        light.color.setRGB(...l.color);
        light.intensity = l.on ? l.strength : 0;
        light.position.set(...l.position);
        light.quaternion.copy(facing(l.direction, l.roll));
      });
      if (!handle) return;
      handle.position.set(...first.position);
      handle.material.color.setRGB(...first.color).multiplyScalar(1 / Math.max(...first.color, 1e-30));
      if (!first.on) handle.material.color.setScalar(0.1); // a lamp that is off can still be taken hold of
    },
    moveBy(step) {
      for (const l of lights) l.position = l.position.map((x, k) => x + step.getComponent(k));
      lamp.update();
    },
  };
  lamp.update();
  return lamp;
}

/** The lamps of a file's lights, of which a divided rectangle has several. `names`: of their sources. */
export function lampsOf(lights, names, extent) {
  const bySource = new Map();
  for (const light of lights) bySource.set(light.source, [...(bySource.get(light.source) ?? []), light]);
  return [...bySource].map(([source, parts]) => makeLamp(names?.[source] || `Lamp ${source + 1}`, parts, extent));
}

/** A point light in the runtime's terms. */
export function pointLight(position, strength, source) {
  return { kind: LightKind.point, on: true, position, direction: [0, -1, 0], color: [1, 1, 1], strength, range: 0, innerAngle: 0,
    outerAngle: Math.PI / 4, width: 1, height: 1, roll: 0, source };
}
