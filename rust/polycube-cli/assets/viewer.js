"use strict";
const T = Three;
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const chosen = (name) => document.querySelector(`input[name=${name}]:checked`).value;

const INK = 0x1a1a21, CONVEX = 0x14213d, REFLEX = 0xd1495b, INSIDE = 0x8d8a86;
const DIRECTIONS = ["#dc5c52", "#66ad6b", "#5c85cc"];
const QUALITY = ["#a50026", "#f46d43", "#fee08b", "#a6d96a", "#1a9850"].map((c) => new T.Color(c));

// ---- Data

data.triangles = unpack(data.triangles, Uint32Array);
data.facets = unpack(data.facets, Uint32Array);
if (data.shape) data.shape = unpack(data.shape, Float32Array);
for (const layout of data.layouts) {
    layout.points = unpack(layout.points, Float32Array);
    layout.planes = layout.planes.map((p) => Float32Array.from(p));
    layout.blocks = unpack(layout.blocks, Uint16Array);
    for (const tiles of [layout.faces, layout.patches]) {
        tiles.corners = unpack(tiles.corners, Uint16Array);
        tiles.facets = unpack(tiles.facets, Uint32Array);
        tiles.ids = unpack(tiles.ids, Uint32Array);
    }
    layout.cuts = {};
}
if (data.hexes) {
    data.hexes.points = unpack(data.hexes.points, Float32Array);
    data.hexes.cells = unpack(data.hexes.cells, Uint32Array);
    data.hexes.quality = unpack(data.hexes.quality, Float32Array);
}

/** The surface cut along the faces of blocks or along patches, once for each layout. */
function cutsOf(layout, kind) {
    if (!layout.cuts[kind]) {
        layout.cuts[kind] = cutSurface(data, layout.points, tilesByFacet(layout[kind], layout.planes, data.labels.length));
    }
    return layout.cuts[kind];
}

function pastel(id) {
    const lightness = [0.84, 0.74, 0.79][id % 3];
    return new T.Color().setHSL((id * 0.618034 + 0.08) % 1, 0.62, lightness, T.SRGBColorSpace);
}

function qualityColour(q) {
    if (q <= 0) return new T.Color("#b000c8");
    const x = Math.min(q, 0.9999) * 4, i = Math.floor(x);
    return QUALITY[i].clone().lerp(QUALITY[i + 1], x - i);
}

// ---- Objects

/** The box around points, its middle, and how far the farthest point is from there. */
function bounds(points) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    points.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
    });
    const middle = low.map((x, a) => (x + high[a]) / 2);
    let radius = 1e-30;
    for (let i = 0; i < points.length; i += 3) {
        radius = Math.max(radius, Math.hypot(...middle.map((x, a) => points[i + a] - x)));
    }
    return { low, high, middle, radius };
}

function geometry(positions, normals, colours) {
    const g = new T.BufferGeometry();
    g.setAttribute("position", new T.BufferAttribute(Float32Array.from(positions), 3));
    if (normals) g.setAttribute("normal", new T.BufferAttribute(normals, 3));
    else g.computeVertexNormals();
    g.setAttribute("color", new T.BufferAttribute(colours, 3));
    return g;
}

/** One colour for each run of `each` corners. */
function spread(colours, each) {
    const out = new Float32Array(colours.length * each * 3);
    colours.forEach((c, i) => {
        for (let k = 0; k < each; k++) out.set([c.r, c.g, c.b], 3 * (i * each + k));
    });
    return out;
}

const behindLines = { polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8 };

function solid(positions, normals, colours, planes) {
    const g = geometry(positions, normals, colours);
    const group = new T.Group();
    group.add(new T.Mesh(g, new T.MeshLambertMaterial({ vertexColors: true, clippingPlanes: planes, ...behindLines })));
    if (planes.length) {
        const inside = new T.MeshBasicMaterial({ color: INSIDE, side: T.BackSide, clippingPlanes: planes, ...behindLines });
        group.add(new T.Mesh(g, inside));
    }
    return group;
}

/** Lines; those with a `rise` lie before the others. */
function lines(positions, colour, width, planes, rise = 0) {
    const g = new T.LineSegmentsGeometry();
    g.setPositions(positions);
    const material = new T.LineMaterial({
        color: colour, linewidth: width, clippingPlanes: planes,
        polygonOffset: rise > 0, polygonOffsetFactor: -rise, polygonOffsetUnits: -8 * rise,
    });
    return new T.LineSegments2(g, material);
}

function directionNormals(pieces) {
    const out = new Float32Array(pieces.facets.length * 9);
    pieces.facets.forEach((facet, i) => {
        const label = data.labels[facet];
        for (let k = 0; k < 3; k++) out[9 * i + 3 * k + (label >> 1)] = label & 1 ? -1 : 1;
    });
    return out;
}

/** The layout on the polycube or on the shape. */
function layoutObject(layout, object, slice, planes) {
    const colour = $("colour").value;
    const pieces = cutsOf(layout, colour === "block" ? "faces" : "patches");
    const points = object === "shape" ? data.shape : layout.points;
    const paint = (id, i) => (colour === "direction" ? new T.Color(DIRECTIONS[data.labels[pieces.facets[i]] >> 1]) : pastel(id));
    const normals = object === "shape"
        ? place(pieces.corners, data.triangles, (data.normals ??= vertexNormals(data.triangles, data.shape)))
        : directionNormals(pieces);
    const group = new T.Group();
    const positions = place(pieces.corners, data.triangles, points);
    group.add(solid(positions, normals, spread(pieces.ids.map(paint), 3), planes));
    if ($("lines").checked) group.add(lines(place(pieces.lines, data.triangles, points), INK, 1.5, planes));
    if ($("singular").checked) singularEdges(points, planes).forEach((edges) => group.add(edges));
    if (slice && object === "polycube") addCap(group, layout, slice, colour);
    return group;
}

function singularEdges(points, planes) {
    return [[true, CONVEX], [false, REFLEX]].map(([convex, colour]) => {
        const positions = [];
        const at = (v) => points.subarray(3 * v, 3 * v + 3);
        data.chains.forEach((chain, i) => {
            if (data.convex[i] !== convex) return;
            for (let k = 1; k < chain.length; k++) positions.push(...at(chain[k - 1]), ...at(chain[k]));
        });
        return lines(positions, colour, 3, planes, 1);
    });
}

function addCap(group, layout, slice, colour) {
    const cap = cutBlocks(layout, slice.axis, slice.at);
    if (!cap.ids.length) return;
    const paint = (id) => (colour === "direction" ? new T.Color(DIRECTIONS[slice.axis]) : pastel(id));
    const material = new T.MeshBasicMaterial({ vertexColors: true, side: T.DoubleSide, ...behindLines });
    group.add(new T.Mesh(geometry(cap.positions, null, spread(cap.ids.map(paint), 6)), material));
    if ($("lines").checked) group.add(lines(cap.lines, INK, 1.5, []));
}

/** The hexahedra whose middles are before the slice, where they can be seen. */
function hexObject(slice) {
    const { points, cells, quality } = data.hexes;
    data.hexes.beyond ??= hexNeighbours(cells);
    const middle = (c) => {
        let sum = 0;
        for (let k = 0; k < 8; k++) sum += points[3 * cells[8 * c + k] + slice.axis];
        return sum / 8;
    };
    const shown = Array.from(quality, (_, c) => !slice || middle(c) <= slice.at);
    const positions = [], edges = [], colours = [];
    data.hexes.beyond.forEach((other, f) => {
        const cell = Math.floor(f / 6);
        if (!shown[cell] || (other >= 0 && shown[other])) return;
        const [a, b, c, d] = HEX_FACES[f % 6].map((k) => Array.from(points.subarray(3 * cells[8 * cell + k], 3 * cells[8 * cell + k] + 3)));
        positions.push(...a, ...b, ...c, ...a, ...c, ...d);
        edges.push(...a, ...b, ...b, ...c, ...c, ...d, ...d, ...a);
        colours.push(qualityColour(quality[cell]));
    });
    const group = new T.Group();
    group.add(solid(positions, null, spread(colours, 6), []));
    if ($("lines").checked) group.add(lines(edges, INK, 1, []));
    return group;
}

// ---- Panes

const canvas = $("canvas");
let renderer = null;
try {
    renderer = new T.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.localClippingEnabled = true;
    renderer.setClearColor(0xffffff);
} catch {
    $("trouble").hidden = false;
}
const camera = new T.OrthographicCamera(-1, 1, 1, -1, -20, 20);
// The axis that points up; the other two follow it round.
const turned = (x, y, z) => new T.Vector3().fromArray([0, 1, 2].map((a) => [x, y, z][(a + 4 - data.up) % 3]));
camera.up.copy(turned(0, 1, 0));
camera.position.copy(turned(5.0, 4.2, 7.6));
const controls = new T.OrbitControls(camera, canvas);
controls.addEventListener("change", render);
controls.saveState();
canvas.addEventListener("dblclick", () => controls.reset());

let panes = [];

/** The step of each column, with its name. */
function columns() {
    const last = data.steps.length - 1;
    if (chosen("mode") === "ends") return [[0, "before"], [last, "after"]];
    const step = Number($("step").value);
    return [[step, step === 0 ? "before" : step === last ? "after" : `step ${step}`]];
}

function wanted() {
    const objects = ["polycube", "shape"].filter((o) => $(o).checked && (o === "polycube" || data.shape));
    const list = columns().flatMap(([step, name]) => objects.map((object) => ({ object, step, name })));
    if (data.hexes && $("hexes").checked) list.push({ object: "hexes", step: null, name: "" });
    return list;
}

function pane({ object, step, name }) {
    const layout = step === null ? null : data.layouts[data.steps[step].layout];
    const points = object === "hexes" ? data.hexes.points : object === "shape" ? data.shape : layout.points;
    const { low, high, middle, radius } = bounds(points);
    const scale = 1 / radius;
    const axis = ["x", "y", "z"].indexOf(chosen("axis"));
    let slice = null, planes = [];
    if (axis >= 0) {
        const at = low[axis] + Number($("slice").value) * (high[axis] - low[axis]);
        const normal = new T.Vector3().setComponent(axis, -1);
        slice = { axis, at };
        planes = [new T.Plane(normal, (at - middle[axis]) * scale)];
    }
    const content = object === "hexes" ? hexObject(slice) : layoutObject(layout, object, slice, planes);
    content.scale.setScalar(scale);
    content.position.set(...middle.map((x) => -x * scale));
    const scene = new T.Scene();
    scene.add(content, new T.AmbientLight(0xffffff, 2.3));
    const light = new T.DirectionalLight(0xffffff, 1.1);
    scene.add(light);
    const counts = step === null ? null : data.steps[step].counts;
    return { scene, light, object, name, counts };
}

function dispose(scene) {
    scene.traverse((o) => {
        o.geometry?.dispose();
        o.material?.dispose();
    });
}

function rebuild() {
    tell();
    if (!renderer) return;
    panes.forEach((p) => dispose(p.scene));
    panes = wanted().map(pane);
    $("captions").replaceChildren(...panes.map(caption));
    render();
}

function caption({ object, name, counts }) {
    const box = document.createElement("div"), head = document.createElement("b"), tail = document.createElement("span");
    const titles = { polycube: "Polycube", shape: "Shape", hexes: "Hexahedra" };
    head.textContent = name ? `${titles[object]}, ${name}` : titles[object];
    tail.textContent = counts
        ? `${times(counts.surface_patches, "patch", "patches")}, ${times(counts.blocks, "block")}`
        : `${times(data.hexes.statistics.cells, "cell")} by scaled Jacobian`;
    box.append(head, document.createElement("br"), tail);
    return box;
}

/** Columns and rows of the panes: as square as the window allows. */
function grid(count, width, height) {
    if (chosen("mode") === "ends" && count === 4) return [2, 2];
    let best = [1, count], size = 0;
    for (let c = 1; c <= count; c++) {
        const r = Math.ceil(count / c), s = Math.min(width / c, height / r);
        if (s > size) [best, size] = [[c, r], s];
    }
    return best;
}

let pending = false;
function render() {
    if (!renderer || pending) return;
    pending = true;
    requestAnimationFrame(draw);
}

function draw() {
    pending = false;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    renderer.setSize(width, height, false);
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, width, height);
    renderer.clear();
    const ends = chosen("mode") === "ends" && panes.length === 4;
    const [c, r] = grid(panes.length, width, height);
    const [w, h] = [width / c, height / r];
    panes.forEach((p, i) => {
        // Before and after stand side by side, polycube above shape.
        const [x, y] = ends ? [Math.floor(i / 2), i % 2] : [i % c, Math.floor(i / c)];
        const half = 1.04 / Math.min(1, w / h);
        Object.assign(camera, { left: -half * w / h, right: half * w / h, top: half, bottom: -half });
        camera.updateProjectionMatrix();
        p.light.position.copy(camera.position).add(turned(-2, 3, 0));
        renderer.setViewport(x * w, height - (y + 1) * h, w, h);
        renderer.setScissor(x * w, height - (y + 1) * h, w, h);
        renderer.render(p.scene, camera);
        Object.assign($("captions").children[i].style, { left: `${100 * x * w / width}%`, top: `${100 * y * h / height}%` });
    });
}

// ---- Words

const number = (x) => x.toLocaleString("en").replaceAll(",", "\u202f");
const times = (n, one, many = `${one}s`) => `${number(n)} ${n === 1 ? one : many}`;

function tell() {
    const last = data.steps.length - 1, step = Number($("step").value);
    const ends = chosen("mode") === "ends";
    const shown = data.steps[ends ? last : step];
    const rows = [["patches", "surface_patches"], ["blocks", "blocks"], ["blocks, padded", "blocks_padded"]];
    $("counts").tBodies[0].replaceChildren(...rows.map(([name, key]) => {
        const row = document.createElement("tr"), head = document.createElement("th");
        head.textContent = name;
        const cells = [data.steps[0], shown, data.steps[last]].map((s) => {
            const cell = document.createElement("td");
            cell.textContent = number(s.counts[key]);
            return cell;
        });
        row.append(head, ...cells);
        return row;
    }));
    $("stepping").hidden = ends;
    $("told").textContent = sentence(step, last);
    $("directions").hidden = $("colour").value !== "direction";
    $("edges").hidden = !$("singular").checked;
    $("slice").disabled = chosen("axis") === "none";
}

function sentence(step, last) {
    const { lambda, pairs, alignments } = data.steps[step];
    if (step === 0) return "The polycube as it came.";
    if (step === last) return "The result, on the integer lattice.";
    return `Step ${step} of ${last}: λ = ${lambda === 1 ? "1" : `1/${Math.round(1 / lambda)}`}, ${times(pairs, "pair")} of corners, ${times(alignments, "level")} aligned.`;
}

function tellQuality() {
    $("quality").hidden = !data.hexes;
    if (!data.hexes) return;
    const { cells, inverted, min, average, histogram } = data.hexes.statistics;
    const most = Math.max(...histogram, 1);
    $("histogram").replaceChildren(...histogram.map((n, i) => {
        const bar = document.createElement("div");
        bar.style.height = `${100 * n / most}%`;
        bar.style.background = `#${qualityColour((i + 0.5) / histogram.length).getHexString()}`;
        bar.title = `${(i / histogram.length).toFixed(2)} to ${((i + 1) / histogram.length).toFixed(2)}: ${n}`;
        return bar;
    }));
    const bad = inverted ? `${number(inverted)} inverted` : "none inverted";
    $("statistics").textContent = `${number(cells)} hexahedra, ${bad}; least ${min.toFixed(3)}, mean ${average.toFixed(3)}.`;
}

// ---- Start

/** Settings in the address, such as page.html#step=3&colour=patch&axis=x&slice=0.4&mode=ends&singular=1 */
function fromAddress() {
    for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
        const radio = document.querySelector(`input[name="${CSS.escape(key)}"][value="${CSS.escape(value)}"]`);
        const control = $(key);
        if (radio) radio.checked = true;
        else if (control?.type === "checkbox") control.checked = value !== "0";
        else if (control && "value" in control) control.value = value;
    }
}

$("title").textContent = data.title;
$("step").max = data.steps.length - 1;
$("step").value = data.steps.length - 1;
$("shape").parentElement.hidden = !data.shape;
$("hexes").parentElement.hidden = !data.hexes;
$("objects").hidden = !data.shape && !data.hexes;
fromAddress();
tellQuality();
document.querySelector("aside").addEventListener("input", rebuild);
new ResizeObserver(render).observe(canvas);
window.addEventListener("hashchange", () => { fromAddress(); rebuild(); });
rebuild();
