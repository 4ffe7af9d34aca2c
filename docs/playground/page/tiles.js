// The first page's tiles: each shows two seconds of its failure when asked or in sight, and shows the cards of its symptom alone.

const still = matchMedia("(prefers-reduced-motion: reduce)");
const pointed = matchMedia("(hover: hover)");
/** @returns {HTMLAnchorElement[]} */
const all = () => [...document.querySelectorAll(/** @type {"a"} */ (".tile[data-family]"))];
const seen = new IntersectionObserver(
  (entries) => {
    for (const { target, isIntersecting } of entries) (isIntersecting ? play : stop)(/** @type {HTMLElement} */ (target));
  },
  { rootMargin: "-25% 0px", threshold: 1 },
);
addEventListener("hashchange", () => choose());
addEventListener("click", ({ target }) => {
  const link = target instanceof Element && target.closest(".tile, .chosen a");
  if (link instanceof HTMLAnchorElement && link.hash) setTimeout(choose, 0, link.hash); // of a page that the theme put in, no hashchange tells
});

/** Without scripts a tile leads to the page of its symptom. */
export function tiles() {
  for (const tile of all()) {
    if (tile.dataset.page) continue;
    tile.dataset.page = tile.getAttribute("href") ?? "";
    tile.onpointerenter = tile.onfocus = () => play(tile);
    tile.onpointerleave = tile.onblur = () => stop(tile);
    if (!pointed.matches) seen.observe(tile);
  }
  choose();
}

/** @param {HTMLElement} tile */
function play(tile) {
  const place = tile.querySelector(".tile-picture");
  if (!tile.dataset.film || !place || still.matches || place.querySelector("video")) return;
  const film = Object.assign(document.createElement("video"), { muted: true, loop: true, playsInline: true, src: tile.dataset.film });
  film.setAttribute("aria-hidden", "true");
  film.onplaying = () => film.classList.add("plays");
  place.append(film);
  film.play().catch(() => film.remove()); // the browser saves power, or there is no network
}

/** @param {HTMLElement} tile */
function stop(tile) {
  if (tile.matches(":hover, :focus-visible")) return;
  tile.querySelector("video")?.remove();
}

/** Shows the cards of the symptom that the address names, or all of them. @param {string} [hash] */
function choose(hash = location.hash) {
  const known = all();
  const note = /** @type {HTMLElement | null} */ (document.querySelector(".chosen"));
  if (!known.length || !note) return;
  const chosen = known.find((tile) => hash === `#${tile.dataset.family}`);
  for (const tile of known) {
    tile.href = tile === chosen ? "#cases" : `#${tile.dataset.family}`;
    if (tile === chosen) tile.setAttribute("aria-current", "true");
    else tile.removeAttribute("aria-current");
  }
  const cards = /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(".case[data-family]"));
  for (const card of cards) card.hidden = chosen !== undefined && card.dataset.family !== chosen.dataset.family;
  note.hidden = !chosen;
  if (!chosen) return;
  const count = [...cards].filter((card) => !card.hidden).length;
  note.innerHTML = '<b></b> <a>What to measure first</a> <a href="#cases">Show all cases</a>';
  /** @type {HTMLElement} */ (note.querySelector("b")).textContent = `${chosen.title}: ${count} ${count === 1 ? "case" : "cases"}.`;
  /** @type {HTMLAnchorElement} */ (note.querySelector("a")).href = chosen.dataset.page ?? "";
  document.querySelector("#cases")?.scrollIntoView({ block: "start", behavior: still.matches ? "auto" : "smooth" });
}
