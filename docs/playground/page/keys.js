// Keys and files that a part of the page takes, wherever in it they arrive.

const OWN = "a, button, input, select, summary, textarea, [contenteditable]"; // which have a use for the space bar

/**
 * @param {HTMLElement} root
 * @param {{check: () => void, toggle: () => void, take: (file: File) => void}} act
 */
export function listen(root, { check, toggle, take }) {
  root.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || !(event.target instanceof Element)) return;
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) check();
    else if (event.key === " " && !event.target.closest(OWN)) toggle();
    else return;
    event.preventDefault();
  });
  const files = (/** @type {DragEvent} */ event) => event.dataTransfer?.types.includes("Files") ?? false;
  root.addEventListener("dragover", (event) => {
    if (files(event)) event.preventDefault();
    root.toggleAttribute("data-dropping", files(event));
  });
  root.addEventListener("dragleave", () => root.removeAttribute("data-dropping"));
  const drop = (/** @type {DragEvent} */ event) => {
    root.removeAttribute("data-dropping");
    if (!files(event)) return;
    event.preventDefault();
    event.stopPropagation(); // the editor would put the file's text where the pointer is
    const file = event.dataTransfer?.files[0];
    if (file) take(file);
  };
  root.addEventListener("drop", drop, true);
}
