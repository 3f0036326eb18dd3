// constants.mjs: generated from the public headers by src/web/constants.sh.
export const STATUSES = ['ok', 'invalid', 'limit_exceeded', 'out_of_memory', 'unsupported', 'interrupted'];
export const LEVELS = ['error', 'warning', 'note'];
export const TOKENS = ['name', 'keyword', 'number', 'string', 'symbol', 'node', 'tag', 'operator', 'comment',
    'invalid', 'newline', 'indent', 'dedent'];
export const SECTIONS = { tree: 1, state: 2, log: 4, error: 8, hash: 16, digest: 32 };
export const COMPOSITES = ['modulate', 'clear', 'src', 'dst', 'over', 'dst_over', 'in', 'dst_in', 'out', 'dst_out',
    'atop', 'dst_atop', 'xor', 'add', 'multiply', 'screen', 'overlay', 'darken', 'lighten', 'color_dodge',
    'color_burn', 'hard_light', 'soft_light', 'difference', 'exclusion', 'hue', 'saturation', 'color', 'luminosity'];
export const CANVAS_MODES = ['multiply', 'clear', 'copy', '', 'source-over', 'destination-over', 'source-in',
    'destination-in', 'source-out', 'destination-out', 'source-atop', 'destination-atop', 'xor', 'lighter', 'multiply',
    'screen', 'overlay', 'darken', 'lighten', 'color-dodge', 'color-burn', 'hard-light', 'soft-light', 'difference',
    'exclusion', 'hue', 'saturation', 'color', 'luminosity'];
export const COMMANDS = [
    ['matrix', (r, p) => p.matrix(r.matrix())],
    ['color', (r, p) => p.color(r.colour())],
    ['linear', (r, p) => p.linear(r.number(), r.number(), r.number(), r.number(), r.number(), r.stops())],
    ['radial', (r, p) => p.radial(r.matrix(), r.number(), r.number(), r.number(), r.number(), r.stops())],
    ['strokeStyle', (r, p) => p.strokeStyle(r.number(), r.number(), r.number(), r.number(), r.number(), r.number(), r.list())],
    ['path', (r, p) => p.path(r.number(), r.number(), r.number(), r.path())],
    ['text', (r, p) => p.text(...r.numbers(9), r.string(), r.string())],
    ['image', (r, p) => p.image(r.number(), r.number(), r.number(), r.number(), r.number(), r.string())],
    ['clip', (r, p) => p.clip(r.number(), r.number(), r.path())],
    ['save', (r, p) => p.save()],
    ['restore', (r, p) => p.restore()],
    ['layer', (r, p) => p.layer()],
    ['layerEnd', (r, p) => p.layerEnd(r.number())],
    ['unsupported', (r, p) => p.unsupported(r.string())],
    ['background', (r, p) => p.background(r.colour())],
    ['pixels', (r, p) => p.pixels(r.number(), r.number(), r.number(), r.number(), r.number(), r.pixels())],
    ['pattern', (r, p) => p.pattern(r.matrix(), r.number(), r.pixels(), r.string())],
    ['filter', (r, p) => p.filter(r.list())],
    ['blend', (r, p) => p.blend(r.number(), r.number(), r.number(), r.paint(), r.paint())],
    ['noise', (r, p) => p.noise(...r.numbers(8))],
    ['solid', (r, p) => p.solid(r.colour(), r.number())],
    ['effect', (r, p) => p.effect(r.list())],
];
export const PATH_ELEMENTS = [
    ['move', 2],
    ['line', 2],
    ['quadratic', 4],
    ['cubic', 6],
    ['arc', 6],
    ['arcOn', 6],
    ['arcTo', 7],
    ['close', 0],
];
export const WORDS = {
    join: ['miter', 'round', 'bevel'],
    cap: ['butt', 'round', 'square'],
    slant: ['upright', 'oblique', 'italic'],
    fit: ['original size', 'stretched', 'inside', 'filling'],
    type: ['fractal', 'turbulence', 'improved'],
};
