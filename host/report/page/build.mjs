// Makes the page of batten report: bundles the third-party code into two scripts and the page's own
// modules into a third, and puts them, the style and the licences into page.html.
//
//   node build.mjs NODE_MODULES OUTPUT
import { createRequire } from 'node:module';
import { readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [modules, output] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(modules, 'any.js'))('esbuild');

function bundle(entry, globalName) {
	const result = esbuild.buildSync({
		entryPoints: [join(here, entry)],
		bundle: true,
		minify: true,
		write: false,
		format: 'iife',
		globalName,
		target: 'es2020',
		nodePaths: [modules],
		legalComments: 'none',
		charset: 'ascii',
		logLevel: 'warning',
	});
	return result.outputFiles[0].text;
}

// Inside a script element nothing may look like its end, or like the begin of a comment. Both can only
// stand in texts and patterns of the code, where a backslash changes nothing.
function insideScript(text) {
	return text.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
}

function escaped(text) {
	return text.replace(/&/g, '&amp;').replace(/</g, '&lt;');
}

function licence(name, file) {
	const facts = JSON.parse(readFileSync(join(modules, name, 'package.json'), 'utf8'));
	return `${name} ${facts.version} (${facts.license})\n\n` + readFileSync(join(modules, name, file), 'utf8').trim();
}

const licences = [
	licence('echarts', 'NOTICE'),
	readFileSync(join(modules, 'echarts', 'LICENSE'), 'utf8').trim(),
	readFileSync(join(modules, 'echarts', 'licenses', 'LICENSE-d3'), 'utf8').trim(),
	licence('zrender', 'LICENSE'),
	licence('tslib', 'LICENSE.txt'),
	licence('three', 'LICENSE'),
].join(`\n\n${'-'.repeat(72)}\n\n`);

const parts = {
	style: readFileSync(join(here, 'page.css'), 'utf8'),
	licences: escaped(licences),
	charts: insideScript(bundle('charts.js', 'battenCharts')),
	solid: insideScript(bundle('solid.js', 'battenSolid')),
	page: insideScript(bundle('main.js', 'battenPage')),
};
let text = readFileSync(join(here, 'page.html'), 'utf8');
for (const [name, part] of Object.entries(parts)) {
	if (text.split(`{{${name}}}`).length !== 2)
		throw new Error(`page.html: expected {{${name}}} once`);
	text = text.replace(`{{${name}}}`, () => part);
}
writeFileSync(`${output}.part`, text);
renameSync(`${output}.part`, output);
