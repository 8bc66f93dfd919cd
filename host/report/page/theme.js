// Colours of the charts out of the style sheet, so that each is written once.

export function colour(name) {
	return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function isDark() {
	const chosen = document.documentElement.dataset.theme;
	return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

export function toggleTheme() {
	document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
}

// What every axis of a chart shares.
export function axisStyle() {
	const text = colour('text-soft');
	return {
		nameTextStyle: { color: colour('text'), fontSize: 12 },
		axisLabel: { color: text, fontSize: 11, hideOverlap: true },
		axisLine: { lineStyle: { color: colour('line-strong') } },
		axisTick: { lineStyle: { color: colour('line-strong') } },
		splitLine: { lineStyle: { color: colour('line') } },
	};
}

export function tooltipStyle() {
	return {
		backgroundColor: colour('panel'),
		borderColor: colour('line-strong'),
		textStyle: { color: colour('text'), fontSize: 12 },
	};
}
