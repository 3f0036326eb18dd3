// pages.mjs: the pages of the manual in reading order, with their source files.

// parts: the parts of files that form the page, each as [file, first heading, heading after the part]. Without a first heading, a part
// starts at the beginning of the file; without a last one, it extends to the end. made: the generator in generated.mjs that adds further
// content. about: the description in the list of pages. replace: pairs of an expression and the text that replaces it on the site.
// autoplay: true if the first dish of the page runs when it comes into view.
export const GROUPS = [
    ['Getting started', [
        { name: 'tutorial', title: 'Tutorial', about: 'From one particle to a dish, in ten steps that you can run on the page',
            parts: [['samples/TUTORIAL.md']], autoplay: true, replace: [
                [/ Save each step as `cells\.fl`[^]*?the other keys\./,
                    ' Every step has a running example on this page: change its script and press Ctrl+Enter.'],
                [/If you have not installed petri[^]*?\n\n/,
                    'The commands on this page are for `petri` on your computer; you need none of them here.\n\n'],
            ] },
        { name: 'gallery', title: 'Gallery', about: 'All samples, running on the page',
            parts: [['samples/README.md', null, 'Gallery'], ['samples/README.md', 'All samples']], made: 'gallery' },
        { name: 'recipes', title: 'Recipes', about: 'Solutions to common tasks', parts: [['samples/RECIPES.md']] },
        { name: 'troubleshooting', title: 'Troubleshooting', about: 'Symptoms, causes, and commands that confirm them',
            parts: [['samples/TROUBLESHOOTING.md']] },
        { name: 'flitter', title: 'For Flitter users', about: 'What runs the same, what is missing, what differs',
            parts: [['src/manual/flitter.md']] },
        { name: 'from-p5', title: 'From p5 or Processing', about: 'Ten idioms of p5, and the same in petri',
            parts: [['src/manual/from-p5.md']] },
        { name: 'from-netlogo', title: 'From NetLogo', about: 'Ten idioms of NetLogo, and the same in petri',
            parts: [['src/manual/from-netlogo.md']] },
    ]],
    ['Reference', [
        { name: 'language', title: 'The language', about: 'Vectors, names, nodes, functions, the state; with editable examples',
            parts: [['grammar/README.md']] },
        { name: 'pitfalls', title: 'Pitfalls', about: 'Symptoms of common mistakes in scripts, and their causes',
            parts: [['src/manual/pitfalls.md']] },
        { name: 'functions', title: 'Functions, keywords and operators', about: 'One line for each, and for the built-in values',
            made: 'functions' },
        { name: 'physics', title: 'Physics', about: 'Each force with its formula, its limits and an editable dish',
            parts: [['lib/physics/README.md']] },
        { name: 'canvas', title: 'Drawing', about: 'Windows, canvases, paths, colours, text, images',
            parts: [['lib/canvas/README.md']] },
        { name: 'effects', title: 'Effects', about: 'Blur, bloom, feedback, shaders and the render graph',
            parts: [['lib/gl/README.md']] },
        { name: 'scenes', title: 'Three dimensions', about: 'Scenes, materials, lights, cameras', parts: [['lib/scene3d/SCENE.md']],
            made: 'scenes' },
        { name: 'nodes', title: 'All nodes', about: 'Every attribute with its type, unit and default', made: 'nodes' },
    ]],
    ['Using petri', [
        { name: 'platforms', title: 'Platforms and packages', about: 'Other systems, packages, wheels',
            parts: [['src/manual/platforms.md']] },
        { name: 'command', title: 'The command', about: 'Commands, examples, messages, exit status', parts: [['src/manual/command.md']] },
        { name: 'options', title: 'All commands and options', about: 'The text of petri help', made: 'options' },
        { name: 'diagnostics', title: 'Diagnostics', about: 'What the codes of errors and warnings mean',
            parts: [['src/manual/diagnostics.md']] },
        { name: 'view', title: 'Watching a script',
            about: 'Keys of the window; scripts that react to the pointer and keys; code sent from an editor',
            parts: [['src/manual/view.md']] },
        { name: 'prompt', title: 'The prompt', about: 'Step through frames, go back, measure and change values',
            parts: [['src/manual/repl.md']], made: 'prompt' },
        { name: 'sweep', title: 'Sweeps', about: 'One script with many parameter values and seeds', parts: [['src/manual/sweep.md']] },
        { name: 'trust', title: 'Trust', about: 'How many digits of results are true', parts: [['src/manual/trust.md']] },
        { name: 'goldens', title: 'Goldens', about: 'Record what a script does, and find changes', parts: [['src/manual/goldens.md']] },
        { name: 'properties', title: 'Properties', about: 'Statements about all runs of a script', parts: [['src/manual/properties.md']] },
        { name: 'diff', title: 'Differences', about: 'Find out why two runs differ', parts: [['src/manual/diff.md']] },
        { name: 'archives', title: 'Archives', about: 'Publish a run with a paper', parts: [['src/manual/archives.md']] },
        { name: 'trajectories', title: 'Trajectories', about: 'Particles as XYZ, CSV and H5MD files; resuming a run',
            parts: [['src/manual/trajectories.md']] },
        { name: 'mpi', title: 'MPI', about: 'One script on several processes', parts: [['src/manual/mpi.md']] },
        { name: 'links', title: 'Links', about: 'Links that contain a script and the hash of its state', parts: [['src/manual/links.md']] },
        { name: 'editors', title: 'Editors', about: 'Language server, syntax highlighting, formatting',
            parts: [['src/manual/editors.md']] },
        { name: 'playground', title: 'The playground', about: 'The page, and <petri-dish> in any page',
            parts: [['src/manual/playground.md']] },
        { name: 'c', title: 'From C and C++', about: 'All public headers',
            parts: [['src/manual/embedding.md']], made: 'headers' },
        { name: 'python', title: 'From Python', about: 'Sessions, numpy, sweeps, notebooks', parts: [['src/python/TUTORIAL.md']] },
        { name: 'javascript', title: 'From JavaScript', about: 'The npm package', parts: [['src/web/engine/README.md']] },
        { name: 'research', title: 'For research', about: 'Reproducible runs, recording, speed', parts: [['src/manual/research.md']] },
        { name: 'security', title: 'Untrusted scripts', about: 'What scripts can do, and how to limit them',
            parts: [['src/manual/security.md']] },
        { name: 'migrating', title: 'Migrating to 0.3', about: 'Names that changed', parts: [['src/manual/migrating.md']] },
    ]],
    ['Contributing', [
        { name: 'extending', title: 'Extending petri', about: 'New forces, nodes, functions, options',
            parts: [['src/manual/extending.md']] },
        { name: 'dependencies', title: 'Dependencies', about: 'Packages that petri uses, and what for',
            parts: [['src/manual/dependencies.md']] },
        { name: 'parser', title: 'The parser', about: 'Tokens, layout, soft keywords, error recovery', parts: [['src/manual/parser.md']] },
        { name: 'physics-engine', title: 'The physics engine', about: 'Data, kernels, neighbour lists, threads, MPI ranks',
            parts: [['src/manual/physics-engine.md']] },
        { name: 'drawing-code', title: 'Drawing code', about: 'Source files of 2-D drawing, effects and 3-D scenes; how to add nodes',
            parts: [['src/manual/drawing-code.md']] },
    ]],
];
export const PAGES = GROUPS.flatMap(([, pages]) => pages);

const plain = heading => heading.replace(/^#+ /, '').trim();

// Returns the part of a text from the heading `from` up to the heading `to`.
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

// Returns the id of a heading, as in tests/docs/pages.sh and nodes.sh.
export const slug = text => text.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-');
