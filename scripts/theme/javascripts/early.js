// Before anything is drawn: the colours that the reader or the reader's system wants, and what the theme's bundle asks for.
// It stands in the place of the theme's inline scripts, so that a page's policy can forbid every script that stands in a page.

var __md_scope = new URL(document.currentScript.dataset.base, location);
var __md_get = (key, storage = localStorage, scope = __md_scope) => JSON.parse(storage.getItem(`${scope.pathname}.${key}`));
var __md_set = (key, value, storage = localStorage, scope = __md_scope) => {
  try {
    storage.setItem(`${scope.pathname}.${key}`, JSON.stringify(value));
  } catch {} // a browser that keeps nothing
};

document.body.dataset.mdColorScheme =
  __md_get("__palette")?.color?.scheme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "slate" : "default");
