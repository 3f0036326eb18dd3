// pages.mjs: what the manual consists of: each page with the texts of the tree that it is made of, in reading order.

// parts: [file, from this heading, up to before this heading]; without headings: from the beginning, to the end.
// `made`: what generated.mjs adds behind them. `about`: for the list of pages.
export const GROUPS = [
    ['To begin', [
        { name: 'tutorial', title: 'Tutorial', about: 'From one particle to a dish, in ten steps that run on the page',
            parts: [['samples/TUTORIAL.md']] },
        { name: 'gallery', title: 'Gallery', about: 'The samples, which run here',
            parts: [['samples/README.md', null, 'What they look like']], made: 'gallery' },
        { name: 'recipes', title: 'Recipes', about: 'How to do single things', parts: [['samples/RECIPES.md']] },
        { name: 'questions', title: 'Questions', about: 'When something is not as one thinks', parts: [['samples/QUESTIONS.md']] },
        { name: 'flitter', title: 'If you know Flitter', about: 'What runs the same, what is missing, what differs',
            parts: [['README.md', 'If you know Flitter', 'In your editor']] },
    ]],
    ['To look up', [
        { name: 'language', title: 'The language', about: 'Vectors, names, nodes, functions, the state; each example can be changed',
            parts: [['grammar/README.md', null, 'For those who change the parser']] },
        { name: 'functions', title: 'All functions and words', about: 'A line on each', made: 'functions' },
        { name: 'physics', title: 'Physics', about: 'Each force with formula, limits and a dish to change',
            parts: [['lib/physics/README.md', null, 'For those who change the engine']] },
        { name: 'canvas', title: 'Drawing', about: 'Windows, canvases, paths, colours, text, images',
            parts: [['lib/canvas/README.md', null, 'For those who change the drawing']] },
        { name: 'effects', title: 'Effects', about: 'Blur, bloom, feedback, shaders and the tree of pictures',
            parts: [['lib/gl/README.md', null, 'For those who change effects']] },
        { name: 'scenes', title: 'Three dimensions', about: 'Scenes, materials, lights, cameras',
            parts: [['lib/gl/SCENE.md', null, 'For those who change it']],
            made: 'scenes' },
        { name: 'nodes', title: 'All nodes', about: 'Each attribute with type, unit and default', made: 'nodes' },
    ]],
    ['To use', [
        { name: 'command', title: 'The command', about: 'Windows, editors, many runs, links, trajectories',
            parts: [['src/README.md', null, 'At the prompt']] },
        { name: 'options', title: 'All commands and options', about: 'What petri help tells', made: 'options' },
        { name: 'prompt', title: 'The prompt', about: 'Step, go back, measure, change', parts: [['src/README.md', 'At the prompt', null]],
            made: 'prompt' },
        { name: 'c', title: 'From C and C++', about: 'petri.h and petri-draw.h, all of them',
            parts: [['README.md', 'If you embed', 'If you do research']], made: 'headers' },
        { name: 'python', title: 'From Python', about: 'Sessions, numpy, sweeps, notebooks', parts: [['src/python/TUTORIAL.md']] },
        { name: 'javascript', title: 'In a browser', about: 'The page, <petri-dish> in any page, the package for npm',
            parts: [['src/web/README.md'], ['src/web/engine/README.md']] },
        { name: 'research', title: 'For research', about: 'Runs that can be repeated to the last bit',
            parts: [['README.md', 'If you do research', 'If a script comes from a stranger']] },
        { name: 'strangers', title: 'Scripts of strangers', about: 'What a script can do, and what bounds it',
            parts: [['README.md', 'If a script comes from a stranger', 'If you change petri']] },
    ]],
];
export const PAGES = GROUPS.flatMap(([, pages]) => pages);

const plain = heading => heading.replace(/^#+ /, '').trim();

// The lines of a part of a file, by its headings.
export function cut(text, from, to) {
    const lines = text.split('\n');
    let fenced = false;
    const heads = lines.map((line, number) => {
        fenced = line.startsWith('```') ? !fenced : fenced;
        return !fenced && line.startsWith('#') ? [number, plain(line)] : null;
    }).filter(Boolean);
    const at = name => {
        const found = heads.find(([, head]) => head === name);
        if (!found)
            throw new Error(`no heading is called '${name}'`);
        return found[0];
    };
    return lines.slice(from ? at(from) : 0, to ? at(to) : undefined).join('\n');
}

// What a heading is linked by, as tests/docs/pages.sh and nodes.sh have it.
export const slug = text => text.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-');
