// automatic.mjs: the automatic picture of particle systems, as drawn by lib/draw/automatic.c.

const MARGIN = 0.04, PANEL = 540, MIN_RADIUS = 2, LEAST_SEEN = 1.5, EYE = 4;
const COS_YAW = 0.9004471023526769, SIN_YAW = 0.43496553411123023;
const COS_PITCH = 0.9393727128473789, SIN_PITCH = 0.34289780745545134;
const GROUND = [0.06, 0.07, 0.09], WALL = [0.75, 0.7, 0.55], LINK = [0.6, 0.65, 0.7], MARK = [0.5, 0.55, 0.6];
const CHARGES = [[0.25, 0.55, 1], [0.85, 0.87, 0.9], [1, 0.5, 0.15]];
const SPEEDS = [[0.2, 0.35, 0.75], [0.2, 0.75, 0.7], [1, 0.95, 0.6]];

const mix = (a, b, part) => [a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + (b[2] - a[2]) * part];
const byte = x => Math.round(255 * x);
const css = (c, alpha = 1) => `rgba(${byte(c[0])},${byte(c[1])},${byte(c[2])},${alpha})`;
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

function shade({ charged }, value) {
    if (charged)
        return value < 0 ? mix(CHARGES[1], CHARGES[0], -value) : mix(CHARGES[1], CHARGES[2], value);
    return value < 0.5 ? mix(SPEEDS[0], SPEEDS[1], value * 2) : mix(SPEEDS[1], SPEEDS[2], value * 2 - 1);
}

// Returns the projection of a point: x and y in the panel, depth (greater is farther from the camera), and size in pixels per unit.
function see(panel, p) {
    const { middle, half, dimensions } = panel.system;
    const x = (p[0] - middle[0]) / half, y = (p[1] - middle[1]) / half;
    if (dimensions < 3)
        return { x: panel.x + x * panel.side, y: panel.y - y * panel.side, depth: 0, size: panel.scale };
    const z = (p[2] - middle[2]) / half;
    const right = x * COS_YAW - z * SIN_YAW, towards = x * SIN_YAW + z * COS_YAW;
    const depth = -(y * SIN_PITCH + towards * COS_PITCH), near = EYE / Math.max(EYE + depth, 0.1);
    const up = y * COS_PITCH - towards * SIN_PITCH;
    return { x: panel.x + right * panel.side * near, y: panel.y - up * panel.side * near, depth, size: panel.scale * near };
}

const inMist = (panel, colour, depth) =>
    panel.system.dimensions < 3 ? colour : mix(colour, GROUND, clamp(0.3 + 0.3 * depth, 0, 0.8));

function circle(context, x, y, radius) {
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
}

function ball(context, seen, radius, colour) {
    const gradient = context.createRadialGradient(seen.x - radius * 0.35, seen.y - radius * 0.4, radius * 0.05,
        seen.x - radius * 0.1, seen.y - radius * 0.1, radius * 1.15);
    gradient.addColorStop(0, css(mix(colour, [1, 1, 1], 0.5)));
    gradient.addColorStop(0.45, css(colour));
    gradient.addColorStop(1, css(mix(colour, [0, 0, 0], 0.65)));
    return gradient;
}

function drawBody(context, panel, body, seen) {
    const shown = clamp(body.radius * seen.size, panel.least, 4 * (panel.width + panel.height));
    const colour = inMist(panel, shade(panel.system, body.shade), seen.depth), small = shown <= panel.least;
    if (body.anchor) {
        const line = 1.5 * panel.pixel;
        circle(context, seen.x, seen.y, Math.max(shown - line / 2, panel.least, 3 * panel.pixel));
        context.lineWidth = line;
        context.strokeStyle = css(colour);
        context.stroke();
        return;
    }
    circle(context, seen.x, seen.y, shown);
    context.fillStyle = panel.system.dimensions === 3 && !small ? ball(context, seen, shown, colour) : css(colour, small ? 1 : 0.85);
    context.fill();
}

function drawBodies(context, panel) {
    const { bodies, dimensions } = panel.system;
    const places = bodies.map(body => ({ body, seen: see(panel, body.position) }));
    if (dimensions === 3)
        places.sort((a, b) => b.seen.depth - a.seen.depth);
    places.forEach(({ body, seen }) => drawBody(context, panel, body, seen));
}

function line(context, from, to, width, style) {
    context.beginPath();
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
    context.lineWidth = width;
    context.strokeStyle = style;
    context.stroke();
}

function drawLinks(context, panel) {
    const { bodies, links } = panel.system;
    for (const [from, to] of links) {
        const a = see(panel, bodies[from].position), b = see(panel, bodies[to].position);
        line(context, a, b, panel.pixel, css(inMist(panel, LINK, (a.depth + b.depth) / 2), 0.4));
    }
}

// Draws a wall as a line, with shading on its outside.
function drawWall(context, panel, { point, normal }) {
    const at = see(panel, point), far = panel.width + panel.height;
    let nx = normal[0], ny = panel.system.dimensions === 1 ? 0 : -normal[1];
    const length = Math.hypot(nx, ny);
    if (!(length > 0 && length < Infinity))
        return;
    nx /= length;
    ny /= length;
    const along = (panel.x - at.x) * -ny + (panel.y - at.y) * nx, x = at.x - ny * along, y = at.y + nx * along;
    line(context, { x: x - ny * far, y: y + nx * far }, { x: x + ny * far, y: y - nx * far }, 2 * panel.pixel, css(WALL, 0.9));
    context.beginPath();
    context.moveTo(x - ny * far, y + nx * far);
    context.lineTo(x + ny * far, y - nx * far);
    context.lineTo(x + (ny - nx) * far, y - (nx + ny) * far);
    context.lineTo(x - (ny + nx) * far, y + (nx - ny) * far);
    context.fillStyle = css(WALL, 0.12);
    context.fill();
}

// Draws a 3-D wall as a grid of lines around the wall's point nearest to the centre.
function drawGrid(context, panel, { point, normal: n }) {
    const { middle, half } = panel.system, away = n.reduce((sum, x, k) => sum + (middle[k] - point[k]) * x, 0);
    if (!(Math.abs(away) < 1.6 * half))
        return;
    const foot = n.map((x, k) => middle[k] - away * x), sizes = n.map(Math.abs), axis = sizes.indexOf(Math.min(...sizes));
    const length = Math.sqrt(1 - n[axis] * n[axis]);
    const u = n.map((x, k) => ((k === axis ? 1 : 0) - n[axis] * x) / length);
    const v = n.map((_, k) => n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3]);
    for (let i = -4; i <= 4; i++)
        for (const [a, b] of [[u, v], [v, u]]) {
            const end = side => see(panel, foot.map((x, k) => x + a[k] * half * i / 4 + side * b[k] * half));
            line(context, end(1), end(-1), panel.pixel, css(WALL, 0.3));
        }
}

// Draws the axes through the origin. Parts outside the panel are clipped.
function drawOrigin(context, panel) {
    const { middle, half, dimensions } = panel.system, solid = dimensions === 3;
    const length = solid ? half : 2 * (panel.width + panel.height) / panel.scale;
    context.beginPath();
    for (let k = 0; k < (solid ? 3 : 2); k++) {
        const end = side => see(panel, [0, 1, 2].map(i => i === k ? (solid ? 0 : middle[k]) + side * length : 0));
        const from = end(-1), to = end(1);
        context.moveTo(from.x, from.y);
        context.lineTo(to.x, to.y);
    }
    context.lineWidth = panel.pixel;
    context.strokeStyle = css(MARK, 0.25);
    context.stroke();
}

function drawScale(context, panel) {
    const left = panel.x - panel.width / 2, bottom = panel.y + panel.height / 2;
    context.beginPath();
    for (const [x1, y1, x2, y2] of panel.system.scale) {
        context.moveTo(left + x1 * panel.pixel, bottom - y1 * panel.pixel);
        context.lineTo(left + x2 * panel.pixel, bottom - y2 * panel.pixel);
    }
    context.lineWidth = 1.5 * panel.pixel;
    context.strokeStyle = css(MARK, 0.8);
    context.stroke();
}

function drawPanel(context, panel) {
    const { system } = panel, left = panel.x - panel.width / 2, top = panel.y - panel.height / 2;
    context.save();
    context.beginPath();
    context.rect(left, top, panel.width, panel.height);
    context.clip();
    drawOrigin(context, panel);
    system.barriers.forEach(barrier => (system.dimensions === 3 ? drawGrid : drawWall)(context, panel, barrier));
    if (system.dimensions === 1) {
        const { y } = see(panel, [system.middle[0], 0, 0]);
        line(context, { x: left, y }, { x: left + panel.width, y }, panel.pixel, css(MARK, 0.5));
    }
    drawLinks(context, panel);
    drawBodies(context, panel);
    drawScale(context, panel);
    context.restore();
}

function readSystem(n, at) {
    const three = i => [n[i], n[i + 1], n[i + 2]];
    const dimensions = n[at], charged = n[at + 1], middle = three(at + 2), half = n[at + 5];
    at += 6;
    const many = (size, make) => {
        const length = n[at], first = at + 1;
        at = first + length * size;
        return Array.from({ length }, (_, i) => make(first + i * size));
    };
    const bodies = many(6, i => ({ position: three(i), radius: n[i + 3], shade: n[i + 4], anchor: n[i + 5] }));
    const links = many(2, i => [n[i], n[i + 1]]), barriers = many(6, i => ({ point: three(i), normal: three(i + 3) }));
    const scale = many(4, i => [n[i], n[i + 1], n[i + 2], n[i + 3]]);
    return [{ dimensions, charged, middle, half, bodies, links, barriers, scale }, at];
}

// Draws the systems whose data begins at n[at]. Returns the index after the data.
export function drawSystems(context, n, at, [scale, x0, y0]) {
    const count = n[at++], columns = Math.ceil(Math.sqrt(Math.max(count, 1))), rows = Math.ceil(Math.max(count, 1) / columns);
    const width = n[0] / columns, height = n[1] / rows, side = Math.min(width, height) / 2 * (1 - 2 * MARGIN);
    context.setTransform(scale, 0, 0, scale, x0, y0);
    context.fillStyle = css(GROUND);
    context.fillRect(0, 0, n[0], n[1]);
    for (let i = 0; i < count; i++) {
        let system;
        [system, at] = readSystem(n, at);
        const pixel = Math.min(width, height) / PANEL;
        drawPanel(context, {
            system, side, width, height, scale: side / system.half, pixel,
            least: Math.max(MIN_RADIUS * pixel, LEAST_SEEN / scale),
            x: (i % columns + 0.5) * width, y: (Math.floor(i / columns) + 0.5) * height,
        });
    }
    return at;
}
