// petri.d.ts: types and documentation of petri.mjs.
import type { Level, Section, Status as StatusName, TokenKind } from './constants.mjs';

export type { Level, Section, TokenKind };

/** The bytes of engine.wasm, a compiled module, a URL, or the response of a fetch. Default: the file `engineFile()` next to petri.mjs. */
export type EngineSource = BufferSource | WebAssembly.Module | Response | URL | string;

/** Compiles the engine, which takes about ten milliseconds. */
export function loadEngine(source?: EngineSource): Promise<Engine>;

/** Returns the name of the engine's file for this browser: engine.wasm or, without WebAssembly SIMD, engine-scalar.wasm. */
export function engineFile(): string;

export type Status = Exclude<StatusName, 'limit_exceeded' | 'out_of_memory' | 'unsupported'> | 'limit' | 'memory' | 'missing';
export const STATUS: Status[];

/** A message about a script. Lines and columns count from 1. Columns count characters. */
export interface Diagnostic {
    level: Level;
    file: string | null;
    line: number;
    column: number;
    endLine: number;
    endColumn: number;
    text: string;
    /** Identifier of the kind of message, such as "unbound-name". */
    code: string | null;
    /** How to fix the problem; "": no hint. */
    hint: string;
    /** The message with position, source line, carets and hint, as far as they exist, as printed by the petri command. */
    rendered: string;
}

export class PetriError extends Error {
    status: Status;
    diagnostics: Diagnostic[];
}

export interface Options {
    /** Frames per second, unless the script sets the rate. Default: 60. */
    fps?: number;
    /** Memory limit of the script in bytes. Default: 1 GiB. */
    memory?: number;
    /** Work limit of a call in units of about ten nanoseconds. A frame that exceeds the limit is aborted. Default: 2^28. */
    work?: number;
    /** Allows `explain`. A frame then takes slightly longer. Default: false. */
    keepForces?: boolean;
    /** Files that scripts can read and import, by name. Scripts cannot access any other files. */
    files?: Record<string, string | Uint8Array>;
    /** The archive whose files the session reads, to replay it with `archive.load`. Close the session before the archive. */
    archive?: Archive;
    onDiagnostic?: (diagnostic: Diagnostic) => void;
    /**
     * Polled about every ten microseconds during calls that may take long. Return true to end the call with the status
     * "interrupted"; the call then changes nothing. Calls that only read values are not interrupted.
     * The callback can check a clock, or a SharedArrayBuffer that another thread writes.
     */
    shouldInterrupt?: () => boolean;
}

export interface Engine {
    readonly version: string;
    /** The exception that made the engine unusable; undefined while the engine works. If it is set, load a new engine. */
    readonly broken?: Error;
    /**
     * Called with true after the WebGL context was lost, and with false after the browser has restored it. Between these calls, `render`
     * returns display lists.
     */
    onContextChange: ((lost: boolean) => void) | null;
    open(options?: Options): Session;
    /**
     * Opens an archive that `petri run --archive` has written. Only the engine in `engine-archives.wasm` can do so:
     * `loadEngine('./engine-archives.wasm')`. Do not change the bytes until the archive is closed. Throws an error if they are not an
     * archive. `memory` limits the size of its files in bytes (default: 1 GiB).
     */
    openArchive(bytes: Uint8Array, options?: { memory?: number }): Archive;
}

export interface ArchiveInfo {
    /** File name of the first script. */
    script: string;
    /** Command line that created the archive; "": unknown. */
    command: string;
    /** Version of petri that created the archive. */
    version: string;
    /** The digest of the run. */
    sha256: string;
    firstFrame: number;
    lastFrame: number;
}

/** An archive of a run, which a session replays. */
export interface Archive {
    readonly info: ArchiveInfo;
    /** Versions of all files; `frame` is the first frame that used the version. */
    readonly files: { name: string; frame: number; bytes: Uint8Array }[];
    /** The first problem while the archive was read; null: none. */
    readonly problem: string | null;
    /** Reads all rows and computes the digest of the run. Returns the problem if the archive is damaged. */
    check(): string | null;
    /**
     * Loads the nearest keyframe at or before a frame, by default the first one, into a session that was opened for this archive. The
     * session's `step` then computes the recorded frames with their inputs, and later frames without.
     */
    load(session: Session, frame?: number): void;
    /** Compares the current frame with the archive. Returns null if the archive has no digest of it. */
    compare(session: Session): boolean | null;
    /** Ends the replay: the session continues without recorded input. */
    endReplay(): void;
    close(): void;
}

export interface Frame {
    /** Counts from 0; -1 before the first frame. */
    number: number;
    time: number;
    beat: number;
    fps: number;
    tempo: number;
    /** Number of simulation steps of all systems in this frame. */
    steps: number;
    evaluationSeconds: number;
    physicsSeconds: number;
}

/** A name whose value the host can set: `let NAME=NAME or DEFAULT -- MIN..MAX|STEP comment`. */
export interface Parameter {
    name: string;
    defaultValue: string;
    value: string;
    comment: string;
    /** The value as a number; NaN unless the value is a single number. */
    number: number;
    defaultNumber: number;
    /** The range; infinite if the comment contains no range. */
    min: number;
    max: number;
    /** Step size; 0: none. */
    step: number;
    defined: boolean;
    settable: boolean;
    line: number;
    column: number;
}

/** Numbers in the engine's memory. The numbers of particle i begin at `data[i * stride]`. */
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

/** A contribution to the force on a particle. */
export interface Contribution {
    /** The node's kind, such as "gravity"; null for the particle's attribute `force`. */
    kind: string | null;
    /** Position of the node; null and 0 if it is unknown. */
    file: string | null;
    line: number;
    column: number;
    /** Id of the other particle as it is printed; null if there is none. */
    partner: string | null;
    vector: number[];
}

/** The forces on a particle in the order of summation. The sum of all vectors is `sum`, to the last bit. */
export interface Explanation {
    contributions: Contribution[];
    sum: number[];
}

export interface Token {
    kind: TokenKind;
    /** Offsets in bytes of the UTF-8 text; `end` is the offset after the token. */
    start: number;
    end: number;
}

/** A row of petri's help tables. The row of a node is followed by the rows of its attributes. */
export interface Help {
    kind: 'function' | 'node' | 'attribute' | 'name';
    name: string;
    /** The parameters of a function, the area of a node, or the type of an attribute. */
    parameters: string;
    defaultValue: string;
    unit: string;
    help: string;
}

/** A picture rendered by the engine: with WebGL 2, or because it has filters or noise. */
export interface RenderedImage {
    image: ImageBitmap;
    title: string;
    ready: boolean;
    /** Descriptions of unsupported parts, which are omitted. */
    unsupported: string[];
    /** True if WebGL 2 is available. */
    screen: boolean;
    /** True if the browser has lost the WebGL context. */
    lost: boolean;
}

/** A session, which runs a script. Calls that fail throw a PetriError and change nothing. */
export interface Session {
    /** Loads a script. Frame numbers restart at 0; the state is kept. */
    load(text: string | Uint8Array, name?: string): this;
    /** Replaces the text of the running script; frames, time and state continue. */
    reload(text: string | Uint8Array, name?: string): this;
    /** Returns the diagnostics of a script without changing anything. */
    diagnose(text: string | Uint8Array, name?: string): Diagnostic[];
    /** Defines a name, as in "SIZE=20", for scripts that are loaded later. */
    define(definition: string): this;
    /** Adds a file that scripts can read and import. null removes the file. */
    setFile(name: string, content: string | Uint8Array | null): void;
    /** Computes the next frame. */
    step(): this;
    stepAt(time: number, beat: number): this;
    /** Clears the state and restarts before frame 0. */
    clear(): void;
    readonly frame: Frame;
    /** The units of work (`Options.work`) of all calls since the session was opened, to limit a whole run. */
    readonly work: number;
    readonly parameters: Parameter[];
    /** Sets a parameter to a value, written as in a script, or to its default if `value` is null. */
    setParameter(name: string, value: string | number | null): this;
    /** Sets a global for scripts that are loaded later. Its value can be changed at any time. */
    setGlobal(name: string, value: number | ArrayLike<number>): this;
    /** The systems of the last frame. Columns are views, valid until the next call that changes the session. Copy them to keep them. */
    readonly systems: System[];
    /** Returns the id of a particle as it is printed; null if there is no such particle. Both arguments count from 0. */
    particleId(system: number, particle: number): string | null;
    /**
     * Explains the force on a particle in the last step of the last frame. Needs `Options.keepForces`, and a frame in which the system
     * took a step.
     */
    explain(system: number, particle: number): Explanation;
    /**
     * Returns the particle that is drawn at a point of the picture, as a circle at its position; null if there is none.
     * x and y are 0 at the top left and 1 at the bottom right. `name` is the name of its system and `id` its id, as they are printed.
     */
    pick(x: number, y: number, options?: { automatic?: boolean }): { name: string; id: string } | null;
    /**
     * Describes a particle: entries of the state, the node of the script that makes it, and the forces on it as by `explain`. `note` is the
     * reason why something is missing.
     */
    describe(particle: { name: string; id: string }): Partial<Explanation> & {
        state: [string, string][]; origin?: { kind: string; file: string; line: number; column: number }; note?: string;
    };
    /** Maps printed keys to arrays of numbers, or to the printed value if not all elements are numbers. */
    readonly state: Map<string, number[] | string>;
    /** Returns the digest of the state, which is the same on every machine. Takes little time. */
    digest(): string;
    /** Returns the SHA-256 of the printed state, which takes a hundred times as long as the digest. */
    hash(): string;
    /** Returns the particles of the last frame as comma-separated values, as written by `petri run --trajectory run.csv`. The first
     * call includes a header and returns the number of dimensions, which must be passed to later calls.
     */
    table(dimensions?: number): { text: string; dimensions: number };
    /** Returns the last frame as printed by `petri run --print`. */
    print(...sections: Section[]): string;
    /** Returns the output of debug() in the last frame. */
    log(): string;
    evaluate(expression: string): { text: string; number: number };
    /** Evaluates a line typed at the prompt and returns its output. Bindings and nodes persist. */
    prompt(text: string): string;
    /**
     * Executes an input of the prompt as `petri repl` does: a command or code. Returns its output; `failed` is true after a message. `host`
     * has the bounds of the timeline and computes its frames; run and plot are called if the input asks for them.
     */
    execute(text: string, host: {
        first: number; last: number; step(): void; goTo(frame: number): void; set(name: string, value: string): void;
        run(): void; plot(expression: string): void;
    }): { text: string; failed: boolean };
    /** Removes the nodes that were typed at the prompt and, if `bindings` is true, also the names. Returns the number of statements. */
    clearPrompt(bindings?: boolean): number;
    /** True if the last frame has anything to draw. */
    readonly drawable: boolean;
    /** Returns the display list of the last frame for `drawPicture`, or null if there is nothing to draw. */
    displayList(options?: { automatic?: boolean }): Picture | null;
    /**
     * Like `displayList`, but content that needs WebGL 2 (3-D scenes, effects, several canvases), and pictures with filters or noise, are
     * rendered to an image, which the caller owns. Returns a display list if no such content exists, or if WebGL 2 or OffscreenCanvas
     * is not available.
     */
    render(options?: { automatic?: boolean }): Picture | RenderedImage | null;
    /** True if the picture of the last frame depends on earlier pictures (`!feedback`, `!reference`, …). */
    readonly needsHistory: boolean;
    /** Must be called after every step whose picture is not shown. If later pictures depend on this one, renders it and returns true. */
    renderIfNeeded(): boolean;
    tokens(text: string): Token[];
    help(): Help[];
    symbol(name: string): number;
    symbolName(number: number): string | null;
    /**
     * Reports the pointer to the script. `x` and `y` are 0 at the top left of the picture and 1 at the bottom right. Each bit of
     * `buttons` is a button.
     */
    pointer(inside: boolean, x?: number, y?: number, buttons?: number): this;
    key(name: string, pressed: boolean): this;
    /** Stores the complete state of the session for `rewind`. */
    snapshot(): Snapshot;
    rewind(snapshot: Snapshot): this;
    /** Keeps the frames that `History.step` computes, with snapshots of at most `bytes` bytes (default: 64 MiB). */
    history(bytes?: number): History;
    close(): void;
}

export interface Picture {
    /** The display list (petri-draw.h, petri_picture_display_list). */
    numbers: Float64Array;
    title: string;
    /** False if particles are not at their positions yet. */
    ready: boolean;
    /** Set by `render`: true if WebGL 2 is available. */
    screen?: boolean;
    /** Set by `render`: true if the browser has lost the WebGL context. */
    lost?: boolean;
}

export interface History {
    /** Starts again at the current frame. */
    start(): unknown;
    /** Like `Session.step`. Steps from a past frame repeat the changes of parameters and of the script. */
    step(): unknown;
    /** Goes to a frame before `frame`, from which few steps lead to it. Returns false if there is none. */
    rewind(frame: number): boolean;
    /**
     * Moves a particle of the current frame, given by the numbers of its system and of the particle in it. A vector that is missing is
     * kept. Frames after this one are discarded.
     */
    move(system: number, particle: number, position?: number[], velocity?: number[]): unknown;
    free(): void;
}

export interface Snapshot {
    readonly bytes: number;
    free(): void;
}
