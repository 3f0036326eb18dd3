// rate.mjs: measures how many frames a second a script runs.

const WINDOW = 1000; // ms over which the rate is measured
const HOLD = 500; // ms for which a rate is shown, so that it can be read

export class Rate {
    constructor() {
        this.begin();
    }

    // Starts to measure when the script starts to run.
    begin() {
        Object.assign(this, { marks: [], rate: null, since: -Infinity });
    }

    // Records that a frame is shown at `now` ms. Returns the rate, or null if it is not known yet.
    see(now, frame) {
        const { marks } = this;
        marks.push([now, frame]);
        while (marks.length > 2 && now - marks[1][0] > WINDOW)
            marks.shift();
        const [start, first] = marks[0];
        if (now - start > HOLD && now - this.since > HOLD)
            Object.assign(this, { rate: (frame - first) / (now - start) * 1000, since: now });
        return this.rate;
    }
}
