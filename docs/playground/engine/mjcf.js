// What newer releases of MuJoCo read in a model and this one does not.
// Since when each attribute is read stands in scripts/clinic/engine/since.json, which Python reads too.

import SINCE from "../../../scripts/clinic/engine/since.json" with { type: "json" };

/**
 * The sentence that names the release that a refused text needs; empty if none is known.
 * @param {string} message of MuJoCo
 * @param {string} version of this MuJoCo
 */
export function newer(message, version) {
  const found = /unrecognized (?:attribute: '([^']*)'|element)\s+Element '([^']*)'/.exec(message);
  if (!found) return "";
  const [, attribute, element] = found;
  const release = sinceOf(attribute ? `${element}.${attribute}` : element);
  if (!release || !isNewer(release, version)) return "";
  const name = attribute ?? element;
  return `This page runs MuJoCo ${version}, which does not know \`${name}\`; \`clinic judge\` with MuJoCo ${release} does.`;
}

/**
 * The first release that reads a name; empty if all that this site knows do.
 * @param {string} name an element, or `element.attribute`
 */
export function sinceOf(name) {
  return Object.entries(SINCE).find(([, names]) => names.includes(name))?.[0] ?? "";
}

/**
 * Whether a release came after a version, by its first two numbers.
 * @param {string} release
 * @param {string} version
 */
export function isNewer(release, version) {
  const [[a, b], [c, d]] = [release, version].map((text) => text.split(".").map(Number));
  return a > c || (a === c && b > d);
}
