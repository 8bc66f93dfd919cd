// The designs as a table. Only the rows in view exist, so that 200000 scroll as lightly as 20.
import { shortNumber } from './data.js';
import { byId, labelOf, make } from './dom.js';

const ROW_HEIGHT = 26;

export function createTable(state) {
	const { sweep } = state;
	const view = byId('table');
	const head = byId('table-head');
	const body = byId('table-body');
	let rows = [];
	let order = { column: null, descending: false };

	const columns = () => [
		{ name: 'design', value: (row) => sweep.id(row), text: (row) => String(sweep.id(row)), meaning: 'number of the design in the plan' },
		{ name: 'status', value: (row) => sweep.statusNumber(row), text: (row) => sweep.status(row), meaning: 'what became of it' },
		...state.axes.map((column) => ({ name: labelOf(column), value: column.value, text: (row) => shortNumber(column.value(row)), meaning: column.meaning })),
	];

	function sort() {
		rows = [];
		for (let row = 0; row < sweep.count; row++)
			if (state.isShown[row])
				rows.push(row);
		if (!order.column)
			return;
		const sign = order.descending ? -1 : 1;
		const { value } = order.column;
		// what has no number comes last whichever way the rest is sorted
		rows.sort((a, b) => {
			const p = value(a);
			const q = value(b);
			if (!Number.isFinite(p) || !Number.isFinite(q))
				return Number.isFinite(q) - Number.isFinite(p) || a - b;
			return sign * (p - q) || a - b;
		});
	}

	function drawHead() {
		const list = columns();
		const template = `84px 110px repeat(${list.length - 2}, minmax(112px, 1fr))`;
		const width = `${194 + 112 * (list.length - 2)}px`;
		for (const part of [head, body])
			part.style.minWidth = width;
		view.style.setProperty('--columns', template);
		head.replaceChildren(...list.map((column) => {
			const isOrder = order.column?.name === column.name;
			return make('button', {
				type: 'button', role: 'columnheader', title: column.meaning,
				'aria-sort': isOrder ? (order.descending ? 'descending' : 'ascending') : 'none',
				onclick: () => {
					order = { column, descending: isOrder && !order.descending };
					drawHead();
					refresh();
				},
			}, column.name, isOrder ? (order.descending ? ' ▼' : ' ▲') : '');
		}));
	}

	function rowElement(row, place, list) {
		const title = [sweep.reason(row), sweep.hasHull(row) ? '' : 'geometry not kept'].filter(Boolean).join('; ');
		const element = make('div', {
			class: 'row', role: 'row', title, 'data-row': row, 'aria-rowindex': place + 2,
			'aria-selected': row === state.selected ? 'true' : 'false',
		}, ...list.map((column, i) => make('span', { role: 'gridcell' },
			i === 0 ? `${state.isFront[row] ? '◆ ' : ''}${column.text(row)}${sweep.hasHull(row) ? '' : ' ·'}` : column.text(row))));
		element.style.top = `${place * ROW_HEIGHT}px`;
		return element;
	}

	function draw() {
		const list = columns();
		const first = Math.max(0, Math.floor(view.scrollTop / ROW_HEIGHT) - 4);
		const last = Math.min(rows.length, first + Math.ceil(view.clientHeight / ROW_HEIGHT) + 8);
		const elements = [];
		for (let place = first; place < last; place++)
			elements.push(rowElement(rows[place], place, list));
		body.style.height = `${rows.length * ROW_HEIGHT}px`;
		view.setAttribute('aria-rowcount', rows.length + 1);
		body.replaceChildren(...elements);
		byId('table-empty').hidden = rows.length > 0;
	}

	function refresh() {
		sort();
		draw();
	}

	function move(step) {
		const place = rows.indexOf(state.selected);
		const next = Math.min(rows.length - 1, Math.max(0, place + step));
		if (rows.length > 0)
			state.select(rows[next]);
	}

	// The chosen row comes into view.
	function follow() {
		const place = rows.indexOf(state.selected);
		const top = place * ROW_HEIGHT;
		const space = view.clientHeight - head.offsetHeight - ROW_HEIGHT;
		if (place >= 0 && (top < view.scrollTop || top > view.scrollTop + space))
			view.scrollTop = Math.max(0, top - space / 2);
		draw();
	}

	view.addEventListener('scroll', draw);
	view.addEventListener('click', (event) => {
		const row = event.target.closest('.row');
		if (row)
			state.select(Number(row.dataset.row));
	});
	view.addEventListener('keydown', (event) => {
		const page = Math.max(1, Math.floor(view.clientHeight / ROW_HEIGHT) - 2);
		const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
		if (event.key in steps && !event.ctrlKey && !event.altKey) {
			move(steps[event.key]);
			event.preventDefault();
		}
	});
	state.on('axes', () => {
		if (order.column && !columns().some((column) => column.name === order.column.name))
			order = { column: null, descending: false };
		drawHead();
	});
	state.on('filter', refresh);
	state.on('selection', follow);
	drawHead();
	refresh();
	return { move };
}
