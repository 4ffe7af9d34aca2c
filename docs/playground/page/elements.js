// Small helpers for building elements. Text is always text, never HTML.

/**
 * An element.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Partial<Record<string, string | boolean>>} [attributes] `true` sets an attribute without a value, `false` none
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function el(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/**
 * A button.
 * @param {string} label
 * @param {() => void} pressed
 * @param {Partial<Record<string, string | boolean>>} [attributes]
 */
export function button(label, pressed, attributes = {}) {
  const made = el("button", { type: "button", ...attributes }, label);
  made.addEventListener("click", pressed);
  return made;
}

/**
 * A labelled choice.
 * @param {string} label
 * @param {[string, string][]} options value and text
 * @param {string} chosen
 * @param {(value: string) => void} changed
 */
export function choice(label, options, chosen, changed) {
  const id = `pg-choice-${label.toLowerCase().replaceAll(" ", "-")}`;
  const select = el("select", { id, "aria-label": label }, ...options.map(([value, text]) => el("option", { value }, text)));
  select.value = chosen;
  select.addEventListener("change", () => changed(select.value));
  return { select, whole: el("span", { class: "pg-choice" }, el("label", { for: id }, label), select) };
}

/**
 * A labelled box to tick.
 * @param {string} label
 * @param {() => void} changed
 */
export function tickbox(label, changed) {
  const box = el("input", { type: "checkbox" });
  box.addEventListener("change", changed);
  return { box, whole: el("label", {}, box, ` ${label}`) };
}

/**
 * A named group of controls.
 * @param {string} label
 * @param {...(Node | string)} children
 */
export function group(label, ...children) {
  return el("div", { class: "pg-group", role: "group", "aria-label": label }, ...children);
}
