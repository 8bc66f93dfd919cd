// The Pareto front of two columns: the designs that no other one is better than in both.

// rows: numbers of designs; a, b: value of a design; goals 'min' or 'max'. Returns the rows on the front,
// by ascending a. Of equal points all are on it.
export function frontOf(rows, a, b, goalA, goalB) {
	const signA = goalA === 'max' ? -1 : 1;
	const signB = goalB === 'max' ? -1 : 1;
	const points = rows
		.filter((row) => Number.isFinite(a(row)) && Number.isFinite(b(row)))
		.map((row) => ({ row, a: signA * a(row), b: signB * b(row) }))
		.sort((p, q) => p.a - q.a || p.b - q.b);
	const front = [];
	let best = Infinity;
	let last = null;
	for (const point of points) {
		if (point.b < best || (last && point.a === last.a && point.b === last.b)) {
			front.push(point.row);
			best = point.b;
			last = point;
		}
	}
	return signA < 0 ? front.reverse() : front;
}
