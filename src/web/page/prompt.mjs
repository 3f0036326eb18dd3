// prompt.mjs: a prompt for expressions, definitions and commands, as in `petri repl`, and its output.

const LINES = 200; // maximum number of output lines

export class Prompt {
    // plot: a function that plots an expression.
    constructor(root, dish, plot) {
        Object.assign(this, { dish, plot });
        this.line = root.getElementById('line');
        this.printed = root.getElementById('printed');
        this.before = [];
        this.at = 0;
        root.getElementById('prompt').onsubmit = event => {
            event.preventDefault();
            this.take(this.line.value);
        };
        this.line.onkeydown = event => {
            if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown')
                return;
            event.preventDefault();
            this.at = Math.min(Math.max(this.at + (event.key === 'ArrowUp' ? -1 : 1), 0), this.before.length);
            this.line.value = this.before[this.at] ?? '';
        };
    }

    async take(text) {
        this.line.value = '';
        if (text.trim()) // an empty line repeats the last stepping command
            this.before = [...this.before.filter(old => old !== text), text];
        this.at = this.before.length;
        this.print(`? ${text}\n`);
        const answer = await this.dish.ask('prompt', { text: `${text}\n` })
            .catch(({ message, reported = [] }) => ({ text: `${message}\n`, reported }));
        if (answer.type === 'frame') {
            this.dish.pause();
            this.dish.show(answer);
        }
        this.print(answer.text + answer.reported.map(({ rendered }) => rendered).join(''));
        if (answer.runs)
            this.dish.run();
        if (answer.plot)
            this.plot(answer.plot);
    }

    print(text) {
        if (!text)
            return;
        this.printed.textContent = (this.printed.textContent + text).split('\n').slice(-LINES).join('\n');
        this.printed.scrollTop = this.printed.scrollHeight;
    }
}
