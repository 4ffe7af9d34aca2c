// The marks of a chart's axes, and how far an axis reaches.

/**
 * Numbers of an axis with as many decimals as it takes to tell them apart.
 * @param {number[]} splits
 * @returns {string[]}
 */
export function ticks(splits) {
  const step = Math.min(...splits.slice(1).map((value, i) => Math.abs(value - splits[i])));
  const most = Math.max(...splits.map(Math.abs));
  if (!Number.isFinite(step) || step === 0) return splits.map(String);
  if (most >= 1e5 || most < 1e-3) {
    const digits = Math.max(0, Math.ceil(Math.log10(most / step) - 1e-9));
    return splits.map((value) => (value === 0 ? "0" : value.toExponential(Math.min(digits, 20)).replace("e+", "e")));
  }
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const exact = [0, 1, 2].map((more) => splits.map((value) => value.toFixed(Math.min(decimals + more, 20))));
  return exact.find((texts) => new Set(texts).size === texts.length && texts.every((text, i) => Math.abs(Number(text) - splits[i]) < step / 100)) ?? exact[2];
}

const LEAST = 1e-3; // of the largest number drawn: what varies less is drawn as the line that it is
const NOTHING = 1e-9; // in the signal's unit

/**
 * From where to where an axis reaches, so that the noise of a signal that stands still does not fill it.
 * @param {number[]} drawn numbers that must be in it; those that are not finite are left out
 * @returns {[number, number]}
 */
export function reach(drawn) {
  const finite = drawn.filter(Number.isFinite);
  if (finite.length === 0) return [0, 1];
  let [low, high] = [Math.min(...finite), Math.max(...finite)];
  const least = Math.max(LEAST * Math.max(Math.abs(low), Math.abs(high)), NOTHING);
  if (high - low < least) {
    const middle = (low + high) / 2;
    const half = Math.abs(middle) > NOTHING ? Math.abs(middle) / 2 : 1;
    [low, high] = [middle - half, middle + half];
  }
  const room = 0.08 * (high - low);
  return [low - room, high + room];
}
