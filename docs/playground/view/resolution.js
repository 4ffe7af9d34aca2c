// How finely to draw, so that frames come in time on machines without a graphics card.

const FRAMES = 15; // whose intervals are averaged
const PAUSE = 500; // ms: a longer interval says nothing about drawing
const LATE = 34; // ms between frames
const EARLY = 20; // ms: so much below LATE that a finer picture is still in time
const PATIENCE = 4; // early averages in a row before the picture gets finer
const STEP = 0.8;
const LEAST = 0.5; // pixels a CSS pixel

/** Pixels drawn a CSS pixel: fewer where frames come late, more again where they come early. */
export class Resolution {
  /** @param {number} most pixels a CSS pixel */
  constructor(most) {
    this.most = most;
    this.ratio = most;
    this.early = 0;
    /** @type {number[]} when the last frames were drawn, in ms */
    this.times = [];
  }

  /**
   * Takes note of a frame.
   * @param {number} now in ms
   * @returns {number} pixels a CSS pixel from now on
   */
  frameDrawn(now) {
    if (now - (this.times.at(-1) ?? now) > PAUSE) this.times = [];
    this.times.push(now);
    if (this.times.length <= FRAMES) return this.ratio;
    const interval = (now - this.times[0]) / FRAMES;
    this.times = [];
    this.early = interval < EARLY ? this.early + 1 : 0;
    if (interval > LATE) this.ratio = Math.max(Math.min(LEAST, this.most), STEP * this.ratio);
    if (this.early < PATIENCE) return this.ratio;
    this.early = 0;
    this.ratio = Math.min(this.most, this.ratio / STEP);
    return this.ratio;
  }
}
