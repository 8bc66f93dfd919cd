// A hull in 3-D, coloured by its mean curvature.
import { byId, make } from './dom.js';
import { FINENESS, refineTable } from './shape.js';
import { colour } from './theme.js';

const views = {
	bow: [1, 0.75, 0.45],
	stern: [-1, 0.75, 0.45],
	side: [0.0001, 1, 0],
	below: [0.4, 0.5, -0.8],
	plan: [0.0001, 0, 1],
};

// 257 colours of sRGB, from -scale to scale.
function createColours(text) {
	const entries = [];
	for (let i = 0; i < text.length; i += 2)
		entries.push(parseInt(text.slice(i, i + 2), 16) / 255);
	const last = entries.length / 3 - 1;
	return (part, channel) => {
		const place = ((Math.max(-1, Math.min(1, part)) + 1) / 2) * last;
		const below = Math.min(last - 1, Math.floor(place));
		return entries[3 * below + channel] + (place - below) * (entries[3 * below + 3 + channel] - entries[3 * below + channel]);
	};
}

export function createSolidView(state) {
	const three = battenSolid;
	const canvas = byId('solid-canvas');
	const { head } = state.sweep;
	const look = createColours(head.colours);
	let scale = head.scale_per_m;
	let hull = null;
	let renderer = null;
	try {
		renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
	} catch (error) {
		byId('solid-note').textContent = 'This browser has no WebGL: the hull cannot be shown in 3-D. Its lines plan and curves can.';
		return { show() {}, hasWebGl: false };
	}
	renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
	const scene = new three.Scene();
	const camera = new three.PerspectiveCamera(30, 1, 0.01, 1000);
	camera.up.set(0, 0, 1);
	const light = new three.DirectionalLight(0xffffff, 0.9);
	camera.add(light);
	light.position.set(0.4, 0.6, 1);
	scene.add(new three.AmbientLight(0xffffff, 2.45), camera);
	const controls = new three.OrbitControls(camera, canvas);
	const group = new three.Group();
	scene.add(group);

	let isWaiting = false;
	function draw() {
		if (isWaiting)
			return;
		isWaiting = true;
		requestAnimationFrame(() => {
			isWaiting = false;
			const { clientWidth, clientHeight } = canvas.parentElement;
			if (clientWidth === 0 || clientHeight === 0)
				return;
			renderer.setSize(clientWidth, clientHeight, false);
			camera.aspect = clientWidth / clientHeight;
			camera.updateProjectionMatrix();
			renderer.render(scene, camera);
		});
	}

	function lookFrom(name) {
		if (!hull)
			return;
		const depth = hull.z[hull.z.length - 1] - hull.z[0];
		const length = hull.x[hull.x.length - 1] - hull.x[0];
		const centre = new three.Vector3(hull.x[0] + length / 2, 0, hull.z[0] + depth / 2);
		const aspect = canvas.parentElement.clientWidth / Math.max(1, canvas.parentElement.clientHeight);
		const distance = (0.56 * length) / Math.tan(((camera.fov / 2) * Math.PI) / 180) / Math.min(Math.max(aspect, 0.3), 3);
		camera.near = distance / 100;
		camera.far = distance * 20;
		camera.position.copy(centre).add(new three.Vector3(...views[name]).normalize().multiplyScalar(distance * (name === 'side' || name === 'plan' ? 1.02 : 0.86)));
		controls.target.copy(centre);
		controls.update();
		draw();
	}

	function build() {
		for (const part of [...group.children]) {
			part.geometry.dispose();
			part.material.dispose();
			group.remove(part);
		}
		const table = refineTable(hull.x, hull.z, hull.y);
		const curvature = refineTable(hull.x, hull.z, hull.curvature);
		group.add(surfaceOf(three, table, curvature, look, scale), linesOf(three, table), waterOf(three, hull));
	}

	function drawBar() {
		const bar = byId('colour-bar');
		const stops = Array.from({ length: 17 }, (_, i) => {
			const part = i / 8 - 1;
			return `rgb(${[0, 1, 2].map((channel) => Math.round(255 * look(part, channel))).join(',')})`;
		});
		bar.style.background = `linear-gradient(to right, ${stops.join(',')})`;
		byId('colour-low').textContent = `−${scale} hollow`;
		byId('colour-high').textContent = `${scale} convex`;
	}

	function setScale(factor) {
		scale = Number((scale * factor).toPrecision(3));
		drawBar();
		if (hull)
			build();
		draw();
	}

	byId('solid-buttons').append(
		...Object.keys(views).map((name) => make('button', { type: 'button', onclick: () => lookFrom(name) }, name)),
		make('button', { type: 'button', title: 'narrower colour scale', onclick: () => setScale(1 / 1.5) }, 'colours +'),
		make('button', { type: 'button', title: 'wider colour scale', onclick: () => setScale(1.5) }, 'colours −'));
	controls.addEventListener('change', draw);
	new ResizeObserver(draw).observe(canvas.parentElement);
	state.on('theme', () => {
		if (hull)
			build();
		draw();
	});
	drawBar();
	return {
		hasWebGl: true,
		show(next) {
			const isFirst = !hull;
			hull = next;
			build();
			if (isFirst)
				lookFrom('bow');
			draw();
		},
	};
}

// Both sides of the hull as triangles between the points of a fine table.
function surfaceOf(three, table, curvature, look, scale) {
	const count = table.width * table.height;
	const places = new Float32Array(6 * count);
	const colours = new Float32Array(6 * count);
	const paint = new three.Color();
	for (let node = 0; node < count; node++) {
		const value = curvature.values[node];
		if (Number.isNaN(value))
			paint.setRGB(0.6, 0.6, 0.6, three.SRGBColorSpace);
		else
			paint.setRGB(look(value / scale, 0), look(value / scale, 1), look(value / scale, 2), three.SRGBColorSpace);
		for (const side of [0, 1]) {
			const at = 3 * (node + side * count);
			places[at] = table.x[node % table.width];
			places[at + 1] = (side ? -1 : 1) * (Number.isNaN(table.values[node]) ? 0 : table.values[node]);
			places[at + 2] = table.z[Math.floor(node / table.width)];
			paint.toArray(colours, at);
		}
	}
	const geometry = new three.BufferGeometry();
	geometry.setAttribute('position', new three.BufferAttribute(places, 3));
	geometry.setAttribute('color', new three.BufferAttribute(colours, 3));
	geometry.setIndex(trianglesOf(table, count));
	geometry.computeVertexNormals();
	return new three.Mesh(geometry, new three.MeshLambertMaterial({ vertexColors: true, side: three.DoubleSide }));
}

function trianglesOf(table, count) {
	const triangles = [];
	const isOn = (node) => !Number.isNaN(table.values[node]);
	const add = (a, b, c) => triangles.push(a, b, c, a + count, c + count, b + count);
	for (let j = 0; j + 1 < table.height; j++)
		for (let i = 0; i + 1 < table.width; i++) {
			const low = j * table.width + i;
			const corners = [low, low + table.width, low + table.width + 1, low + 1].filter(isOn);
			if (corners.length >= 3)
				add(corners[0], corners[1], corners[2]);
			if (corners.length === 4)
				add(corners[0], corners[2], corners[3]);
		}
	return triangles;
}

// The stations and waterlines of the table, on both sides.
function linesOf(three, table) {
	const points = [];
	const add = (a, b) => {
		if (Number.isNaN(table.values[a]) || Number.isNaN(table.values[b]))
			return;
		for (const side of [1, -1])
			for (const node of [a, b])
				points.push(table.x[node % table.width], side * table.values[node], table.z[Math.floor(node / table.width)]);
	};
	for (let j = 0; j < table.height; j++)
		for (let i = 0; i < table.width; i++) {
			const node = j * table.width + i;
			if (j % FINENESS === 0 && i + 1 < table.width)
				add(node, node + 1);
			if (i % FINENESS === 0 && j + 1 < table.height)
				add(node, node + table.width);
		}
	const geometry = new three.BufferGeometry();
	geometry.setAttribute('position', new three.BufferAttribute(new Float32Array(points), 3));
	return new three.LineSegments(geometry, new three.LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.28 }));
}

function waterOf(three, hull) {
	const length = hull.x[hull.x.length - 1] - hull.x[0];
	const plane = new three.Mesh(new three.PlaneGeometry(1.1 * length, 0.45 * length),
		new three.MeshBasicMaterial({ color: colour('design'), transparent: true, opacity: 0.1, side: three.DoubleSide, depthWrite: false }));
	plane.position.set(hull.x[0] + length / 2, 0, hull.draft);
	return plane;
}
