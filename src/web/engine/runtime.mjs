// runtime.mjs: the functions that emscripten expects of every host: setjmp and longjmp, and the upper half of 64-bit results.

// Thrown by longjmp.
const LEFT = Symbol('longjmp');

// Returns the imports of a program. `find(name)` returns one of them, or undefined. `exports` returns the exports of the
// instance; it is called only after the program has started.
export function runtime(exports) {
    let high = 0;
    // Functions that use setjmp call other functions through this wrapper, which catches longjmp.
    const invoke = (index, ...values) => {
        const wasm = exports(), stack = wasm.stackSave();
        try {
            return wasm.__indirect_function_table.get(index)(...values);
        } catch (error) {
            if (error !== LEFT)
                throw error;
            wasm.stackRestore(stack);
            wasm.setThrew(1, 0);
        }
    };
    const functions = {
        getTempRet0: () => high,
        setTempRet0: value => (high = value),
        emscripten_notify_memory_growth: () => {},
        _emscripten_throw_longjmp: () => {
            throw LEFT;
        },
    };
    return name => name.startsWith('invoke_') ? invoke : functions[name];
}
