// Elements in one line. Text only ever becomes text.

export function make(tag, attributes = {}, ...children) {
	const element = document.createElement(tag);
	for (const [name, value] of Object.entries(attributes)) {
		if (name.startsWith('on'))
			element.addEventListener(name.slice(2), value);
		else if (value === true)
			element.setAttribute(name, '');
		else if (value !== false && value !== null && value !== undefined)
			element.setAttribute(name, value);
	}
	element.append(...children);
	return element;
}

export function makeSvg(tag, attributes = {}, ...children) {
	const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
	for (const [name, value] of Object.entries(attributes))
		element.setAttribute(name, value);
	element.append(...children);
	return element;
}

export function byId(id) {
	return document.getElementById(id);
}

// Name and unit of a column.
export function labelOf(column) {
	return column.unit ? `${column.name} [${column.unit}]` : column.name;
}

// The options of a choice among columns: parameters and measures apart, those that vary first.
export function columnOptions(sweep, chosen) {
	const group = (label, columns) => make('optgroup', { label }, ...columns.map((column) =>
		make('option', { value: column.number, selected: column === chosen, title: column.meaning }, labelOf(column))));
	return [
		group('Parameters', sweep.columns.filter((column) => column.parameter && column.varies)),
		group('Measures', sweep.columns.filter((column) => !column.parameter && column.varies)),
	].filter((element) => element.children.length > 0);
}
