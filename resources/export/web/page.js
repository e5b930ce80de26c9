// SPDX-License-Identifier: MIT
// A scene whose light visitors change. Direct light is three.js', with shadow maps; bounced light is the runtime's, in a lightmap that
// it relights bounce by bounce. A frame is drawn only where something has changed.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { makeLamp, pointLight } from './lamps.js';
import { button, color, group, short, slider, toggle } from './panel.js';
import { LightKind, openTransport } from './transport.js';

const kFrameMs = 12; // of bounces between two frames, at least one bounce

const message = document.getElementById('message'), panel = document.getElementById('panel');
const controlsElement = document.getElementById('controls'), status = document.getElementById('status');

async function fetched(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
}

/** The light of objects that the lightmap does not light: harmonics of the grid around each. */
function lightFromGrid(mesh, transport, gridLit) {
  const harmonics = { value: Array.from({ length: 9 }, () => new THREE.Vector3()) };
  mesh.material = mesh.material.clone();
  mesh.material.onBeforeCompile = (shader) => {
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
  };
  mesh.material.customProgramCacheKey = () => 'limn-grid';
  const centre = new THREE.Box3().setFromObject(mesh).getCenter(new THREE.Vector3());
  gridLit.push(() => transport.gridHarmonics(centre.toArray())?.forEach((rgb, i) => harmonics.value[i].set(...rgb)));
}

async function start() {
  const description = JSON.parse(new TextDecoder().decode(await fetched('scene.json')));
  document.title = description.title;
  const [wasm, file, gltf] = await Promise.all([fetched('limn_runtime.wasm'), fetched(description.transport),
    new GLTFLoader().loadAsync(description.scene)]);
  const opened = performance.now(), transport = await openTransport(wasm, file), openMs = performance.now() - opened;

  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: description.keepPicture === true });
  renderer.toneMapping = THREE.AgXToneMapping;
  renderer.shadowMap.enabled = true;
  document.body.prepend(renderer.domElement);
  const scene = new THREE.Scene();
  scene.add(gltf.scene);
  const lightsOfFile = [];
  gltf.scene.traverse((o) => { if (o.isLight) lightsOfFile.push(o); });
  for (const light of lightsOfFile) light.removeFromParent(); // the transport file has them, with rectangles
  gltf.scene.updateMatrixWorld(true);
  const origin = new THREE.Vector3().setFromMatrixPosition(gltf.scene.getObjectByName('Limn')?.matrixWorld ?? new THREE.Matrix4());
  gltf.scene.position.sub(origin); // the transport file counts from the scene's own origin
  gltf.scene.updateMatrixWorld(true);
  const bounds = new THREE.Box3().setFromObject(gltf.scene), extent = bounds.getSize(new THREE.Vector3()).length();

  // The lightmap. Half floats are filtered by every graphics card.
  const { width, height } = transport.counts, halfs = new Uint16Array(4 * width * height);
  const lightmap = new THREE.DataTexture(halfs, width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  Object.assign(lightmap, { channel: 1, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, generateMipmaps: false });
  const materials = new Set(), gridLit = [];
  gltf.scene.traverse((o) => {
    if (!o.isMesh) return;
    o.castShadow = o.receiveShadow = true;
    o.material.shadowSide = THREE.DoubleSide;
    if (o.geometry.attributes.uv1 && width > 0) o.material.lightMap = lightmap;
    else lightFromGrid(o, transport, gridLit);
    materials.add(o.material);
  });

  const state = { exposureEv: 0, sky: { color: [1, 1, 1], factor: 1 }, bounces: 0, lightMs: 0, frames: 0, framesPerSecond: 0 };
  let dirty = true, lightDirty = true, fps = { frames: 0, since: performance.now() };
  const draw = () => { dirty = true; };

  // Lamps: those of the file, whose rectangles may be divided, and those that visitors add.
  const lamps = [];
  const sendLights = () => { transport.setLights(lamps.flatMap((l) => l.lights)); lightDirty = true; draw(); };
  const changeLamp = (lamp, moved) => { lamp.update(moved); sendLights(); };
  const addLamp = (name, lights) => {
    const lamp = makeLamp(name, lights, bounds);
    lamps.push(lamp);
    scene.add(lamp.object);
    addLampRows(lamp);
    return lamp;
  };
  const unit = (kind) => kind === LightKind.directional ? 'lx' : kind === LightKind.rectangle ? 'nt' : 'cd';
  function addLampRows(lamp) {
    const rows = group(lampRows, lamp.name), first = lamp.lights[0], most = Math.max(...first.color, 1e-30);
    const each = (change, moved = false) => { lamp.lights.forEach(change); changeLamp(lamp, moved); };
    toggle(rows, 'On', first.on, (on) => each((l) => { l.on = on; }));
    color(rows, 'Colour', THREE, first.color, (rgb) => each((l) => { l.color = rgb.map((v) => v * most); }));
    const decades = Math.log10(Math.max(first.strength, 1e-3));
    slider(rows, 'Strength', decades - 2, decades + 2, decades, (v) => `${short(10 ** v)} ${unit(first.kind)}`,
      (v) => each((l) => { l.strength = 10 ** v; }));
    if (first.kind !== LightKind.directional) return;
    const turn = { azimuth: Math.atan2(first.direction[0], first.direction[2]), height: Math.asin(-first.direction[1]) };
    const degrees = (v) => `${Math.round(v)}°`;
    const aim = () => each((l) => {
      l.direction = [Math.sin(turn.azimuth) * Math.cos(turn.height), -Math.sin(turn.height), Math.cos(turn.azimuth) * Math.cos(turn.height)];
    }, true);
    slider(rows, 'Azimuth', -180, 180, turn.azimuth * 180 / Math.PI, degrees, (v) => { turn.azimuth = v * Math.PI / 180; aim(); });
    slider(rows, 'Height', -90, 90, turn.height * 180 / Math.PI, degrees, (v) => { turn.height = v * Math.PI / 180; aim(); });
  }
  const view = group(controlsElement, 'View');
  slider(view, 'Exposure', -8, 8, 0, (v) => `${v >= 0 ? '+' : ''}${v.toFixed(1)} EV`, (v) => { state.exposureEv = v; draw(); });
  if (transport.fileSky.some((v) => v > 0)) {
    const rows = group(controlsElement, 'Sky'), cells = transport.fileSky.length / 3, mean = [0, 0, 0];
    transport.fileSky.forEach((v, k) => { mean[k % 3] += v / cells; });
    const change = () => {
      const factor = state.sky.color.map((v) => v * state.sky.factor);
      transport.setSky(transport.fileSky.map((v, k) => v * factor[k % 3]));
      scene.background = new THREE.Color(...mean.map((v, k) => v * factor[k]));
      lightDirty = true;
      draw();
    };
    color(rows, 'Tint', THREE, [1, 1, 1], (rgb) => { state.sky.color = rgb; change(); });
    slider(rows, 'Strength', 0, 4, 1, (v) => `× ${v.toFixed(2)}`, (v) => { state.sky.factor = v; change(); });
    change();
  }
  const emissive = new Map(); // number in the transport file: materials of the page
  for (const m of materials) {
    const number = m.userData.limn?.material;
    if (number !== undefined && m.emissive && m.emissive.getHex() !== 0 && m.emissiveIntensity > 0)
      emissive.set(number, [...(emissive.get(number) ?? []), m]);
  }
  for (const [number, list] of emissive) {
    const rows = group(controlsElement, list[0].name || `Material ${number}`), base = list.map((m) => m.emissive.clone());
    const glow = { color: [1, 1, 1], factor: 1 };
    const change = () => {
      const rgb = glow.color.map((v) => v * glow.factor);
      transport.scaleEmission(number, rgb);
      list.forEach((m, k) => m.emissive.setRGB(base[k].r * rgb[0], base[k].g * rgb[1], base[k].b * rgb[2]));
      lightDirty = true;
      draw();
    };
    color(rows, 'Tint', THREE, [1, 1, 1], (rgb) => { glow.color = rgb; change(); });
    slider(rows, 'Glow', 0, 4, 1, (v) => `× ${v.toFixed(2)}`, (v) => { glow.factor = v; change(); });
  }
  const lampRows = document.createElement('div');
  controlsElement.append(lampRows);
  const bySource = new Map();
  for (const light of transport.fileLights()) bySource.set(light.source, [...(bySource.get(light.source) ?? []), light]);
  for (const [source, lights] of bySource) addLamp(transport.meta.lights?.[source] || `Lamp ${source + 1}`, lights);
  sendLights();

  // Exposure that shows the mean of what surfaces of albedo 1/2 send as a middle grey.
  let settled = 0;
  while (!transport.converged() && settled++ < 200) transport.step();
  const mean = transport.meanIrradiance(), base = mean > 0 ? 0.18 * 2 * Math.PI / mean : 1;
  // Half floats hold 2^-14 to 2^16 times the mean.
  const scale = mean > 0 ? 2 ** -Math.round(Math.log2(mean)) : 1;
  for (const m of materials) m.lightMapIntensity = 1 / scale;

  const camera = new THREE.PerspectiveCamera(45, 1, extent * 1e-3, extent * 8);
  const shown = gltf.cameras[0];
  const orbit = new OrbitControls(camera, renderer.domElement);
  if (shown) {
    shown.updateWorldMatrix(true, false);
    camera.fov = shown.fov;
    camera.position.setFromMatrixPosition(shown.matrixWorld);
    const ahead = new THREE.Vector3(0, 0, -1).transformDirection(shown.matrixWorld);
    const hit = new THREE.Raycaster(camera.position, ahead).intersectObject(gltf.scene, true)[0];
    orbit.target.copy(camera.position).addScaledVector(ahead, hit?.distance ?? extent / 2);
  } else {
    bounds.getCenter(orbit.target);
    camera.position.copy(orbit.target).add(new THREE.Vector3(0.4, 0.3, 0.8).multiplyScalar(extent));
  }
  orbit.addEventListener('change', draw);
  orbit.update();

  const strengthHere = Math.max(1e-6, mean * extent * extent / 8);
  button(controlsElement, 'Add a lamp', () => {
    const place = camera.position.clone().lerp(orbit.target, 0.6);
    addLamp(`Lamp ${lamps.length + 1}`, [pointLight(place.toArray(), strengthHere, lamps.length)]);
    sendLights();
  });

  // A lamp is dragged in the plane through it that faces the camera.
  const pointer = new THREE.Vector2(), ray = new THREE.Raycaster(), plane = new THREE.Plane(), at = new THREE.Vector3();
  let held = null;
  const aimRay = (event) => {
    const box = renderer.domElement.getBoundingClientRect();
    pointer.set((event.clientX - box.left) / box.width * 2 - 1, 1 - (event.clientY - box.top) / box.height * 2);
    ray.setFromCamera(pointer, camera);
  };
  renderer.domElement.addEventListener('pointerdown', (event) => {
    aimRay(event);
    const near = lamps.filter((l) => l.handle?.visible).map((lamp) => ({ lamp, angle: ray.ray.distanceToPoint(lamp.handle.position) /
      camera.position.distanceTo(lamp.handle.position) })).sort((a, b) => a.angle - b.angle)[0];
    if (!near || near.angle > (event.pointerType === 'mouse' ? 0.03 : 0.06)) return;
    held = near.lamp;
    orbit.enabled = false;
    plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), held.handle.position);
    renderer.domElement.setPointerCapture(event.pointerId);
  }, { capture: true });
  renderer.domElement.addEventListener('pointermove', (event) => {
    if (!held) return;
    aimRay(event);
    if (!ray.ray.intersectPlane(plane, at)) return;
    held.moveBy(at.sub(held.handle.position));
    sendLights();
  });
  const release = () => { held = null; orbit.enabled = true; };
  renderer.domElement.addEventListener('pointerup', release);
  renderer.domElement.addEventListener('pointercancel', release);

  const resize = () => {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    draw();
  };
  addEventListener('resize', resize);
  resize();

  function relight() {
    const begin = performance.now();
    let bounces = 0;
    do bounces += transport.step(); while (!transport.converged() && performance.now() - begin < kFrameMs);
    state.lightMs = (performance.now() - begin) / Math.max(bounces, 1);
    state.bounces = bounces;
    halfs.set(transport.lightmap(scale));
    lightmap.needsUpdate = true;
    gridLit.forEach((update) => update());
    lightDirty = !transport.converged();
    dirty = true;
  }
  function frame(now) {
    if (lightDirty) relight();
    if (dirty) {
      dirty = false;
      renderer.toneMappingExposure = base * 2 ** state.exposureEv;
      renderer.render(scene, camera);
      ++state.frames;
      ++fps.frames;
    }
    if (now - fps.since > 500) {
      state.framesPerSecond = fps.frames * 1000 / (now - fps.since);
      fps = { frames: 0, since: now };
      status.textContent = `${state.bounces > 0 ? short(state.lightMs) : '–'} ms per bounce · ${Math.round(state.framesPerSecond)} frames/s`;
    }
    requestAnimationFrame(frame);
  }
  message.remove();
  panel.hidden = false;
  requestAnimationFrame(frame);
  // For scripts that drive the page.
  window.limn = { THREE, transport, scene, camera, orbit, renderer, lamps, lightmap, state, openMs, sendLights, draw, settled: () => !lightDirty && !dirty };
}

start().catch((error) => {
  message.textContent = `This page cannot show its scene.\n${error.message}`;
  console.error(error);
});
