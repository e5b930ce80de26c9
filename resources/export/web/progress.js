// SPDX-License-Identifier: MIT
// Downloads that say how far they are.

/** The bytes at `url`; calls `report` with the number that has arrived. */
export async function download(url, report = () => {}) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  const reader = answer.body.getReader(), parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    size += value.length;
    report(size);
  }
  const bytes = new Uint8Array(size);
  parts.reduce((at, part) => { bytes.set(part, at); return at + part.length; }, 0);
  return bytes;
}

/** "4.2" of 4 200 000 bytes. */
export const megabytes = (bytes) => (bytes / 1e6).toFixed(1);

/** A bar under a line of text: a share in [0, 1], or none. */
export function progressBar(bar, text) {
  return (what, share) => {
    text.textContent = what;
    bar.hidden = share === undefined;
    if (share !== undefined) bar.value = share;
  };
}
