// constants.d.mts: types of the names in constants.mjs, generated from the public headers by src/web/constants.sh.
export type Status = 'ok' | 'invalid' | 'limit_exceeded' | 'out_of_memory' | 'unsupported' | 'interrupted';
export type Level = 'error' | 'warning' | 'note';
export type TokenKind = 'name' | 'keyword' | 'number' | 'string' | 'symbol' | 'node' | 'tag' | 'operator' | 'comment' |
    'invalid' | 'newline' | 'indent' | 'dedent';
export type Section = 'tree' | 'state' | 'log' | 'error' | 'hash' | 'digest';
export type Composite = 'modulate' | 'clear' | 'src' | 'dst' | 'over' | 'dst_over' | 'in' | 'dst_in' | 'out' |
    'dst_out' | 'atop' | 'dst_atop' | 'xor' | 'add' | 'multiply' | 'screen' | 'overlay' | 'darken' | 'lighten' |
    'color_dodge' | 'color_burn' | 'hard_light' | 'soft_light' | 'difference' | 'exclusion' | 'hue' | 'saturation' |
    'color' | 'luminosity';
