// The pointer on the canvas: drag to turn the view, pinch or Ctrl and wheel to zoom, drag to pull a body.

/** @import {Scene} from "./scene.js" */

const TURN = 0.008; // rad a pixel

/**
 * @typedef {object} Pull
 * @property {() => boolean} wanted whether a drag pulls
 * @property {(ray: {origin: number[], direction: number[]}) => void} grab
 * @property {() => number[] | null} held the point of the world that is held
 * @property {(point: number[]) => void} drag
 * @property {() => void} release
 */

/**
 * @param {HTMLCanvasElement} canvas
 * @param {Scene} scene
 * @param {Pull} pull
 */
export function listenToPointer(canvas, scene, pull) {
  /** @type {Map<number, PointerEvent>} */
  const down = new Map();
  let pulling = false;

  const place = (/** @type {PointerEvent} */ event) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return /** @type {const} */ ([(2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height]);
  };
  const spread = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, event);
    if (down.size > 1 || !(pull.wanted() || event.ctrlKey || event.metaKey)) return;
    pulling = true;
    pull.grab(scene.ray(...place(event)));
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const held = pull.held();
    if (pulling) {
      if (held) pull.drag(scene.pointAt(...place(event), held));
    } else if (down.size === 2) {
      const was = spread();
      down.set(event.pointerId, event);
      scene.camera.approach(was / Math.max(spread(), 1));
      scene.render();
    } else {
      scene.camera.orbit(TURN * (event.clientX - before.clientX), TURN * (event.clientY - before.clientY));
      scene.render();
    }
    down.set(event.pointerId, event);
  });
  const up = (/** @type {PointerEvent} */ event) => {
    down.delete(event.pointerId);
    if (!pulling || down.size > 0) return;
    pulling = false;
    pull.release();
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey) return; // a wheel alone scrolls the page
      event.preventDefault();
      scene.camera.approach(Math.exp(0.002 * event.deltaY));
      scene.render();
    },
    { passive: false },
  );
}
