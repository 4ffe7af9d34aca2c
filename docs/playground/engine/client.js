// The engine as the page sees it: a worker that is asked, watched, and started anew when it crashes or falls silent.

const LIMIT = 6000; // ms without a sign of life
const BOOT_LIMIT = 60000; // the engine is fetched over the reader's network
const MAX_FAILURES = 200; // failed compiles: each leaves a little of the module's stack behind
const ANSWERED = new Set(["boot", "open", "frame", "grab", "hold", "check", "refer"]);
const PROGRESS = new Set(["judging"]);

/** @typedef {"crashed" | "silent" | "unavailable"} Loss */

/** The worker in which MuJoCo runs. */
export class Engine {
  /** @param {{worker: string, wasm: string, schema: string, record: object}} source addresses, and what the worker is told */
  constructor(source) {
    this.source = source;
    /** @type {((message: any) => void) | null} called with every answer of the present generation */
    this.onMessage = null;
    /** @type {((reason: Loss, message: string) => void) | null} called once the worker has been ended */
    this.onLost = null;
    /** @type {(() => void)[]} what there was to say before anyone listened */
    this.early = [];
    this.generation = 0;
    this.waiting = 0;
    this.failures = 0;
    this.booted = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    /** @type {Worker | null} */
    this.worker = null;
  }

  /**
   * Sets who is told; what there was to tell before is told now.
   * @param {(message: any) => void} onMessage
   * @param {(reason: Loss, message: string) => void} onLost
   */
  listen(onMessage, onLost) {
    this.onMessage = onMessage;
    this.onLost = onLost;
    for (const tell of this.early.splice(0)) tell();
  }

  /** Whether failed compiles have used the module up. */
  get wornOut() {
    return this.failures > MAX_FAILURES;
  }

  /** Starts a new worker in the place of the one before. */
  renew() {
    this.end();
    const worker = new Worker(this.source.worker, { type: "module" });
    const { generation } = this;
    worker.onmessage = ({ data }) => this.receive(data);
    worker.onerror = (event) => {
      event.preventDefault();
      if (generation === this.generation) this.lose("crashed", event.message ?? "");
    };
    this.worker = worker;
    const { record } = this.source;
    this.post({ type: "boot", wasm: this.source.wasm, record });
  }

  /** Ends the worker; what it still sends is not heard. */
  end() {
    clearTimeout(this.timer);
    this.worker?.terminate();
    this.worker = null;
    this.generation += 1;
    this.waiting = 0;
    this.failures = 0;
    this.booted = false;
  }

  /** @param {{type: string} & Record<string, unknown>} message */
  post(message) {
    if (!this.worker) return;
    this.worker.postMessage({ ...message, generation: this.generation });
    if (!ANSWERED.has(message.type)) return;
    this.waiting += 1;
    if (this.waiting === 1) this.watch();
  }

  /** @param {any} message */
  receive(message) {
    if (message.generation !== this.generation) return;
    if (message.type === "dead") {
      this.lose(this.booted ? "crashed" : "unavailable", message.message);
      return;
    }
    if (message.type === "booted") this.booted = true;
    if (!PROGRESS.has(message.type)) this.waiting -= 1;
    this.failures = message.failures ?? this.failures;
    this.watch();
    if (this.onMessage) this.onMessage(message);
    else this.early.push(() => this.onMessage?.(message));
  }

  /** Waits for a sign of life, while an answer is owed. */
  watch() {
    clearTimeout(this.timer);
    if (this.waiting === 0) return;
    this.timer = setTimeout(() => this.lose("silent", `no answer within ${LIMIT / 1000} s`), this.booted ? LIMIT : BOOT_LIMIT);
  }

  /**
   * Ends the worker and tells why.
   * @param {Loss} reason
   * @param {string} message
   */
  lose(reason, message) {
    this.end();
    if (this.onLost) this.onLost(reason, message);
    else this.early.push(() => this.onLost?.(reason, message));
  }
}
