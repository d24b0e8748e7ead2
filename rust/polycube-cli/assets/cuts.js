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
    return byFacet;
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

/** The part of a triangle within a tile. */
function within(polygon, tile, axes) {
    for (const axis of axes) {
        if (polygon.some((p) => p[axis] < tile.low[axis])) polygon = clip(polygon, axis, tile.low[axis], 1);
        if (polygon.some((p) => p[axis] > tile.high[axis])) polygon = clip(polygon, axis, tile.high[axis], -1);
    }
    return polygon;
}

function area(polygon, [u, v]) {
    let sum = 0;
    for (let i = 0; i < polygon.length; i++) {
        const a = polygon[i], b = polygon[(i + 1) % polygon.length];
        sum += a[u] * b[v] - a[v] * b[u];
    }
    return Math.abs(sum) / 2;
}

/** How far the middle of a polygon is from a tile. */
function distance(polygon, tile, axes) {
    let sum = 0;
    for (const axis of axes) {
        const middle = polygon.reduce((s, p) => s + p[axis], 0) / polygon.length;
        sum += Math.max(tile.low[axis] - middle, middle - tile.high[axis], 0);
    }
    return sum;
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
        let left = area(polygon, axes);
        const least = 1e-5 * left;
        for (const tile of tiles[facet]) {
            if (left <= least) break;
            const beside = (a) => polygon.every((p) => p[a] <= tile.low[a]) || polygon.every((p) => p[a] >= tile.high[a]);
            if (axes.some(beside)) continue;
            const part = within(polygon, tile, axes);
            const covered = area(part, axes);
            if (part.length < 3 || covered === 0) continue;
            pieces.add(part, t, facet, tile.id);
            pieces.addLines(part, t, tile, axes);
            left -= covered;
        }
        // Where the mesh folds over the border of its facet, or is flat, the nearest tile lends its colour.
        if (left > least || least === 0) {
            const nearest = tiles[facet].reduce((best, tile) => {
                const d = distance(polygon, tile, axes);
                return d < best[0] ? [d, tile] : best;
            }, [Infinity, null])[1];
            if (nearest) pieces.add(polygon, t, facet, nearest.id);
        }
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
