// webgl.mjs: implements, with WebGL 2, the OpenGL ES 3 functions that lib/gl calls. WebGL 2 uses objects instead of names, and arrays
// instead of addresses.

const SETTINGS = { alpha: true, antialias: false, depth: false, premultipliedAlpha: true, stencil: false };
const EXTENSIONS = ['EXT_color_buffer_float', 'EXT_color_buffer_half_float', 'OES_texture_float_linear', 'EXT_float_blend'];
const KINDS = ['Buffer', 'Framebuffer', 'Renderbuffer', 'Texture', 'VertexArray'];
// A script whose drawing makes the driver fail would otherwise lose the context again after each restoration.
const MAX_LOSSES = 3, LOSS_INTERVAL = 600000; // maximum number of losses within this many ms after which a context is restored
const UNSIGNED_BYTE = 0x1401, RED = 0x1903, INFO_LOG_LENGTH = 0x8B84, SAMPLES = 0x80A9;
// For each of these functions, the indices of the arguments that are objects.
const WITH_OBJECTS = {
    attachShader: [0, 1], bindBuffer: [1], bindBufferBase: [2], bindFramebuffer: [1], bindRenderbuffer: [1], bindTexture: [1],
    bindVertexArray: [0], compileShader: [0], framebufferRenderbuffer: [3], framebufferTexture2D: [3], linkProgram: [0],
    uniformBlockBinding: [0], useProgram: [0],
};
// Functions whose arguments are passed on unchanged.
const PLAIN = ['activeTexture', 'blendEquation', 'blendFunc', 'checkFramebufferStatus', 'clear', 'clearColor',
    'cullFace', 'disable', 'drawArrays', 'drawElementsInstanced', 'enable', 'enableVertexAttribArray', 'finish',
    'getError', 'renderbufferStorageMultisample', 'scissor', 'texParameteri', 'texStorage2D', 'vertexAttribDivisor', 'viewport'];

// The engine's WebGL 2 context, which is created when it is first needed. `memory`: the functions of wasm.mjs that access memory.
export class Screen {
    constructor(memory) {
        this.memory = memory;
        this.objects = [null];
        this.locations = [];
        this.canvas = null;
        this.gl = null;
        this.extensions = new Set();
        this.losses = []; // times of recent losses of the context
        this.restored = 0; // how many times the context was restored
        this.onContextChange = null; // called with true after the context was lost, with false after it was restored
        this.functions = this.makeFunctions();
    }

    // True if there is a working context.
    get ready() {
        if (!this.canvas && typeof OffscreenCanvas !== 'undefined') {
            this.canvas = new OffscreenCanvas(1, 1);
            this.gl = this.canvas.getContext('webgl2', SETTINGS);
            this.canvas.addEventListener('webglcontextlost', event => this.lose(event));
            this.canvas.addEventListener('webglcontextrestored', () => this.restore());
            this.enableExtensions();
        }
        return !!this.gl && !this.gl.isContextLost();
    }

    get lost() {
        return !!this.gl?.isContextLost();
    }

    // Identifies the working context; 0 if there is none. Objects of an earlier context no longer exist.
    get context() {
        return this.ready ? this.restored + 1 : 0;
    }

    enableExtensions() {
        EXTENSIONS.forEach(name => this.gl?.getExtension(name) && this.extensions.add(`GL_${name}`));
    }

    lose(event) {
        const now = performance.now();
        this.losses = [...this.losses.filter(at => now - at < LOSS_INTERVAL), now];
        if (this.losses.length <= MAX_LOSSES)
            event.preventDefault(); // the browser restores only contexts whose event was handled
        this.onContextChange?.(true);
    }

    restore() {
        this.restored++;
        this.objects.fill(null);
        this.locations.fill(null);
        this.enableExtensions();
        this.onContextChange?.(false);
    }

    resize(width, height) {
        if (this.canvas.width !== width || this.canvas.height !== height)
            Object.assign(this.canvas, { width, height });
    }

    // Returns the last drawing as an ImageBitmap.
    take() {
        return this.canvas.transferToImageBitmap();
    }

    add(object) {
        return this.objects.push(object) - 1;
    }

    addLocation(program, name) {
        const known = (program.locations ??= new Map());
        if (!known.has(name)) {
            const location = this.gl.getUniformLocation(program, name);
            known.set(name, location ? this.locations.push(location) - 1 : -1);
        }
        return known.get(name);
    }

    writeText(text, at, size) {
        const bytes = new TextEncoder().encode(text).subarray(0, size - 1);
        this.memory.bytes().set(bytes, at);
        this.memory.bytes()[at + bytes.length] = 0;
    }

    // Returns a view of the numbers of width x height pixels.
    pixels(format, type, at, width, height) {
        const count = (format === RED ? 1 : 4) * width * height;
        return !at ? null : type === UNSIGNED_BYTE ? this.memory.bytes().subarray(at, at + count) : this.memory.floats(at, count);
    }

    makeFunctions() {
        const { objects, memory } = this, set = (at, value) => at && memory.setWord(at, value), functions = {};
        // After the context is lost, it returns null instead of objects, so functions then do nothing.
        const put = (name, act) => (functions[`gl${name[0].toUpperCase()}${name.slice(1)}`] = (...args) => this.lost ? 0 : act(...args));
        const each = (count, at, act) => {
            for (let i = 0; i < count; i++)
                act(at + 4 * i);
        };
        const location = at => this.locations[at] ?? null;
        PLAIN.forEach(name => put(name, (...args) => this.gl[name](...args)));
        Object.entries(WITH_OBJECTS).forEach(([name, places]) => put(name, (...args) => {
            places.forEach(i => (args[i] = objects[args[i]]));
            return this.gl[name](...args);
        }));
        KINDS.forEach(kind => {
            put(`gen${kind}s`, (count, at) => each(count, at, to => set(to, this.add(this.gl[`create${kind}`]()))));
            put(`delete${kind}s`, (count, at) => each(count, at, from => {
                const name = memory.word(from);
                this.gl[`delete${kind}`](objects[name] ?? null);
                name && delete objects[name];
            }));
        });
        ['Program', 'Shader'].forEach(kind => {
            put(`create${kind}`, type => this.add(this.gl[`create${kind}`](type)));
            put(`delete${kind}`, name => {
                const object = objects[name];
                object?.locations?.forEach(at => at >= 0 && delete this.locations[at]);
                this.gl[`delete${kind}`](object ?? null);
                name && delete objects[name];
            });
            put(`get${kind}iv`, (name, what, at) => set(at, what === INFO_LOG_LENGTH
                ? new TextEncoder().encode(this.gl[`get${kind}InfoLog`](objects[name])).length + 1
                : Number(this.gl[`get${kind}Parameter`](objects[name], what))));
            put(`get${kind}InfoLog`, (name, size, length, at) => this.writeText(this.gl[`get${kind}InfoLog`](objects[name]), at, size));
        });
        for (const size of [1, 2, 3, 4])
            for (const kind of 'fi') {
                const name = `uniform${size}${kind}`;
                put(name, (at, ...args) => this.gl[name](location(at), ...args));
                put(`${name}v`, (at, count, from) => this.gl[`${name}v`](location(at),
                    kind === 'f' ? memory.floats(from, size * count) : memory.words(from, size * count)));
            }
        for (const size of [2, 3, 4])
            put(`uniformMatrix${size}fv`, (at, count, turned, from) =>
                this.gl[`uniformMatrix${size}fv`](location(at), !!turned, memory.floats(from, size * size * count)));
        put('bindAttribLocation', (program, at, name) => this.gl.bindAttribLocation(objects[program], at, memory.text(name)));
        // Without a flush, SwiftShader in Chromium copies the result of later drawing instead of the current content.
        put('blitFramebuffer', (...args) => {
            this.gl.blitFramebuffer(...args);
            this.gl.flush();
        });
        put('bufferData', (target, size, from, usage) =>
            this.gl.bufferData(target, from ? memory.bytes().subarray(from, from + size) : size, usage));
        put('bufferSubData', (target, offset, size, from) =>
            this.gl.bufferSubData(target, offset, memory.bytes().subarray(from, from + size)));
        put('clearDepthf', depth => this.gl.clearDepth(depth));
        put('depthMask', on => this.gl.depthMask(!!on));
        put('getActiveUniform', (program, index, room, length, size, type, name) => {
            const active = this.gl.getActiveUniform(objects[program], index);
            set(size, active.size);
            set(type, active.type);
            this.writeText(active.name, name, room);
        });
        put('getActiveUniformBlockiv', (program, index, what, at) =>
            set(at, this.gl.getActiveUniformBlockParameter(objects[program], index, what)));
        put('getIntegerv', (what, at) => set(at, this.gl.getParameter(what)));
        put('getInternalformativ', (target, format, what, count, at) => {
            const samples = this.gl.getInternalformatParameter(target, format, SAMPLES) ?? [];
            what === SAMPLES ? samples.slice(0, count).forEach((number, i) => set(at + 4 * i, number)) : set(at, samples.length);
        });
        put('getUniformBlockIndex', (program, name) => this.gl.getUniformBlockIndex(objects[program], memory.text(name)));
        put('getUniformLocation', (program, name) => this.addLocation(objects[program], memory.text(name)));
        put('readPixels', (x, y, width, height, format, type, at) =>
            this.gl.readPixels(x, y, width, height, format, type, this.pixels(format, type, at, width, height)));
        put('shaderSource', (shader, count, texts) => this.gl.shaderSource(objects[shader], memory.text(memory.word(texts))));
        put('texImage2D', (target, level, inner, width, height, border, format, type, at) =>
            this.gl.texImage2D(target, level, inner, width, height, border, format, type, this.pixels(format, type, at, width, height)));
        put('texSubImage2D', (target, level, x, y, width, height, format, type, at) =>
            this.gl.texSubImage2D(target, level, x, y, width, height, format, type, this.pixels(format, type, at, width, height)));
        put('vertexAttribPointer', (index, size, type, normal, stride, offset) =>
            this.gl.vertexAttribPointer(index, size, type, !!normal, stride, offset));
        return functions;
    }
}
