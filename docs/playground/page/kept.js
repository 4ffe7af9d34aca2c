// The reader's text of a case, kept in this browser until it is the case's own again.

const KEY = "mujoco-clinic-draft:";

/**
 * @param {string} slug
 * @returns {string | null} null if there is none
 */
export function kept(slug) {
  try {
    return localStorage.getItem(KEY + slug);
  } catch {
    return null; // storage may be switched off
  }
}

/**
 * Keeps a text.
 * @param {string} slug
 * @param {string | null} text null forgets it
 * @returns {boolean} whether the browser has taken it
 */
export function keep(slug, text) {
  try {
    if (text === null) localStorage.removeItem(KEY + slug);
    else localStorage.setItem(KEY + slug, text);
    return true;
  } catch {
    return false; // storage is full, or switched off
  }
}
