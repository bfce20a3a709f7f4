// Decodes streams by the WebAssembly module that is compiled from the C++ decoder (experiments/play/wasm_decoder.h).

// The module's functions with JavaScript's types. Runs in a worker, and in Node for tests. `bytes`: the module.
async function loadDecoder(bytes) {
  const refuse = () => { throw new Error('internal: the decoder called the system'); };
  const module = await WebAssembly.compile(bytes), imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ||= {})[name] = refuse;
  imports.env.emscripten_notify_memory_growth = () => {};
  const gsp = (await WebAssembly.instantiate(module, imports)).exports;
  gsp._initialize();

  // Views of the memory are made anew each time: it moves when it grows.
  const array = (type, start, length) => new type(gsp.memory.buffer, start, length);
  const checked = (result) => {
    if (result) return result;
    const text = array(Uint8Array, gsp.gsp_error());
    throw new Error(new TextDecoder().decode(text.slice(0, text.indexOf(0))));
  };

  return {
    // A handle for `decode`. Throws Error with the cause where the header is damaged.
    open(stream) {
      const copy = gsp.malloc(stream.length || 1);
      array(Uint8Array, copy, stream.length).set(stream);
      try {
        return checked(gsp.gsp_open(copy, stream.length));
      } finally {
        gsp.free(copy);
      }
    },
    close: (handle) => gsp.gsp_close(handle),
    headerBytes: (handle) => gsp.gsp_header_bytes(handle),
    // The mesh of the first `count` bytes: positions #V by 3 in double precision, faces #F by 3, those of base face f
    // from 4^level·f on, creases #C by 2, base vertices. At most of level `finest`, vertices of finer ones left out.
    decode(handle, count, finest) {
      checked(gsp.gsp_decode(handle, count, finest));
      const vertices = gsp.gsp_vertex_count(handle), faces = gsp.gsp_face_count(handle);
      return {
        level: gsp.gsp_level(handle),
        positions: array(Float64Array, gsp.gsp_positions(handle), 3 * vertices).slice(),
        faces: array(Int32Array, gsp.gsp_faces(handle), 3 * faces).slice(),
        creases: array(Int32Array, gsp.gsp_creases(handle), 2 * gsp.gsp_crease_count(handle)).slice(),
      };
    },
  };
}

// The decoder in a worker, so that the page goes on being drawn. Each function returns a promise.
const Decoder = (() => {
  let worker = null, calls = 0;
  const waiting = new Map();

  // What the worker runs: it answers [number, name of a function, arguments] with [number, result, error].
  function serve(load) {
    let decoder = null;
    onmessage = async ({ data: [number, name, ...given] }) => {
      try {
        if (name === 'load') decoder = await load(given[0]);
        const result = name === 'load' ? true : decoder[name](...given);
        postMessage([number, result, null], result.positions ? [result.positions.buffer, result.faces.buffer] : []);
      } catch (error) {
        postMessage([number, null, error.message]);
      }
    };
  }

  function call(...request) {
    return new Promise((done, failed) => {
      waiting.set(++calls, { done, failed });
      worker.postMessage([calls, ...request]);
    });
  }

  async function start() {
    const script = `'use strict';\n${loadDecoder}\n(${serve})(loadDecoder);`;
    worker = new Worker(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })));
    worker.onmessage = ({ data: [number, result, error] }) => {
      const { done, failed } = waiting.get(number);
      waiting.delete(number);
      if (error === null) done(result); else failed(new Error(error));
    };
    await call('load', await Surface.unpacked('decoder'));
  }

  let started = null;
  const within = async (...request) => { await (started ||= start()); return call(...request); };
  return {
    open: (stream) => within('open', stream),
    headerBytes: (handle) => within('headerBytes', handle),
    decode: (handle, count, finest) => within('decode', handle, count, finest),
  };
})();

// `work` of one argument, such that of calls made while it runs only the last is carried out, when it is free again.
function latest(work) {
  let running = false, next = [];
  return async function call(argument) {
    next = [argument];
    if (running) return;
    running = true;
    try {
      while (next.length) await work(next.pop());
    } finally {
      running = false;
    }
  };
}

// What the 3D view draws of the first `count` bytes of a view's stream.
async function decodedShape(view, count, stream = 0) {
  view.handles ||= [];
  view.grids ||= [];
  const handle = await (view.handles[stream] ||= Decoder.open(Surface.bytesOf(view.streams[stream])));
  const { level, positions, faces } = await Decoder.decode(handle, count, view.level);
  const grid = view.grids[level] ||= Surface.gridOf(faces, level);
  return { level, grid, vertices: positions.length / 3, position: Surface.fitted(view, positions) };
}

// A slider's places 0..steps as bytes, in equal factors from `low` to `high`, and back.
const bytesAt = (place, steps, low, high) => Math.round(low * (high / low) ** (place / steps));
const placeOf = (bytes, steps, low, high) => (high > low ? Math.round(steps * Math.log(bytes / low) / Math.log(high / low)) : 0);

// Several places may stand for the same byte: a slider that is at one of them stays.
function setSlider(slider, bytes, steps, low, high) {
  if (bytesAt(Number(slider.value), steps, low, high) !== bytes) slider.value = placeOf(bytes, steps, low, high);
}
