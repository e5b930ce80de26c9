// SPDX-License-Identifier: MIT
// Lamps under the pointer: they are dragged in the plane through them that faces the camera, and put where one clicks.
import * as THREE from 'three';

const kReach = { mouse: 0.03, touch: 0.06 }; // angles within which a lamp is taken hold of [rad]
const kClick = 8; // pixels that a pointer may move in a click
const kStandOff = 0.06; // of the scene's extent, from a surface to a new lamp

/**
 * `view`: canvas, camera, orbit, root, extent and lamps(). Calls `heard`.held(lamp or null), moved(lamp), placed(position) after place(),
 * and removed(lamp).
 */
export function lampHandles({ canvas, camera, orbit, root, extent, lamps }, heard) {
  const pointer = new THREE.Vector2(), ray = new THREE.Raycaster(), plane = new THREE.Plane(), point = new THREE.Vector3();
  let held = null, chosen = null, placing = null, pressed = null;
  const aim = (event) => {
    const box = canvas.getBoundingClientRect();
    pointer.set((event.clientX - box.left) / box.width * 2 - 1, 1 - (event.clientY - box.top) / box.height * 2);
    ray.setFromCamera(pointer, camera);
  };
  const nearest = (event) => {
    const found = lamps().filter((l) => l.handle).map((lamp) => ({ lamp, angle: ray.ray.distanceToPoint(lamp.handle.position) /
      camera.position.distanceTo(lamp.handle.position) })).sort((a, b) => a.angle - b.angle)[0];
    return found && found.angle < (event.pointerType === 'mouse' ? kReach.mouse : kReach.touch) ? found.lamp : null;
  };
  /** A little in front of the surface under the pointer, or half way to what is in front of that. */
  const before = () => {
    const hit = ray.intersectObject(root, true)[0];
    if (!hit) return ray.ray.at(camera.position.distanceTo(orbit.target) * 0.6, new THREE.Vector3());
    const normal = hit.face.normal.clone().transformDirection(hit.object.matrixWorld);
    if (normal.dot(ray.ray.direction) > 0) normal.negate();
    const start = hit.point.clone().addScaledVector(normal, 1e-4 * extent);
    const free = new THREE.Raycaster(start, normal).intersectObject(root, true)[0]?.distance ?? Infinity;
    return hit.point.addScaledVector(normal, Math.min(kStandOff * extent, free / 2));
  };
  const place = (on) => {
    placing = on;
    canvas.classList.toggle('placing', Boolean(on));
  };
  const choose = (lamp) => {
    chosen?.handle?.scale.setScalar(1);
    chosen = lamp;
    lamp?.handle?.scale.setScalar(1.5);
    heard.held(lamp);
  };

  canvas.addEventListener('pointerdown', (event) => {
    aim(event);
    pressed = { x: event.clientX, y: event.clientY };
    const lamp = placing || held ? null : nearest(event);
    if (!lamp) return;
    held = lamp;
    choose(lamp);
    orbit.enabled = false;
    plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), lamp.handle.position);
    canvas.setPointerCapture(event.pointerId);
  }, { capture: true });
  canvas.addEventListener('pointermove', (event) => {
    if (!held) return;
    aim(event);
    if (!ray.ray.intersectPlane(plane, point)) return;
    held.moveBy(point.sub(held.handle.position));
    heard.moved(held);
  });
  const release = (event) => {
    held = null;
    orbit.enabled = true;
    if (!placing || !pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > kClick) return;
    aim(event);
    place(null);
    heard.placed(before());
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', () => { held = pressed = null; orbit.enabled = true; });
  addEventListener('keydown', (event) => {
    if (event.target instanceof HTMLInputElement && event.target.type !== 'range') return;
    if (event.key === 'Escape' && placing) { place(null); heard.placed(null); }
    if ((event.key === 'Delete' || event.key === 'Backspace') && chosen) heard.removed(chosen);
  });
  return { place: () => place(true), choose };
}
