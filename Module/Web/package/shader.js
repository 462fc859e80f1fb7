// SPDX-License-Identifier: BSD-3-Clause
//
// Workers, which leave the page free: each shades a band of rows of the same run.

import { module } from "./module.js";
import { needNumber, needObject, rangeError, refuseUnknown } from "./values.js";

const errorTypes = { RangeError, TypeError, Error };
const most = 64; // workers

// One worker, and the calls that it has not answered yet.
class Thread {
  constructor(onFailure) {
    this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.waiting = new Map();
    this.calls = 0;
    this.worker.onmessage = ({ data }) => this.answer(data);
    // Compiled once for all; where that fails the worker tries for itself, and says why not.
    const hand = (compiled) => this.worker.postMessage({ compiled });
    module.compile().then(hand, () => hand(null));
    this.worker.onerror = (event) =>
      onFailure(new Error(`the worker failed: ${event.message ?? "it cannot be loaded"}`));
  }

  call(message, transfer) {
    const call = this.calls++;
    return new Promise((resolve, reject) => {
      this.worker.postMessage({ ...message, call }, transfer);
      this.waiting.set(call, { resolve, reject });
    });
  }

  answer({ call, result, error }) {
    const { resolve, reject } = this.waiting.get(call);
    this.waiting.delete(call);
    if (error) {
      reject(new (errorTypes[error.name] ?? Error)(error.message));
    } else {
      resolve(result);
    }
  }

  end(error) {
    this.worker.terminate();
    this.waiting.forEach(({ reject }) => reject(error));
    this.waiting.clear();
  }
}

//--------------------------------------------------------------------------------------------------
// Bands, the northern one last, as one array.
function joined(arrays) {
  const whole = new arrays[0].constructor(arrays.reduce((sum, array) => sum + array.length, 0));
  let at = whole.length;
  for (const array of arrays) {
    at -= array.length;
    whole.set(array, at);
  }
  return whole;
}

function joinBands(bands) {
  const [first] = bands;
  const total = (key) => bands.reduce((sum, { statistics }) => sum + statistics[key], 0);
  const layers = Object.keys(first.layers).map((name) => [
    name,
    joined(bands.map((band) => band.layers[name])),
  ]);
  const lightsTraced = Math.max(...bands.map(({ statistics }) => statistics.lightsTraced));
  return {
    ...first,
    data: joined(bands.map(({ data }) => data)),
    height: bands.reduce((sum, { height }) => sum + height, 0),
    layers: Object.fromEntries(layers),
    statistics: {
      ...first.statistics,
      lightsTraced,
      raysTraced: total("raysTraced"),
      cellsVisited: total("cellsVisited"),
    },
  };
}

function countOf(workers) {
  if (workers === "auto") {
    return Math.min(most, Math.max(1, navigator.hardwareConcurrency ?? 1));
  }
  if (
    !Number.isInteger(needNumber("workers", workers, 'a whole number or "auto" is')) ||
    workers < 1 ||
    workers > most
  ) {
    throw rangeError("workers", workers, `a whole number in [1, ${most}] is`);
  }
  return workers;
}

export function createWorkerShader(how = {}) {
  refuseUnknown("", needObject("createWorkerShader", how), ["workers"]);
  if (typeof Worker === "undefined") {
    throw new Error(
      "there is no Worker here, in which a page stays free while it shades; call shade() instead",
    );
  }
  let ended = null;
  const threads = [];
  const end = (error) => {
    ended ??= error;
    threads.forEach((thread) => thread.end(error));
  };
  for (let k = countOf(how.workers ?? 1); k > 0; --k) {
    threads.push(new Thread(end));
  }

  // The last worker may be handed the heights: the others have got their copies then.
  const callAll = (all, message, { transfer = false } = {}) => {
    if (ended) {
      return Promise.reject(ended);
    }
    const given = transfer && ArrayBuffer.isView(message.heights) ? [message.heights.buffer] : [];
    return Promise.all(
      all.map((thread, k) =>
        thread.call({ ...message, band: [k, all.length] }, k + 1 === all.length ? given : []),
      ),
    );
  };
  const callOne = async (message, how) => (await callAll(threads.slice(0, 1), message, how))[0];
  return {
    async shade(heights, options = {}, transfer) {
      return joinBands(await callAll(threads, { what: "shade", heights, options }, transfer));
    },
    heightsOfMesh: (mesh, options = {}) => callOne({ what: "heightsOfMesh", heights: mesh, options }),
    heightsOfNormals: (normals, options = {}) =>
      callOne({ what: "heightsOfNormals", heights: normals, options }),
    fitHeightScale: (heights, options = {}, transfer) =>
      callOne({ what: "fitHeightScale", heights, options }, transfer),
    findExposure: (heights, options = {}, transfer) =>
      callOne({ what: "findExposure", heights, options }, transfer),
    terminate: () => end(new Error("the worker was terminated")),
  };
}
