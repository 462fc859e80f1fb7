// SPDX-License-Identifier: BSD-3-Clause
//
// Files in and out.

const mostBytes = 2 ** 30;
const patience = 1000; // milliseconds

// One waits, so that a file is not kept waiting; not one that could not be loaded.
let waiting = null;

function newWorker() {
  const worker = new Worker(new URL("./files.worker.js", import.meta.url), { type: "module" });
  worker.onerror = () => {
    if (waiting === worker) {
      waiting = null;
    }
  };
  return worker;
}

waiting = newWorker();

/** Calls a worker of files, which ends afterwards, so that its memory is free again. */
export function callFiles(message, transfer = []) {
  return new Promise((resolve, reject) => {
    const worker = waiting ?? newWorker();
    waiting = null;
    const end = () => {
      worker.terminate();
      // Not before the picture that is waited for.
      setTimeout(() => (waiting ??= newWorker()), patience);
    };
    worker.onmessage = ({ data }) => {
      end();
      if (data.error) {
        reject(new Error(data.error));
      } else {
        resolve(data.result);
      }
    };
    worker.onerror = (event) => {
      end();
      reject(new Error(`What reads files has failed: ${event.message ?? "it cannot be loaded"}`));
    };
    worker.postMessage(message, transfer);
  });
}

/** Opens a File as "heights", "picture" or "mask"; heights in one of the ways of sources.js. */
export async function openFile(file, what, how) {
  if (file.size > mostBytes) {
    throw new Error(`“${file.name}” cannot be opened: it is larger than 1 GB.`);
  }
  let buffer;
  try {
    buffer = await file.arrayBuffer();
  } catch {
    throw new Error(`“${file.name}” cannot be opened: it cannot be read from where it is.`);
  }
  return { name: file.name, ...(await callFiles({ what, name: file.name, buffer, how }, [buffer])) };
}

export function download(name, content, type) {
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

let input = null;

/** A file that the user chooses; nothing is called if none is. */
export function choose(accept, then) {
  input ??= document.querySelector("#file");
  input.accept = accept;
  input.value = "";
  input.onchange = () => {
    if (input.files.length > 0) {
      then(input.files[0]);
    }
  };
  input.click();
}
