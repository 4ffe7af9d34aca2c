// The page's side of the worker: a watchdog, generations, renewal.

const LIMIT = 6000; // ms without a sign of life
const BOOT_LIMIT = 60000; // the engine is fetched over the reader's network
const MAX_FAILURES = 200; // failed compiles: each leaves a little of the module's stack behind
const ANSWERED = new Set(["boot", "open", "frame", "grab", "hold", "check"]);
const PROGRESS = new Set(["judging"]);

/** @typedef {"crashed" | "silent" | "unavailable"} Loss */

/** A worker that is renewed when it crashes or falls silent. */
export class Engine {
  /** @param {{worker: string, wasm: string, record: object}} source */
  constructor(source) {
    this.source = source;
    /** @type {((message: any) => void) | null} called with every answer of the present generation */
    this.hear = null;
    /** @type {((reason: Loss, message: string) => void) | null} called once the worker has been ended */
    this.mourn = null;
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
   * @param {(message: any) => void} hear
   * @param {(reason: Loss, message: string) => void} mourn
   */
  listen(hear, mourn) {
    this.hear = hear;
    this.mourn = mourn;
    for (const say of this.early.splice(0)) say();
  }

  /** Whether failed compiles have used the module up. */
  get worn() {
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
    if (this.hear) this.hear(message);
    else this.early.push(() => this.hear?.(message));
  }

  watch() {
    clearTimeout(this.timer);
    if (this.waiting === 0) return;
    this.timer = setTimeout(() => this.lose("silent", `no answer within ${LIMIT / 1000} s`), this.booted ? LIMIT : BOOT_LIMIT);
  }

  /**
   * @param {Loss} reason
   * @param {string} message
   */
  lose(reason, message) {
    this.end();
    if (this.mourn) this.mourn(reason, message);
    else this.early.push(() => this.mourn?.(reason, message));
  }
}
