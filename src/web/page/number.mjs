// number.mjs: numbers as text, which keep their number of digits when they change.

// Returns a number that was moved by a count of steps. A step is one in the last digit.
export function moved(text, steps) {
    const digits = text.split('.')[1]?.length ?? 0;
    return (Number(text) + steps / 10 ** digits).toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1');
}
