// What the user has chosen, which designs that leaves, and who wants to know.
import { frontOf } from './front.js';

const AXES_MOST = 9;
const telling = ['energy_bending', 'fn_per_m2', 'volume_m3', 'cb', 'cp', 'lcb_pct_lbp_fwd', 'wetted_surface_m2', 'kmt_m', 'cn_max_m'];

// Parameters first, then objectives, then what a naval architect asks for first; only what varies.
function chooseAxes(sweep) {
	const named = (name) => sweep.columns.find((column) => !column.parameter && column.name === name);
	const wanted = [
		...sweep.columns.filter((column) => column.parameter).slice(0, 5),
		...sweep.head.objectives.map((objective) => named(objective.measure)),
		...telling.map(named),
		...sweep.columns,
	];
	return [...new Set(wanted)].filter((column) => column && column.varies).slice(0, AXES_MOST);
}

function chooseScatter(sweep, axes) {
	const objectives = sweep.head.objectives
		.map((objective) => sweep.columns.find((column) => !column.parameter && column.name === objective.measure))
		.filter((column) => column && column.varies);
	const measure = axes.find((column) => !column.parameter);
	const x = objectives.length > 1 ? objectives[0] : axes[0] ?? sweep.columns[0];
	const y = objectives.length > 1 ? objectives[1] : objectives[0] ?? measure ?? sweep.columns[1] ?? x;
	return [x, y === x ? sweep.columns.find((column) => column.varies && column !== x) ?? x : y];
}

export function createState(sweep) {
	const axes = chooseAxes(sweep);
	const [x, y] = chooseScatter(sweep, axes);
	const goalOf = (column) => sweep.head.objectives.find((o) => o.measure === column?.name)?.goal ?? 'min';
	const listeners = {};
	const state = {
		sweep,
		axes,
		x,
		y,
		goalX: goalOf(x),
		goalY: goalOf(y),
		goalOf,
		frontBy: sweep.head.front > 0 ? 'plan' : 'axes',
		frontOnly: false,
		keptOnly: false,
		hiddenStatuses: new Set(),
		brushes: new Map(), // column number -> intervals [low, high]
		selected: -1, // a row
		isFront: new Uint8Array(sweep.count),
		isOffered: new Uint8Array(sweep.count), // by everything but the brushes
		isShown: new Uint8Array(sweep.count),
		shownCount: 0,
		on(event, listener) {
			(listeners[event] ??= []).push(listener);
		},
		tell(event) {
			(listeners[event] ?? []).forEach((listener) => listener());
		},
		select(row) {
			state.selected = row;
			state.tell('selection');
		},
		update() {
			findFront(state);
			filter(state);
			state.tell('filter');
		},
	};
	findFront(state);
	filter(state);
	return state;
}

function findFront(state) {
	const { sweep } = state;
	state.isFront.fill(0);
	if (state.frontBy === 'plan') {
		for (let row = 0; row < sweep.count; row++)
			state.isFront[row] = sweep.onFront(row) ? 1 : 0;
		return;
	}
	const rows = [];
	for (let row = 0; row < sweep.count; row++)
		if (sweep.status(row) === 'done' || sweep.status(row) === 'not_converged')
			rows.push(row);
	for (const row of frontOf(rows, state.x.value, state.y.value, state.goalX, state.goalY))
		state.isFront[row] = 1;
}

function isWithin(value, intervals) {
	return intervals.some(([low, high]) => value >= low && value <= high);
}

function filter(state) {
	const { sweep } = state;
	const brushes = [...state.brushes].map(([number, intervals]) => [sweep.columns[number].value, intervals]);
	state.shownCount = 0;
	for (let row = 0; row < sweep.count; row++) {
		const offered = (!state.frontOnly || state.isFront[row]) && (!state.keptOnly || sweep.hasHull(row)) &&
			!state.hiddenStatuses.has(sweep.statusNumber(row));
		const shown = offered && brushes.every(([value, intervals]) => isWithin(value(row), intervals));
		state.isOffered[row] = offered ? 1 : 0;
		state.isShown[row] = shown ? 1 : 0;
		state.shownCount += shown ? 1 : 0;
	}
}
