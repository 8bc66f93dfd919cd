// A scatter of any two columns, with the front.
import { shortNumber } from './data.js';
import { byId, columnOptions, labelOf, make } from './dom.js';
import { axisStyle, colour, tooltipStyle } from './theme.js';

function pointsOf(state, wanted) {
	const points = [];
	for (let row = 0; row < state.sweep.count; row++)
		if (wanted(row)) {
			const point = [state.x.value(row), state.y.value(row), row];
			if (Number.isFinite(point[0]) && Number.isFinite(point[1]))
				points.push(point);
		}
	return points;
}

function describe(state, row) {
	const { sweep } = state;
	const line = (name, value) => make('div', {}, `${name}: ${value}`);
	return make('div', {},
		make('strong', {}, `Design ${sweep.id(row)}`), ` ${sweep.status(row)}${state.isFront[row] ? ', on the front' : ''}`,
		line(labelOf(state.x), shortNumber(state.x.value(row))),
		line(labelOf(state.y), shortNumber(state.y.value(row))),
		...sweep.columns.filter((column) => column.parameter && column !== state.x && column !== state.y).slice(0, 6)
			.map((column) => line(column.name, shortNumber(column.value(row)))),
		line('geometry', sweep.hasHull(row) ? 'click to see the hull' : 'was not kept'));
}

function seriesOption(state) {
	const size = state.sweep.count > 3000 ? 4 : 7;
	const front = pointsOf(state, (row) => state.isShown[row] && state.isFront[row]).sort((a, b) => a[0] - b[0]);
	const point = (id, data, color, opacity, symbolSize, z, more = {}) => ({
		id, data, symbolSize, z, type: 'scatter', animation: false, itemStyle: { color, opacity },
		emphasis: { disabled: true }, large: true, largeThreshold: 1500, progressive: 0, dimensions: ['x', 'y', 'row'], encode: { x: 0, y: 1 }, ...more,
	});
	const chosen = state.selected >= 0 ? pointsOf(state, (row) => row === state.selected) : [];
	return [
		point('hidden', pointsOf(state, (row) => !state.isShown[row]), colour('text-soft'), 0.12, size, 1, { silent: true }),
		point('shown', pointsOf(state, (row) => state.isShown[row] && !state.isFront[row]), colour('design'), 0.55, size, 2),
		{
			id: 'front-line', type: 'line', data: state.frontBy === 'axes' ? front.map((p) => [p[0], p[1]]) : [], silent: true, showSymbol: false,
			step: 'end', animation: false, lineStyle: { color: colour('front'), width: 1, opacity: 0.6 }, z: 2,
		},
		point('front', front, colour('front'), 0.95, size + 3, 3),
		point('selected', chosen, 'transparent', 1, 16, 4, { silent: true, itemStyle: { color: 'transparent', borderColor: colour('selected'), borderWidth: 3 } }),
	];
}

function chartOption(state) {
	const axis = (column, gap) => ({
		...axisStyle(), type: 'value', scale: true, name: labelOf(column), nameLocation: 'middle', nameGap: gap,
	});
	return {
		animation: false,
		grid: { left: 74, right: 18, top: 14, bottom: 46 },
		xAxis: axis(state.x, 28),
		yAxis: axis(state.y, 56),
		dataZoom: [
			{ type: 'inside', xAxisIndex: 0, zoomOnMouseWheel: 'ctrl', moveOnMouseWheel: false, filterMode: 'none' },
			{ type: 'inside', yAxisIndex: 0, zoomOnMouseWheel: 'ctrl', moveOnMouseWheel: false, filterMode: 'none' },
		],
		tooltip: { ...tooltipStyle(), trigger: 'item', confine: true, formatter: (item) => (item.data.length > 2 ? describe(state, item.data[2]) : '') },
		series: seriesOption(state),
	};
}

export function createScatter(state) {
	const chart = battenCharts.init(byId('scatter'), null, { renderer: 'canvas' });
	const redraw = () => chart.setOption(chartOption(state), true);
	const refresh = () => chart.setOption({ series: seriesOption(state) });
	chart.on('click', (item) => {
		if (item.data?.length > 2)
			state.select(item.data[2]);
	});
	state.on('theme', redraw);
	state.on('scatter', redraw);
	state.on('filter', refresh);
	state.on('selection', () => chart.setOption({ series: [seriesOption(state)[4]] }));
	new ResizeObserver(() => chart.resize()).observe(byId('scatter'));
	redraw();
	createChoices(state);
	return chart;
}

function createChoices(state) {
	const choices = [['x', 'goalX'], ['y', 'goalY']];
	for (const [axis, goal] of choices) {
		const select = byId(`scatter-${axis}`);
		const button = byId(`goal-${axis}`);
		const show = () => {
			button.textContent = state[goal] === 'max' ? '↑ more is better' : '↓ less is better';
		};
		const change = () => {
			state.update();
			state.tell('scatter');
			if (state.frontBy === 'axes')
				state.tell('offer');
		};
		select.append(...columnOptions(state.sweep, state[axis]));
		select.addEventListener('change', () => {
			state[axis] = state.sweep.columns[select.value];
			state[goal] = state.goalOf(state[axis]);
			show();
			change();
		});
		button.addEventListener('click', () => {
			state[goal] = state[goal] === 'max' ? 'min' : 'max';
			show();
			change();
		});
		show();
	}
}
