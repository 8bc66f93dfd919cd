// What the program put into the page, as arrays. Nothing of it is ever taken for markup.

function block(id) {
	const element = document.getElementById(id);
	return element ? element.textContent : null;
}

export function bytesOf(base64) {
	const text = atob(base64);
	const bytes = new Uint8Array(text.length);
	for (let i = 0; i < text.length; i++)
		bytes[i] = text.charCodeAt(i);
	return bytes;
}

// Numbers are little-endian in the page, and so is every machine that runs a browser today.
const f64 = (text) => new Float64Array(bytesOf(text).buffer);
const f32 = (text) => new Float32Array(bytesOf(text).buffer);

// 32767ths of a limit; -32768 is none.
function parts(text, limit) {
	return Float32Array.from(new Int16Array(bytesOf(text).buffer), (n) => (n === -32768 ? NaN : (n / 32767) * limit));
}

const units = [
	[/_pct_lbp_fwd$/, '% LBP, + forward'],
	[/_from_ap_m$/, 'm from AP, + forward'],
	[/_t_per_cm$/, 't/cm'],
	[/_per_m2$/, '1/m²'],
	[/_per_m$/, '1/m'],
	[/_pct$/, '%'],
	[/_m4$/, 'm⁴'],
	[/_m3$/, 'm³'],
	[/_m2$/, 'm²'],
	[/_m$/, 'm'],
	[/_t$/, 't'],
];

// The unit that a name carries; '' where it has none.
export function unitOf(name) {
	const found = units.find(([pattern]) => pattern.test(name));
	return found ? found[1] : '';
}

const FIRST_VALUE = 3; // after id, status and front

export function readSweep() {
	const head = JSON.parse(block('batten-sweep'));
	const rows = f64(block('batten-rows'));
	const reasons = JSON.parse(block('batten-reasons'));
	let width = FIRST_VALUE;
	const columns = head.columns.map((column, number) => {
		const at = 'constant' in column ? -1 : width++;
		const constant = column.constant ?? NaN;
		return {
			...column,
			number,
			unit: unitOf(column.name),
			varies: at >= 0,
			value: at >= 0 ? (row) => rows[row * width + at] : () => constant,
		};
	});
	const count = rows.length / width;
	const rowOf = new Map();
	for (let row = 0; row < count; row++)
		rowOf.set(rows[row * width], row);
	return {
		head,
		columns,
		count,
		rowOf,
		id: (row) => rows[row * width],
		status: (row) => head.statuses[rows[row * width + 1]]?.name ?? '',
		statusNumber: (row) => rows[row * width + 1],
		onFront: (row) => rows[row * width + 2] === 1,
		reason: (row) => reasons[rows[row * width]] ?? '',
		hasHull: (row) => document.getElementById(`batten-hull-${rows[row * width]}`) !== null,
	};
}

// The geometry of a design, or of the 'parent'; null where it was not kept.
export function readHull(sweep, name) {
	const text = block(`batten-hull-${name}`);
	if (!text)
		return null;
	const hull = JSON.parse(text);
	const y = f32(hull.y_m);
	const change = hull.before_m ? parts(hull.before_m, hull.before_m_limit) : null;
	return {
		name,
		draft: hull.draft_m,
		lbp: hull.lbp_m,
		x: hull.x_m ? f64(hull.x_m) : Float64Array.from(sweep.head.x_m),
		z: hull.z_m ? f64(hull.z_m) : Float64Array.from(sweep.head.z_m),
		y,
		before: change ? y.map((value, i) => Math.max(0, value + change[i])) : null,
		largestChange: change ? hull.before_m_limit : 0,
		curvature: parts(hull.curvature_per_m, hull.curvature_per_m_limit),
		areaX: hull.area_x_m ? f32(hull.area_x_m) : null,
		area: hull.area_m2 ? f32(hull.area_m2) : null,
		drafts: hull.drafts_m ?? [],
		hydrostatics: hull.hydrostatics ?? [],
	};
}

// A number for the eye; the title of a cell has all its digits.
export function shortNumber(value) {
	if (!Number.isFinite(value))
		return '–';
	if (Number.isInteger(value) && Math.abs(value) < 1e7)
		return String(value);
	return String(Number(value.toPrecision(6)));
}
