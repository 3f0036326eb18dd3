// petri.d.ts: the types of petri.mjs, and what each call does.

/** Bytes, a compiled module, where to fetch engine.wasm, or the answer of a fetch. Nothing: beside petri.mjs. */
export type EngineSource = BufferSource | WebAssembly.Module | Response | URL | string;

/** Compiles the engine, which takes some ten milliseconds. */
export function loadEngine(source?: EngineSource): Promise<Engine>;

export type Status = 'ok' | 'invalid' | 'limit' | 'memory' | 'missing' | 'interrupted';
export const STATUS: Status[];

/** What petri has to say of a script. Lines and columns count from 1, columns in characters. */
export interface Diagnostic {
    level: 'error' | 'warning' | 'note';
    file: string | null;
    line: number;
    column: number;
    endLine: number;
    endColumn: number;
    text: string;
    /** The short name of the kind, such as "unbound-name". */
    code: string | null;
    /** A second sentence that helps; "" for none. */
    hint: string;
    /** With place, source line and carets, as the command prints it. */
    rendered: string;
}

export class PetriError extends Error {
    status: Status;
    diagnostics: Diagnostic[];
}

export interface Options {
    /** Frames a second, unless the script says so itself. Default 60. */
    fps?: number;
    /** Bytes that a script may use. Default 1 GiB. */
    memory?: number;
    /** Work of one call in units of some ten nanoseconds; a frame that needs more is given up. Default 2^28. */
    work?: number;
    /** What scripts may read and import, by name. They reach nothing else. */
    files?: Record<string, string | Uint8Array>;
    onDiagnostic?: (diagnostic: Diagnostic) => void;
    /**
     * Asked every ten microseconds or so of a call that may take long: true ends it, with the status "interrupted", and
     * nothing has changed. Calls that only look at what is there are made to their end.
     * It may look at a clock, or at a SharedArrayBuffer that another thread writes.
     */
    shouldInterrupt?: () => boolean;
}

export interface Engine {
    readonly version: string;
    /** Why the engine cannot be used any more, after an exception within it; load another one then. */
    readonly broken?: Error;
    open(options?: Options): Session;
}

export interface Frame {
    /** From 0; -1 before the first. */
    number: number;
    time: number;
    beat: number;
    fps: number;
    tempo: number;
    /** Simulation steps of all systems in this frame. */
    steps: number;
    evaluationSeconds: number;
    physicsSeconds: number;
}

/** A name that may be set from outside: `let NAME=NAME or DEFAULT -- LEAST..MOST|STEP comment`. */
export interface Parameter {
    name: string;
    defaultValue: string;
    value: string;
    comment: string;
    /** NaN unless the value is one number. */
    number: number;
    defaultNumber: number;
    /** The range; infinite without one. */
    min: number;
    max: number;
    /** 0: none. */
    step: number;
    defined: boolean;
    settable: boolean;
    line: number;
    column: number;
}

/** Numbers in the engine's memory: those of particle i begin at `data[i * stride]`. */
export interface Column {
    data: Float64Array;
    stride: number;
}

export interface System {
    name: string;
    dimensions: number;
    count: number;
    forces: number;
    steps: number;
    position: Column | null;
    velocity: Column | null;
    radius: Column | null;
    mass: Column | null;
    charge: Column | null;
    /** null if an id is no number. */
    ids: Column | null;
}

export interface Token {
    kind: 'name' | 'keyword' | 'number' | 'string' | 'symbol' | 'node' | 'tag' | 'operator' | 'comment' | 'invalid'
        | 'newline' | 'indent' | 'dedent';
    /** In bytes of UTF-8. */
    start: number;
    end: number;
}

/** A row of petri's tables; the attributes of a node follow it. */
export interface Help {
    kind: 'function' | 'node' | 'attribute' | 'name';
    name: string;
    /** Of a function; the area of a node; the type of an attribute. */
    parameters: string;
    defaultValue: string;
    unit: string;
    help: string;
}

export type Section = 'tree' | 'state' | 'log' | 'error' | 'hash';

/** A picture that WebGL 2 has drawn. */
export interface RenderedImage {
    image: ImageBitmap;
    title: string;
    ready: boolean;
    /** What is left out, as words. */
    unsupported: string[];
    screen: true;
}

/** One script that runs. Calls that fail throw a PetriError; what they were to change is then as before. */
export interface Session {
    /** Loads a script; frames count from 0 again, the state is kept. */
    load(text: string | Uint8Array, name?: string): this;
    /** Another text for the script that runs; frames, time and state go on. */
    reload(text: string | Uint8Array, name?: string): this;
    /** What would be told of a text; nothing changes. */
    diagnose(text: string | Uint8Array, name?: string): Diagnostic[];
    /** A value for a name, such as "SIZE=20", in scripts that are loaded from now on. */
    define(definition: string): this;
    /** Gives scripts a file; null takes it away. */
    setFile(name: string, content: string | Uint8Array | null): void;
    /** Makes the next frame. */
    step(): this;
    stepAt(time: number, beat: number): this;
    /** Forgets the state and goes to before frame 0. */
    clear(): void;
    readonly frame: Frame;
    readonly parameters: Parameter[];
    /** The value as a script would write it; null: the default. */
    setParameter(name: string, value: string | number | null): this;
    /** A name for scripts that are loaded from now on, whose value may be another at any time. */
    setGlobal(name: string, value: number | ArrayLike<number>): this;
    /** Views that the next call which changes something makes invalid; copy what is to be kept. */
    readonly systems: System[];
    /** Printed keys; numbers, or the printed form of what is none. */
    readonly state: Map<string, number[] | string>;
    /** The SHA-256 of the state: the same on every machine. */
    hash(): string;
    /**
     * The particles of the last frame as comma-separated values, as `petri run --trajectory run.csv` writes them: the first
     * call gives a header, too, and the dimensions that the columns have, for the calls in later frames.
     */
    table(dimensions?: number): { text: string; dimensions: number };
    /** The last frame as `petri run --print` shows it. */
    print(...sections: Section[]): string;
    /** What debug() said in the last frame. */
    log(): string;
    evaluate(expression: string): { text: string; number: number };
    /** A line typed at the prompt; what it prints. Bindings and nodes stay. */
    prompt(text: string): string;
    /** Whether the last frame has anything to draw. */
    readonly drawable: boolean;
    /** What the last frame shows, as numbers for `drawPicture`; null if there is nothing to draw. */
    displayList(options?: { automatic?: boolean }): Picture | null;
    /**
     * The same, but with all that takes WebGL 2 (three dimensions, effects, several canvases), as an image that is the
     * caller's; numbers where they are all of it, or there is no WebGL 2.
     */
    render(options?: { automatic?: boolean }): Picture | RenderedImage | null;
    /** Whether the pictures of the last frame depend on those before (`!feedback`, `!reference`, …). */
    readonly needsHistory: boolean;
    /** To be called after each step whose picture is not shown: makes it if later ones depend on it, and says whether they do. */
    renderIfNeeded(): boolean;
    tokens(text: string): Token[];
    help(): Help[];
    symbol(name: string): number;
    symbolName(number: number): string | null;
    /** Where the pointer is in the picture, 0 to 1 from the top left; buttons as bits. */
    pointer(inside: boolean, x?: number, y?: number, buttons?: number): this;
    key(name: string, pressed: boolean): this;
    /** All that decides how the session goes on, for `rewind`. */
    snapshot(): Snapshot;
    rewind(snapshot: Snapshot): this;
    close(): void;
}

export interface Picture {
    /** As petri-draw.h describes them (petri_picture_display_list). */
    numbers: Float64Array;
    title: string;
    /** false: particles are not yet where they will be seen. */
    ready: boolean;
    /** Of `render`: whether there is WebGL 2. */
    screen?: boolean;
}

export interface Snapshot {
    readonly bytes: number;
    free(): void;
}
