// cells.mjs: small dishes of one script with different parameters, in the worker, which loads this file when a grid is opened.

const CATCH_UP = 8; // maximum number of frames in one request, for a dish that was out of view

export class Cells {
    // player: has the engine, its options and the files. paint: the function of paint.mjs, with its images.
    constructor({ player, images, paint }) {
        Object.assign(this, { player, images, paint, all: [] });
    }

    // Replaces the dishes. cells: the canvas and the changes of parameters (player.mjs) of each.
    begin({ text, name, cells }) {
        this.all.forEach(({ session }) => session.close());
        this.all = cells.map(({ canvas, changes }) => {
            const { engine, options, files } = this.player;
            const session = engine.open({ ...options, files, keepForces: false, onDiagnostic: () => {} });
            const cell = { session, context: canvas.getContext('2d'), frame: -1, problem: '' };
            this.attempt(cell, () => {
                changes.forEach(([, parameter, value]) => session.define(`${parameter}=${value}`));
                session.load(text, name);
            });
            return cell;
        });
        return {};
    }

    // Steps the dishes with the numbers in `which` to frame `to`, and draws them. Returns the frame and the problem of each.
    step({ which, to }) {
        const cells = which.map(number => this.all[number]);
        for (const cell of cells)
            if (!cell.problem)
                this.attempt(cell, () => this.advance(cell, Math.min(to, Math.max(cell.frame, 0) + CATCH_UP)));
        return { cells: cells.map(({ frame, problem }) => ({ frame, problem })) };
    }

    advance(cell, to) {
        const { session, context } = cell;
        for (; cell.frame < to; cell.frame++) {
            session.step();
            session.renderIfNeeded();
        }
        const draw = automatic => {
            const picture = session.render({ automatic });
            return picture ? this.paint(context, picture, this.images) : ['picture'];
        };
        if (draw(false).includes('canvas3d'))
            draw(true);
        if (!session.drawable)
            throw new Error('draws nothing');
    }

    attempt(cell, act) {
        try {
            act();
        } catch (error) {
            if (this.player.engine.broken)
                throw error;
            cell.problem = error.diagnostics?.find(({ level }) => level === 'error')?.text ?? error.message.split('\n')[0];
        }
    }

    digest({ number }) {
        const { session, frame } = this.all[number];
        return { digest: session.digest(), frame };
    }
}
