// call.mjs: calls of the engine.

// Makes a call of the engine for its owner, a session or an archive, which receives what the engine writes. After an exception the state
// of the engine is undefined, so the engine is not used again. Only calls that can report an interruption may be interrupted.
export function callEngine(owner, act, mayInterrupt = false) {
    const { engine } = owner;
    if (engine.broken)
        throw engine.broken;
    const outer = engine.session;
    engine.session = owner;
    Object.assign(owner, { mayInterrupt, reported: [], written: [], results: [] });
    try {
        return act(engine.memory.wasm);
    } catch (error) {
        engine.broken = new Error(`the engine crashed: ${error.message}`, { cause: error });
        throw engine.broken;
    } finally {
        engine.session = outer;
    }
}
