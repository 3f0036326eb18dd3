// message.mjs: the line of a page for messages.

export function say(text, bad = false) {
    const line = document.getElementById('message');
    line.textContent = text;
    line.classList.toggle('error', bad);
}
