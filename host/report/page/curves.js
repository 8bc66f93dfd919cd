// The clicked design's curves: section areas, curvature of its waterlines, hydrostatics over drafts.
import { shortNumber, unitOf } from './data.js';
import { byId, make } from './dom.js';
import { lineCurvature } from './shape.js';
import { axisStyle, colour, tooltipStyle } from './theme.js';

const WATERLINES_MOST = 6;
const strokes = ['#3b6fb6', '#d9822b', '#2a9d73', '#b5498f', '#8a6d3b', '#5c7cfa'];

function option(title, xName, yName, series) {
	const axis = (name, gap) => ({ ...axisStyle(), type: 'value', scale: true, name, nameLocation: 'middle', nameGap: gap });
	return {
		animation: false,
		grid: { left: 66, right: 16, top: 34, bottom: 40 },
		legend: { top: 2, textStyle: { color: colour('text-soft'), fontSize: 11 }, itemWidth: 18, itemHeight: 8, type: 'plain' },
		tooltip: { ...tooltipStyle(), trigger: 'axis', confine: true, valueFormatter: shortNumber, renderMode: 'richText' },
		xAxis: axis(xName, 24),
		yAxis: axis(yName, 50),
		series,
		aria: { enabled: true, label: { description: title } },
	};
}

function line(name, points, color, type = 'solid') {
	return { name, type: 'line', data: points, showSymbol: false, animation: false, lineStyle: { color, type, width: type === 'solid' ? 2 : 1.4 }, itemStyle: { color } };
}

function areaSeries(hull, parent) {
	const points = (of) => Array.from(of.areaX, (x, i) => [x, of.area[i]]);
	const series = hull.area ? [line('section area', points(hull), colour('front'))] : [];
	if (parent?.area && parent !== hull)
		series.push(line('parent', points(parent), colour('text-soft'), 'dashed'));
	return series;
}

// Waterlines spread evenly over the table, those that have a curvature.
function curvatureSeries(hull) {
	const lines = [];
	for (let j = 0; j < hull.z.length; j++) {
		const values = lineCurvature(hull.x, hull.y.slice(j * hull.x.length, (j + 1) * hull.x.length));
		if (values.filter(Number.isFinite).length > 2)
			lines.push({ z: hull.z[j], values });
	}
	const step = Math.max(1, Math.ceil(lines.length / WATERLINES_MOST));
	return lines.filter((_, i) => (lines.length - 1 - i) % step === 0).map(({ z, values }, k) =>
		line(`z = ${shortNumber(z)} m`, Array.from(hull.x, (x, i) => [x, Number.isFinite(values[i]) ? values[i] : null]), strokes[k % strokes.length]));
}

function hydrostaticsTable(names, hull) {
	if (hull.drafts.length === 0)
		return make('p', { class: 'note' }, 'The sweep has no hydrostatics over drafts.');
	return make('table', { class: 'values' },
		make('thead', {}, make('tr', {}, make('th', {}, 'draft_m'), ...hull.drafts.map((draft) => make('th', {}, shortNumber(draft))))),
		make('tbody', {}, ...names.map((name, i) => make('tr', {},
			make('th', { title: unitOf(name) }, name), ...hull.hydrostatics.map((row) => make('td', {}, shortNumber(row[i] ?? NaN)))))));
}

export function createCurves(state) {
	let charts = null;
	return {
		show(hull, parent) {
			charts ??= ['area-chart', 'curvature-chart'].map((id) => {
				const chart = battenCharts.init(byId(id));
				new ResizeObserver(() => chart.resize()).observe(byId(id));
				return chart;
			});
			const x = 'x from AP, + forward [m]';
			charts[0].setOption(option('section area curve', x, `area below ${shortNumber(hull.draft)} m, both sides [m²]`, areaSeries(hull, parent)), true);
			charts[1].setOption(option('curvature of waterlines', x, 'curvature of the waterline [1/m]', curvatureSeries(hull)), true);
			byId('hydrostatics').replaceChildren(hydrostaticsTable(state.sweep.head.hydrostatics, hull));
		},
	};
}
