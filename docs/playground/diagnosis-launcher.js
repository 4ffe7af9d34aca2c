// Starts the diagnosis' workers, from memory. A worker from memory has the policy of what starts it, and a page's forbids what
// MuJoCo and Python do: compile. This worker comes from the site, and has none.

/** @typedef {{parts: import("./diagnosis/client.js").Parts}} Asked */

self.onmessage = (/** @type {MessageEvent<Asked>} */ { data, ports: [page] }) => {
  const worker = new Worker(data.parts.worker, { type: "module" });
  worker.onmessage = ({ data }) => page.postMessage(data);
  worker.onerror = (event) => {
    event.preventDefault();
    page.postMessage({ type: "died", message: event.message || "the worker could not be started" });
  };
  page.onmessage = () => worker.terminate();
  worker.postMessage(data);
};
