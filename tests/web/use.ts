// use.ts: a TypeScript program that uses the package. types.test.mjs checks its types and runs it.
import { loadEngine, PetriError, STATUS } from 'petri';
import type {
    Column, Diagnostic, Engine, Explanation, Frame, Help, History, Options, Parameter, Picture, RenderedImage, Snapshot, Status, System,
    Token,
} from 'petri';
import { pictureSize } from 'petri/drawing';

const reported: Diagnostic[] = [];
const options: Options = {
    fps: 30, memory: 2 ** 28, work: 2 ** 26, onDiagnostic: one => { reported.push(one); }, shouldInterrupt: () => false,
    files: { 'parts.fl': 'let SPEED=3\n', 'rows.csv': new Uint8Array([49, 44, 50, 10]) },
};
const SCRIPT = `import SPEED from 'parts.fl'
let COUNT=COUNT or 4 -- 1..9|2 how many
!window size=64;32
    !canvas
        !path
            !ellipse point=10;10 radius=5
            !fill color=1;0;0
!physics state=:world dimensions=2
    for i in ..COUNT
        !particle id=i position=i;0 velocity=SPEED;GIVEN
debug(frame)
`;

export async function run(wasm: Uint8Array<ArrayBuffer>): Promise<Record<string, unknown>> {
    const engine: Engine = await loadEngine(wasm);
    const session = engine.open(options).define('UNUSED=2').setGlobal('GIVEN', [1]).load(SCRIPT, 'use.fl');
    session.step().stepAt(0.5, 1).pointer(true, 0.5, 0.5, 1).key('a', true);
    const frame: Frame = session.frame, log: string = session.log();
    const parameters: Parameter[] = session.parameters;
    const systems: System[] = session.systems;
    const position: Column | null | undefined = systems[0]?.position;
    const place: number = position?.data[position.stride] ?? NaN;
    const state: number[] | string | undefined = session.state.get(':world;1');
    const picture: Picture | null = session.displayList({ automatic: true });
    const shown: Picture | RenderedImage | null = session.render();
    const size = picture && pictureSize(picture.numbers);
    const table = session.table(), rows: string = session.table(2).text;
    const snapshot: Snapshot = session.snapshot();
    const forces: Explanation | null = session.particleId(0, 0) ? null : session.explain(0, 0);
    const hash: string = session.hash(), digest: string = session.digest();
    session.step();
    const again: string = session.rewind(snapshot).hash();
    const history: History = session.history(1e6), before: boolean = history.rewind(-2);
    history.free();
    const tokens: Token[] = session.tokens('if 1 -- one\n    !a x=:b\n');
    const help: Help[] = session.help();
    const { text, number } = session.evaluate('1+2');
    const printed = [session.print('state', 'hash'), log, session.prompt('1;2'), rows];
    let status: Status | undefined;
    let diagnostics: Diagnostic[] = session.diagnose('!a x=nowhere\n');
    try {
        session.reload('!a x=(', 'bad.fl');
    } catch (error) {
        if (!(error instanceof PetriError))
            throw error;
        status = error.status;
        diagnostics = diagnostics.concat(error.diagnostics);
    }
    session.setParameter('COUNT', 7).setParameter('COUNT', null).setFile('parts.fl', null);
    const name: string | null = session.symbolName(session.symbol('world'));
    const kinds: boolean[] = [session.drawable, session.needsHistory, session.renderIfNeeded()];

    // @ts-expect-error A view is a getter; the session has no setter for it.
    const wrong = () => { session.frame = frame; };
    // @ts-expect-error No such section of a frame.
    const part = () => session.print('pictures');
    // @ts-expect-error A status is one of six words.
    status === 'fine';

    const result = {
        frame, parameters, systems: structuredClone(systems), picture, shown, snapshot, before, tokens, help, diagnostics, reported, place,
        state,
        size,
        same: hash === again && digest.length === 32 && forces === null && table.dimensions === 2, text, number, printed, status,
        statuses: STATUS, name, kinds, wrong, part, version: engine.version,
    };
    session.clear();
    session.close();
    return result;
}
