// SPDX-License-Identifier: MIT
// The lamps of the page: what three.js draws direct light with, and what a visitor takes hold of.
import * as THREE from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { LightKind } from './transport.js';

/** Rotation whose -Z axis is `direction`, as lights of three.js shine, turned by `roll` about it. */
function facing(direction, roll) {
  const d = new THREE.Vector3(...direction), up = Math.abs(d.y) > 0.9999 ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0, 1, 0);
  const m = new THREE.Matrix4().lookAt(new THREE.Vector3(), d, up);
  return new THREE.Quaternion().setFromRotationMatrix(m).multiply(new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), roll));
}

function shadowed(light, size, extent) {
  light.castShadow = true;
  light.shadow.mapSize.set(size, size);
  light.shadow.autoUpdate = false;
  light.shadow.bias = -1e-4 * extent;
  light.shadow.normalBias = 2e-3 * extent;
  light.shadow.camera.near = 1e-3 * extent;
  light.shadow.camera.far = 4 * extent;
  return light;
}

/** `lights` in the runtime's terms, several for one lamp where a rectangle was divided. `bounds` encloses the scene. */
export function makeLamp(name, lights, bounds) {
  const extent = bounds.getSize(new THREE.Vector3()).length(), object = new THREE.Group(), target = new THREE.Object3D();
  const first = lights[0];
  let drawn = [];
  switch (first.kind) {
    case LightKind.directional: {
      const sun = shadowed(new THREE.DirectionalLight(), 2048, extent);
      Object.assign(sun.shadow.camera, { left: -extent / 2, right: extent / 2, top: extent / 2, bottom: -extent / 2 });
      sun.target = target;
      drawn = [sun];
      break;
    }
    case LightKind.point:
      drawn = [shadowed(new THREE.PointLight(0xffffff, 1, first.range, 2), 512, extent)];
      break;
    case LightKind.spot: {
      const penumbra = 1 - first.innerAngle / first.outerAngle;
      const spot = shadowed(new THREE.SpotLight(0xffffff, 1, first.range, first.outerAngle, penumbra, 2), 1024, extent);
      spot.target = target;
      drawn = [spot];
      break;
    }
    case LightKind.rectangle:
      RectAreaLightUniformsLib.init();
      drawn = lights.map((l) => new THREE.RectAreaLight(0xffffff, 1, l.width, l.height));
      break;
  }
  const hasPlace = first.kind !== LightKind.directional;
  const handle = hasPlace ? new THREE.Mesh(new THREE.SphereGeometry(extent * 0.008, 24, 12), new THREE.MeshBasicMaterial({ toneMapped: false })) : null;
  if (handle) object.add(handle);
  object.add(target, ...drawn);

  const lamp = {
    name, lights, object, handle, hasPlace,
    /** Brings what three.js draws up to the state of `lights`. `moved`: shadows are drawn again. */
    update(moved) {
      drawn.forEach((light, k) => {
        const l = lights[k], color = new THREE.Color(...l.color), most = Math.max(color.r, color.g, color.b, 1e-30);
        light.color = color.multiplyScalar(1 / most);
        light.intensity = l.on ? l.strength * most : 0;
        if (hasPlace) light.position.set(...l.position);
        else light.position.copy(bounds.getCenter(new THREE.Vector3())).addScaledVector(new THREE.Vector3(...l.direction), -extent);
        if (light.isRectAreaLight) light.quaternion.copy(facing(l.direction, l.roll));
        if (moved && light.shadow) light.shadow.needsUpdate = true;
      });
      target.position.copy(drawn[0].position).addScaledVector(new THREE.Vector3(...first.direction), extent);
      if (handle) {
        handle.position.set(...first.position);
        handle.material.color.copy(drawn[0].color);
        handle.visible = first.on;
      }
    },
    moveBy(step) {
      for (const l of lights) l.position = l.position.map((x, k) => x + step.getComponent(k));
      lamp.update(true);
    },
  };
  lamp.update(true);
  return lamp;
}

/** A point light in the runtime's terms. */
export function pointLight(position, strength, source) {
  return { kind: LightKind.point, on: true, position, direction: [0, -1, 0], color: [1, 1, 1], strength, range: 0, innerAngle: 0,
    outerAngle: Math.PI / 4, width: 1, height: 1, roll: 0, source };
}
