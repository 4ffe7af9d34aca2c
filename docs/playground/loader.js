// On every page: offers the playground, and ticks what has been solved. The playground itself is fetched on a click.

const base = new URL(".", /** @type {HTMLScriptElement} */ (document.currentScript).src);
const KEY = "mujoco-clinic"; // as in page/solved.js
const CHOICES = `<label class="md-button">Choose files<input type="file" multiple accept=".xml,.mjcf,.urdf,.zip,.stl,.obj,.msh,.png"></label>
<label class="md-button">Choose a folder<input type="file" webkitdirectory></label>
<label>What do you see? <select><option value="">not sure</select></label>`;
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

/** @param {HTMLElement} root where a reader's own model is taken */
function take(root) {
  const [note, form, place] = /** @type {HTMLElement[]} */ ([...root.children]);
  if (!self.WebAssembly || !self.DecompressionStream || location.protocol === "file:") return;
  note.hidden = true;
  form.hidden = false;
  form.children[1].innerHTML = CHOICES;
  const seen = /** @type {HTMLSelectElement} */ (form.querySelector("select"));
  for (const each of root.dataset.symptoms?.split("|") ?? []) seen.add(new Option(...each.split(": ").reverse()));
  const given = async (/** @type {Iterable<FileSystemEntry | File>} */ files) => {
    try {
      const { start } = await import(base + "diagnose.js");
      await start(place, base, new URL(root.dataset.rules ?? "", location.href).href, seen.value, files);
    } catch (error) {
      console.error(error);
      note.hidden = false;
    }
  };
  form.onchange = async ({ target }) => {
    if (!(target instanceof HTMLInputElement) || !target.files?.length) return;
    await given(target.files);
    target.value = ""; // the same file can be chosen again
  };
  form.ondragover = (event) => event.preventDefault();
  form.ondrop = (event) => {
    event.preventDefault();
    const items = [...(event.dataTransfer?.items ?? [])].map((item) => item.webkitGetAsEntry() ?? item.getAsFile()); // gone in a moment
    void given(items.filter((item) => item !== null));
  };
}

document$.subscribe(() => {
  leave();
  leave = () => {};
  tick();
  const root = document.querySelector(".playground");
  if (root) offer(root);
  const reader = /** @type {HTMLElement | null} */ (document.querySelector(".diagnose"));
  if (reader && !reader.querySelector("input")) take(reader);
});
