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

async function start(module) {
  engine = await stylobateModule({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
    deliver(place, index, state, numbers) {
      batch.push({place, index, state, numbers});
      if (batch.length === 8) sendBatch();
    },
  });
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
    if (data.name === "start") await start(data.args[0]);
    postMessage({id: data.id, reply: data.name === "start" ? {} : answer(data)});
  } catch (error) { // the engine itself has failed: not what it says of a study
    postMessage({id: data.id, reply: {error: `The engine failed: ${error.message ?? error}`}});
  }
};
