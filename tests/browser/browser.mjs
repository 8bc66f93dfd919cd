// A headless Chromium, spoken to through a pipe (Chrome DevTools Protocol): no package is needed.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const flags = ['--headless', '--no-sandbox', '--enable-unsafe-swiftshader', '--use-gl=angle', '--use-angle=swiftshader',
	'--disable-dev-shm-usage', '--no-first-run', '--window-size=1440,1400', '--remote-debugging-pipe'];

export async function openBrowser(program) {
	const folder = mkdtempSync(join(tmpdir(), 'batten-browser-'));
	const child = spawn(program, [...flags, `--user-data-dir=${folder}`, 'about:blank'],
		{ stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
	const answers = new Map();
	const complaints = [];
	let last = 0;
	let text = '';
	child.stdio[4].on('data', (data) => {
		text += data;
		for (let end = text.indexOf('\0'); end >= 0; end = text.indexOf('\0')) {
			take(JSON.parse(text.slice(0, end)));
			text = text.slice(end + 1);
		}
	});

	function take(message) {
		if (message.id) {
			const { resolve, reject } = answers.get(message.id);
			answers.delete(message.id);
			message.error ? reject(new Error(JSON.stringify(message.error))) : resolve(message.result);
		} else if (message.method === 'Runtime.exceptionThrown') {
			const { exception, text: what } = message.params.exceptionDetails;
			complaints.push(exception?.description ?? what);
		} else if (message.method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(message.params.type)) {
			complaints.push(message.params.args.map((argument) => argument.value ?? argument.description).join(' '));
		} else if (message.method === 'Log.entryAdded' && message.params.entry.level === 'error') {
			complaints.push(message.params.entry.text);
		}
	}

	const call = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
		answers.set(++last, { resolve, reject });
		child.stdio[3].write(`${JSON.stringify({ id: last, method, params, sessionId })}\0`);
	});
	const { targetInfos } = await call('Target.getTargets');
	const target = targetInfos.find(({ type }) => type === 'page');
	const { sessionId } = await call('Target.attachToTarget', { targetId: target.targetId, flatten: true });
	const send = (method, params) => call(method, params, sessionId);
	await send('Runtime.enable');
	await send('Log.enable');
	await send('Page.enable');

	const evaluate = async (expression) => {
		const { result, exceptionDetails } = await send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
		if (exceptionDetails)
			throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
		return result.value;
	};
	const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
	return {
		complaints,
		evaluate,
		open: (url) => send('Page.navigate', { url }),
		// Waits until the expression is true; 60 s are for machines under load.
		async until(expression) {
			for (let i = 0; i < 600; i++) {
				try {
					if (await evaluate(expression))
						return;
				} catch {
					// the page is being loaded
				}
				await pause(100);
			}
			throw new Error(`never true: ${expression}; the page says: ${complaints.join('; ')}`);
		},
		async mouse(type, x, y, buttons = type === 'mousePressed' ? 1 : 0) {
			await send('Input.dispatchMouseEvent', { type, x, y, buttons, button: type === 'mouseMoved' && !buttons ? 'none' : 'left', clickCount: type === 'mouseMoved' ? 0 : 1 });
		},
		async key(key, text = key) {
			await send('Input.dispatchKeyEvent', { type: 'keyDown', key, text: text.length === 1 ? text : undefined });
			await send('Input.dispatchKeyEvent', { type: 'keyUp', key });
		},
		picture: async () => Buffer.from((await send('Page.captureScreenshot', { format: 'png' })).data, 'base64'),
		async close() {
			const gone = new Promise((resolve) => child.on('exit', resolve));
			child.kill('SIGKILL');
			await gone;
			// Processes that it started may write on for a moment.
			for (let left = 20; left > 0; left--) {
				try {
					rmSync(folder, { recursive: true, force: true });
					return;
				} catch {
					await pause(200);
				}
			}
		},
	};
}
