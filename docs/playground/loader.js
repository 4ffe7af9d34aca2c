// On every page: offers the playground, and ticks what has been solved. The playground itself is fetched on a click.

const base = new URL(".", /** @type {HTMLScriptElement} */ (document.currentScript).src);
const KEY = "mujoco-clinic"; // as in page/solved.js
let leave = () => {};

/** @returns {string[]} */
function solved() {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? "[]");
  } catch {
    return [];
  }
}

function tick() {
  const slugs = solved();
  for (const card of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(".case[data-case]"))) {
    card.toggleAttribute("data-solved", slugs.includes(card.dataset.case ?? ""));
  }
  const forget = /** @type {HTMLButtonElement | null} */ (document.querySelector(".forget"));
  if (!forget) return;
  forget.hidden = slugs.length === 0;
  forget.onclick = () => {
    localStorage.removeItem(KEY);
    tick();
  };
}

/** @param {Element} root */
function offer(root) {
  const [note, button] = /** @type {[HTMLElement, HTMLButtonElement]} */ ([...root.children]);
  if (!self.WebAssembly || !self.WebGL2RenderingContext || !self.DecompressionStream || location.protocol === "file:") return;
  note.hidden = true;
  button.hidden = false;
  button.onclick = async () => {
    button.disabled = true;
    try {
      const { mount } = await import(base + "start.js");
      const left = await mount(root, base);
      if (root.isConnected) leave = left;
      else left();
    } catch (error) {
      console.error(error);
      note.hidden = false;
      button.hidden = true;
    }
  };
  if (location.hash.startsWith("#model=")) button.click();
}

document$.subscribe(() => {
  leave();
  leave = () => {};
  tick();
  const root = document.querySelector(".playground");
  if (root) offer(root);
});
