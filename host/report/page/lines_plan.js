// A lines plan: profile with buttocks, half-breadth plan, body plan. Bow to the right, fore sections
// right and aft ones left, midship on both.
import { byId, make, makeSvg } from './dom.js';
import { buttock, refineLine, refinePlaces, refineTable } from './shape.js';

const WIDTH = 640;
const MARGIN = 34;
const LINES_MOST = 30; // of tables with more only every n-th is drawn

// A path through (x, y) in pixels, broken where there is no point.
function pathOf(xs, ys) {
	let text = '';
	let isDown = false;
	for (let i = 0; i < xs.length; i++) {
		const isPoint = Number.isFinite(xs[i]) && Number.isFinite(ys[i]);
		if (isPoint)
			text += `${isDown ? 'L' : 'M'}${xs[i].toFixed(2)} ${ys[i].toFixed(2)}`;
		isDown = isPoint;
	}
	return text;
}

function everyNth(count) {
	const step = Math.ceil(count / LINES_MOST);
	return Array.from({ length: count }, (_, i) => i).filter((i) => i % step === 0 || i === count - 1);
}

function rowOf(hull, values, j) {
	return values.slice(j * hull.x.length, (j + 1) * hull.x.length);
}

function columnOf(hull, values, i) {
	return Float64Array.from(hull.z, (_, j) => values[j * hull.x.length + i]);
}

// A view: metres to pixels, and what is drawn in it.
function createView(svg, left, top, scale, title) {
	const label = (x, y, text, anchor = 'middle') => svg.append(makeSvg('text', { x, y, 'text-anchor': anchor, class: 'plan-label' }, text));
	svg.append(makeSvg('text', { x: 4, y: top - 6, class: 'plan-title' }, title));
	return {
		x: (metres) => left + metres * scale,
		curve: (xs, ys, kind) => svg.append(makeSvg('path', { d: pathOf(xs, ys), class: `plan-${kind}` })),
		label,
	};
}

function drawProfile(svg, hull, top, scale) {
	const bottom = top + (hull.z[hull.z.length - 1] - hull.z[0]) * scale;
	const view = createView(svg, MARGIN - hull.x[0] * scale, top, scale, 'Profile: buttocks at 1/4, 1/2, 3/4 of the half-beam');
	const height = (z) => bottom - (z - hull.z[0]) * scale;
	const table = refineTable(hull.x, hull.z, hull.y);
	const xs = Array.from(table.x, view.x);
	const ends = [view.x(hull.x[0]), view.x(hull.x[hull.x.length - 1])];
	for (const j of everyNth(hull.z.length))
		view.curve(ends, [height(hull.z[j]), height(hull.z[j])], 'grid');
	for (const i of everyNth(hull.x.length))
		view.curve([view.x(hull.x[i]), view.x(hull.x[i])], [top, bottom], 'grid');
	const halfBeam = hull.y.reduce((most, y) => (y > most ? y : most), 0);
	for (const part of [0.25, 0.5, 0.75])
		view.curve(xs, Array.from(buttock(table, part * halfBeam), height), 'curve');
	const edge = Array.from({ length: table.width }, (_, i) => {
		for (let j = 0; j < table.height; j++)
			if (!Number.isNaN(table.values[j * table.width + i]))
				return height(table.z[j]);
		return NaN;
	});
	view.curve(xs, edge, 'edge');
	view.curve(ends, [height(hull.draft), height(hull.draft)], 'water');
	view.label(view.x(0), bottom + 12, 'AP');
	view.label(view.x(hull.lbp), bottom + 12, 'FP');
	return bottom;
}

function drawHalfBreadths(svg, hull, top, scale, halfBeam) {
	const view = createView(svg, MARGIN - hull.x[0] * scale, top, scale, 'Half-breadth plan: waterlines');
	const bottom = top + halfBeam * scale;
	const xs = Array.from(refinePlaces(hull.x), view.x);
	const across = (y) => bottom - y * scale;
	view.curve([view.x(hull.x[0]), view.x(hull.x[hull.x.length - 1])], [bottom, bottom], 'grid');
	for (const j of everyNth(hull.z.length)) {
		if (hull.before)
			view.curve(xs, Array.from(refineLine(hull.x, rowOf(hull, hull.before, j)), across), 'before');
		view.curve(xs, Array.from(refineLine(hull.x, rowOf(hull, hull.y, j)), across), 'curve');
	}
	return bottom;
}

function drawBody(svg, hull, top, halfBeam) {
	const depth = hull.z[hull.z.length - 1] - hull.z[0];
	const scale = Math.min((0.94 * (WIDTH - 2 * MARGIN)) / (2 * halfBeam), 250 / depth);
	const bottom = top + depth * scale;
	const view = createView(svg, WIDTH / 2, top, scale, 'Body plan: aft sections left, fore sections right');
	const height = (z) => bottom - (z - hull.z[0]) * scale;
	const zs = Array.from(refinePlaces(hull.z), height);
	for (const j of everyNth(hull.z.length))
		view.curve([view.x(-halfBeam), view.x(halfBeam)], [height(hull.z[j]), height(hull.z[j])], 'grid');
	view.curve([view.x(0), view.x(0)], [top, bottom], 'grid');
	for (const i of everyNth(hull.x.length)) {
		const offset = hull.x[i] - hull.lbp / 2;
		const sides = Math.abs(offset) < 1e-6 * hull.lbp ? [-1, 1] : [Math.sign(offset)];
		for (const side of sides) {
			const across = (y) => view.x(side * y);
			if (hull.before)
				view.curve(Array.from(refineLine(hull.z, columnOf(hull, hull.before, i)), across), zs, 'before');
			view.curve(Array.from(refineLine(hull.z, columnOf(hull, hull.y, i)), across), zs, 'curve');
		}
	}
	view.curve([view.x(-halfBeam), view.x(halfBeam)], [height(hull.draft), height(hull.draft)], 'water');
	return bottom;
}

export function drawLinesPlan(hull) {
	const length = hull.x[hull.x.length - 1] - hull.x[0];
	const halfBeam = hull.y.reduce((most, y) => (y > most ? y : most), 0);
	const scale = (WIDTH - 2 * MARGIN) / length;
	const svg = makeSvg('svg', { role: 'img', 'aria-label': `Lines plan of ${hull.name}` });
	const profile = drawProfile(svg, hull, 22, scale);
	const breadths = drawHalfBreadths(svg, hull, profile + 36, scale, halfBeam);
	const body = drawBody(svg, hull, breadths + 30, halfBeam);
	svg.setAttribute('viewBox', `0 0 ${WIDTH} ${Math.ceil(body + 10)}`);
	const note = hull.before
		? `Dashed: before fairing; largest change ${Number((1000 * hull.largestChange).toPrecision(3))} mm. `
		: '';
	byId('lines').replaceChildren(svg,
		make('p', { class: 'note' }, `${note}Blue: waterline at the draft of ${Number(hull.draft.toPrecision(5))} m. The body plan has a scale of its own.`));
}
