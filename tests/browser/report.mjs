// The page of batten report in a real browser: it loads without a complaint, a brush filters, a click shows
// a hull or says that its geometry was not kept.
//
//   node report.mjs CHROMIUM REPORT.html [PICTURE.png]
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { openBrowser } from './browser.mjs';

const [program, report, picture] = process.argv.slice(2);
const browser = await openBrowser(program);
const { evaluate, until } = browser;
const shown = () => evaluate("Number(document.getElementById('count').dataset.shown)");
const textOf = (id) => evaluate(`document.getElementById('${id}').textContent`);
const click = (selector) => evaluate(`document.querySelector(${JSON.stringify(selector)}).click()`);
const boxOf = (id) => evaluate(`(() => { const r = document.getElementById('${id}').getBoundingClientRect(); return { x: r.x, y: r.y, width: r.width, height: r.height }; })()`);
// Whether a canvas shows more than one colour: something was drawn.
const isDrawn = (selector) => evaluate(`(() => {
	const from = document.querySelector(${JSON.stringify(selector)});
	const to = document.createElement('canvas');
	to.width = 64;
	to.height = 64;
	const context = to.getContext('2d');
	context.drawImage(from, 0, 0, 64, 64);
	const pixels = new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer);
	return new Set(pixels).size > 8;
})()`);

// The numbers of the page are those of the database; its text stays text.
async function checkLoaded() {
	await until('document.documentElement.dataset.firstFrame && document.documentElement.dataset.complete');
	console.log(`first frame at ${await evaluate('document.documentElement.dataset.firstFrame')} ms, all lines at ${await evaluate('document.documentElement.dataset.complete')} ms`);
	assert.equal(await shown(), 10000);
	assert.match(await textOf('sweep-name'), /<\/script><script>/);
	assert.equal(await evaluate('document.querySelectorAll("h1 b, h1 script").length'), 0);
	assert.match(await textOf('licences'), /Apache License[^]*three[^]*MIT/);
	assert.match(await textOf('sweep-facts'), /frame ap-fwd/);
	assert.ok(await isDrawn('#scatter canvas'), 'the scatter is empty');
	assert.ok(await isDrawn('#parallel canvas'), 'the parallel coordinates are empty');
}

// Drags along the first axis from a quarter to three quarters of its height.
async function checkBrush() {
	const box = await boxOf('parallel');
	const x = box.x + 46;
	const [from, to] = [0.35, 0.6].map((part) => box.y + part * box.height);
	await browser.mouse('mouseMoved', x, from);
	await browser.mouse('mousePressed', x, from);
	for (let k = 1; k <= 4; k++)
		await browser.mouse('mouseMoved', x, from + ((to - from) * k) / 4, 1);
	await browser.mouse('mouseReleased', x, to);
	await until("document.getElementById('count').dataset.shown !== '10000'");
	const brushed = await shown();
	assert.ok(brushed > 1000 && brushed < 9000, `a brush left ${brushed} designs`);
	await click('#front-only');
	const both = await shown();
	assert.ok(both > 0 && both < brushed, `brush and front left ${both} designs`);
	await click('#reset');
	assert.equal(await shown(), 10000);
	await until('!document.getElementById("front-only").checked');
	await click('#front-only');
	assert.equal(await shown(), Number((await textOf('front-count')).replace(/[^0-9]/g, '')));
	await click('#reset');
}

async function checkHull() {
	await click('[data-row="2"]');
	await until("document.getElementById('design-name').textContent === 'Design 2'");
	assert.equal(await evaluate('document.getElementById("no-hull").hidden'), true);
	assert.equal(await textOf('solid-note'), '');
	// a WebGL canvas keeps its picture for the frame only: the screen is looked at
	await evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
	assert.ok((await evaluate("document.getElementById('solid-canvas').width")) > 100);
	for (const [tab, wanted] of [['lines', '#lines path'], ['curves', '#area-chart canvas'], ['numbers', '#numbers tr']]) {
		await click(`#tab-${tab}`);
		assert.ok(await evaluate(`document.querySelectorAll(${JSON.stringify(wanted)}).length > 0`), `${tab}: nothing is shown`);
	}
	assert.match(await textOf('lines'), /largest change [0-9.]+ mm/);
	await click('#tab-curves');
	await until("document.querySelectorAll('#hydrostatics td').length === 20");
	assert.ok(await isDrawn('#area-chart canvas'), 'the section area curve is empty');
	await click('#tab-solid');
}

// A design without geometry, by the keyboard; a failed one tells why.
async function checkOthers() {
	await evaluate("document.getElementById('table').focus()");
	await browser.key('End', 'End');
	await until("document.getElementById('design-name').textContent === 'Design 9999'");
	assert.match(await textOf('no-hull'), /The geometry of design 9999 was not kept/);
	assert.equal(await evaluate('document.getElementById("no-hull").hidden'), false);
	await browser.key('Home', 'Home');
	await until("document.getElementById('design-name').textContent === 'Design 0'");
	await click('#statuses input');
	const failed = await shown();
	assert.ok(failed > 50 && failed < 200, `${failed} failed designs`);
	await browser.key('j');
	assert.match(await textOf('design-status'), /vary_failed · dcp: no such form/);
	await click('#reset');
	await click('#theme');
	await click('#theme');
	await click('[data-row="2"]');
}

try {
	await browser.open(pathToFileURL(report).href);
	await checkLoaded();
	await checkBrush();
	await checkHull();
	await checkOthers();
	if (picture)
		writeFileSync(picture, await browser.picture());
	assert.deepEqual(browser.complaints, []);
} finally {
	await browser.close();
}
