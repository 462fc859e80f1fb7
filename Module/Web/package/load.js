// SPDX-License-Identifier: BSD-3-Clause
//
// A module of WebAssembly: brought in once, and called with arrays that are copied into its memory.

async function compile(url) {
  const name = url.pathname.replace(/.*\//, "");
  if (url.protocol === "file:" && typeof process === "object" && process.versions?.node) {
    // Named by a variable, so that tools that bundle for browsers leave it alone.
    const files = "node:fs/promises";
    const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ files);
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`${name} cannot be loaded: ${response.status} ${response.statusText} (${url})`);
  }
  // While it comes in, which only goes where a server tells the type of the file.
  return response.headers.get("content-type") === "application/wasm"
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

export function textAt(wasm, address) {
  const bytes = new Uint8Array(wasm.memory.buffer, address >>> 0);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

/** Throws what a call says is wrong, if it says something. */
export function need(wasm, wrong, prefix = "") {
  const text = textAt(wasm, wrong);
  if (text !== "") {
    throw new RangeError(prefix + text);
  }
}

/** An array of Type of rows that run from south to north in the module. */
export function rowsFrom(wasm, address, From, width, height, size, Type = From) {
  const row = width * size;
  const result = new Type(row * height);
  const from = new From(wasm.memory.buffer, address >>> 0, row * height);
  for (let j = 0; j < height; ++j) {
    result.set(from.subarray((height - 1 - j) * row, (height - j) * row), j * row);
  }
  return result;
}

export class WebModule {
  /** @param url   of the WebAssembly */
  constructor(url) {
    this.url = url;
    this.compiled = undefined; // a promise of the compiled module
    this.instance = undefined; // of it; none after one that ended in the middle of a run
  }

  /** The compiled module, which may be posted to workers. */
  compile() {
    this.compiled ??= compile(this.url).catch((error) => {
      this.compiled = undefined; // so that it may be tried again
      throw error;
    });
    return this.compiled;
  }

  /** Takes a module that was compiled elsewhere. */
  take(module) {
    this.compiled ??= Promise.resolve(module);
  }

  /** Loads what is needed; later calls find it there. */
  async load() {
    const module = await this.compile();
    if (!this.instance) {
      const nothing = () => 0;
      // What the C library asks of a system: there is none.
      const imports = {};
      for (const { module: space, name } of WebAssembly.Module.imports(module)) {
        (imports[space] ??= {})[name] = nothing;
      }
      const created = await WebAssembly.instantiate(module, imports);
      this.instance ??= created.exports;
      if (created.exports === this.instance) {
        this.instance._initialize?.();
      }
    }
    return this.instance;
  }

  /**
   * Calls body(wasm, put), where put copies an array into the module's memory and returns its address. What ends
   * the module in the middle becomes an error, and the next run gets a new one.
   */
  async using(body) {
    let wasm = await this.load();
    while (wasm !== this.instance) {
      wasm = await this.load(); // another run has ended it meanwhile
    }
    const taken = [];
    const put = (array) => {
      const address = array.byteLength < 2 ** 32 ? wasm.reliefAllocate(array.byteLength) >>> 0 : 0;
      if (address === 0) {
        throw new RangeError("there is not enough memory for the run");
      }
      taken.push(address);
      new Uint8Array(wasm.memory.buffer, address, array.byteLength).set(
        new Uint8Array(array.buffer, array.byteOffset, array.byteLength),
      );
      return address;
    };
    try {
      wasm.reliefBegin();
      return body(wasm, put);
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) {
        this.instance = undefined;
        throw wasm.reliefIsOutOfMemory() !== 0
          ? new RangeError("there is not enough memory for the run", { cause: error })
          : error;
      }
      throw error;
    } finally {
      if (wasm === this.instance) {
        wasm.reliefEnd();
        taken.forEach((address) => wasm.reliefFree(address));
      }
    }
  }
}
