// player.mjs: runs a script in the worker, with keyframes for going back, and records changes of parameters and of the script.

const EVERY = 20; // frames between keyframes, doubled each time when there are too many
const MAX_KEYFRAMES = 64; // maximum number of keyframes, not counting those after parameter changes
const MAX_BYTES = 256 << 20;
const MAX_TIME = 1000; // ms of computing after which a frame becomes a keyframe, so that going back in a slow world takes about a second
export const FIRST_SEEN = 2; // first frame in which particles are at their positions

export class Player {
    // options: options for sessions, except files. watches: an object that is notified of every frame.
    constructor(engine, options, watches) {
        this.engine = engine;
        this.watches = watches;
        this.options = options;
        this.files = {};
        this.session = null;
        this.time = 0; // ms of computing since the last keyframe
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
        try {
            load(session);
        } catch (error) {
            session.close();
            throw error;
        }
        this.forget(-2);
        this.session?.close();
        this.archive?.close();
        Object.assign(this, {
            session, text, name, keyframes: [], every: EVERY, first: 0, frame: -1, lastFrame: -1, torn: false, lacksHistory: false,
            archive: null, recordedEnd: -1, replays: false, verified: new Set(), differing: new Set(),
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

    // Stores the changes as a list and in a map from frames to changes. A change is [last frame before it, parameter, value], or, for the
    // script, [last frame before it, null, text]. A link may have thousands of changes and a million frames, so searching the list after
    // every frame would take too long.
    setChanges(changes) {
        this.changes = changes;
        this.changesAt = new Map();
        for (const change of changes) {
            if (!this.changesAt.has(change[0]))
                this.changesAt.set(change[0], []);
            this.changesAt.get(change[0]).push(change);
        }
    }

    // Frees the keyframes of all frames after `frame`.
    forget(frame) {
        const keep = this.keyframes?.filter(key => key.frame <= frame) ?? [];
        this.keyframes?.filter(key => key.frame > frame).forEach(key => key.snapshot.free());
        this.keyframes = keep;
    }

    step() {
        const start = performance.now();
        this.torn = true; // the session has no valid frame until this step is complete
        this.session.step();
        this.needsHistory = this.session.renderIfNeeded();
        this.torn = false;
        this.frame++;
        this.lastFrame = Math.max(this.lastFrame, this.frame);
        if (this.archive)
            this.verify();
        if (this.replays && this.frame === this.recordedEnd && this.frame < this.archive.info.lastFrame)
            this.endReplay();
        this.watches.see(this);
        const later = this.changesAt.get(this.frame) ?? [];
        for (const [, name, value] of later)
            if (name === null)
                this.session.reload(value, this.name);
            else
                this.session.setParameter(name, value);
        this.time += performance.now() - start;
        if (later.length || this.frame % this.every === 0 || this.time > MAX_TIME)
            this.keep(later.length > 0);
    }

    // Called after the WebGL context was restored. The next `seek` to the current frame renders all earlier pictures again if this frame
    // depends on them.
    redraw() {
        this.automatic = false;
        this.lacksHistory = !!this.needsHistory;
    }

    keep(changed) {
        this.time = 0;
        const there = this.keyframes.findIndex(key => key.frame === this.frame);
        if (there >= 0) {
            if (!changed)
                return;
            this.keyframes[there].snapshot.free();
            this.keyframes.splice(there, 1);
        }
        this.keyframes.push({ frame: this.frame, snapshot: this.session.snapshot(), changed });
        this.keyframes.sort((a, b) => a.frame - b.frame);
        this.thin();
    }

    thin() {
        const bytes = this.keyframes.reduce((sum, key) => sum + key.snapshot.bytes, 0);
        const changed = this.keyframes.filter(key => key.changed);
        // If there are too many keyframes after changes, treats them like the others. They save work but are not needed, because stepping
        // from an earlier keyframe repeats the changes.
        if (changed.length > MAX_KEYFRAMES || (changed.length > 0 && bytes > MAX_BYTES))
            changed.forEach(key => { key.changed = false; });
        const usual = this.keyframes.filter(key => !key.changed);
        if (usual.length < 2 || (usual.length <= MAX_KEYFRAMES && bytes <= MAX_BYTES))
            return;
        this.every *= 2;
        const dropped = usual.filter(key => key.frame % this.every !== 0);
        dropped.forEach(key => key.snapshot.free());
        this.keyframes = this.keyframes.filter(key => !dropped.includes(key));
    }

    // Goes to a frame. To go back, restores the last keyframe before the frame and steps from there, so that the frame's tree is computed.
    // Takes at most `max` steps, and ends after a step if `ends` returns true. Returns false if the frame is not reached yet.
    seek(wanted, max = Infinity, ends = () => false) {
        const frame = Math.max(wanted, this.first);
        if (frame < this.frame || (frame === this.frame && (this.torn || this.lacksHistory))) {
            // If pictures depend on earlier pictures, all of them are rendered again from the first.
            // After the end of a replay, its frames need their recorded input again, which only the archive can load.
            const usable = key => key.frame < frame && (this.replays || key.frame >= this.recordedEnd);
            const key = this.needsHistory ? null : this.keyframes.findLast(usable);
            const end = this.lastFrame;
            if (key) {
                this.session.rewind(key.snapshot);
                this.frame = key.frame;
            } else if (this.archive) {
                this.archive.load(this.session, this.needsHistory ? -1 : Math.min(frame, this.recordedEnd) - 1);
                this.frame = this.session.frame.number;
                this.replays = true;
            } else {
                const { text, name, changes, keyframes } = this;
                this.keyframes = [];
                this.load(text, name, changes);
                keyframes.forEach(old => old.snapshot.free());
            }
            this.lastFrame = end;
        }
        for (let i = 0; this.frame < frame && i < max && !ends(); i++)
            this.step();
        return this.frame >= frame;
    }

    // Changes a parameter for the next and all later frames. Frees later keyframes.
    set(name, value) {
        if (this.archive)
            this.cutReplay();
        this.session.setParameter(name, value);
        this.record(name, value);
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
        const key = again && this.keyframes.find(({ frame }) => frame === at - 1);
        if (key) {
            this.session.rewind(key.snapshot);
            this.frame = at - 1;
        } else if (again) {
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

    // Records a change after the current frame: a parameter, or the script if `name` is null.
    record(name, value) {
        const before = this.changes.filter(([frame, other]) => frame < this.frame || (frame === this.frame && other !== name));
        this.setChanges([...before, [this.frame, name, value]]);
        this.forget(this.frame);
        this.lastFrame = this.frame;
        this.watches.forget(this.frame);
        if (this.frame >= 0)
            this.keep(true);
    }
}
