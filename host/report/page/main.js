// The page: reads the sweep, makes its views, tells the time of the first frame.
import { readSweep } from './data.js';
import { createDesign } from './design.js';
import { byId, make } from './dom.js';
import { createParallel } from './parallel.js';
import { createScatter } from './scatter.js';
import { createState } from './state.js';
import { createTable } from './table.js';
import { toggleTheme } from './theme.js';

function showHead(sweep) {
	const { head } = sweep;
	document.title = `${head.name} · batten report`;
	byId('sweep-name').textContent = head.name;
	const shard = Number(head.shards) > 1 ? `shard ${head.shard} of ${head.shards}` : '';
	const unfinished = head.complete === '0' ? `unfinished: ${head.designs} of ${head.design_count} designs` : '';
	const part = head.shown < head.designs ? `${head.shown} of ${head.designs} designs are shown: the front, the hulls in the page and every n-th of the rest` : '';
	byId('sweep-facts').textContent = [
		`${head.designs.toLocaleString('en')} designs`, `seed ${head.seed}`, shard, unfinished, part,
		'frame ap-fwd: x forward from the aft perpendicular, y to port, z up', 'metres',
	].filter(Boolean).join(' · ');
	byId('plan').textContent = head.plan;
	byId('plan-facts').textContent = `Plan hash ${head.plan_hash}; computed by batten ${head.batten_version}, page by batten ${head.report_version}.`;
}

function showCount(state) {
	byId('count').textContent = `${state.shownCount.toLocaleString('en')} of ${state.sweep.count.toLocaleString('en')} designs`;
	byId('count').dataset.shown = state.shownCount;
	const onFront = state.isFront.reduce((sum, value, row) => sum + (value && state.isShown[row]), 0);
	byId('front-count').textContent = `${onFront.toLocaleString('en')} on the front`;
	byId('reset').disabled = state.brushes.size === 0 && !state.frontOnly && !state.keptOnly && state.hiddenStatuses.size === 0;
}

function createFilters(state) {
	const change = () => {
		state.update();
		state.tell('offer');
	};
	const check = (id, name) => byId(id).addEventListener('change', (event) => {
		state[name] = event.target.checked;
		change();
	});
	check('front-only', 'frontOnly');
	check('kept-only', 'keptOnly');
	const by = byId('front-by');
	const names = state.sweep.head.objectives.map((objective) => `${objective.measure} ${objective.goal}`).join(', ');
	if (names)
		by.append(make('option', { value: 'plan', selected: state.frontBy === 'plan' }, `the plan's objectives (${names})`));
	by.append(make('option', { value: 'axes', selected: state.frontBy === 'axes' }, 'the two axes of the scatter'));
	by.addEventListener('change', () => {
		state.frontBy = by.value;
		change();
	});
	state.sweep.head.statuses.forEach((status, number) => {
		const toggle = (event) => {
			state.hiddenStatuses[event.target.checked ? 'delete' : 'add'](number);
			change();
		};
		byId('statuses').append(make('label', { class: 'chip' },
			make('input', { type: 'checkbox', checked: true, onchange: toggle }), ` ${status.name} ${status.count.toLocaleString('en')}`));
	});
	const reset = () => {
		state.brushes.clear();
		state.frontOnly = false;
		state.keptOnly = false;
		state.hiddenStatuses.clear();
		for (const box of document.querySelectorAll('#filters input'))
			box.checked = box.closest('#statuses') !== null;
		change();
	};
	byId('reset').addEventListener('click', reset);
	state.on('filter', () => showCount(state));
	showCount(state);
	return { reset };
}

function createKeys(state, table, design, filters) {
	const keys = {
		r: filters.reset,
		f: () => byId('front-only').click(),
		h: () => byId('kept-only').click(),
		t: () => byId('theme').click(),
		j: () => table.move(1),
		k: () => table.move(-1),
		1: () => design.choose('solid'),
		2: () => design.choose('lines'),
		3: () => design.choose('curves'),
		4: () => design.choose('numbers'),
		'?': () => byId('help').showModal(),
	};
	document.addEventListener('keydown', (event) => {
		if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest('select, dialog[open], input:not([type=checkbox])'))
			return;
		keys[event.key]?.();
	});
	for (const button of document.querySelectorAll('[data-dialog]'))
		button.addEventListener('click', () => byId(button.dataset.dialog).showModal());
}

// Not where a test only looks at a module.
function start() {
	const sweep = readSweep();
	const state = createState(sweep);
	showHead(sweep);
	createScatter(state);
	const table = createTable(state);
	const filters = createFilters(state);
	const parallel = createParallel(state);
	const design = createDesign(state);
	createKeys(state, table, design, filters);
	byId('theme').addEventListener('click', () => {
		toggleTheme();
		state.tell('theme');
	});
	matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => state.tell('theme'));
	const { dataset } = document.documentElement;
	parallel.on('finished', () => {
		dataset.complete ??= performance.now().toFixed(0);
	});
	requestAnimationFrame(() => {
		// the frame that holds all of the above has been drawn when the next one begins
		requestAnimationFrame(() => {
			dataset.firstFrame = performance.now().toFixed(0);
		});
	});
}

start();
