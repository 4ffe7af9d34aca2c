// While the site is served: a page that is loaded anew, after an edit, stands where it stood, with the same folds open.
(() => {
  const key = `place:${location.pathname}`;
  const folds = () => [...document.querySelectorAll("details")];
  addEventListener("pagehide", () => {
    sessionStorage.setItem(key, JSON.stringify({ top: scrollY, open: folds().map((fold) => fold.open) }));
  });
  const kept = JSON.parse(sessionStorage.getItem(key) ?? "null");
  if (kept === null || performance.getEntriesByType("navigation")[0].type !== "reload") return;
  folds().forEach((fold, i) => (fold.open = kept.open[i] ?? fold.open));
  addEventListener("load", () => scrollTo(0, kept.top));
})();
