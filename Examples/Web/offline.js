// SPDX-License-Identifier: BSD-3-Clause
//
// A service worker that keeps the page for when there is no network: the FILES of one BUILD, which assemble.mjs
// knows. Those that few need are kept once they were used.

const prefix = "reliefshading-page ";
const name = prefix + BUILD;

self.addEventListener("install", (event) => {
  // As they are on the server now, not as some cache has them.
  const requests = FILES.map((file) => new Request(file, { cache: "reload" }));
  event.waitUntil(caches.open(name).then((cache) => cache.addAll(requests)));
});

self.addEventListener("activate", (event) => {
  const remove = async () => {
    const names = await caches.keys();
    const old = names.filter((other) => other.startsWith(prefix) && other !== name);
    await Promise.all(old.map((other) => caches.delete(other)));
    // The page that is open is of this build, too.
    await self.clients.claim();
  };
  event.waitUntil(remove());
});

async function answer(request) {
  const cache = await caches.open(name);
  const { pathname } = new URL(request.url);
  const kept = await cache.match(pathname.endsWith("/") ? "index.html" : request, { ignoreSearch: true });
  if (kept) {
    return kept;
  }
  const response = await fetch(request);
  if (response.ok) {
    await cache.put(request, response.clone());
  }
  return response;
}

self.addEventListener("fetch", (event) => {
  if (event.request.method === "GET" && event.request.url.startsWith(self.registration.scope)) {
    event.respondWith(answer(event.request));
  }
});
