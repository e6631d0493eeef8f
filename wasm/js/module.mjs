// SPDX-License-Identifier: Zlib
//
// Loads the WebAssembly module: chooses it, gives what it imports, and reads what it leaves.

/** Something Cairn refused; the message is the sentence that the C++ library gives. */
export class CairnError extends Error {
  name = 'CairnError';
}

// A function that uses one instruction of 128 bits.
const usesSimd = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** Whether this host has WebAssembly's vectors. */
export const hasSimd = () => WebAssembly.validate(usesSimd);

async function bytesOf(url) {
  if (url.protocol !== 'file:') {
    const response = await fetch(url);
    if (!response.ok) throw new CairnError(`${url} could not be fetched (${response.status}); serve it beside cairn.mjs`);
    return response.arrayBuffer();
  }
  const files = 'node:fs/promises';  // a variable, so that no bundler looks for it
  const { readFile } = await import(/* @vite-ignore */ files);
  return readFile(url);
}

// What the C library writes, line by line, to the console: warnings of Cairn's.
function makeWriter(memory) {
  let line = '';
  const decoder = new TextDecoder();
  return (file, parts, count, written) => {
    const view = new DataView(memory().buffer);
    let total = 0;
    for (let i = 0; i < count; ++i) {
      const at = view.getUint32(parts + 8 * i, true);
      const length = view.getUint32(parts + 8 * i + 4, true);
      line += decoder.decode(new Uint8Array(memory().buffer, at, length).slice());
      total += length;
    }
    view.setUint32(written, total, true);
    const lines = line.split('\n');
    line = lines.pop();
    for (const text of lines) (file === 1 ? console.log : console.error)(text);
    return 0;
  };
}

function importsFor(memory) {
  const unsupported = () => 52;  // WASI's ENOSYS: there are no files
  return {
    host: { now: () => performance.now() },
    env: { emscripten_notify_memory_growth: () => {} },
    wasi_snapshot_preview1: {
      fd_write: makeWriter(memory),
      fd_close: unsupported,
      fd_seek: unsupported,
      proc_exit: (code) => {
        throw new CairnError(`Cairn ended itself (${code}); this is a flaw of Cairn's, please report it`);
      },
    },
  };
}

// The module's functions. One that is broken off leaves memory that nobody can trust, so every later call says so.
function guarded(exports) {
  let fault = null;
  const guard = (name, call) => (...numbers) => {
    if (fault) throw new CairnError(fault);
    try {
      return call(...numbers);
    } catch (error) {
      fault = `Cairn broke off in ${name} (${error.message ?? error}) and this module cannot go on; load it anew`;
      throw new CairnError(fault);
    }
  };
  const isCall = ([, value]) => typeof value === 'function';
  return { memory: exports.memory, ...Object.fromEntries(Object.entries(exports).filter(isCall).map(([name, call]) => [name, guard(name, call)])) };
}

/** The instance with what all classes need of it: one place that knows how memory is read. */
export class Memory {
  constructor(exports) {
    this.exports = exports;
    this.argumentsAt = exports.cairn_arguments();
  }

  text(pointer) {
    const bytes = new Uint8Array(this.exports.memory.buffer, pointer);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  /** The list that a call has just returned, a view and no copy, or the sentence why there is none. */
  list(Kind, pointer) {
    return new Kind(this.exports.memory.buffer, this.check(pointer), this.exports.cairn_count());
  }

  /** Hands numbers to the next call. */
  pass(...numbers) {
    new Float64Array(this.exports.memory.buffer, this.argumentsAt, numbers.length).set(numbers);
  }

  /** The result of a call, or the sentence why there is none. */
  check(result, subject) {
    if (result) return result;
    const sentence = this.text(this.exports.cairn_error());
    throw new CairnError(subject ? `${subject} ${sentence}` : sentence);
  }

  /** Calls `use` with a copy of the bytes in the module's memory. */
  withBytes(bytes, use) {
    const pointer = this.exports.cairn_allocate(Math.max(bytes.length, 1));
    if (!pointer) throw new CairnError('there is not enough memory; free trees and worlds that are not used');
    try {
      new Uint8Array(this.exports.memory.buffer, pointer, bytes.length).set(bytes);
      return use(pointer, bytes.length);
    } finally {
      this.exports.cairn_deallocate(pointer);
    }
  }
}

/** Compiles and starts the module: `cairn.wasm`, or `cairn-plain.wasm` where there are no vectors. */
export async function instantiate(simd, bytes) {
  const url = simd ? new URL('./cairn.wasm', import.meta.url) : new URL('./cairn-plain.wasm', import.meta.url);
  let instance;
  const imports = importsFor(() => instance.exports.memory);
  ({ instance } = await WebAssembly.instantiate(bytes ?? (await bytesOf(url)), imports));
  const calls = guarded(instance.exports);
  calls._initialize();
  return new Memory(calls);
}
