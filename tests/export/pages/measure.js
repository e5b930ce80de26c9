// SPDX-License-Identifier: MIT
// What the scenes of write_known_light.cpp must look like, and how far a picture is from it.
// Pictures: { data: RGBA, size, scale = 1, topFirst = false } of size x size pixels that the scene's square [-1, 1]^2 fills, seen from
// +Z with +Y up; data * scale is linear radiance.

const PI = Math.PI;
const CONVOLVED = [1, 2 / 3, 2 / 3, 2 / 3, 1 / 4, 1 / 4, 1 / 4, 1 / 4, 1 / 4]; // A_l / pi

/** Real orthonormal harmonics without Condon-Shortley sign, coefficient (l, m) at l (l + 1) + m. */
export function basis([x, y, z]) {
    const k1 = Math.sqrt(3 / (4 * PI)), k2 = Math.sqrt(15 / (4 * PI));
    return [Math.sqrt(1 / (4 * PI)), k1 * y, k1 * z, k1 * x,
        k2 * x * y, k2 * y * z, Math.sqrt(5 / (16 * PI)) * (3 * z * z - 1), k2 * x * z, k2 / 2 * (x * x - y * y)];
}

/** E(n) / pi of nine scalar coefficients of radiance. */
export const exitance = (c, n) => basis(n).reduce((sum, y, i) => sum + CONVOLVED[i] * c[i] * y, 0);

/** KnownLight::probe(i), times `scale`. */
export function probe(i, scale = 1) {
    const c = new Array(9).fill(0);
    c[0] = (i === 0 ? 1 : 0.5) / basis([0, 0, 1])[0] * scale;
    if (i > 0) c[i] = 0.25 * scale;
    return c;
}

/** Calls visit(normal, pixel) for the pixels well inside the ball's outline. */
export function onBall({ data, size, scale = 1, topFirst = false }, visit) {
    for (let row = 0; row < size; ++row) for (let column = 0; column < size; ++column) {
        const x = (column + 0.5) / size * 2 - 1, up = (row + 0.5) / size * 2 - 1, y = topFirst ? -up : up;
        if (x * x + y * y > 0.8) continue;
        const at = 4 * (row * size + column);
        visit([x, y, Math.sqrt(1 - x * x - y * y)], [0, 1, 2].map((k) => data[at + k] * scale));
    }
}

/** The factor with which harmonic i arrives, by least squares of it and the constant, and the largest error. */
function harmonic(i, picture, light) {
    const c = probe(i, light), constant = c.map((v, k) => (k === 0 ? v : 0)), rest = c.map((v, k) => (k === 0 ? 0 : v));
    let aa = 0, ab = 0, bb = 0, av = 0, bv = 0, error = 0;
    onBall(picture, (n, [v]) => {
        const a = exitance(constant, n), b = exitance(rest, n);
        aa += a * a; ab += a * b; bb += b * b; av += a * v; bv += b * v;
        error = Math.max(error, Math.abs(v - a - b));
    });
    return { factor: i === 0 ? av / aa : (bv * aa - av * ab) / (aa * bb - ab * ab), error };
}

/** A row of the table: the ball in the nine lights. `draw(i)` resolves to the picture of probe i. */
export async function ball(consumer, what, draw, tolerance, light = 1, count = 9) {
    const factors = [];
    let error = 0;
    for (let i = 0; i < count; ++i) {
        const one = harmonic(i, await draw(i), light);
        factors.push(one.factor);
        error = Math.max(error, one.error);
    }
    return row(consumer, what, factors, error, error < tolerance && Math.max(...factors.map((f) => Math.abs(f - 1))) < 10 * tolerance);
}

/** KnownLight::quadIrradiance(). */
export const quadIrradiance = (x, y) => [0.25 + x / 8, 3 * y / 8, 5];

/** A row of the table: the grey quad under its lightmap. Errors are relative to the brightest channel. */
export function quad(consumer, what, { data, size, scale = 1, topFirst = false }, tolerance, expected = 1) {
    let ratio = 0, count = 0, error = 0;
    for (let row = 2; row < size - 2; ++row) for (let column = 2; column < size - 2; ++column) {
        const s = (column + 0.5) / size, up = (row + 0.5) / size, t = topFirst ? up : 1 - up;
        const radiance = quadIrradiance(7 * s, 7 * t).map((e) => 0.5 * e / PI), at = 4 * (row * size + column);
        ratio += data[at + 2] * scale / radiance[2];
        ++count;
        for (let k = 0; k < 3; ++k) error = Math.max(error, Math.abs(data[at + k] * scale - expected * radiance[k]) / radiance[2]);
    }
    return row(consumer, what, [ratio / count], error, error < tolerance);
}

export function row(consumer, what, factors, error, ok) {
    return { consumer, what, factors, error, ok };
}

/** Hands the rows to tests/export/run.mjs. */
export async function measured(rows) {
    try {
        const list = await rows();
        window.result = { ok: list.every((r) => r.ok), rows: list };
    } catch (e) {
        window.result = { ok: false, error: String(e?.stack ?? e) };
    }
}
