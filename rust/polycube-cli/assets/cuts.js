"use strict";
// Geometry of the page: reading packed numbers, cutting the surface along the tiles of a layout, cutting blocks.

/** A typed array from base64. */
function unpack(text, Type) {
    const binary = atob(text);
    const bytes = Uint8Array.from({ length: binary.length }, (_, i) => binary.charCodeAt(i));
    return new Type(bytes.buffer);
}

/** The tiles of a layout as boxes of coordinates, by facet. */
function tilesByFacet(tiles, planes, facetCount) {
    const byFacet = Array.from({ length: facetCount }, () => []);
    tiles.facets.forEach((facet, i) => {
        const at = (k) => planes[k % 3][tiles.corners[6 * i + k]];
        byFacet[facet].push({ id: tiles.ids[i], low: [at(0), at(1), at(2)], high: [at(3), at(4), at(5)] });
    });
    byFacet.forEach(openOuterSides);
    return byFacet;
}

/** Gives tiles their range: `from` and `to` are `low` and `high`, but without end at the outermost sides of the facet. */
function openOuterSides(tiles) {
    const low = [0, 1, 2].map((a) => tiles.reduce((m, t) => Math.min(m, t.low[a]), Infinity));
    const high = [0, 1, 2].map((a) => tiles.reduce((m, t) => Math.max(m, t.high[a]), -Infinity));
    for (const tile of tiles) {
        tile.from = tile.low.map((x, a) => (x === low[a] ? -Infinity : x));
        tile.to = tile.high.map((x, a) => (x === high[a] ? Infinity : x));
    }
}

/** The part of a polygon on one side of `value` along `axis`; corners are [x, y, z, weights of the triangle's corners]. */
function clip(polygon, axis, value, sign) {
    const kept = [];
    for (let i = 0; i < polygon.length; i++) {
        const a = polygon[i], b = polygon[(i + 1) % polygon.length];
        const da = sign * (a[axis] - value), db = sign * (b[axis] - value);
        if (da >= 0) kept.push(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            const t = da / (da - db);
            const c = a.map((x, k) => x + t * (b[k] - x));
            c[axis] = value;
            kept.push(c);
        }
    }
    return kept;
}

/** The part of a polygon within a tile, and the parts around it. */
function split(polygon, tile, axes) {
    const outside = [];
    for (const axis of axes) {
        for (const [value, sign] of [[tile.from[axis], 1], [tile.to[axis], -1]]) {
            if (!polygon.some((p) => sign * p[axis] < sign * value)) continue;
            outside.push(clip(polygon, axis, value, -sign));
            polygon = clip(polygon, axis, value, sign);
        }
    }
    return [polygon, outside.filter((part) => part.length > 2)];
}

function area(polygon, [u, v]) {
    let sum = 0;
    for (let i = 0; i < polygon.length; i++) {
        const a = polygon[i], b = polygon[(i + 1) % polygon.length];
        sum += a[u] * b[v] - a[v] * b[u];
    }
    return Math.abs(sum) / 2;
}

/** The tile nearest to a place. */
function nearest(place, tiles, axes) {
    const gap = (tile) => axes.reduce((sum, a) => sum + Math.max(tile.low[a] - place[a], place[a] - tile.high[a], 0), 0);
    let best = tiles[0], least = Infinity;
    for (const tile of tiles) {
        const own = gap(tile);
        if (own < least) [best, least] = [tile, own];
    }
    return best;
}

/** Gives a polygon outside all tiles to the nearest: halved until all its corners agree or it is small enough. */
function lend(polygon, tiles, axes, depth, give) {
    const owners = polygon.map((p) => nearest(p, tiles, axes));
    if (depth === 0 || owners.every((tile) => tile === owners[0])) return give(polygon, owners[0]);
    const range = axes.map((a) => [Math.min(...polygon.map((p) => p[a])), Math.max(...polygon.map((p) => p[a]))]);
    const wider = range[1][1] - range[1][0] > range[0][1] - range[0][0] ? 1 : 0;
    const middle = (range[wider][0] + range[wider][1]) / 2;
    for (const sign of [1, -1]) {
        const half = clip(polygon, axes[wider], middle, sign);
        if (half.length > 2) lend(half, tiles, axes, depth - 1, give);
    }
}

/** Receives the pieces of a surface: three corners a triangle, two a line; each as triangle and weights. */
class Pieces {
    constructor() {
        this.corners = [];
        this.ids = [];
        this.facets = [];
        this.lines = [];
    }
    add(polygon, triangle, facet, id) {
        for (let i = 2; i < polygon.length; i++) {
            for (const p of [polygon[0], polygon[i - 1], polygon[i]]) this.corners.push(triangle, p[3], p[4], p[5]);
            this.ids.push(id);
            this.facets.push(facet);
        }
    }
    addLines(polygon, triangle, tile, axes) {
        for (let i = 0; i < polygon.length; i++) {
            const a = polygon[i], b = polygon[(i + 1) % polygon.length];
            const onSide = (axis) => [tile.low, tile.high].some((end) => a[axis] === end[axis] && b[axis] === end[axis]);
            if (a !== b && axes.some(onSide)) {
                this.lines.push(triangle, a[3], a[4], a[5], triangle, b[3], b[4], b[5]);
            }
        }
    }
}

/** Cuts all triangles along the tiles. `points` are the vertices on the polycube. */
function cutSurface(data, points, tiles) {
    const pieces = new Pieces();
    for (let t = 0; t < data.facets.length; t++) {
        const facet = data.facets[t], axis = data.labels[facet] >> 1, axes = [(axis + 1) % 3, (axis + 2) % 3];
        const polygon = [0, 1, 2].map((k) => {
            const v = 3 * data.triangles[3 * t + k];
            return [points[v], points[v + 1], points[v + 2], +(k === 0), +(k === 1), +(k === 2)];
        });
        const least = 1e-6 * area(polygon, axes);
        let left = [polygon];
        for (const tile of tiles[facet]) {
            const beside = (a) => polygon.every((p) => p[a] <= tile.from[a]) || polygon.every((p) => p[a] >= tile.to[a]);
            if (!left.length) break;
            if (axes.some(beside)) continue;
            left = left.flatMap((part) => {
                const [inside, outside] = split(part, tile, axes);
                if (inside.length < 3) return [part];
                pieces.add(inside, t, facet, tile.id);
                pieces.addLines(inside, t, tile, axes);
                return outside.filter((p) => area(p, axes) > least);
            });
        }
        // Where the mesh folds over a border of its facet the nearest tile lends its colour.
        if (!tiles[facet].length) continue;
        const give = (part, tile) => pieces.add(part, t, facet, tile.id);
        for (const part of left) lend(part, tiles[facet], axes, 6, give);
    }
    return pieces;
}

/** The corners of pieces or lines as coordinates. */
function place(corners, triangles, points) {
    const out = new Float32Array(corners.length / 4 * 3);
    for (let i = 0, o = 0; i < corners.length; i += 4) {
        const t = 3 * corners[i];
        for (let a = 0; a < 3; a++) {
            let x = 0;
            for (let k = 0; k < 3; k++) x += corners[i + 1 + k] * points[3 * triangles[t + k] + a];
            out[o++] = x;
        }
    }
    return out;
}

/** The cut through all blocks across `axis` at `at`: rectangles as two triangles each, outlines, and block numbers. */
function cutBlocks(layout, axis, at) {
    const positions = [], lines = [], ids = [];
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    for (let i = 0; i < layout.blocks.length; i += 6) {
        const end = (a, side) => layout.planes[a][layout.blocks[i + 3 * side + a]];
        if (!(end(axis, 0) < at && at <= end(axis, 1))) continue;
        const corner = (s, t) => {
            const p = [0, 0, 0];
            [p[axis], p[u], p[v]] = [at, end(u, s), end(v, t)];
            return p;
        };
        const [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        positions.push(...a, ...b, ...c, ...a, ...c, ...d);
        lines.push(...a, ...b, ...b, ...c, ...c, ...d, ...d, ...a);
        ids.push(i / 6);
    }
    return { positions, lines, ids };
}

/** Mean normals of the vertices. */
function vertexNormals(triangles, points) {
    const normals = new Float32Array(points.length);
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[t + k]);
        const e = [0, 1, 2].map((k) => points[b + k] - points[a + k]);
        const f = [0, 1, 2].map((k) => points[c + k] - points[a + k]);
        const n = [0, 1, 2].map((k) => e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3]);
        for (const v of [a, b, c]) for (let k = 0; k < 3; k++) normals[v + k] += n[k];
    }
    return normals;
}

const HEX_FACES = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];

/** For each face of each hexahedron the hexahedron beyond it, or -1. */
function hexNeighbours(cells) {
    const open = new Map(), beyond = new Int32Array(cells.length / 8 * 6).fill(-1);
    for (let f = 0; f < beyond.length; f++) {
        const cell = Math.floor(f / 6);
        const key = HEX_FACES[f % 6].map((k) => cells[8 * cell + k]).sort((a, b) => a - b).join();
        const other = open.get(key);
        if (other === undefined) open.set(key, f);
        else {
            beyond[f] = Math.floor(other / 6);
            beyond[other] = cell;
        }
    }
    return beyond;
}
