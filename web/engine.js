// The engine as the page has it: workers, each with an instance, that are asked by messages. Nothing is loaded: the
// engine stands in the page, packed (web/assemble.py).

/** Why this browser cannot run the engine; null: it can. */
function whyNoEngine() {
  const needs = "Chrome or Edge from 95 on, Firefox from 113 on, or Safari from 16.4 on";
  if (typeof WebAssembly !== "object") return `This browser has no WebAssembly, or it is switched off. The page needs ${needs}.`;
  // (module (func (result v128) i32.const 0 i8x16.splat))
  const wide = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11]);
  if (!WebAssembly.validate(wide)) return `This browser's WebAssembly has no registers of 128 bits. The page needs ${needs}.`;
  if (typeof DecompressionStream !== "function") return `This browser cannot unpack the engine. The page needs ${needs}.`;
  return null;
}

/** A message of the engine about a study or a record: the program's own. */
class EngineError extends Error {}

class EngineWorker {
  /** @param code of the worker, as a URL   @param modules the compiled engine and its fused steps, or null */
  constructor(code, modules) {
    this.worker = new Worker(code);
    this.waiting = new Map();
    this.last = 0;
    this.worker.onmessage = ({data}) => this.receive(data);
    this.worker.onerror = (event) => {
      for (const {refuse} of this.waiting.values()) refuse(new EngineError(event.message));
      this.waiting.clear();
    };
    this.ready = this.call("start", modules);
  }

  /** @param each called with each list of outcomes that come before the reply */
  call(name, args, each = null) {
    const id = ++this.last;
    return new Promise((accept, refuse) => {
      this.waiting.set(id, {accept, refuse, each});
      this.worker.postMessage({id, name, args});
    });
  }

  receive({id, reply, outcomes}) {
    const one = this.waiting.get(id);
    if (!one) return;
    if (outcomes) return one.each(outcomes);
    this.waiting.delete(id);
    if (reply.error) one.refuse(new EngineError(reply.error));
    else one.accept(reply);
  }

  end() {
    this.worker.terminate();
    for (const {refuse} of this.waiting.values()) refuse(new EngineError("stopped"));
    this.waiting.clear();
  }
}

/** All workers: one reads studies and follows single realizations, the others run an ensemble and count its outcomes. */
class Engine {
  static async load() {
    const text = (id) => document.getElementById(id).textContent;
    const compiled = async (id) => {
      const packed = Uint8Array.from(atob(text(id)), (letter) => letter.charCodeAt(0));
      const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
      return WebAssembly.compile(await new Response(stream).arrayBuffer());
    };
    const module = await compiled("engine-packed");
    const fused = await compiled("fused-packed").catch(() => null); // refused where there are no such instructions
    const code = URL.createObjectURL(new Blob([text("engine-glue"), text("engine-worker")], {type: "text/javascript"}));
    return new Engine(code, [module, fused]);
  }

  /** @param modules as of `EngineWorker` */
  constructor(code, modules) {
    this.code = code;
    this.modules = modules;
    this.files = new Map(); ///< records, by their names
    this.desk = new EngineWorker(code, modules);
    this.crew = [];
  }

  /** Whether steps have the processor's multiply-adds; known when it is ready. */
  fused = false;
  async ready() { this.fused = (await this.desk.ready).fused; }

  async addFile(name, bytes) {
    this.files.set(name, bytes);
    await this.desk.call("write_file", [name, bytes]);
  }

  /** The components of a record. */
  record(name, unit) { return this.desk.call("read_record_file", [name, unit]); }
  /** What a study is; refused with the program's message. */
  open(study) { return this.desk.call("open_study", [study]); }
  /** One realization of the study that was opened last. */
  trace(index) { return this.desk.call("trace_one", [index]); }

  /** A worker that has the records, and has opened a study. */
  async worker(study) {
    const worker = new EngineWorker(this.code, this.modules);
    this.crew.push(worker);
    await worker.ready;
    for (const [name, bytes] of this.files) await worker.call("write_file", [name, bytes]);
    await worker.call("open_study", [study]);
    return worker;
  }

  /**
   * Runs all realizations of a study.
   * @param workers how many at a time
   * @param each called with each {place, index, state, numbers}, and with what the program reports after it: counts,
   *        share of collapse and interval
   * @returns when all have ended; refused when `stop` is called before
   */
  async run(study, workers, each) {
    this.stop();
    const counter = await this.worker(study);
    const counts = [];
    const take = (outcomes) => {
      for (const one of outcomes)
        counts.push(counter.call("count_outcome", [one.place, one.state]).then((told) => each(one, told)));
    };
    try {
      await Promise.all(Array.from({length: workers}, async (_, number) =>
        (await this.worker(study)).call("run_part", [number, workers], take)));
      await Promise.all(counts);
    } finally {
      Promise.allSettled(counts);
      this.stop();
    }
  }

  stop() {
    for (const worker of this.crew) worker.end();
    this.crew = [];
  }
}
