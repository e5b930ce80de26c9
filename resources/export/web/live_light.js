// SPDX-License-Identifier: MIT
// The page's side of live_worker.js.

/**
 * Begins to load the transport. `heard` has progress(share), lit(result), whose buffer goes back by done(), and failed(text).
 * Changes that are sent before the transport is there are made when it is. `kept` of the result is how many sources' light is kept, and of
 * how many.
 */
export function startLiveLight(options, heard) {
  const worker = new Worker(new URL('./live_worker.js', import.meta.url), { type: 'module' });
  const light = {
    serial: 0, live: false, openMs: 0, latest: null, kept: [0, 0],
    /** `state`: lights, sky, emission and gridPoints, as live_worker.js takes them. */
    send(state) { worker.postMessage({ state: { ...state, serial: ++light.serial } }); },
    done(buffer) { worker.postMessage({ buffer }, [buffer]); },
    /** Whether the latest result shows what was sent last, with all its bounces. */
    settled() { return light.latest !== null && light.latest.serial === light.serial && light.latest.ended; },
  };
  worker.onmessage = ({ data }) => {
    if (data.progress !== undefined) heard.progress(data.progress);
    if (data.ready) light.openMs = data.ready.openMs;
    if (data.lit) {
      light.live = true;
      light.latest = data.lit;
      heard.lit(data.lit);
    }
    if (data.kept) light.kept = data.kept;
    if (data.error) heard.failed(data.error);
  };
  worker.onerror = (event) => heard.failed(event.message ?? 'The thread of bounces has ended');
  worker.postMessage({ open: options });
  return light;
}
