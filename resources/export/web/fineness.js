// SPDX-License-Identifier: MIT
// How finely a frame is drawn. While a visitor drags and the graphics card is slow, frames have fewer pixels; the picture at rest has all.

const kSlow = 45, kFast = 25, kGoal = 33; // ms that a frame takes
const kLeast = 0.3; // of the pixels along each side
const kRest = 300, kLost = 2000; // ms

export class Fineness {
  constructor(gl) {
    Object.assign(this, { gl, share: 1, known: 1, shown: 1, down: false, latest: -Infinity, fence: null, begun: 0 });
    for (const end of ['pointerup', 'pointercancel']) addEventListener(end, () => { this.down = false; this.latest = performance.now(); });
    addEventListener('pointerdown', () => {
      this.down = true;
      this.latest = performance.now();
      this.share = this.known;
    });
  }

  /** Whether the card is done with the frame before. */
  ready(now) {
    if (!this.fence) return true;
    const done = this.gl.getSyncParameter(this.fence, this.gl.SYNC_STATUS) === this.gl.SIGNALED, ms = now - this.begun;
    if (!done && ms < kLost) return false;
    this.gl.deleteSync(this.fence);
    this.fence = null;
    if (!this.down && this.shown === 1) this.known = ms > kSlow ? Math.max(kLeast, Math.sqrt(kGoal / ms)) : 1; // for the next drag
    if (!this.down) return true;
    if (ms > kSlow) this.share = Math.max(kLeast, this.share * Math.max(0.5, Math.sqrt(kGoal / ms)));
    else if (ms < kFast) this.share = Math.min(1, this.share * 1.1);
    this.known = this.share;
    return true;
  }

  /** Whether `share` is another than at the call before. */
  changed(now) {
    if (!this.down && now - this.latest > kRest) this.share = 1;
    const is = this.share !== this.shown;
    this.shown = this.share;
    return is;
  }

  /** A frame has been drawn, which began at `now`. */
  drawn(now) {
    this.begun = now;
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }
}
