// offline.js: service worker with which page, manual and tour work offline after the first visit. offline_files.mjs adds the list of files
// and the choice of the engine.
//
// The files of one version have one cache and are compared with their hashes, so that versions do not mix, even if the server is updated
// meanwhile. The browser installs a new version beside the old one; the next page that is opened or loaded again uses it. Pages of the old
// version that are still open ask for their worker and modules with hashes (`?v=`), and do not get those of the new version.
const VERSION = '';
const FILES = {}; // SHA-256 of each file in base64
const engineFile = null; // that of simd.mjs
const CACHE = `petri-${VERSION}`;
const FIRST = path => !path.includes('/') && path !== 'standalone.html' || path === `petri/${engineFile()}`; // files that the page needs
const newer = new Set(); // ids of pages that show a newer version, from the network

// Fetches a file of this version. Fails if the server has another version.
async function download(path) {
    const got = await fetch(path, { cache: 'no-cache', integrity: `sha256-${FILES[path]}` });
    if (!got.ok)
        throw new Error(`${path}: status ${got.status}`);
    const answer = got.redirected ? new Response(got.body, got) : got; // browsers reject redirected answers to navigations
    await (await caches.open(CACHE)).put(path, answer.clone());
    return answer;
}

const get = async path => await (await caches.open(CACHE)).match(path) ?? download(path);

async function open({ request, resultingClientId }, path) {
    const { waiting } = registration, pages = waiting ? await clients.matchAll() : [];
    if (waiting && pages.length < 2) { // a page that is loaded again is still among them
        waiting.postMessage('use');
        return new Response('<script>location.reload()</script>', { headers: { 'Content-Type': 'text/html' } });
    }
    return get(path).catch(() => {
        newer.add(resultingClientId);
        return fetch(request);
    });
}

self.addEventListener('install', event => event.waitUntil(Promise.all(Object.keys(FILES).filter(FIRST).map(download))));
self.addEventListener('activate', event => event.waitUntil((async () => {
    for (const name of await caches.keys())
        if (name.startsWith('petri') && name !== CACHE)
            await caches.delete(name);
    await clients.claim();
})()));
self.addEventListener('message', ({ data }) => {
    if (data === 'use')
        skipWaiting();
    else // a folder: keep all of its texts
        Object.keys(FILES).filter(path => path.startsWith(data) && /\.(html|js|css|json|fl)$/.test(path)).reduce((last, path) =>
            last.then(() => get(path)).catch(() => {}), Promise.resolve());
});
self.addEventListener('fetch', event => {
    const { request, clientId } = event, { pathname, searchParams } = new URL(request.url);
    const path = pathname.slice(new URL(registration.scope).pathname.length).replace(/(^|\/)$/, '$1index.html');
    const version = searchParams.get('v');
    if (request.method !== 'GET' || !request.url.startsWith(registration.scope) || !Object.hasOwn(FILES, path) || newer.has(clientId))
        return;
    event.respondWith(request.mode === 'navigate' ? open(event, path)
        : version && !FILES[path].startsWith(version) ? new Response('', { status: 404, statusText: 'another version' }) : get(path));
});
