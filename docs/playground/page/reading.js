// On a case's page: tells the answer or keeps it, as the reader chose, and runs the film while it is in sight.

const WAY = "mujoco-clinic-way"; // how a case is read: `answer` or `puzzle`
const ENGINES = /^https?:\/\/([\w-]+\.)*(google|bing|duckduckgo|ecosia|yahoo|yandex|baidu|kagi|startpage|qwant|search\.brave)\.[a-z]{2,3}(\.[a-z]{2})?(\/|$)/;
let searched = ENGINES.test(document.referrer); // with a search engine: true on the first page alone

export function reading() {
  const tell = /** @type {HTMLDetailsElement | null} */ (document.querySelector(".answer"));
  if (tell) choose(tell);
  const film = /** @type {HTMLElement | null} */ (document.querySelector(".film"));
  if (film) run(film);
  searched = false;
}

addEventListener("hashchange", () => {
  const tell = /** @type {HTMLDetailsElement | null} */ (document.querySelector(".answer"));
  if (tell && location.hash === "#answer") unfold(tell, true);
});

/** @param {HTMLDetailsElement} tell the answer of a case: opens and closes all folds with it, and keeps the choice */
function choose(tell) {
  if (location.hash === "#answer" || (way() ?? (searched && "answer")) === "answer") unfold(tell, true);
  /** @type {HTMLElement} */ (tell.querySelector("summary")).onclick = (event) => {
    event.preventDefault();
    unfold(tell, !tell.open);
    try {
      localStorage.setItem(WAY, tell.open ? "answer" : "puzzle");
    } catch {} // it is not kept then
  };
}

/** @returns {string | null} the way that was chosen */
function way() {
  try {
    return localStorage.getItem(WAY);
  } catch {
    return null;
  }
}

/** @param {HTMLDetailsElement} tell @param {boolean} open */
function unfold(tell, open) {
  for (const fold of tell.parentElement?.querySelectorAll("details") ?? []) fold.open = open;
}

/** @param {HTMLElement} film runs while it is in sight; for who asks for less motion, when told to */
function run(film) {
  const video = /** @type {HTMLVideoElement} */ (film.querySelector("video"));
  const press = /** @type {HTMLButtonElement} */ (film.querySelector("button"));
  let wanted = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  const go = (/** @type {boolean} */ on) => void (on ? video.play().catch(() => {}) : video.pause()); // what cannot be played stays a still
  new IntersectionObserver(([{ isIntersecting }]) => go(isIntersecting && wanted), { threshold: 0.5 }).observe(video);
  press.hidden = false;
  press.onclick = () => go((wanted = video.paused));
  video.onplay = video.onpause = () => {
    press.textContent = video.paused ? "Play" : "Pause";
  };
}
