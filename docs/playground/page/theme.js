// The theme's own script: what it does, it does for who moves, so it is fetched when the reader first does.

const MOVES = ["pointermove", "pointerdown", "touchstart", "wheel", "scroll", "keydown"];

/** @param {() => Promise<void>} fetched fetches the theme's script and runs it */
export function theme(fetched) {
  /** @type {Promise<void> | null} */
  let begun = null;
  const begin = () => {
    for (const move of MOVES) removeEventListener(move, begin);
    return (begun ??= fetched().catch(console.error));
  };
  for (const move of MOVES) addEventListener(move, begin, { passive: true });
  colours(begin);
  seen();
}

/** Shows the switch of the colours, and hands to the theme what was chosen before it was there. @param {() => Promise<void>} begin */
function colours(begin) {
  const form = document.querySelector("[data-md-component=palette]");
  const inputs = /** @type {HTMLInputElement[]} */ ([...(form?.querySelectorAll("input") ?? [])]);
  const now = inputs.find((input) => input.dataset.mdColorScheme === document.body.dataset.mdColorScheme);
  if (now) /** @type {HTMLElement} */ (now.nextElementSibling).hidden = false;
  const early = (/** @type {Event} */ { target }) => {
    for (const input of inputs) input.removeEventListener("change", early);
    void begin().then(() => target?.dispatchEvent(new Event("change")));
  };
  for (const input of inputs) input.addEventListener("change", early);
}

/** Brings the page's own place in the list of pages into sight. */
function seen() {
  const link = /** @type {HTMLElement | null} */ (document.querySelector(".md-sidebar--primary .md-nav__link--active[href]"));
  const list = /** @type {HTMLElement | null} */ (link?.closest(".md-sidebar__scrollwrap"));
  if (link && list) list.scrollTop = link.offsetTop - list.offsetTop - list.clientHeight / 2;
}
