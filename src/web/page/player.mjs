// player.mjs: runs a script in the worker, with a history for going back, and records changes of parameters and of the script.

const MAX_BYTES = 256 << 20; // of the history
const MAX_LOGS = 200; // frames whose output is kept; the prompt shows no more lines
export const FIRST_SEEN = 2; // first frame in which particles are at their positions

export class Player {
    // options: options for sessions, except files. watches: an object that is notified of every frame.
    constructor(engine, options, watches) {
        this.engine = engine;
        this.watches = watches;
        this.options = options;
        this.files = {};
        this.session = null;
    }

    // Opens a new session for a script, before frame 0. If loading fails, throws the error and keeps the current session.
    load(text, name, changes = []) {
        this.replace({ files: this.files }, text, name, changes, session => {
            for (const [frame, parameter, value] of changes)
                if (frame < 0)
                    session.define(`${parameter}=${value}`);
            session.load(text, name);
        });
    }

    // Opens a new session that replays an archive, like `load`. On success, the player closes the archive.
    replay(archive, text) {
        const { script, firstFrame, lastFrame } = archive.info;
        this.replace({ archive }, text, script, [], session => archive.load(session));
        Object.assign(this, { archive, first: firstFrame, frame: firstFrame - 1, lastFrame, recordedEnd: lastFrame, replays: true });
    }

    replace(options, text, name, changes, load) {
        const session = this.engine.open({ ...this.options, ...options });
        let history;
        try {
            load(session);
            history = session.history(MAX_BYTES);
        } catch (error) {
            session.close();
            throw error;
        }
        this.history?.free();
        this.session?.close();
        this.archive?.close();
        Object.assign(this, {
            session, history, text, name, first: 0, frame: -1, lastFrame: -1, torn: false, lacksHistory: false,
            archive: null, recordedEnd: -1, replays: false, verified: new Set(), differing: new Set(),
            logs: [], logOfShown: '', logged: session.frame.number, // last frame whose output is in a log
            known: session.frame.number, // last frame of the history, to which steps repeat the changes
        });
        this.setChanges(changes);
    }

    endReplay() {
        this.archive.endReplay();
        this.replays = false;
    }

    // Ends the replay after the current frame, so that later frames have no recorded input and are not compared.
    cutReplay() {
        this.endReplay();
        this.recordedEnd = Math.min(this.recordedEnd, this.frame);
        for (const frames of [this.verified, this.differing])
            frames.forEach(frame => frame > this.frame && frames.delete(frame));
    }

    // Compares the frame that was just computed with the archive.
    verify() {
        const same = this.frame <= this.recordedEnd ? this.archive.compare(this.session) : null;
        if (same !== null)
            (same ? this.verified : this.differing).add(this.frame);
    }

    // The result of the comparison: `same` is that of the current frame, null if it is not known.
    get verification() {
        const { frame, first, verified, differing } = this;
        return this.archive && {
            same: differing.has(frame) ? false : verified.has(frame) ? true : null, verified: verified.size,
            of: this.archive.info.lastFrame - first + 1, differs: differing.size ? Math.min(...differing) : null,
        };
    }

    // Stores the changes as a list and in a map from frames to changes. A change is [last frame before it, parameter, value]; for the
    // script, [last frame before it, null, text]; for a particle, [frame, null, arguments of History.move]. A link may have thousands of
    // changes and a million frames, so searching the list after every frame would take too long.
    setChanges(changes) {
        this.changes = changes;
        this.changesAt = new Map();
        for (const change of changes) {
            if (!this.changesAt.has(change[0]))
                this.changesAt.set(change[0], []);
            this.changesAt.get(change[0]).push(change);
        }
    }

    step() {
        this.torn = true; // the session has no valid frame until this step is complete
        this.history.step();
        this.needsHistory = this.session.renderIfNeeded();
        this.torn = false;
        this.frame++;
        this.lastFrame = Math.max(this.lastFrame, this.frame);
        this.collectLog();
        if (this.archive)
            this.verify();
        if (this.replays && this.frame === this.recordedEnd && this.frame < this.archive.info.lastFrame)
            this.endReplay();
        this.watches.see(this);
        const later = this.frame >= this.known ? this.changesAt.get(this.frame) ?? [] : [];
        this.known = Math.max(this.known, this.frame);
        for (const [, name, value] of later)
            if (Array.isArray(value))
                this.history.move(...value);
            else if (name === null)
                this.session.reload(value, this.name);
            else
                this.session.setParameter(name, value);
    }

    // Collects the output of debug() of each frame that was not computed before; of other frames, only that of the last.
    collectLog() {
        const log = this.session.log(), isNew = this.frame > this.logged;
        this.logOfShown = isNew ? '' : log;
        if (isNew && log)
            this.logs = [...this.logs.slice(1 - MAX_LOGS), log];
        this.logged = Math.max(this.logged, this.frame);
    }

    // Returns the output since the last call.
    takeLog() {
        const log = this.logs.join('') + this.logOfShown;
        Object.assign(this, { logs: [], logOfShown: '' });
        return log;
    }

    // Called after the WebGL context was restored. The next `seek` to the current frame renders all earlier pictures again if this frame
    // depends on them.
    redraw() {
        this.automatic = false;
        this.lacksHistory = !!this.needsHistory;
    }

    // Goes to a frame before `frame`, from which few steps lead to it.
    back(frame) {
        const { lastFrame, logged, logs } = this;
        // If pictures depend on earlier pictures, all of them are rendered again from the first.
        // After the end of a replay, its frames need their recorded input again, which only the archive can load.
        if (!this.needsHistory && this.history.rewind(frame) && (this.replays || this.session.frame.number >= this.recordedEnd)) {
            this.frame = this.session.frame.number;
        } else if (this.archive) {
            this.archive.load(this.session, this.needsHistory ? -1 : Math.min(frame, this.recordedEnd) - 1);
            this.history.start();
            this.frame = this.known = this.session.frame.number;
            this.replays = true;
        } else {
            this.load(this.text, this.name, this.changes);
        }
        Object.assign(this, { lastFrame, logged, logs });
    }

    // Goes to a frame. To go back, steps from an earlier frame, so that the frame's tree is computed. Takes at most `max` steps, and ends
    // after a step if `ends` returns true. Returns false if the frame is not reached yet.
    seek(wanted, max = Infinity, ends = () => false) {
        const frame = Math.max(wanted, this.first);
        if (frame < this.frame || (frame === this.frame && (this.torn || this.lacksHistory)))
            this.back(frame);
        for (let i = 0; this.frame < frame && i < max && !ends(); i++)
            this.step();
        return this.frame >= frame;
    }

    // Changes a parameter for the next and all later frames. Forgets the later frames.
    set(name, value) {
        if (this.archive)
            this.cutReplay();
        this.session.setParameter(name, value);
        this.record(name, value);
    }

    // Moves a particle in the current frame (History.move). Forgets the later frames.
    move(...particle) {
        if (this.archive)
            this.cutReplay();
        this.history.move(...particle);
        this.record(null, particle);
    }

    // Replaces the script for the next and all later frames; state, frame numbers and clocks continue. If `again` is true, computes the
    // current frame with the new script. If the script has errors, throws and keeps the old script.
    edit(text, again) {
        const at = this.frame;
        if (again && (at === 0 || (at <= FIRST_SEEN && this.changes.length === 0))) { // nothing has run yet
            this.load(text, this.name);
            this.watches.forget(-1);
            this.seek(at);
            return;
        }
        if (again) {
            this.back(at);
            this.seek(at - 1);
        }
        try {
            this.session.reload(text, this.name);
            this.record(null, text);
        } finally {
            if (again)
                this.seek(at);
        }
    }

    // Records a change after the current frame. It replaces one of the same parameter, or of the script, but not moves of particles.
    record(name, value) {
        const isReplaced = (other, old) => other === name && !Array.isArray(old) && !Array.isArray(value);
        const before = this.changes.filter(([frame, other, old]) =>
            frame < this.frame || (frame === this.frame && !isReplaced(other, old)));
        this.setChanges([...before, [this.frame, name, value]]);
        this.lastFrame = this.known = this.logged = this.frame;
        this.watches.forget(this.frame);
    }
}
