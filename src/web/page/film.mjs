// film.mjs: encodes pictures as a video or a GIF. The frames have exact times, regardless of the rendering time.
import { GIFEncoder, applyPalette, quantize } from 'gifenc';
import { BufferTarget, CanvasSource, Mp4OutputFormat, Output, Quality, WebMOutputFormat, getFirstEncodableVideoCodec } from 'mediabunny';

const BITS = 0.2; // bits per pixel and frame
const FORMATS = {
    mp4: { name: 'MP4', codecs: ['avc'], encoders: 'H.264', other: 'WebM or GIF', Format: Mp4OutputFormat },
    webm: { name: 'WebM', codecs: ['vp9', 'vp8'], encoders: 'VP9 or VP8', other: 'GIF', Format: WebMOutputFormat },
};
const GIF_RATE = 50; // maximum number of frames a second: browsers show frames of less than 1/50 s for 1/10 s
const TICK = 100; // times in a GIF are multiples of 1/100 s

// Returns an object with the context of a canvas. `add` appends the content of the canvas as a frame, and `end` returns the file. Of the
// frames of the script, add only every `every`th. kind: 'gif', 'mp4' or 'webm'. Throws if the browser cannot encode the format.
export function beginFilm(kind, size, fps) {
    return kind === 'gif' ? new Gif(size, fps) : Video.begin(FORMATS[kind], size, fps);
}

class Gif {
    constructor({ width, height }, fps) {
        const canvas = new OffscreenCanvas(width, height), every = Math.ceil(fps / GIF_RATE);
        Object.assign(this, { every, rate: fps / every, count: 0, encoder: GIFEncoder() });
        this.context = canvas.getContext('2d', { alpha: false, willReadFrequently: true });
    }

    add() {
        const { width, height } = this.context.canvas, { data } = this.context.getImageData(0, 0, width, height);
        const palette = quantize(data, 256), ticks = count => Math.round(TICK * count / this.rate);
        const delay = (ticks(this.count + 1) - ticks(this.count++)) * 1000 / TICK;
        this.encoder.writeFrame(applyPalette(data, palette), width, height, { palette, delay });
    }

    cancel() {}

    end() {
        this.encoder.finish();
        return new Blob([this.encoder.bytes()], { type: 'image/gif' });
    }
}

class Video {
    static async begin({ name, codecs, encoders, other, Format }, { width, height }, fps) {
        const even = size => size + (codecs[0] === 'avc' ? size % 2 : 0); // H.264 needs even numbers of rows and columns
        const film = Object.assign(new Video(), { every: 1, fps, count: 0 });
        const canvas = new OffscreenCanvas(even(width), even(height));
        film.context = canvas.getContext('2d', { alpha: false });
        const quality = new Quality({ bitrate: Math.max(width * height * fps * BITS, 2e5) });
        const codec = await getFirstEncodableVideoCodec(codecs, { width: canvas.width, height: canvas.height, quality, frameRate: fps });
        if (!codec)
            throw new Error(`cannot make ${name} videos: this browser has no encoder for ${encoders} (WebCodecs); choose ${other}`);
        film.source = new CanvasSource(canvas, { codec, quality, latencyMode: 'quality', keyFrameInterval: 1 });
        film.output = new Output({ format: new Format(), target: new BufferTarget() });
        film.output.addVideoTrack(film.source, { frameRate: fps });
        await film.output.start();
        return film;
    }

    add() {
        return this.source.add(this.count++ / this.fps, 1 / this.fps);
    }

    cancel() {
        return this.output.cancel();
    }

    async end() {
        await this.output.finalize();
        return new Blob([this.output.target.buffer], { type: await this.output.getMimeType() });
    }
}
