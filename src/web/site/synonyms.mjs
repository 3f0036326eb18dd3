// synonyms.mjs: other words for words of the manual, by which the search finds them. Words are in lower case; `of` maps a searched word to
// words of the manual.

const TABLE = {
    circle: 'ellipse', disc: 'ellipse', dot: 'ellipse', background: 'rect colour', backdrop: 'rect', square: 'rect', rectangle: 'rect',
    friction: 'drag', damping: 'drag', viscosity: 'drag', wall: 'barrier', border: 'barrier', boundary: 'boundaries barrier',
    bounce: 'barrier collision', loop: 'for', repeat: 'for', while: 'for', mouse: 'pointer', cursor: 'pointer', touch: 'pointer',
    click: 'pointer', keyboard: 'keys pointer', keypress: 'keys', export: 'render playground', save: 'render write', film: 'video',
    movie: 'video', mp4: 'video', animation: 'video', screenshot: 'picture', image: 'picture', png: 'picture', spring: 'distance',
    rope: 'distance chain',
    string: 'chain', cloth: 'chain', pin: 'anchor', fixed: 'anchor', static: 'anchor', variable: 'let name', constant: 'let',
    function: 'func', method: 'func', array: 'vector', list: 'vector', tuple: 'vector', noise: 'random', rand: 'random uniform',
    color: 'colour', hue: 'hsv', rgb: 'colour', opacity: 'alpha', transparent: 'alpha', slider: 'parameter', knob: 'parameter',
    setting: 'parameter', argument: 'parameter', flag: 'option', cli: 'command', shader: 'glsl', glow: 'bloom', jupyter: 'notebook',
    ipython: 'notebook', pandas: 'numpy', install: 'installed', setup: 'install', magnet: 'electrostatic', charge: 'electrostatic',
    attract: 'gravity', repel: 'electrostatic', planet: 'gravity orbit', hash: 'digest', checksum: 'digest', seed: 'random seed',
    random: 'uniform', text: 'label', font: 'text', '3d': 'three dimensions', camera: 'scene', mesh: 'model', fps: 'frame rate',
    crash: 'troubleshooting', debug: 'print', log: 'debug', share: 'link', embed: 'petri-dish', component: 'petri-dish',
    npm: 'javascript', node: 'javascript', wasm: 'webassembly', vim: 'editor', vscode: 'editor', emacs: 'editor', cluster: 'mpi',
    parallel: 'mpi threads', undo: 'back', rewind: 'back', audio: 'sound', music: 'sound', speed: 'velocity', if: 'else',
    csv: 'table trajectories', error: 'diagnostic', warning: 'diagnostic', safe: 'untrusted', sandbox: 'untrusted',
};

export const synonymsOf = word => TABLE[word]?.split(' ') ?? [];
