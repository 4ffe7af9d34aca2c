// Stylesheets that are loaded when they are needed.

/**
 * Loads a stylesheet once.
 * @param {URL} address
 * @returns {Promise<unknown>} when it holds
 */
export async function stylesheet(address) {
  const href = String(address);
  if ([...document.styleSheets].some((sheet) => sheet.href === href)) return;
  const link = document.createElement("link");
  await new Promise((resolve, reject) => {
    Object.assign(link, { rel: "stylesheet", href, onload: resolve, onerror: reject });
    document.head.append(link);
  });
}
