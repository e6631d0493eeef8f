// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page that compares engines, opened and used in Chromium.
//   node page_test.mjs PAGE PACKAGES FOLDER [CHECK...]
// PAGE is the folder the page was built into, PACKAGES holds node_modules; pictures are left in FOLDER.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { launch, openPage, serve, skip, state } from './browser.mjs';
import { geoJsonOfTwoRocks, vtkOfTwoRocks } from './samples.mjs';

const [built, packages, folder, ...wanted] = process.argv.slice(2);
if (!existsSync(join(built, 'index.html'))) skip('the page is not built: ./cairn.sh web --build');
mkdirSync(folder, { recursive: true });
const file = (name) => join(folder, name);

const kSmall = '?body=ring&bodies=10&microseconds=0'; // without a deadline, so that a busy machine changes nothing
// Refinement keeps a budget of operations; measuring the pairs that it finished comes on top (docs/limits.md).
const kBeyond = 3;
const kEngines = ['Cairn', 'Rapier', 'Rapier', 'Jolt', 'Havok'];

const placeOf = ({ poses }, body) => poses.slice(7 * body, 7 * body + 3);
const until = (page, what, ...more) => page.waitForFunction(what, more, { polling: 200 });

async function setSlider(page, id, value) {
  await page.$eval(`#${id}`, (slider, wish) => {
    slider.value = wish;
    for (const type of ['input', 'change']) slider.dispatchEvent(new Event(type, { bubbles: true }));
  }, value);
}

/// Bodies fall, come to rest inside the pit, and sleep.
async function checkRest(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  const start = await state(page);
  assert.equal(start.engine.name, 'Cairn');
  assert.equal(start.bodies, 10);
  await until(page, () => window.cairnWeb.state().asleep === 10);
  const { poses } = await state(page);
  for (let body = 0; body < 10; ++body) {
    const [x, y, z] = placeOf({ poses }, body);
    assert.ok(Math.abs(x) < 1.3 && Math.abs(z) < 1.3 && y > 0.05 && y < 2, `body ${body} lies at ${[x, y, z]}`);
  }
  await until(page, () => document.querySelector('#status').textContent.endsWith('10 bodies, 10 asleep'));
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Operations of the first steps of a scene with a budget, or without. Budgets of operations give the same in each run.
async function operationsOf(page, place) {
  await setSlider(page, 'operations', place);
  const steps = page.evaluate(() => new Promise((done) => {
    const seen = [];
    const { cairnWeb: web } = window;
    const take = web.take.bind(web);
    web.take = (frame) => {
      take(frame);
      if (seen.length === 0 && frame.samples[0].step !== 1) return; // of the scene before
      seen.push(...frame.samples);
      if (seen.at(-1).step < 200) return;
      web.take = take;
      done(seen.filter(({ step }) => step <= 200).map(({ operations, unresolvedPairs }) => ({ operations, unresolvedPairs })));
    };
  }));
  await page.click('#drop');
  return steps;
}

async function checkBudget(browser, address) {
  const page = await openPage(browser, `${address}?body=link&bodies=40&microseconds=0`);
  const free = await operationsOf(page, 24);
  const shown = (await state(page)).contacts;
  assert.ok(shown.contacts > 40 && shown.open === 0, 'without a budget no contact is cut short');
  const tight = await operationsOf(page, 3); // a thousand operations
  await until(page, () => window.cairnWeb.state().contacts.open > 10);
  const again = await operationsOf(page, 3);
  const most = (steps) => Math.max(...steps.map(({ operations }) => operations));
  const open = (steps) => steps.reduce((sum, { unresolvedPairs }) => sum + unresolvedPairs, 0);
  console.log(`budget of 1,000 operations: at most ${most(tight)}, ${open(tight)} pairs unresolved in 200 steps; without: ${most(free)}, ${open(free)}`);
  assert.equal(await page.textContent('#operations-text'), '1,000 operations');
  assert.ok(most(tight) <= kBeyond * 1000, 'a budget is kept, but for the last measurements');
  assert.ok(most(free) > 20 * most(tight), 'without a budget, far more is done');
  assert.equal(open(free), 0);
  assert.ok(open(tight) > 0, 'what a budget costs is told');
  assert.deepEqual(again, tight, 'the same budget of operations gives the same steps');
  assert.ok(Number((await page.textContent('#open-pairs')).replaceAll(',', '')) >= 0);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Every engine drops the same scene.
async function checkEngines(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  const ids = await page.$$eval('#engine option', (options) => options.map(({ value }) => value));
  assert.equal(ids.length, kEngines.length);
  const start = await page.evaluate(() => window.cairnWeb.state().engine);
  assert.equal(start.name, 'Cairn');
  for (const [k, id] of ids.entries()) {
    await page.selectOption('#engine', id);
    await until(page, ([name]) => window.cairnWeb.state().engine?.name === name && window.cairnWeb.state().step < 50, kEngines[k]).catch(() => {});
    await until(page, ([name]) => window.cairnWeb.state().engine?.name === name && window.cairnWeb.state().step > 150, kEngines[k]);
    const now = await state(page);
    assert.match(await page.textContent('#status'), new RegExp(`^${kEngines[k]} [0-9.]+: 10 bodies`));
    for (let body = 0; body < 10; ++body) {
      const [x, y, z] = placeOf(now, body);
      assert.ok(Math.abs(x) < 1.4 && Math.abs(z) < 1.4 && y > -0.1 && y < 3, `${id}: body ${body} is at ${[x, y, z]}`);
    }
    assert.equal(await page.isVisible('#microseconds'), id === 'cairn', `${id}: budgets are Cairn's`);
    assert.ok((await page.textContent('#time-facts')).length > 20);
    assert.equal(await page.isVisible('#refusal'), false);
  }
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// An engine that does not come is said to be missing, and the next one is there all the same.
async function checkMissingEngine(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  await page.context().route(/jolt-physics/, (route) => route.abort());
  await page.selectOption('#engine', 'jolt');
  await page.waitForSelector('#refusal:not([hidden])');
  assert.ok((await page.textContent('#refusal')).length > 10);
  await page.selectOption('#engine', 'rapier-parts');
  await until(page, () => window.cairnWeb.state().engine.name === 'Rapier' && window.cairnWeb.state().step > 20);
  assert.equal(await page.isVisible('#refusal'), false);
  assert.ok(page.faults.every((fault) => fault.includes('jolt') || fault.includes('ERR_FAILED')), page.faults.join());
  await page.context().close();
}

/// A file that does not come is told, and while an engine loads the page says so.
async function checkMissingFile(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  await page.context().route(/hulls\.json/, (route) => new Promise((done) => setTimeout(done, 1500)).then(() => route.abort()));
  await page.selectOption('#engine', 'jolt');
  await page.waitForTimeout(700); // several of the page's changes of its numbers
  assert.equal(await page.textContent('#status'), 'Jolt, convex parts is loading');
  await page.waitForSelector('#refusal:not([hidden])');
  assert.match(await page.textContent('#refusal'), /^models\/ring\.hulls\.json could not be loaded; /);
  assert.ok(page.faults.every((fault) => fault.includes('hulls') || fault.includes('ERR_FAILED')), page.faults.join());
  await page.context().close();
}

/// A frame that waited while other bodies came is not laid upon them.
async function checkLateFrame(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  const numbers = await page.evaluate(async () => {
    const { cairnWeb: web } = window;
    while (!web.waiting_) await new Promise((done) => setTimeout(done, 1));
    const { poses } = web.waiting_;
    document.querySelector('#count').value = 50;
    const dropped = web.drop();
    web.showFrame = () => {}; // no picture comes in between
    await dropped;
    delete web.showFrame;
    web.waiting_ ??= null;
    web.showFrame();
    return { before: poses.length, now: web.cloud_.poses.length };
  });
  assert.deepEqual(numbers, { before: 70, now: 350 });
  await page.context().close();
}

/// Without WebGL, a sentence says what to do.
async function checkNoWebGl(browser, address) {
  const page = await browser.newPage();
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
      return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...more);
    };
  });
  await page.goto(address);
  await page.waitForSelector('#refusal:not([hidden])');
  assert.match(await page.textContent('#refusal'), /WebGL 2; switch on/);
  await page.close();
}

/// The body and place where a pointer would take a body.
async function bodyToTake(page) {
  return page.evaluate(() => {
    const { cairnWeb: web } = window;
    for (let body = 0; body < 10; ++body) {
      const { x, y } = web.placeOf(body);
      // A ring's middle is its hole, so look around it.
      for (let k = 0; k < 24; ++k) {
        const at = { x: x + 24 * Math.cos(k) * (1 + k / 12), y: y + 24 * Math.sin(k) * (1 + k / 12) };
        const hit = web.bodyAt(at.x, at.y);
        if (hit !== null) return { body: hit, ...at };
      }
    }
    return null;
  });
}

async function checkHand(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  await until(page, () => window.cairnWeb.state().asleep === 10);
  const { body, x, y } = await bodyToTake(page);
  const before = placeOf(await state(page), body);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - 180, { steps: 4 });
  assert.equal((await state(page)).held, body);
  await until(page, ([b, h]) => window.cairnWeb.state().poses[7 * b + 1] > h + 0.3, body, before[1]);
  await page.mouse.up();
  assert.equal((await state(page)).held, null);
  await until(page, ([b, h]) => window.cairnWeb.state().poses[7 * b + 1] < h + 0.3, body, before[1]);
  // By keys.
  await page.focus('#picture');
  await page.keyboard.press('Escape');
  for (let press = 0; press < 3; ++press) await page.keyboard.press('n');
  await page.keyboard.press('Shift+N');
  assert.equal((await state(page)).chosen, 1);
  const [, low] = placeOf(await state(page), 1);
  await page.keyboard.press('Enter');
  await page.keyboard.press('PageUp');
  assert.equal((await state(page)).held, 1);
  assert.match(await page.textContent('#status'), /body 2 held/);
  await until(page, ([h]) => window.cairnWeb.state().poses[8] > h + 0.3, low);
  await page.keyboard.press('Enter');
  assert.equal((await state(page)).held, null);
  await checkView(page);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Dragging beside bodies and keys turn the view; F brings it back.
async function checkView(page) {
  const eye = () => page.evaluate(() => window.cairnWeb.stage_.camera.position.toArray());
  const distance = (a, b) => Math.hypot(...a.map((c, k) => c - b[k]));
  const whole = await eye();
  await page.mouse.move(60, 500);
  await page.mouse.down();
  await page.mouse.move(160, 480, { steps: 4 });
  await page.mouse.up();
  const turned = await eye();
  assert.ok(distance(whole, turned) > 0.3, 'dragging turns the view');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('+');
  assert.ok(distance(turned, await eye()) > 0.1, 'so do keys');
  await page.keyboard.press('F'); // as caps lock makes it
  assert.ok(distance(whole, await eye()) < 1e-6, 'F shows the whole');
}

async function openFile(page, name, text) {
  writeFileSync(file(name), text);
  await page.setInputFiles('#file', file(name));
}

async function checkReplay(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  await until(page, () => window.cairnWeb.recorder_.steps.at(-1) - window.cairnWeb.recorder_.steps[0] > 60);
  await page.click('#replay-last');
  const replay = await state(page);
  assert.ok(replay.isReplaying && replay.replay.duration > 0.5);
  const download = page.waitForEvent('download');
  await page.click('#save');
  await (await download).saveAs(file('run.json'));
  await page.click('#live');
  assert.equal((await state(page)).isReplaying, false);
  await openFile(page, 'run.json', readFileSync(file('run.json'), 'utf8'));
  await until(page, () => window.cairnWeb.state().isReplaying);
  assert.match(await page.textContent('#replay-about'), /^10 bodies, Cairn/);
  for (const [name, text] of [['two.vtk', vtkOfTwoRocks], ['two.geojson', geoJsonOfTwoRocks]]) {
    await openFile(page, name, text);
    await until(page, () => document.querySelector('#replay-about').textContent.startsWith('2 rocks'));
    assert.equal((await state(page)).replay.duration, 2);
  }
  await openFile(page, 'bad.json', '{"format": "other"}');
  await page.waitForSelector('#refusal:not([hidden])');
  assert.match(await page.textContent('#refusal'), /no run of this page/);
  await page.click('#replay-rocks');
  await until(page, () => document.querySelector('#replay-about').textContent.startsWith('100 rocks'));
  await setSlider(page, 'replay', 300);
  await page.waitForTimeout(1000);
  await page.screenshot({ path: file('rocks.png') });
  await page.click('#live');
  await page.click('#pause');
  await page.waitForTimeout(1000); // frames on their way arrive
  const { step } = await state(page);
  await page.waitForTimeout(1000);
  assert.equal((await state(page)).step, step, 'a pause stops the world');
  await page.click('#pause');
  await until(page, ([last]) => window.cairnWeb.state().step > last + 10, step);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Tab visits every control once, in the order they are read; each shows its focus and has a name.
async function checkTabs(browser, address) {
  const page = await openPage(browser, `${address}${kSmall}`);
  await page.evaluate(() => document.activeElement.blur());
  const visited = [];
  for (;;) {
    await page.keyboard.press('Tab');
    const now = await page.evaluate(() => {
      const { activeElement: active } = document;
      const style = getComputedStyle(active);
      const frame = getComputedStyle(active.parentElement, '::after').borderTopStyle;
      const name = active.ariaLabel ?? active.labels?.[0]?.textContent ?? document.getElementById(active.getAttribute('aria-labelledby'))?.textContent ?? active.textContent;
      return { id: active.id, name: name.trim(), isSeen: style.outlineStyle !== 'none' || (active.tagName === 'CANVAS' && frame === 'solid') };
    });
    if (visited.includes(now.id) || now.id === '' || visited.length > 30) break;
    assert.ok(now.isSeen, `${now.id} shows its focus`);
    assert.ok(now.name.length > 2, `${now.id} has a name`);
    visited.push(now.id);
  }
  const scene = ['engine', 'body', 'count', 'drop', 'pause', 'show-contacts', 'frame'];
  assert.deepEqual(visited, ['picture', 'microseconds', 'operations', ...scene, 'replay-last', 'replay-rocks', 'open', 'save']);
  await page.focus('#operations');
  for (let press = 0; press < 3; ++press) await page.keyboard.press('ArrowLeft');
  assert.equal(await page.textContent('#operations-text'), '150,000 operations');
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

async function checkDesktop(browser, address) {
  const page = await openPage(browser, `${address}?bodies=60&operations=10000`);
  await until(page, () => window.cairnWeb.state().step > 130);
  await page.screenshot({ path: file('desktop.png') });
  await until(page, () => window.cairnWeb.state().step > 400);
  await page.screenshot({ path: file('desktop-later.png') });
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

async function checkPhone(browser, address) {
  const options = { viewport: { width: 400, height: 840 }, deviceScaleFactor: 1, hasTouch: true, colorScheme: 'dark', reducedMotion: 'reduce' };
  const page = await openPage(browser, `${address}${kSmall}&operations=2000`, options);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 400);
  const boxes = await page.$$eval('button, input, select, h1, .chart', (list) => list.filter((e) => e.checkVisibility()).map((e) => ({ id: e.id, ...e.getBoundingClientRect().toJSON() })));
  for (const box of boxes) {
    assert.ok(box.left >= 0 && box.right <= 400, JSON.stringify(box));
    if (!['', 'time-chart', 'work-chart'].includes(box.id)) assert.ok(box.height >= 34, `${box.id} is large enough for a finger: ${box.height}`);
  }
  await until(page, () => window.cairnWeb.state().asleep === 10);
  const { body, x, y } = await bodyToTake(page);
  const [, low] = placeOf(await state(page), body);
  const touch = (type, at) => page.dispatchEvent('#picture', type, { pointerId: 7, pointerType: 'touch', isPrimary: true, button: 0, buttons: 1, clientX: at.x, clientY: at.y, bubbles: true });
  await touch('pointerdown', { x, y });
  await touch('pointermove', { x, y: y - 120 });
  await until(page, ([b, h]) => window.cairnWeb.state().poses[7 * b + 1] > h + 0.2, body, low);
  await page.screenshot({ path: file('phone.png') });
  await touch('pointerup', { x, y: y - 120 });
  assert.equal((await state(page)).held, null);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// A server without headers for isolation, and in a folder of its address, does as well.
async function checkPlainServer(browser) {
  const server = await serve(join(built, '..'), false);
  const page = await openPage(browser, `${server.address}page/${kSmall}`);
  assert.equal(await page.evaluate(() => window.crossOriginIsolated), false);
  await until(page, () => window.cairnWeb.state().step > 30);
  assert.deepEqual(page.faults, []);
  await page.context().close();
  server.close();
}

const server = await serve(built);
const browser = await launch(packages);
try {
  for (const check of [checkRest, checkBudget, checkEngines, checkMissingEngine, checkMissingFile, checkLateFrame, checkNoWebGl, checkHand, checkReplay, checkTabs, checkDesktop, checkPhone, checkPlainServer]) {
    if (wanted.length > 0 && !wanted.includes(check.name)) continue;
    const start = performance.now();
    await check(browser, server.address);
    console.log(`${check.name}: passed in ${((performance.now() - start) / 1000).toFixed(1)} s`);
  }
} finally {
  await browser.close();
  server.close();
}
