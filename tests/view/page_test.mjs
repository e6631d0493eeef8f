// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pages of `cairn view`, opened and used in Chromium.
//   node page_test.mjs CAIRN PACKAGES TREE FOLDER [CHECK...]
// PACKAGES holds node_modules, TREE is a small tree; pages and pictures of them are left in FOLDER.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { cairn, colorsOf, launch, openPage, placeOf, settled, skip, state } from './browser.mjs';
import { bumpyBall } from './bumpy_ball.mjs';
import { cutOf, seenFrom, truthOf } from './tree_truth.mjs';

const [program, packages, tree, folder, ...wanted] = process.argv.slice(2);
if (!packages || !existsSync(join(packages, 'node_modules/playwright-core')))
  skip('this build has no viewer, or not the packages of its test: node and npm are needed when Cairn is configured');
mkdirSync(folder, { recursive: true });

const truth = truthOf(program, tree, folder);
const file = (name) => join(folder, name);
const view = (input, page, ...options) => cairn(program, 'view', input, '-o', file(page), ...options);

async function checkLevels(page) {
  await page.focus('#level');
  await page.keyboard.press('Home');
  for (let level = 0; level < truth.levels.length; ++level) {
    const now = await state(page);
    assert.equal(now.level, level);
    assert.equal(now.instances, truth.levels[level].spheres, `spheres of level ${level}`);
    const shown = (await page.textContent('#sphere-count')).replaceAll(',', '');
    assert.equal(Number(shown), truth.levels[level].spheres);
    const error = parseFloat(await page.textContent('#level-error'));
    assert.ok(Math.abs(error / truth.levels[level].error_max - 1) < 6e-3, `error of level ${level}: ${error}`);
    await page.keyboard.press('ArrowRight');
  }
  assert.equal((await state(page)).level, truth.levels.length - 1, 'the slider ends at the last level');
}

async function checkKeys(page) {
  await page.focus('#picture');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowDown');
  assert.equal((await state(page)).level, truth.levels.length - 3);
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('ArrowRight');
  assert.equal((await state(page)).level, truth.levels.length - 1);
  const all = await colorsOf(page);
  await page.keyboard.press('s');
  assert.equal((await state(page)).instances, 0);
  assert.equal(await page.getAttribute('#show-spheres', 'aria-pressed'), 'false');
  const withoutSpheres = await colorsOf(page);
  await page.keyboard.press('m');
  const nothing = await colorsOf(page);
  // The middle of the picture: spheres over mesh, mesh, ground.
  const middle = [312, 300];
  const [a, b, c] = [all, withoutSpheres, nothing].map((colors) => colors(...middle));
  for (const [one, other] of [[a, b], [b, c], [a, c]]) assert.ok(colorDistance(one, other) > 12, `${one} and ${other}`);
  await page.keyboard.press('m');
  await page.keyboard.press('s');
  const before = (await state(page)).eye;
  await page.mouse.move(300, 300);
  await page.mouse.down();
  await page.mouse.move(420, 340, { steps: 4 });
  await page.mouse.up();
  const turned = await state(page);
  assert.ok(distance(turned.eye, before) > 0.1 * truth.diagonal, 'dragging turns the view');
  assert.equal(turned.chosen, null, 'and chooses nothing');
  await page.keyboard.press('f');
  await page.waitForFunction((eye) => Math.hypot(...window.cairnView.state().eye.map((c, k) => c - eye[k])) < 1e-6, before);
}

const distance = (a, b) => Math.hypot(...a.map((c, k) => c - b[k]));
const colorDistance = distance;

/// Tab visits every control once, and each shows that it has the focus.
async function checkTabs(page) {
  await page.evaluate(() => document.activeElement.blur());
  const visited = [];
  for (;;) {
    await page.keyboard.press('Tab');
    const now = await page.evaluate(() => {
      const { activeElement: active } = document;
      const style = getComputedStyle(active);
      const frame = getComputedStyle(active.parentElement, '::after').borderTopStyle;
      return { id: active.id, visible: style.outlineStyle !== 'none' || (active.tagName === 'CANVAS' && frame === 'solid') };
    });
    if (visited.includes(now.id) || now.id === '' || visited.length > 20) break;
    assert.ok(now.visible, `${now.id} shows its focus`);
    visited.push(now.id);
  }
  assert.deepEqual(visited, ['picture', 'level', 'worst', 'show-mesh', 'show-spheres', 'show-edges', 'frame', 'up']);
}

async function detailsOf(page) {
  const rows = await page.$$eval('#details div', (list) => list.map((row) => [row.children[0].textContent, row.children[1].textContent]));
  return Object.fromEntries(rows);
}

/// Every sphere that can be seen is drawn, and where it belongs.
async function checkDrawn(page, seen) {
  await settled(page);
  const drawn = await page.evaluate((nodes) => {
    const places = nodes.map((node) => window.cairnView.placeOf(node));
    return places.map(({ x, y }) => window.cairnView.drawnAt(x, y));
  }, seen);
  assert.deepEqual(drawn, seen);
}

/// Chooses spheres by the mouse and compares what is said with the other commands.
async function checkClicks(page) {
  const { eye, level } = await state(page);
  const seen = seenFrom(eye, truth, cutOf(truth, level));
  assert.ok(seen.length > 5, `${seen.length} spheres can be clicked`);
  await checkDrawn(page, seen);
  for (const node of [seen[0], seen[Math.floor(seen.length / 2)], seen.at(-1)]) {
    const { x, y } = await placeOf(page, node);
    await page.mouse.click(x, y);
    assert.equal((await state(page)).chosen, node);
    assert.equal(await page.textContent('#selection-name'), `Node ${node}`);
    const said = await detailsOf(page);
    const { radius, parent, children, center } = truth.spheres[node];
    assert.equal(said.Level, String(truth.spheres[node].level));
    assert.equal(said.Parent, String(parent));
    assert.equal(said.Children, children.length ? children.join('') : 'none, it is a leaf');
    assert.ok(Math.abs(parseFloat(said.Radius) / radius - 1) < 6e-3, `radius ${said.Radius}`);
    said.Centre.split(', ').forEach((c, k) => assert.ok(Math.abs(c - center[k]) <= 6e-3 * Math.abs(center[k]) + 1e-6 * truth.diagonal));
    assert.ok(parseFloat(said['Certified error']) <= 1.006 * truth.levels[level].error_max);
    assert.ok(Number(said['Triangles held'].replaceAll(',', '')) > 0);
    await settled(page);
    assert.equal(await page.textContent('#parent-label:not([hidden])'), `parent ${parent}`);
  }
  await page.screenshot({ path: file('chosen.png') });
  const chosen = await colorsOf(page);
  await page.keyboard.press('Escape');
  assert.equal((await state(page)).chosen, null);
  assert.ok(!(await page.isVisible('#selection')));
  const free = await colorsOf(page);
  let changed = 0;
  for (let x = 0; x < 620; x += 4) for (let y = 0; y < 600; y += 4) changed += colorDistance(chosen(x, y), free(x, y)) > 20;
  assert.ok(changed > 50, `the chosen sphere and its parent stand out (${changed} of 23250 places)`);
  await page.keyboard.press('w');
  const said = await detailsOf(page);
  assert.ok(Math.abs(parseFloat(said['Certified error']) / truth.levels[level].error_max - 1) < 6e-3, 'the worst sphere');
  for (let up = level; up > 0; --up) {
    await page.keyboard.press('p');
    const { chosen } = await state(page);
    assert.equal((await detailsOf(page)).Children, truth.spheres[chosen].children.join(''));
  }
  assert.deepEqual([(await state(page)).chosen, (await state(page)).level], [0, 0], 'P leads to the root');
  const root = await detailsOf(page);
  assert.equal(Number(root['Triangles held'].replaceAll(',', '')), truth.triangles, 'the root holds every triangle');
  await page.keyboard.press('Escape');
}

/// Spheres of more error are less blue and more red, as the scale of the legend is.
async function checkColors(page, { seenOn, levels }) {
  await page.keyboard.press('m');
  const { level, eye } = await state(page);
  const colors = await colorsOf(page);
  const samples = [];
  for (const node of seenOn(eye, level)) {
    const { x, y } = await placeOf(page, node);
    await page.mouse.click(x, y);
    const [red, , blue] = colors(x, y);
    samples.push({ error: parseFloat((await detailsOf(page))['Certified error']), warmth: red - blue });
    await page.keyboard.press('Escape');
    if (samples.length === 25) break;
  }
  await page.keyboard.press('m');
  const pairs = samples.flatMap((a, i) => samples.slice(i + 1).map((b) => [a, b])).filter(([a, b]) => Math.abs(a.error - b.error) > 0.25 * levels[level].error_max);
  const right = pairs.filter(([a, b]) => a.error < b.error === a.warmth < b.warmth).length;
  console.log(`colours: of ${pairs.length} pairs of spheres with different errors, ${right} have the warmer colour at the greater error`);
  assert.ok(pairs.length >= 20 && right >= 0.95 * pairs.length);
}

async function checkTree(browser) {
  const page = await openPage(browser, file('tree.html'));
  await page.screenshot({ path: file('desktop.png') });
  await checkTabs(page);
  await checkLevels(page);
  await checkKeys(page);
  await checkClicks(page);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

async function checkPhone(browser) {
  const options = { viewport: { width: 400, height: 800 }, deviceScaleFactor: 1, hasTouch: true, colorScheme: 'dark', reducedMotion: 'reduce' };
  const page = await openPage(browser, file('tree.html'), options);
  await page.screenshot({ path: file('phone.png') });
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 400);
  const boxes = await page.$$eval('button, input, h1', (list) => list.filter((e) => e.checkVisibility()).map((e) => e.getBoundingClientRect().toJSON()));
  for (const box of boxes) assert.ok(box.left >= 0 && box.right <= 400, JSON.stringify(box));
  const colors = await colorsOf(page);
  assert.ok(Math.max(...colors(5, 300)) < 90, 'the dark theme is dark');
  const { eye, level } = await state(page);
  const [node] = seenFrom(eye, truth, cutOf(truth, level));
  const { x, y } = await placeOf(page, node);
  await page.touchscreen.tap(x, y);
  assert.equal((await state(page)).chosen, node);
  await page.evaluate(() => window.cairnView.orbit(0.2));
  await page.keyboard.press('f');
  assert.ok(distance((await state(page)).eye, eye) < 1e-6, 'without motion, the view is framed at once');
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Names are text and nothing else, and a mesh or a cover is shown as well.
async function checkMeshes(browser) {
  const name = '"><img src=x onerror="window.harm=1"><!--<script>';
  writeFileSync(file(`${name}.obj`), bumpyBall(2));
  for (const options of [[], ['--spheres', '12']]) {
    view(file(`${name}.obj`), 'mesh.html', ...options);
    const page = await openPage(browser, file('mesh.html'));
    assert.equal(await page.textContent('h1'), `${name}.obj`);
    assert.equal(await page.title(), `${name}.obj · Cairn`);
    assert.equal(await page.evaluate(() => window.harm ?? document.images.length), 0);
    assert.equal((await state(page)).instances, options.length ? 12 : 0);
    assert.ok(!(await page.isVisible('#level-section')), 'without levels, no slider');
    assert.deepEqual(page.faults, []);
    await page.context().close();
  }
}

/// A tree of 37,000 spheres: how quickly it opens and turns.
async function checkLargeTree(browser) {
  writeFileSync(file('large.obj'), bumpyBall(6, 0.5, 2));
  cairn(program, 'build', file('large.obj'), '-o', file('large.cairn'), '--method', 'octree', '--depth', '6', '--samples', '100', '--no-evaluate');
  const { page_bytes: bytes } = JSON.parse(view(file('large.cairn'), 'large.html', '--json', '-'));
  const start = performance.now();
  const page = await openPage(browser, file('large.html'));
  const opened = performance.now() - start;
  const large = truthOf(program, file('large.cairn'), folder);
  await page.focus('#picture');
  await page.keyboard.press('ArrowRight'); // where more spheres can be seen
  await checkColors(page, { ...large, seenOn: (eye, level) => seenFrom(eye, large, cutOf(large, level)) });
  for (let level = 0; level < 6; ++level) await page.keyboard.press('ArrowRight');
  await settled(page);
  const { spheres, instances } = await state(page);
  assert.ok(spheres >= 37000 && instances > 25000, `${spheres} spheres, ${instances} at once`);
  const { frames, seconds, pace } = await page.evaluate(() => window.cairnView.orbit(6));
  console.log(
    `large tree: ${spheres} spheres, page of ${(bytes / 1e6).toFixed(1)} MB, drawn after ${(opened / 1000).toFixed(1)} s; ` +
      `turning all ${instances} of its last level: ${(frames / seconds).toFixed(1)} frames a second in SwiftShader, drawn with ${pace.width} x ${pace.height} pixels`,
  );
  assert.ok(frames > 0);
  await page.screenshot({ path: file('large.png') });
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

const browser = await launch(packages);
try {
  view(tree, 'tree.html');
  for (const check of [checkTree, checkPhone, checkMeshes, checkLargeTree]) {
    if (wanted.length > 0 && !wanted.includes(check.name)) continue;
    const start = performance.now();
    await check(browser);
    console.log(`${check.name}: passed in ${((performance.now() - start) / 1000).toFixed(1)} s`);
  }
} finally {
  await browser.close();
}
