// offline.js: service worker with which the page works offline after the first visit. Files are cached, and fetched again when the network
// is available.
const KEPT = 'petri';

self.addEventListener('install', event => {
    event.waitUntil(caches.open(KEPT).then(cache => cache.addAll(['./', 'style.css', 'start.js', 'page.js', 'worker.js',
        'petri-dish.js', 'samples.json', 'petri/engine.wasm'])));
    self.skipWaiting();
});
self.addEventListener('activate', event => event.waitUntil(self.clients.claim()));
self.addEventListener('fetch', event => {
    if (event.request.method !== 'GET' || new URL(event.request.url).origin !== location.origin)
        return;
    event.respondWith((async () => {
        const cache = await caches.open(KEPT);
        try {
            const answer = await fetch(event.request);
            if (answer.ok)
                await cache.put(event.request, answer.clone());
            return answer;
        } catch (error) {
            const kept = await cache.match(event.request, { ignoreSearch: true });
            if (kept)
                return kept;
            throw error;
        }
    })());
});
