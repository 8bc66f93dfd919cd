// Parallel coordinates: a line a design, brushed along its axes.
import { byId, columnOptions, labelOf, make, makeSvg } from './dom.js';
import { axisStyle, colour } from './theme.js';

const PLACE = { left: 46, right: 66, top: 48, bottom: 22 };
const LINES_MOST = 20000; // more are a grey field and take seconds; every n-th is drawn then

function lineOf(state, row) {
	return state.axes.map((column) => column.value(row));
}

function linesOf(state, wanted) {
	const rows = [];
	for (let row = 0; row < state.sweep.count; row++)
		if (wanted(row))
			rows.push(row);
	const step = Math.ceil(rows.length / LINES_MOST) || 1;
	return rows.filter((_, i) => i % step === 0).map((row) => lineOf(state, row))
		.filter((line) => line.every(Number.isFinite));
}

function rangeOf(state, column) {
	if (column.range)
		return column.range;
	let low = Infinity;
	let high = -Infinity;
	for (let row = 0; row < state.sweep.count; row++) {
		const value = column.value(row);
		if (Number.isFinite(value)) {
			low = Math.min(low, value);
			high = Math.max(high, value);
		}
	}
	column.range = low <= high ? [low, high] : [0, 1];
	return column.range;
}

// As many digits as the range asks for.
function tickText(value, range) {
	const decimals = Math.min(12, Math.max(0, 2 - Math.floor(Math.log10(range || 1))));
	return Math.abs(value) >= 1e6 || range < 1e-9 ? value.toPrecision(4) : String(Number(value.toFixed(decimals)));
}

function axesOption(state) {
	const style = axisStyle();
	return state.axes.map((column, dim) => {
		const [min, max] = rangeOf(state, column);
		return {
			dim, min, max,
			id: `axis-${column.number}`,
			name: column.unit ? `${column.name}\n[${column.unit.split(/ of| from|,/)[0]}]` : column.name,
			nameTextStyle: { ...style.nameTextStyle, fontSize: 11, lineHeight: 14, fontWeight: column.parameter ? 'bold' : 'normal' },
			nameGap: 10,
			axisLabel: {
				...style.axisLabel, showMinLabel: true, showMaxLabel: true, fontSize: 10, color: colour('text'),
				textBorderColor: colour('panel'), textBorderWidth: 3,
				formatter: (value) => tickText(value, max - min),
			},
			splitNumber: 4,
			axisLine: style.axisLine,
			axisTick: style.axisTick,
			areaSelectStyle: { width: 18, color: colour('brush'), borderColor: colour('brush'), borderWidth: 1, opacity: 0.35 },
		};
	});
}

function seriesOption(state) {
	const base = linesOf(state, (row) => state.isOffered[row] && !state.isFront[row]);
	const front = linesOf(state, (row) => state.isOffered[row] && state.isFront[row]);
	const dense = (lines, most, least) => Math.min(most, Math.max(least, 120 / Math.max(lines.length, 1)));
	const series = (id, data, lineStyle, z) => ({
		id, data, lineStyle, z, type: 'parallel', silent: true, animation: false, smooth: false,
		inactiveOpacity: 0.01, activeOpacity: lineStyle.opacity, progressive: 500, emphasis: { disabled: true },
	});
	return [
		series('designs', base, { color: colour('design'), width: 1, opacity: dense(base, 0.6, 0.05) }, 2),
		series('front', front, { color: colour('front'), width: 1.2, opacity: dense(front, 0.8, 0.15) }, 3),
	];
}

// The chosen design's line lies over the chart, so that choosing another one draws nothing anew.
function drawSelected(state) {
	const { clientWidth, clientHeight } = byId('parallel');
	const step = (clientWidth - PLACE.left - PLACE.right) / Math.max(1, state.axes.length - 1);
	const height = clientHeight - PLACE.top - PLACE.bottom;
	const points = state.selected < 0 ? [] : state.axes.map((column, k) => {
		const [low, high] = rangeOf(state, column);
		const part = (column.value(state.selected) - low) / (high - low || 1);
		return `${PLACE.left + k * step},${PLACE.top + (1 - part) * height}`;
	});
	byId('parallel-chosen').replaceChildren(
		...(points.some((point) => point.includes('NaN')) ? [] : [makeSvg('polyline', { points: points.join(' ') })]));
}

export function createParallel(state) {
	const chart = battenCharts.init(byId('parallel'), null, { renderer: 'canvas' });

	function draw() {
		chart.setOption({
			animation: false,
			parallel: { ...PLACE, axisExpandable: false },
			parallelAxis: axesOption(state),
			series: seriesOption(state),
		}, true);
		for (const [number, intervals] of state.brushes)
			chart.dispatchAction({ type: 'axisAreaSelect', parallelAxisId: `axis-${number}`, intervals });
	}

	// The brushes as they are on the axes now.
	function readBrushes() {
		const brushes = new Map();
		state.axes.forEach((column, dim) => {
			const intervals = chart.getModel().getComponent('parallelAxis', dim)?.activeIntervals ?? [];
			if (intervals.length > 0)
				brushes.set(column.number, intervals.map((interval) => [...interval]));
		});
		return brushes;
	}

	let isDrawing = false;
	const redraw = () => {
		isDrawing = true;
		draw();
		isDrawing = false;
		drawSelected(state);
	};
	chart.on('axisareaselected', () => {
		if (isDrawing)
			return;
		state.brushes = readBrushes();
		state.update();
	});
	state.on('axes', redraw);
	state.on('theme', redraw);
	state.on('offer', redraw);
	state.on('selection', () => drawSelected(state));
	new ResizeObserver(() => {
		chart.resize();
		drawSelected(state);
	}).observe(byId('parallel'));
	redraw();
	createAxisChoice(state);
	return chart;
}

// Which columns are axes: a list with a check mark each.
function createAxisChoice(state) {
	const list = byId('axis-list');
	const toggle = (column, on) => {
		state.axes = on ? [...state.axes, column] : state.axes.filter((other) => other !== column);
		if (!on)
			state.brushes.delete(column.number);
		state.tell('axes');
		state.update();
	};
	for (const group of columnOptions(state.sweep, null)) {
		list.append(make('strong', {}, group.label));
		for (const option of group.children) {
			const column = state.sweep.columns[option.value];
			list.append(make('label', { title: column.meaning },
				make('input', { type: 'checkbox', checked: state.axes.includes(column), onchange: (event) => toggle(column, event.target.checked) }),
				` ${labelOf(column)}`));
		}
	}
}
