// The page's modules that need no browser: the front, the shape, the units.
//
//   node modules.mjs PAGE_FOLDER
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

// Modules of their own, without a package.json that would say so: copied under the ending that does.
const folder = mkdtempSync(join(tmpdir(), 'batten-modules-'));
async function load(name) {
	const path = join(folder, `${name}.mjs`);
	writeFileSync(path, readFileSync(join(process.argv[2], `${name}.js`)));
	return import(pathToFileURL(path).href);
}
const { frontOf } = await load('front');
const shape = await load('shape');
const { shortNumber, unitOf } = await load('data');
rmSync(folder, { recursive: true });

// The front against the definition, for every pair of goals.
const count = 300;
const points = Array.from({ length: count }, (_, i) => [((i * 7919) % 101) / 10, ((i * 104729) % 97) / 10]);
points[5] = [NaN, 1];
points[6] = [...points[7]];
for (const [goalA, goalB] of [['min', 'min'], ['min', 'max'], ['max', 'min'], ['max', 'max']]) {
	const a = (row) => points[row][0];
	const b = (row) => points[row][1];
	const better = (p, q, goal) => (goal === 'min' ? p < q : p > q);
	const isBeaten = (row) => points.some(([p, q]) => Number.isFinite(p) && !better(a(row), p, goalA) && !better(b(row), q, goalB) &&
		(better(p, a(row), goalA) || better(q, b(row), goalB)));
	const rows = points.map((_, i) => i);
	const expected = rows.filter((row) => Number.isFinite(a(row)) && !isBeaten(row));
	const found = frontOf(rows, a, b, goalA, goalB);
	assert.deepEqual([...found].sort((p, q) => p - q), expected);
	assert.ok(found.every((row, i) => i === 0 || a(row) >= a(found[i - 1])));
}

// A circle's curvature, whatever the spacing; convex is positive.
const places = Float64Array.from([0, 0.2, 0.5, 0.75, 1, 1.3, 1.5]);
const circle = places.map((x) => Math.sqrt(100 - (x - 0.7) ** 2));
const curvature = shape.lineCurvature(places, circle);
assert.ok(Number.isNaN(curvature[0]) && Number.isNaN(curvature[6]));
for (let i = 1; i < 6; i++)
	assert.ok(Math.abs(curvature[i] - 0.1) < 1e-4, `curvature ${curvature[i]}`);

// Fine lines go through their points, swing past none, and stop where the hull does.
const fine = shape.refineLine(places, Float64Array.from([NaN, 0, 1, 1, 3, NaN, 2]));
assert.equal(fine.length, 6 * shape.FINENESS + 1);
assert.ok(Number.isNaN(fine[3]) && fine[4] === 0 && fine[8] === 1 && fine[16] === 3 && Number.isNaN(fine[18]) && fine[24] === 2);
assert.ok(fine.slice(8, 13).every((value) => value === 1));
assert.ok(fine.slice(4, 17).every((value) => value >= 0 && value <= 3));

// A plane stays one, and half of a cell with a corner outside is on it.
const x = [0, 1, 2.5];
const z = [0, 2, 3];
const plane = (u, v) => 1 + 2 * u + 3 * v;
const values = Float64Array.from(z.flatMap((v) => x.map((u) => plane(u, v))));
values[0] = NaN;
const table = shape.refineTable(x, z, values);
let inCorner = 0;
for (let j = 0; j < table.height; j++)
	for (let i = 0; i < table.width; i++) {
		const value = table.values[j * table.width + i];
		if (!Number.isNaN(value))
			assert.ok(Math.abs(value - plane(table.x[i], table.z[j])) < 1e-12);
		if (i <= shape.FINENESS && j <= shape.FINENESS)
			inCorner += Number.isNaN(value) ? 0 : 1;
	}
assert.equal(inCorner, ((shape.FINENESS + 1) * (shape.FINENESS + 2)) / 2);
assert.ok(Math.abs(shape.buttock(table, plane(2.5, 1))[table.width - 1] - 1) < 1e-12);

assert.equal(unitOf('wetted_surface_m2'), 'm²');
assert.equal(unitOf('fn_per_m2'), '1/m²');
assert.equal(unitOf('lcb_pct_lbp_fwd'), '% LBP, + forward');
assert.equal(unitOf('cb'), '');
assert.equal(shortNumber(NaN), '–');
assert.equal(shortNumber(0.1 + 0.2), '0.3');
