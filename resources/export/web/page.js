// SPDX-License-Identifier: MIT
// A scene whose light visitors change. The first picture has a lightmap in the light that the scene begins with; behind it, the transport
// loads, from which another thread relights the lightmap bounce by bounce. Direct light is this thread's. A frame is drawn only where
// something has changed.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { expanded } from './expand.js';
import { Fineness } from './fineness.js';
import { lampHandles } from './handles.js';
import { LampLight } from './lamp_light.js';
import { glowPanel, lampPanel } from './lamp_panel.js';
import { lampsOf, makeLamp, pointLight, prepareRectangles } from './lamps.js';
import { firstLightmap, liveLightmap } from './lightmap.js';
import { startLiveLight } from './live_light.js';
import { button, color, group, short, slider } from './panel.js';
import { download, megabytes, progressBar } from './progress.js';
import { kMaxLights, lightsIn } from './transport.js';
import { emissive, frameView, lightScene, loadScene, placeCamera } from './view_scene.js';

const element = (id) => document.getElementById(id);
const message = element('message'), panel = element('panel'), controls = element('controls');
const tell = progressBar(element('bar'), element('status'));

const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

/** The lightmap of the first picture: words with a shared exponent; null where the scene has none. */
async function firstMap(description) {
  if (!description.lightmap) return null;
  const { file, width, height } = description.lightmap, bytes = await expanded(await download(file));
  return firstLightmap(new Uint32Array(bytes.buffer, bytes.byteOffset, width * height), width, height);
}

async function start() {
  const loading = message.querySelector('progress');
  const description = JSON.parse(new TextDecoder().decode(await download('scene.json')));
  document.title = description.title;
  loading.value = 0.2;
  const step = (promise) => promise.then((value) => { loading.value += 0.4; return value; });
  const [view, first] = await Promise.all([step(loadScene(description.scene)), step(firstMap(description))]);
  const { root, casters, bounds } = view, extent = bounds.getSize(new THREE.Vector3()).length();

  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: description.keepPicture === true });
  renderer.toneMapping = THREE.AgXToneMapping;
  const canvas = renderer.domElement;
  document.body.prepend(canvas);
  const scene = new THREE.Scene();
  scene.add(root);

  const lightBytes = bytesOf(description.lights), fileLights = lightsIn(lightBytes.buffer, 0, lightBytes.length / 80);
  const maxLights = Math.max(kMaxLights, fileLights.length);
  await prepareRectangles(fileLights);
  const lampLight = new LampLight(renderer, casters, bounds, maxLights), lit = lightScene(root, first, lampLight);
  const scale = description.lightmap?.scale ?? 1; // of the numbers in lightmaps
  for (const m of lit.materials) m.lightMapIntensity = 1 / scale;
  const mean = description.meanIrradiance, base = mean > 0 ? 0.18 * 2 * Math.PI / mean : 1; // the mean becomes a middle grey, with albedo 1/2

  const fineness = new Fineness(renderer.getContext());
  const state = { exposureEv: 0, bounces: 0, allBounces: 0, lightMs: 0, mixed: false, lit: 0, frames: 0, framesPerSecond: 0, live: false };
  const sky = { color: [1, 1, 1], factor: 1 }, emission = new Map(emissive(lit).map(({ number }) => [number, [1, 1, 1]]));
  let dirty = true, lampsChanged = true, failure = '', shown = first, fps = { frames: 0, since: performance.now() };
  const draw = () => { dirty = true; };

  // Bounced light.
  const live = description.lightmap ? liveLightmap(description.lightmap.width, description.lightmap.height) : null;
  const light = startLiveLight({ wasm: new URL('limn_runtime.wasm', location.href).href, file: new URL(description.transport, location.href).href,
    bytes: description.transportBytes, mapScale: scale, maxLights }, {
    progress(share) {
      tell(share < 1 ? `Moving light: ${megabytes(share * description.transportBytes)} of ${megabytes(description.transportBytes)} MB` :
        'Preparing moving light', share);
    },
    lit(result) {
      if (!state.live) tell('');
      Object.assign(state, { live: true, lightMs: result.ms, mixed: result.mixed, allBounces: state.allBounces + result.bounces - (result.serial === state.serial ? state.bounces : 0),
        bounces: result.bounces, serial: result.serial, lit: state.lit + 1 });
      result.harmonics.forEach((list, k) => lit.grid[k].show(list));
      if (live && result.serial > 1) { // until something changes, the first map is as good or better
        light.done(live.show(result.buffer));
        if (shown !== live.map) for (const m of lit.materials) if (m.lightMap) m.lightMap = live.map;
        shown = live.map;
      } else light.done(result.buffer);
      draw();
    },
    failed(text) {
      failure = `Light does not move: ${text}`;
      tell(failure);
      console.error(text);
    },
  });
  const lamps = [];
  const sendLights = () => {
    lampsChanged = true;
    light.send({ lights: lamps.flatMap((l) => l.lights), sky: sky.color.map((v) => v * sky.factor), emission: [...emission],
      gridPoints: lit.grid.map((g) => g.point) });
    draw();
  };

  const camera = new THREE.PerspectiveCamera(45, 1, extent * 1e-3, extent * 8), orbit = new OrbitControls(camera, canvas);
  const wanted = placeCamera(camera, orbit.target, view);
  orbit.addEventListener('change', draw);
  orbit.update();

  // Lamps: those of the file, and those that visitors add.
  const rowsOfView = group(controls, 'View', { open: innerWidth > 600 });
  slider(rowsOfView.body, 'Exposure', -8, 8, 0, (v) => `${v >= 0 ? '+' : ''}${v.toFixed(1)} EV`, (v) => { state.exposureEv = v; draw(); });
  if (description.sky.some((v) => v > 0)) {
    const change = () => {
      scene.background = new THREE.Color(...description.sky.map((v, k) => v * sky.color[k] * sky.factor));
      draw();
    };
    const rows = group(controls, 'Sky', { open: innerWidth > 600 });
    color(rows.body, 'Tint', THREE, [1, 1, 1], (rgb) => { sky.color = rgb; change(); sendLights(); });
    slider(rows.body, 'Strength', 0, 4, 1, (v) => `× ${v.toFixed(2)}`, (v) => { sky.factor = v; change(); sendLights(); });
    change();
  }
  const changeLamp = (lamp) => { lamp.update(); sendLights(); };
  const removeLamp = (lamp) => {
    lamps.splice(lamps.indexOf(lamp), 1);
    lamp.object.removeFromParent();
    handles.choose(null);
    list.list(lamps);
    sendLights();
  };
  const strengthHere = Math.max(1e-6, mean * extent * extent / 8);
  let added = fileLights.length;
  const addLamp = (position = camera.position.clone().lerp(orbit.target, 0.6)) => {
    if (lamps.flatMap((l) => l.lights).length >= maxLights) return null;
    const lamp = makeLamp(`Lamp ${++added}`, [pointLight(position.toArray(), strengthHere, added)], extent);
    lamps.push(lamp);
    scene.add(lamp.object);
    list.list(lamps);
    handles.choose(lamp);
    sendLights();
    return lamp;
  };
  const hint = element('hint');
  const handles = lampHandles({ canvas, camera, orbit, root, extent, lamps: () => lamps }, {
    held(lamp) { list.hold(lamp); draw(); },
    moved: sendLights,
    placed(position) {
      hint.hidden = true;
      if (position) addLamp(position);
    },
    removed: removeLamp,
  });
  const place = () => {
    hint.textContent = lamps.flatMap((l) => l.lights).length >= maxLights ? `There can be ${maxLights} lamps` :
      `${matchMedia('(pointer: coarse)').matches ? 'Tap' : 'Click'} where the lamp shall be`;
    hint.hidden = false;
    if (innerWidth <= 600) element('light').open = false;
    handles.place();
  };
  button(controls, 'Add a lamp', place);
  const list = lampPanel(controls, changeLamp, removeLamp);
  glowPanel(controls, emissive(lit), (number, rgb) => { emission.set(number, rgb); sendLights(); });
  lamps.push(...lampsOf(fileLights, JSON.parse(description.meta).lights, extent));
  for (const lamp of lamps) scene.add(lamp.object);
  list.list(lamps);
  sendLights();

  const resize = () => {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * fineness.share);
    renderer.setSize(innerWidth, innerHeight);
    const isPhone = innerWidth <= 600, isOpen = element('light').open;
    frameView(camera, wanted, innerWidth, innerHeight, isPhone || !isOpen ? 0 : panel.offsetWidth, isPhone ? panel.offsetHeight : 0);
    draw();
  };
  message.remove();
  panel.hidden = false;
  if (innerWidth <= 600) element('light').open = false;
  addEventListener('resize', resize);
  element('light').addEventListener('toggle', resize);
  resize();

  const sentence = () => {
    const { latest } = light, speed = `${short(state.lightMs)} ms ${state.mixed ? 'for all bounces' : 'per bounce'}` +
      (state.framesPerSecond > 0 ? ` · ${short(state.framesPerSecond)} frames/s` : '');
    return latest?.early ? `Stopped after ${latest.bounces} bounces: ${(100 * latest.missing).toFixed(1)} % of light may be missing` : speed;
  };
  function frame(now) {
    const ready = fineness.ready(now);
    if (ready && fineness.changed(now)) {
      resize();
      lampsChanged = true;
    }
    if (ready && lampsChanged) {
      lampsChanged = false;
      lampLight.update(lamps, fineness.share < 1);
    }
    if (ready && dirty) {
      dirty = false;
      renderer.toneMappingExposure = base * 2 ** state.exposureEv;
      renderer.render(scene, camera);
      fineness.drawn(now);
      ++state.frames;
      ++fps.frames;
    }
    if (now - fps.since > 500) {
      state.framesPerSecond = fps.frames * 1000 / (now - fps.since);
      fps = { frames: 0, since: now };
      if (state.live && !failure) tell(sentence());
    }
    requestAnimationFrame(frame);
  }
  requestAnimationFrame(frame);
  // For scripts that drive the page.
  window.limn = { THREE, scene, camera, orbit, renderer, lamps, lampLight, light, state, wanted, addLamp, removeLamp, sendLights, draw,
    lightmap: () => shown, settled: () => light.settled() && !dirty && !lampsChanged && !fineness.fence };
}

start().catch((error) => {
  message.textContent = `This page cannot show its scene.\n${error.message}`;
  console.error(error);
});
