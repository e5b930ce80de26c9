// SPDX-License-Identifier: MIT
// The panel's groups of lamps and of what glows. Lamps are grouped by their names without numbers.
import * as THREE from 'three';
import { button, color, group, short, slider, toggle } from './panel.js';
import { LightKind } from './transport.js';

const unit = (kind) => kind === LightKind.directional ? 'lx' : kind === LightKind.rectangle ? 'nt' : 'cd';
const stem = (name) => name.replace(/[\s._-]*\d+$/, '') || name;

/** Rows of one lamp. `changed(lamp)` follows each change, `removed(lamp)` the button. */
function lampRows(rows, lamp, changed, removed) {
  const first = lamp.lights[0], most = Math.max(...first.color, 1e-30);
  const each = (change) => { lamp.lights.forEach(change); changed(lamp); };
  toggle(rows, 'On', first.on, (on) => each((l) => { l.on = on; }));
  color(rows, 'Colour', THREE, first.color, (rgb) => each((l) => { l.color = rgb.map((v) => v * most); }));
  const decades = Math.log10(Math.max(first.strength, 1e-3));
  slider(rows, 'Strength', decades - 2, decades + 2, decades, (v) => `${short(10 ** v)} ${unit(first.kind)}`,
    (v) => each((l) => { l.strength = 10 ** v; }));
  if (first.kind === LightKind.directional) {
    const turn = { azimuth: Math.atan2(first.direction[0], first.direction[2]), height: Math.asin(-first.direction[1]) };
    const degrees = (v) => `${Math.round(v)}°`;
    const aim = () => each((l) => {
      l.direction = [Math.sin(turn.azimuth) * Math.cos(turn.height), -Math.sin(turn.height), Math.cos(turn.azimuth) * Math.cos(turn.height)];
    });
    slider(rows, 'Azimuth', -180, 180, turn.azimuth * 180 / Math.PI, degrees, (v) => { turn.azimuth = v * Math.PI / 180; aim(); });
    slider(rows, 'Height', -90, 90, turn.height * 180 / Math.PI, degrees, (v) => { turn.height = v * Math.PI / 180; aim(); });
  }
  button(rows, 'Remove', () => removed(lamp), 'quiet');
}

/** The group "Lamps" in `parent`. list(lamps) brings it up to date, hold(lamp) unfolds one. */
export function lampPanel(parent, changed, removed) {
  const all = group(parent, 'Lamps', { open: true }), items = new Map();
  let unfolded = null; // by hold()
  return {
    list(lamps) {
      all.count(lamps.length);
      const stems = new Map();
      for (const lamp of lamps) stems.set(stem(lamp.name), [...(stems.get(stem(lamp.name)) ?? []), lamp]);
      const opened = new Set([...items].filter(([, item]) => item.set.open).map(([lamp]) => lamp));
      all.body.replaceChildren();
      items.clear();
      if (lamps.length === 0) {
        const none = document.createElement('p');
        none.className = 'none';
        none.textContent = 'There are no lamps yet.';
        all.body.append(none);
      }
      for (const [name, list] of stems) {
        const parts = stems.size > 1 && list.length > 1 ? group(all.body, name, { open: list.some((l) => opened.has(l)) || lamps.length < 8 }) : all;
        if (parts !== all) parts.count(list.length);
        for (const lamp of list) items.set(lamp, Object.assign(group(parts.body, lamp.name,
          { open: opened.has(lamp) || lamps.length === 1 && lamp.handle === null, fill: (rows) => lampRows(rows, lamp, changed, removed) }), { parts }));
      }
    },
    hold(lamp) {
      for (const [each, item] of items) item.set.classList.toggle('held', each === lamp);
      const item = items.get(lamp);
      if (!item) return;
      if (unfolded && unfolded !== lamp && items.has(unfolded)) items.get(unfolded).set.open = false;
      if (!item.set.open) unfolded = lamp;
      all.open();
      item.parts.open();
      item.open();
      item.set.scrollIntoView({ block: 'nearest' });
    },
  };
}

/** The group "Glowing objects": one entry for each material that emits light, under the names of its objects. */
export function glowPanel(parent, emissive, changed) {
  if (emissive.length === 0) return;
  const all = group(parent, 'Glowing objects', { open: emissive.length < 4 });
  all.count(emissive.length);
  for (const { number, materials, objects } of emissive) {
    const base = materials.map((m) => m.emissive.clone()), glow = { color: [1, 1, 1], factor: 1 };
    const named = objects.length > 0 ? objects : [materials[0].name || `Material ${number}`];
    const title = named.length > 2 ? `${named[0]} and ${named.length - 1} more` : named.join(', ');
    const change = () => {
      const rgb = glow.color.map((v) => v * glow.factor);
      materials.forEach((m, k) => m.emissive.setRGB(base[k].r * rgb[0], base[k].g * rgb[1], base[k].b * rgb[2]));
      changed(number, rgb);
    };
    group(all.body, title, { open: emissive.length === 1, full: named.join(', '), fill: (rows) => {
      color(rows, 'Tint', THREE, [1, 1, 1], (rgb) => { glow.color = rgb; change(); });
      slider(rows, 'Glow', 0, 4, 1, (v) => `× ${v.toFixed(2)}`, (v) => { glow.factor = v; change(); });
    } });
  }
}
