// On every page: offers the playground and the search, ticks what has been solved, and puts what scrolls in the keyboard's reach. What they need is fetched when asked for.

import { reading } from "./page/reading.js";
import { theme } from "./page/theme.js";
import { tiles } from "./page/tiles.js";

const own = /** @type {HTMLScriptElement} */ (document.currentScript);
const base = new URL(".", own.src);
const KEY = "mujoco-clinic"; // as in page/solved.js and page/kept.js
const CHOICES = `<label class="md-button">Choose files<input type="file" multiple accept=".xml,.mjcf,.urdf,.zip,.stl,.obj,.msh,.png"></label>
<label class="md-button">Choose a folder<input type="file" webkitdirectory></label>
<label>What do you see? <select><option value="">not sure</select></label>`;
const SEARCH = new URL("../search/", base).href;
const SITE = new URL("../../", base).href;
/** @type {Map<string, Promise<void>>} */
const scripts = new Map();
const scrolls = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target.scrollWidth > target.clientWidth) target.setAttribute("tabindex", "0");
    else target.removeAttribute("tabindex");
  }
});

/** @param {string} address @returns {Promise<void>} when the script has run; a module would not be fetched from a file */
function script(address) {
  const begun =
    scripts.get(address) ??
    new Promise((done, failed) => {
      document.head.append(Object.assign(document.createElement("script"), { src: address, onload: () => done(), onerror: failed }));
    });
  scripts.set(address, begun);
  begun.catch(() => scripts.delete(address)); // it can be tried again
  return begun;
}

async function searching() {
  await script(SEARCH + "index.js");
  await script(base + "search.js");
}

/** @param {HTMLFormElement} form a search box */
function listen(form) {
  const input = /** @type {HTMLInputElement} */ (form.querySelector("input"));
  input.oninput = async () => {
    input.oninput = null;
    try {
      await searching();
      clinicSearch(form, SITE, (name) => script(SEARCH + name));
    } catch {
      const place = /** @type {HTMLElement} */ (form.querySelector(".search-results"));
      place.textContent = "The search could not be fetched. Are you offline? The next letter tries again.";
      place.hidden = false;
      listen(form);
    }
  };
}

/** @param {HTMLElement} link an example, which is asked in the box above it */
function example(link) {
  link.onclick = (event) => {
    event.preventDefault();
    const input = /** @type {HTMLInputElement} */ (document.querySelector(".search-home input"));
    input.value = link.textContent ?? "";
    input.focus();
    input.dispatchEvent(new Event("input"));
  };
}

/** @param {HTMLElement} line tells which page the reader may have meant */
async function guess(line) {
  await searching();
  const found = clinicNearest(location.pathname);
  if (!found) return;
  const link = /** @type {HTMLAnchorElement} */ (line.querySelector("a"));
  [link.href, link.textContent] = [new URL(found.at, SITE).href, found.title];
  line.hidden = false;
}

addEventListener("keydown", (event) => {
  if (event.key !== "/" || event.ctrlKey || event.metaKey || (event.target instanceof Element && event.target.closest("input, textarea, select, [contenteditable]"))) return;
  event.preventDefault();
  /** @type {HTMLElement | null} */ (document.querySelector(".search input"))?.focus();
});

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

/** Whether the reader comes back to a text that was edited here: after a reload, or with the browser's button. */
function left() {
  const [, slug] = /([^/]+)\/[^/]*$/.exec(location.pathname) ?? [];
  const [entry] = performance.getEntriesByType("navigation");
  try {
    return /** @type {PerformanceNavigationTiming} */ (entry).type !== "navigate" && `${KEY}-draft:${slug}` in localStorage;
  } catch {
    return false;
  }
}

/** @param {HTMLElement} root */
function offer(root) {
  const note = /** @type {HTMLElement} */ (root.querySelector("p"));
  const button = /** @type {HTMLButtonElement} */ (root.querySelector(".md-button"));
  if (!self.WebAssembly || !self.WebGL2RenderingContext || !self.DecompressionStream || location.protocol === "file:") return;
  const words = note.textContent;
  note.hidden = true;
  button.hidden = false;
  button.onclick = async () => {
    button.disabled = true;
    try {
      const { mount } = await import(base + (root.dataset.module ?? "start.js"));
      await mount(root, base);
    } catch (error) {
      console.error(error);
      const away = error instanceof TypeError || error instanceof Event; // what a fetch fails with
      note.textContent = away ? "The playground could not be fetched. Are you offline? The button tries again." : words;
      button.disabled = note.hidden = false;
      button.hidden = !away;
    }
  };
  if (location.hash.startsWith("#model=") || left()) button.click();
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
  /** @type {(FileSystemEntry | File)[] | undefined} */
  let last;
  const given = async (/** @type {(FileSystemEntry | File)[]} */ files) => {
    last = files;
    try {
      const { start } = await import(base + "diagnose.js");
      await start(place, base, root.dataset.rules, seen.value, files);
    } catch (error) {
      console.error(error);
      note.hidden = false;
    }
  };
  seen.onchange = () => last && given(last);
  form.onchange = async ({ target }) => {
    if (!(target instanceof HTMLInputElement) || !target.files?.length) return;
    await given([...target.files]);
    target.value = ""; // the same file can be chosen again
  };
  form.ondragover = (event) => event.preventDefault();
  form.ondrop = (event) => {
    event.preventDefault();
    const items = [...(event.dataTransfer?.items ?? [])].map((item) => item.webkitGetAsEntry() ?? item.getAsFile()); // gone in a moment
    void given(items.filter((item) => item !== null));
  };
}

/** @param {Element} code @returns {HTMLElement} in the theme's clothes */
function copier(code) {
  const place = Object.assign(document.createElement("span"), { className: "md-code__nav" });
  const button = Object.assign(document.createElement("button"), { className: "md-code__button", type: "button", title: "Copy" });
  button.dataset.mdType = "copy";
  button.onclick = async () => {
    await navigator.clipboard.writeText(/** @type {HTMLElement | null} */ (code.closest("[data-copy]"))?.dataset.copy ?? (code.textContent ?? "").trimEnd());
    button.title = "Copied";
    button.classList.add("md-code__button--active");
  };
  button.onblur = () => {
    button.title = "Copy";
    button.classList.remove("md-code__button--active");
  };
  place.append(button);
  return place;
}

/** Puts what scrolls in the keyboard's reach. */
function reach() {
  for (const wide of document.querySelectorAll(".md-typeset table, .md-typeset__scrollwrap, .md-typeset pre > code, .md-typeset .formula")) scrolls.observe(wide);
}

function copiers() {
  if (!navigator.clipboard) return;
  for (const code of document.querySelectorAll(".highlight pre > code:first-child")) code.before(copier(code));
}

reach();
copiers();
tick();
tiles();
reading();
theme(async () => {
  await script(own.dataset.theme ?? "");
  document.dispatchEvent(new Event("DOMContentLoaded")); // which it waits for
  reach(); // it has wrapped tables
});
for (const form of /** @type {NodeListOf<HTMLFormElement>} */ (document.querySelectorAll("form.search"))) listen(form);
for (const link of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("a[data-ask]"))) example(link);
const nearest = /** @type {HTMLElement | null} */ (document.querySelector(".nearest"));
if (nearest) void guess(nearest);
const root = /** @type {HTMLElement | null} */ (document.querySelector(".playground"));
if (root) offer(root);
const reader = /** @type {HTMLElement | null} */ (document.querySelector(".diagnose"));
if (reader) take(reader);
