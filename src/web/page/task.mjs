// task.mjs: checks the task of a lesson of the tour, in the worker.

// Runs a script from frame 0 to a frame. Returns true if the expression `check` is true for the state after this frame, and the regular
// expression `tree` matches its nodes; each is optional.
export function passes(engine, { text, name, frame, check, tree }, options = {}) {
    const session = engine.open(options);
    try {
        session.load(text, name);
        for (let i = 0; i <= frame; i++)
            session.step();
        return (!check || session.evaluate(`1 if (${check}) else 0`).text === '1')
            && (!tree || new RegExp(tree, 'm').test(session.print('tree')));
    } catch (error) {
        if (engine.broken || error.status === 'interrupted')
            throw error;
        return false;
    } finally {
        if (!engine.broken)
            session.close();
    }
}
