// One instance of the engine in a worker of its own. The page sends {id, name, args}; a reply has the same id. The
// functions are those of engine.cpp; what run_part delivers comes between, in messages of up to 8 realizations.

let engine = null, batch = [], batchNumber = 0;

/** Sends what has been delivered since the last time. */
function sendBatch() {
  if (batch.length) postMessage({id: batchNumber, outcomes: batch});
  batch = [];
}

const argumentTypes = {
  open_study: ["string"],
  read_record_file: ["string", "string"],
  run_part: ["number", "number"],
  count_outcome: ["number", "number"],
  trace_one: ["number"],
};

/** @param fusedModule of steps with the processor's multiply-adds; null: the browser has none */
async function start(module, fusedModule) {
  let memory = null;
  engine = await stylobateModule({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then((instance) => {
        memory = instance.exports.memory;
        done(instance, module);
      });
      return {};
    },
    deliver(place, index, state, numbers) {
      batch.push({place, index, state, numbers});
      if (batch.length === 8) sendBatch();
    },
  });
  if (fusedModule) await addFused(fusedModule, memory);
}

/** Takes the steps of a module that shares the engine's memory, if its multiply-adds round once. */
async function addFused(fusedModule, memory) {
  const stackBytes = 1 << 18, room = engine._malloc(stackBytes);
  const number = (value, mutable = false) => new WebAssembly.Global({value: "i32", mutable}, value);
  const instance = await WebAssembly.instantiate(fusedModule, {env: {
    memory,
    __stack_pointer: number((room + stackBytes) & ~15, true),
    __memory_base: number(0),
    __table_base: number(0),
    memcpy: (to, from, bytes) => {
      new Uint8Array(memory.buffer).copyWithin(to, from, from + bytes);
      return to;
    },
  }});
  const cases = (room + 15) & ~15;
  new Float64Array(memory.buffer, cases, 6).set([1 + 2 ** -30, 3, 1 - 2 ** -30, 1 / 3, -1, -1]);
  if (!instance.exports.is_fused(cases)) return;
  engine.fused = instance.exports;
  engine.ccall("use_fused", null, [], []);
}

function answer({id, name, args}) {
  if (name === "write_file") {
    engine.FS.writeFile(args[0], args[1]);
    return {};
  }
  batchNumber = id;
  const reply = JSON.parse(engine.ccall(name, "string", argumentTypes[name], args));
  sendBatch();
  return reply;
}

onmessage = async ({data}) => {
  try {
    if (data.name === "start") await start(...data.args);
    postMessage({id: data.id, reply: data.name === "start" ? {fused: Boolean(engine.fused)} : answer(data)});
  } catch (error) { // the engine itself has failed: not what it says of a study
    postMessage({id: data.id, reply: {error: `The engine failed: ${error.message ?? error}`}});
  }
};
