// film.mjs: encodes pictures as a video. Each frame of the script is one frame of the video, regardless of the rendering time.
import { packFilm } from './webm.mjs';

const CODECS = [['vp09.00.51.08', 'V_VP9'], ['vp8', 'V_VP8']];
const BITS = 0.2; // bits per pixel and frame
const KEY_EVERY = 60; // frames from one key frame to the next
const MAX_WAITING = 4; // maximum number of frames queued in the encoder

async function chooseCodec(settings) {
    for (const [codec, name] of globalThis.VideoEncoder ? CODECS : []) {
        const { supported } = await VideoEncoder.isConfigSupported({ ...settings, codec }).catch(() => ({}));
        if (supported)
            return [codec, name];
    }
    throw new Error('cannot make videos: this browser has no encoder for VP9 or VP8 (WebCodecs); use another browser');
}

export class Film {
    static async begin({ width, height }, fps) {
        const settings = { width, height, framerate: fps, bitrate: Math.max(width * height * fps * BITS, 2e5), latencyMode: 'quality' };
        const [codec, name] = await chooseCodec(settings), film = new Film();
        Object.assign(film, { width, height, fps, codec: name, count: 0, chunks: [], error: null });
        film.canvas = new OffscreenCanvas(width, height);
        film.context = film.canvas.getContext('2d', { alpha: false });
        film.encoder = new VideoEncoder({
            output: chunk => {
                const data = new Uint8Array(chunk.byteLength);
                chunk.copyTo(data);
                film.chunks.push({ data, time: Math.round(chunk.timestamp / 1000), key: chunk.type === 'key' });
            },
            error: error => (film.error = error),
        });
        film.encoder.configure({ ...settings, codec });
        return film;
    }

    // Adds the content of the canvas as the next frame.
    async add() {
        const microseconds = count => Math.round(count * 1e6 / this.fps);
        const frame = new VideoFrame(this.canvas, { timestamp: microseconds(this.count), duration: microseconds(1) });
        this.encoder.encode(frame, { keyFrame: this.count++ % KEY_EVERY === 0 });
        frame.close();
        while (this.encoder.encodeQueueSize > MAX_WAITING && !this.error)
            await new Promise(resolve => this.encoder.addEventListener('dequeue', resolve, { once: true }));
        if (this.error)
            throw this.error;
    }

    async end() {
        await this.encoder.flush();
        this.encoder.close();
        return packFilm(this);
    }
}
