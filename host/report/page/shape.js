// Smooth lines through a hull's table, for the eye only: cubics with the slopes of three-point
// parabolas, limited so that they do not swing past their ends. Nothing is measured on them.

export const FINENESS = 4; // pieces an interval of the table

// Slopes of values over places within one unbroken run.
function slopesOf(places, values) {
	const count = values.length;
	const slopes = new Float64Array(count);
	const chord = (i) => (values[i + 1] - values[i]) / (places[i + 1] - places[i]);
	for (let i = 1; i + 1 < count; i++) {
		const [before, after] = [chord(i - 1), chord(i)];
		const [stepBefore, stepAfter] = [places[i] - places[i - 1], places[i + 1] - places[i]];
		const slope = (stepAfter * before + stepBefore * after) / (stepBefore + stepAfter);
		const most = 3 * Math.min(Math.abs(before), Math.abs(after));
		slopes[i] = before * after <= 0 ? 0 : Math.max(-most, Math.min(most, slope));
	}
	if (count > 1) {
		slopes[0] = count > 2 ? 1.5 * chord(0) - 0.5 * slopes[1] : chord(0);
		slopes[count - 1] = count > 2 ? 1.5 * chord(count - 2) - 0.5 * slopes[count - 2] : chord(0);
	}
	return slopes;
}

function hermite(from, to, fromSlope, toSlope, t) {
	const s = 1 - t;
	return s * s * ((1 + 2 * t) * from + t * fromSlope) + t * t * ((1 + 2 * s) * to - s * toSlope);
}

// FINENESS values an interval; NaN between points of which one is none.
export function refineLine(places, values) {
	const count = values.length;
	const fine = new Float64Array((count - 1) * FINENESS + 1).fill(NaN);
	for (let first = 0; first < count; first++) {
		if (Number.isNaN(values[first]))
			continue;
		let last = first;
		while (last + 1 < count && !Number.isNaN(values[last + 1]))
			last++;
		const slopes = slopesOf(places.slice(first, last + 1), values.slice(first, last + 1));
		for (let i = first; i < last; i++) {
			const step = places[i + 1] - places[i];
			for (let k = 0; k < FINENESS; k++)
				fine[i * FINENESS + k] = hermite(values[i], values[i + 1], step * slopes[i - first], step * slopes[i + 1 - first], k / FINENESS);
		}
		fine[last * FINENESS] = values[last];
		first = last;
	}
	return fine;
}

export function refinePlaces(places) {
	const fine = new Float64Array((places.length - 1) * FINENESS + 1);
	for (let i = 0; i < fine.length; i++) {
		const at = Math.min(Math.floor(i / FINENESS), places.length - 2);
		fine[i] = places[at] + (places[at + 1] - places[at]) * (i / FINENESS - at);
	}
	return fine;
}

// Where three corners of a cell are on the hull, the half of the cell between them is: its points lie
// straight between its two edges.
function fillCorners(fine, width, rows, columns) {
	const at = (j, i) => fine[j * width + i];
	for (let j = 0; j + 1 < rows; j++)
		for (let i = 0; i + 1 < columns; i++) {
			const low = [j * FINENESS, i * FINENESS];
			const corners = [[0, 0], [0, 1], [1, 0], [1, 1]];
			const missing = corners.filter(([b, a]) => Number.isNaN(at(low[0] + b * FINENESS, low[1] + a * FINENESS)));
			if (missing.length !== 1)
				continue;
			const [b, a] = missing[0]; // the right angle lies opposite
			const spot = (v, u) => [low[0] + (b ? v : FINENESS - v), low[1] + (a ? u : FINENESS - u)];
			for (let v = 1; v < FINENESS; v++)
				for (let u = 1; u + v <= FINENESS; u++) {
					const sum = u + v;
					const alongX = at(...spot(0, sum));
					const alongZ = at(...spot(sum, 0));
					const [row, column] = spot(v, u);
					fine[row * width + column] = alongX + (alongZ - alongX) * (v / sum);
				}
		}
}

// A table [waterlines][stations] as a finer one: along the waterlines, then along z.
export function refineTable(x, z, values) {
	const width = (x.length - 1) * FINENESS + 1;
	const height = (z.length - 1) * FINENESS + 1;
	const lines = Array.from(z, (_, j) => refineLine(x, values.slice(j * x.length, (j + 1) * x.length)));
	const fine = new Float64Array(width * height);
	for (let i = 0; i < width; i++) {
		const column = refineLine(z, Float64Array.from(lines, (line) => line[i]));
		for (let j = 0; j < height; j++)
			fine[j * width + i] = column[j];
	}
	fillCorners(fine, width, z.length, x.length);
	return { width, height, values: fine, x: refinePlaces(x), z: refinePlaces(z) };
}

// Curvature of a line y(x) at its inner points, convex to the water positive, by the parabola through
// three neighbours; NaN elsewhere.
export function lineCurvature(places, values) {
	const curvature = new Float64Array(values.length).fill(NaN);
	for (let i = 1; i + 1 < values.length; i++) {
		const [before, after] = [places[i] - places[i - 1], places[i + 1] - places[i]];
		const [aft, fore] = [(values[i] - values[i - 1]) / before, (values[i + 1] - values[i]) / after];
		const first = (after * aft + before * fore) / (before + after);
		const second = (2 * (fore - aft)) / (before + after);
		curvature[i] = -second / Math.pow(1 + first * first, 1.5);
	}
	return curvature;
}

// Heights z at which the sections reach half-breadth y0, one a place along x: the buttock's lowest
// branch. NaN where there is none.
export function buttock(table, y0) {
	return Float64Array.from({ length: table.width }, (_, i) => {
		for (let j = 0; j + 1 < table.height; j++) {
			const [low, high] = [table.values[j * table.width + i], table.values[(j + 1) * table.width + i]];
			if (low < y0 && high >= y0)
				return table.z[j] + ((table.z[j + 1] - table.z[j]) * (y0 - low)) / (high - low);
		}
		return NaN;
	});
}
