// petri.d.ts: types and documentation of petri.mjs.

/** Bytes, a compiled module, the URL of engine.wasm, or the response of a fetch. Default: engine.wasm next to petri.mjs. */
export type EngineSource = BufferSource | WebAssembly.Module | Response | URL | string;

/** Compiles the engine, which takes about ten milliseconds. */
export function loadEngine(source?: EngineSource): Promise<Engine>;

export type Status = 'ok' | 'invalid' | 'limit' | 'memory' | 'missing' | 'interrupted';
export const STATUS: Status[];

/** A message about a script. Lines and columns count from 1, columns in characters. */
export interface Diagnostic {
    level: 'error' | 'warning' | 'note';
    file: string | null;
    line: number;
    column: number;
    endLine: number;
    endColumn: number;
    text: string;
    /** Identifier of the kind of message, such as "unbound-name". */
    code: string | null;
    /** Advice; "" for none. */
    hint: string;
    /** With position, source line and carets, as printed by the command. */
    rendered: string;
}

export class PetriError extends Error {
    status: Status;
    diagnostics: Diagnostic[];
}

export interface Options {
    /** Frames per second, unless the script sets it. Default 60. */
    fps?: number;
    /** Memory limit of the script in bytes. Default 1 GiB. */
    memory?: number;
    /** Work limit of a call in units of about ten nanoseconds; a frame that exceeds it is aborted. Default 2^28. */
    work?: number;
    /** Files that scripts can read and import, by name. They have no other access. */
    files?: Record<string, string | Uint8Array>;
    onDiagnostic?: (diagnostic: Diagnostic) => void;
    /**
     * Polled about every ten microseconds during calls that may take long. Return true to end the call with the status
     * "interrupted"; nothing has changed then. Calls that only read values are not interrupted.
     * It can check a clock, or a SharedArrayBuffer that another thread writes.
     */
    shouldInterrupt?: () => boolean;
}

export interface Engine {
    readonly version: string;
    /** The exception that made the engine unusable; load another engine then. */
    readonly broken?: Error;
    open(options?: Options): Session;
}

export interface Frame {
    /** From 0; -1 before the first frame. */
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

/** A name that can be set from outside: `let NAME=NAME or DEFAULT -- MIN..MAX|STEP comment`. */
export interface Parameter {
    name: string;
    defaultValue: string;
    value: string;
    comment: string;
    /** NaN unless the value is one number. */
    number: number;
    defaultNumber: number;
    /** The range; infinite if there is none. */
    min: number;
    max: number;
    /** 0: none. */
    step: number;
    defined: boolean;
    settable: boolean;
    line: number;
    column: number;
}

/** Numbers in the engine's memory; those of particle i begin at `data[i * stride]`. */
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
    /** null if an id is not a number. */
    ids: Column | null;
}

export interface Token {
    kind: 'name' | 'keyword' | 'number' | 'string' | 'symbol' | 'node' | 'tag' | 'operator' | 'comment' | 'invalid'
        | 'newline' | 'indent' | 'dedent';
    /** Positions in bytes of UTF-8. */
    start: number;
    end: number;
}

/** A row of petri's tables; a node is followed by its attributes. */
export interface Help {
    kind: 'function' | 'node' | 'attribute' | 'name';
    name: string;
    /** The parameters of a function, the area of a node, or the type of an attribute. */
    parameters: string;
    defaultValue: string;
    unit: string;
    help: string;
}

export type Section = 'tree' | 'state' | 'log' | 'error' | 'hash';

/** A picture drawn with WebGL 2. */
export interface RenderedImage {
    image: ImageBitmap;
    title: string;
    ready: boolean;
    /** Descriptions of unsupported parts, which are omitted. */
    unsupported: string[];
    screen: true;
}

/** A running script. Calls that fail throw a PetriError and change nothing. */
export interface Session {
    /** Loads a script. Frames count from 0 again; the state is kept. */
    load(text: string | Uint8Array, name?: string): this;
    /** Replaces the text of the running script; frames, time and state continue. */
    reload(text: string | Uint8Array, name?: string): this;
    /** Returns the diagnostics of a script without changing anything. */
    diagnose(text: string | Uint8Array, name?: string): Diagnostic[];
    /** Defines a name, as in "SIZE=20", for scripts loaded from now on. */
    define(definition: string): this;
    /** Adds a file for scripts; null removes it. */
    setFile(name: string, content: string | Uint8Array | null): void;
    /** Computes the next frame. */
    step(): this;
    stepAt(time: number, beat: number): this;
    /** Clears the state and restarts before frame 0. */
    clear(): void;
    readonly frame: Frame;
    readonly parameters: Parameter[];
    /** Sets a parameter to a value, written as in a script; null: to its default. */
    setParameter(name: string, value: string | number | null): this;
    /** Sets a global for scripts loaded from now on. Its value can be changed at any time. */
    setGlobal(name: string, value: number | ArrayLike<number>): this;
    /** Columns are views, valid until the next call that changes something; copy them to keep them. */
    readonly systems: System[];
    /** Printed keys with numbers, or with the printed value if it is not all numbers. */
    readonly state: Map<string, number[] | string>;
    /** The SHA-256 of the state: the same on every machine. */
    hash(): string;
    /**
     * The particles of the last frame as comma-separated values, as written by `petri run --trajectory run.csv`. The first
     * call includes a header and returns the number of dimensions, which must be passed in later frames.
     */
    table(dimensions?: number): { text: string; dimensions: number };
    /** The last frame as printed by `petri run --print`. */
    print(...sections: Section[]): string;
    /** The output of debug() in the last frame. */
    log(): string;
    evaluate(expression: string): { text: string; number: number };
    /** Evaluates a line typed at the prompt and returns its output. Bindings and nodes persist. */
    prompt(text: string): string;
    /** True if the last frame has anything to draw. */
    readonly drawable: boolean;
    /** The display list of the last frame for `drawPicture`; null if there is nothing to draw. */
    displayList(options?: { automatic?: boolean }): Picture | null;
    /**
     * Like `displayList`, but content that needs WebGL 2 (3-D scenes, effects, several canvases) is rendered to an image,
     * which the caller owns. Returns a display list if that is sufficient, or without WebGL 2.
     */
    render(options?: { automatic?: boolean }): Picture | RenderedImage | null;
    /** True if the pictures of the last frame depend on earlier ones (`!feedback`, `!reference`, …). */
    readonly needsHistory: boolean;
    /** Call this after every step whose picture is not shown. Renders it if later ones depend on it, and returns whether they do. */
    renderIfNeeded(): boolean;
    tokens(text: string): Token[];
    help(): Help[];
    symbol(name: string): number;
    symbolName(number: number): string | null;
    /** Reports the pointer's position in the picture, 0 to 1 from the top left; buttons as bits. */
    pointer(inside: boolean, x?: number, y?: number, buttons?: number): this;
    key(name: string, pressed: boolean): this;
    /** Stores the complete state of the session for `rewind`. */
    snapshot(): Snapshot;
    rewind(snapshot: Snapshot): this;
    close(): void;
}

export interface Picture {
    /** The display list (petri-draw.h, petri_picture_display_list). */
    numbers: Float64Array;
    title: string;
    /** false: particles are not at their positions yet. */
    ready: boolean;
    /** Set by `render`: true if WebGL 2 is available. */
    screen?: boolean;
}

export interface Snapshot {
    readonly bytes: number;
    free(): void;
}
