// transfer.mjs: opens and makes links, and opens files and archives.
import { packLink, readLink } from './link.mjs';

export class Transfer {
    // page: has the editor, the dish, the script's name, say() and openText().
    constructor(page) {
        this.page = page;
    }

    async copyLink() {
        const { dish, editor, name, say } = this.page;
        const loaded = dish.loaded === editor.text && dish.frame >= 0;
        const answer = loaded ? await dish.attempt('digest') : null, edited = answer?.changes.some(([, parameter]) => parameter === null);
        const link = await packLink({ text: editor.text, name, ...(edited ? { changes: lastValues(answer.changes) } : answer ?? {}) })
            .catch(error => say(error.message, true));
        if (!link)
            return;
        history.replaceState(null, '', link);
        const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
        say((copied ? 'Link copied. Nothing was uploaded.' : 'The link is in the address bar.')
            + (edited ? ' It opens the script at its start, because the script or its particles were changed while it ran.' : ''));
    }

    // Opens the script in the page's link, and runs it in `petri view`. Returns '' on success, or the reason why no script was opened.
    async openLink() {
        if (location.hash.length < 2)
            return 'no link';
        try {
            const linked = await readLink(location.hash);
            await this.page.openText(linked.text, linked.name, { ...linked, play: globalThis.petriView });
            return '';
        } catch (error) {
            this.page.say(error.message, true);
            return error.message;
        }
    }

    // Replays an archive. Its script is shown in the editor; running a changed script ends the replay.
    async openArchive(file) {
        const { dish } = this.page, script = await dish.replay(new Uint8Array(await file.arrayBuffer()));
        if (!script)
            return;
        this.page.scripts.show(script.text, script.name);
        dish.run();
    }

    // Adds scripts and the files that they read. Opens the script that no other script refers to. If there is no such script, restarts the
    // current script if it uses the files.
    async takeFiles(files) {
        const { dish, editor, name, openText } = this.page;
        const archive = [...files].find(file => file.name.endsWith('.petri'));
        if (archive)
            return this.openArchive(archive);
        for (const file of files)
            await dish.addFile(file.name, new Uint8Array(await file.arrayBuffer()));
        await dish.giveFiles();
        const decoded = [...files].filter(file => file.name.endsWith('.fl'))
            .map(file => ({ called: file.name, text: new TextDecoder().decode(dish.files.get(file.name)) }));
        const isNamed = called => [{ called: name, text: editor.text }, ...decoded]
            .some(other => other.called !== called && other.text.includes(called));
        const script = decoded.find(({ called }) => !isNamed(called));
        if (script)
            await openText(script.text, script.called, { play: true });
        else if ([...files].some(file => editor.text.includes(file.name)))
            await dish.open(editor.text, name);
    }

    listen(root) {
        const $ = id => root.getElementById(id);
        $('link').onclick = () => this.copyLink();
        $('open').onclick = () => $('file').click();
        $('file').onchange = () => this.takeFiles($('file').files);
        root.ondragover = event => event.preventDefault();
        root.ondrop = event => {
            event.preventDefault();
            this.takeFiles(event.dataTransfer.files);
        };
        addEventListener('hashchange', () => this.openLink());
    }
}

// Returns the changes that set each parameter before the first frame to the value to which it was changed last.
const lastValues = changes => [...new Map(changes.filter(([, name]) => name !== null).map(([, name, value]) => [name, value]))]
    .map(([name, value]) => [-1, name, value]);
