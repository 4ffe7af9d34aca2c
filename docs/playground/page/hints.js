// Hints one by one, the last of which opens the diagnosis.

import { button, el } from "./elements.js";

/**
 * @param {{title: string, text: string}[]} all
 */
export function hints(all) {
  const said = el("ol", { "aria-live": "polite" });
  const ask = button("Give me a hint", () => {
    const hint = all[said.childElementCount];
    if (hint) {
      said.append(el("li", {}, el("strong", {}, `${hint.title}: `), hint.text));
      ask.textContent = said.childElementCount < all.length ? "Another hint" : "Open the diagnosis";
      return;
    }
    const fold = document.querySelector("details.question");
    if (fold instanceof HTMLDetailsElement) fold.open = true;
    fold?.scrollIntoView({ block: "start" });
  });
  return el("div", { class: "pg-hints" }, said, ask);
}
