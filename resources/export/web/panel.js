// SPDX-License-Identifier: MIT
// The page's small panel: rows that change a value and say so.

function row(parent, label, ...widgets) {
  const line = document.createElement('label'), text = document.createElement('span');
  text.textContent = label;
  line.append(text, ...widgets);
  parent.append(line);
  return line;
}

/**
 * A group of rows that folds, under `title`, which is cut off where it is too long; `full` is all of it. `fill(body)` is called when it
 * is first unfolded.
 */
export function group(parent, title, { open = false, full = title, fill } = {}) {
  const set = document.createElement('details'), head = document.createElement('summary'), body = document.createElement('div');
  const name = document.createElement('span'), count = document.createElement('span');
  name.className = 'name';
  name.textContent = title;
  name.title = full;
  count.className = 'count';
  head.append(name, count);
  set.append(head, body);
  parent.append(set);
  let filled = !fill;
  const unfold = () => { if (set.open && !filled) { filled = true; fill(body); } };
  set.addEventListener('toggle', unfold);
  set.open = open;
  unfold();
  return { set, body, open() { set.open = true; unfold(); }, count(n) { count.textContent = n; } };
}

/** A slider over [lower, upper]. `text` shows a value with its unit. */
export function slider(parent, label, lower, upper, value, text, changed) {
  const input = document.createElement('input'), output = document.createElement('output');
  Object.assign(input, { type: 'range', min: lower, max: upper, step: (upper - lower) / 400, value });
  input.setAttribute('aria-label', label);
  output.textContent = text(value);
  input.addEventListener('input', () => { output.textContent = text(+input.value); changed(+input.value); });
  row(parent, label, input, output);
}

/** A linear colour of the brightest channel 1. */
export function color(parent, label, THREE, rgb, changed) {
  const input = document.createElement('input'), most = Math.max(...rgb, 1e-30);
  Object.assign(input, { type: 'color', value: '#' + new THREE.Color(...rgb.map((v) => v / most)).getHexString() });
  input.setAttribute('aria-label', label);
  input.addEventListener('input', () => changed(new THREE.Color(input.value).toArray()));
  row(parent, label, input);
}

export function toggle(parent, label, on, changed) {
  const input = document.createElement('input');
  Object.assign(input, { type: 'checkbox', checked: on });
  input.addEventListener('change', () => changed(input.checked));
  row(parent, label, input);
}

export function button(parent, label, pressed, kind = 'wide') {
  const b = document.createElement('button');
  b.type = 'button';
  b.className = kind;
  b.textContent = label;
  b.addEventListener('click', pressed);
  parent.append(b);
  return b;
}

/** Four significant digits at most. */
export const short = (v) => Number(v.toPrecision(3)).toString();
