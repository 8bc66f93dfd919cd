// The clicked design: its hull in 3-D, its lines plan, its curves, all its numbers.
import { createCurves } from './curves.js';
import { readHull, shortNumber } from './data.js';
import { byId, make } from './dom.js';
import { drawLinesPlan } from './lines_plan.js';
import { createSolidView } from './solid_view.js';

const tabs = ['solid', 'lines', 'curves', 'numbers'];

export function createDesign(state) {
	const { sweep } = state;
	const parent = readHull(sweep, 'parent');
	const curves = createCurves(state);
	let solid = null;
	let tab = 'solid';
	let hull = null;
	let isParent = false;

	function drawTab() {
		for (const name of tabs) {
			byId(`panel-${name}`).hidden = name !== tab || (!hull && name !== 'numbers');
			byId(`tab-${name}`).setAttribute('aria-selected', String(name === tab));
			byId(`tab-${name}`).tabIndex = name === tab ? 0 : -1;
		}
		byId('no-hull').hidden = hull !== null || tab === 'numbers';
		if (tab === 'numbers')
			drawNumbers();
		if (!hull)
			return;
		if (tab === 'solid') {
			solid ??= createSolidView(state);
			solid.show(hull);
		} else if (tab === 'lines') {
			drawLinesPlan(hull);
		} else if (tab === 'curves') {
			curves.show(hull, parent);
		}
	}

	function drawNumbers() {
		if (isParent || state.selected < 0) {
			byId('numbers').replaceChildren(make('p', { class: 'note' }, isParent ? 'The measures of the parent are not in the database.' : 'Choose a design.'));
			return;
		}
		const cells = sweep.columns.map((column) => {
			const value = column.value(state.selected);
			return make('tr', {}, make('th', { title: column.meaning }, column.name),
				make('td', { title: String(value) }, shortNumber(value)), make('td', { class: 'unit' }, column.unit), make('td', { class: 'unit' }, column.meaning));
		});
		byId('numbers').replaceChildren(make('table', { class: 'values' }, make('tbody', {}, ...cells)));
	}

	function showDesign() {
		const row = state.selected;
		isParent = false;
		hull = row >= 0 ? readHull(sweep, sweep.id(row)) : null;
		byId('design-name').textContent = row < 0 ? 'No design chosen' : `Design ${sweep.id(row)}`;
		byId('design-status').textContent = row < 0 ? '' :
			[sweep.status(row), state.isFront[row] ? 'on the front' : '', sweep.reason(row)].filter(Boolean).join(' · ');
		byId('no-hull').textContent = row < 0
			? 'Click a point of the scatter or a row of the table to see a hull.'
			: `The geometry of design ${sweep.id(row)} was not kept: this page has the hulls of ${sweep.head.hulls} of ${sweep.head.designs} designs. ` +
				'Its numbers are all here; "hull in page" above leaves the designs that can be looked at.';
		drawTab();
	}

	function showParent() {
		if (!parent)
			return;
		isParent = true;
		hull = parent;
		byId('design-name').textContent = 'Parent';
		byId('design-status').textContent = 'the hull that was varied';
		drawTab();
	}

	function choose(name) {
		tab = name;
		drawTab();
	}

	for (const name of tabs)
		byId(`tab-${name}`).addEventListener('click', () => choose(name));
	byId('tabs').addEventListener('keydown', (event) => {
		const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
		if (!step)
			return;
		choose(tabs[(tabs.indexOf(tab) + step + tabs.length) % tabs.length]);
		byId(`tab-${tab}`).focus();
	});
	byId('show-parent').hidden = !parent;
	byId('show-parent').addEventListener('click', showParent);
	state.on('selection', showDesign);
	state.on('theme', drawTab);
	showDesign();
	return { choose };
}
