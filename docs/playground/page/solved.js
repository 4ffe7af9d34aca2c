// Which cases have been solved, kept in this browser. The loader reads the same key.

const KEY = "mujoco-clinic";

/** @returns {string[]} */
function solved() {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? "[]");
  } catch {
    return [];
  }
}

/**
 * Remembers that a case has been solved.
 * @param {string} slug
 */
export function markSolved(slug) {
  try {
    localStorage.setItem(KEY, JSON.stringify([...new Set([...solved(), slug])]));
  } catch {
    // storage may be switched off: then nothing is kept
  }
}
