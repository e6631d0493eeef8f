// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pages of `cairn view` for a robot, opened and used in Chromium; judged by kinematics from the URDF's text.
//   node robot_page_test.mjs CAIRN PACKAGES FOLDER [CHECK...]
// PACKAGES holds node_modules; pages and pictures of them are left in FOLDER.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { writeArm } from './arm_files.mjs';
import { cairn, colorsOf, launch, openPage, placeOf, settled, skip, state } from './browser.mjs';
import { overlapsAt, pairName, posesOf, robotOf, spheresAt } from './robot_truth.mjs';
import { seenFrom } from './tree_truth.mjs';

const [program, packages, folder, ...wanted] = process.argv.slice(2);
if (!packages || !existsSync(join(packages, 'node_modules/playwright-core')))
  skip('this build has no viewer, or not the packages of its test: node and npm are needed when Cairn is configured');

const file = (name) => join(folder, name);
const kMeshes = ['--package-path', `arm=${folder}`];
const kFit = ['--spheres', '8', ...kMeshes];

/// Spheres as `cairn robot` writes them, and pairs that always meet as it reports them.
function fitted(urdf, output) {
  const report = JSON.parse(cairn(program, 'robot', urdf, '-o', output, '--primitives', '--json', '-', ...kFit));
  return { report, robot: robotOf(readFileSync(output, 'utf8')), always: report.self_collision.always.map((pair) => pairName(...pair)) };
}

const urdf = writeArm(folder);
const truth = fitted(urdf, file('arm_spheres.urdf'));
const rest = Object.fromEntries(truth.robot.active.map(({ name, lower, upper }) => [name, Math.min(Math.max(0, lower), upper)]));
const slider = (name) => `input[data-joint="${name}"]`;

/// Joint positions of which some fold the arm into itself, and one is the position of rest.
const kPoses = [
  {},
  { lift: 2.1, bend: 2.2 },
  { turn: -2.5, lift: -0.8, bend: 2.35, spin: 1.2 },
  { turn: 1.1, lift: 0.4, bend: -2.7, grip: 0.03 },
  { turn: 2.9, lift: 1.9, bend: 1, spin: -3, grip: 0.02 },
].map((pose) => ({ ...rest, ...pose }));

const kPixel = 0.004; // metres: two pixels of the picture, which shows some 1.4 m in 600

const seen = (eye, spheres, pixel = kPixel) => seenFrom(eye, { spheres }, [...spheres.keys()], pixel);

async function moveTo(page, pose) {
  for (const [name, position] of Object.entries(pose)) await page.fill(slider(name), String(position));
  await page.click('#frame'); // or the arm would reach out of the picture
  await settled(page);
}

async function checkSliders(page) {
  const rows = await page.$$eval('#joints input', (list) => list.map((e) => ({ name: e.dataset.joint, label: e.labels[0].textContent, lower: Number(e.min), upper: Number(e.max), value: Number(e.value) })));
  assert.deepEqual(rows, truth.robot.active.map(({ name, lower, upper }) => ({ name, label: name, lower, upper, value: rest[name] })));
  const texts = await page.$$eval('#joints .joint', (list) => list.map((e) => e.innerText.split(/\s+/).join(' ')));
  assert.deepEqual(texts, ['turn 0° −170 170', 'lift 0° −103.1 131.8', 'bend 0° −160.4 137.5', 'spin 0° −180 180', 'grip 4 mm 4 36 moves grip_right too']);
}

/// Poses of links equal those of the text, to rounding: a few joints, lengths below a metre.
async function checkPoses(page, pose) {
  const { poses, joints } = await state(page);
  for (const { name } of truth.robot.active) assert.equal(joints[name], pose[name]);
  assert.equal(joints.grip_right, pose.grip + 0.001);
  const expected = posesOf(truth.robot, pose);
  assert.deepEqual(Object.keys(poses).sort(), Object.keys(expected).sort());
  for (const [name, { rotation, translation }] of Object.entries(poses))
    for (let k = 0; k < 3; ++k) {
      assert.ok(Math.abs(translation[k] - expected[name][k][3]) < 1e-12, `${name} is where its joints lead`);
      for (let j = 0; j < 3; ++j) assert.ok(Math.abs(rotation[3 * k + j] - expected[name][k][j]) < 1e-12, `${name} is turned`);
    }
}

/// Every sphere that the text lets the eye see is drawn there, red exactly where its link overlaps. Returns how many
/// were red and how many not.
async function checkRed(page, pose) {
  const { pairs, closest } = overlapsAt(truth.robot, pose, truth.always);
  assert.ok(closest > 1e-6, `no pair is so near to touching that rounding decides: ${closest}`);
  const { overlaps, eye } = await state(page);
  assert.deepEqual(overlaps.map((pair) => pairName(...pair)).sort(), pairs);
  const notice = await page.textContent('#overlaps');
  assert.equal(notice.startsWith('No links'), pairs.length === 0, notice);
  for (const [a, b] of overlaps.slice(0, 3)) assert.ok(notice.includes(`${a} and ${b}`), notice);
  const spheres = spheresAt(truth.robot, pose);
  const nodes = seen(eye, spheres);
  const places = await page.evaluate((list) => list.map((node) => window.cairnView.placeOf(node)), nodes);
  const drawn = await page.evaluate((list) => list.map(({ x, y }) => window.cairnView.drawnAt(x, y)), places);
  assert.deepEqual(drawn, nodes, 'spheres are drawn where the text has them');
  const colors = await colorsOf(page);
  const counts = { red: 0, other: 0 };
  nodes.forEach((node, k) => {
    const [red, green, blue] = colors(places[k].x, places[k].y);
    const isRed = red - green > 0.33 * red && red - blue > 0.33 * red; // the yellow end of the scale has 0.2 and 0.7
    const overlaps = pairs.some((pair) => pair.split(' & ').includes(spheres[node].link));
    assert.equal(isRed, overlaps, `sphere ${node} of ${spheres[node].link}: ${[red, green, blue]}`);
    ++counts[isRed ? 'red' : 'other'];
  });
  return counts;
}

/// Meshes are where their spheres are: middles of spheres of slim links lie in the mesh.
async function checkMeshes(page, pose) {
  const spheres = spheresAt(truth.robot, pose);
  const slim = [...spheres.keys()].filter((node) => ['upper_arm', 'forearm', 'finger_left', 'finger_right'].includes(spheres[node].link));
  const places = await Promise.all(slim.map((node) => placeOf(page, node)));
  const withMesh = await colorsOf(page);
  await page.click('#show-mesh');
  const without = await colorsOf(page);
  await page.click('#show-mesh');
  places.forEach(({ x, y }, k) => {
    const difference = Math.hypot(...withMesh(x, y).map((c, i) => c - without(x, y)[i]));
    assert.ok(difference > 30, `the mesh of ${spheres[slim[k]].link} covers the middle of its sphere ${slim[k]}: ${difference}`);
  });
}

async function checkMotion(page) {
  const sums = { red: 0, other: 0, overlapping: 0 };
  for (const pose of kPoses) {
    await moveTo(page, pose);
    await checkPoses(page, pose);
    await page.click('#show-mesh');
    await settled(page);
    const { red, other } = await checkRed(page, pose);
    await page.click('#show-mesh');
    if (pose.grip !== rest.grip) {
      await page.click('#show-spheres');
      await checkMeshes(page, pose);
      await page.click('#show-spheres');
    }
    sums.red += red;
    sums.other += other;
    sums.overlapping += red > 0 ? 1 : 0;
  }
  console.log(`motion: ${kPoses.length} poses, ${sums.overlapping} with overlaps; ${sums.red} spheres seen red, ${sums.other} not`);
  assert.ok(sums.red >= 15 && sums.other >= 40 && sums.overlapping >= 3 && sums.overlapping < kPoses.length);
  await page.screenshot({ path: file('robot_overlap.png') });
}

/// Numbers from 0 to 1 that a seed decides (Mulberry32).
function randomOf(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/// In any pose, links are where the text has them, and exactly those that overlap are told.
async function checkRandomPoses(page) {
  const seed = Number(process.env.CAIRN_SEED ?? Date.now() % 1e6);
  console.log(`random poses: CAIRN_SEED=${seed}`);
  const random = randomOf(seed);
  const met = new Set();
  for (let i = 0; i < 60; ++i) {
    // Few digits, which a slider keeps.
    const within = ({ lower, upper }) => Math.trunc(1e4 * (lower + random() * (upper - lower))) / 1e4;
    const pose = Object.fromEntries(truth.robot.active.map((joint) => [joint.name, within(joint)]));
    await page.evaluate((positions) => {
      for (const e of document.querySelectorAll('#joints input')) {
        e.value = positions[e.dataset.joint];
        e.dispatchEvent(new Event('input'));
      }
    }, pose);
    await checkPoses(page, pose);
    const { pairs, closest } = overlapsAt(truth.robot, pose, truth.always);
    if (closest < 1e-6) continue; // rounding decides
    assert.deepEqual((await state(page)).overlaps.map((pair) => pairName(...pair)).sort(), pairs, JSON.stringify(pose));
    pairs.forEach((pair) => met.add(pair));
  }
  assert.ok(met.size >= 3, `pairs that met: ${[...met]}`);
}

async function detailsOf(page) {
  const rows = await page.$$eval('#details div', (list) => list.map((row) => [row.children[0].textContent, row.children[1].textContent]));
  return Object.fromEntries(rows);
}

const near = (text, value) => assert.ok(Math.abs(parseFloat(text) - 1000 * value) <= 6e-3 * 1000 * value, `${text} is ${1000 * value} mm`);

async function checkClicks(page) {
  await page.keyboard.press('r');
  await page.keyboard.press('f');
  await settled(page);
  const spheres = spheresAt(truth.robot, rest);
  const { eye } = await state(page);
  const links = new Set();
  for (const node of seen(eye, spheres)) {
    const { link, radius } = spheres[node];
    if (links.has(link)) continue;
    links.add(link);
    const { x, y } = await placeOf(page, node);
    await page.mouse.click(x, y);
    assert.equal((await state(page)).chosen, node);
    const said = await detailsOf(page);
    assert.equal(said.Link, link);
    near(said.Radius, radius);
    const { certified_sticks_out_m: most } = truth.report.links.find((l) => l.link === link);
    const isGiven = said['Certified error'].startsWith('none');
    assert.equal(isGiven, link === 'wrist' && radius === 0.03, `of sphere ${node} of ${link}: ${said['Certified error']}`);
    if (!isGiven) assert.ok(parseFloat(said['Certified error']) <= 1006 * most, `${said['Certified error']} of ${link}, at most ${1000 * most} mm`);
    await settled(page);
    assert.equal(await page.textContent('#chosen-label:not([hidden])'), link);
    const top = await page.$eval('#selection', (e) => e.getBoundingClientRect().top);
    assert.ok(top >= 0 && top < 600, `what is said of the sphere is in view, at ${top}`);
    await page.keyboard.press('Escape');
  }
  assert.ok(links.size >= 5, `links that were clicked: ${[...links]}`);
  await page.keyboard.press('w');
  const worst = await detailsOf(page);
  const errors = truth.report.links.map((l) => l.certified_sticks_out_m ?? 0);
  near(worst['Certified error'], Math.max(...errors));
  assert.equal(worst.Link, truth.report.links[errors.indexOf(Math.max(...errors))].link);
  await page.screenshot({ path: file('robot_chosen.png') });
  await page.keyboard.press('Escape');
}

async function checkKeys(page) {
  await page.evaluate(() => document.activeElement.blur());
  const visited = [];
  for (;;) {
    await page.keyboard.press('Tab');
    const id = await page.evaluate(() => document.activeElement.id);
    if (visited.includes(id) || id === '' || visited.length > 30) break;
    visited.push(id);
  }
  const sliders = truth.robot.active.map((_, k) => `joint-${k}`);
  assert.deepEqual(visited, ['picture', 'rest', ...sliders, 'worst', 'show-mesh', 'show-spheres', 'show-edges', 'frame', 'up']);
  const degrees = async (joint) => ((await state(page)).joints[joint] * 180) / Math.PI;
  await page.focus(slider('turn'));
  for (const [key, expected] of [['ArrowRight', 1], ['ArrowUp', 2], ['PageUp', 12], ['ArrowLeft', 11], ['PageDown', 1], ['ArrowDown', 0]]) {
    await page.keyboard.press(key);
    assert.ok(Math.abs((await degrees('turn')) - expected) < 1e-9, `${key} leads to ${expected} degrees`);
  }
  await page.keyboard.press('End');
  assert.equal((await state(page)).joints.turn, 2.9671);
  await page.keyboard.press('ArrowRight');
  assert.equal((await state(page)).joints.turn, 2.9671, 'limits hold');
  assert.equal(await page.getAttribute(slider('turn'), 'aria-valuetext'), '170 degrees');
  await page.keyboard.press('ArrowLeft');
  assert.ok(Math.abs((await degrees('turn')) - 170) < 1e-9, 'a key leads to whole degrees');
  await page.focus(slider('grip'));
  await page.keyboard.press('PageUp');
  assert.ok(Math.abs((await state(page)).joints.grip - 0.005) < 1e-12, 'a page is ten steps of a tenth of a millimetre');
  await page.keyboard.press('s');
  assert.equal((await state(page)).instances, 0, 'letters work beside the sliders');
  await page.keyboard.press('s');
  await page.keyboard.press('r');
  assert.deepEqual((await state(page)).joints, { stand: 0, hold: 0, ...rest, grip_right: rest.grip + 0.001 });
}

async function checkRobot(browser) {
  const page = await openPage(browser, file('robot.html'), { colorScheme: 'dark', reducedMotion: 'reduce' }); // a mesh is unlike the ground
  await page.screenshot({ path: file('robot.png') });
  assert.equal(await page.textContent('h1'), 'small arm');
  assert.match(await page.textContent('#facts'), /^9 links · 8 joints · 65 spheres · /);
  assert.ok(await page.isVisible('#plain'), 'the wrist has a sphere of its own');
  await checkSliders(page);
  await checkKeys(page);
  await checkMotion(page);
  await checkRandomPoses(page);
  await checkClicks(page);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

async function checkPhone(browser) {
  const options = { viewport: { width: 400, height: 800 }, deviceScaleFactor: 1, hasTouch: true, reducedMotion: 'reduce' };
  const page = await openPage(browser, file('robot.html'), options);
  await page.screenshot({ path: file('robot_phone.png') });
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 400);
  const boxes = await page.$$eval('button, input, h1, label, output, #overlaps', (list) => list.filter((e) => e.checkVisibility()).map((e) => e.getBoundingClientRect().toJSON()));
  assert.ok(boxes.length > 20);
  for (const box of boxes) assert.ok(box.left >= 0 && box.right <= 400, JSON.stringify(box));
  const box = await (await page.$(slider('lift'))).boundingBox();
  await page.touchscreen.tap(box.x + 0.8 * box.width, box.y + box.height / 2);
  const { lift } = (await state(page)).joints;
  assert.ok(lift > 1 && lift < 2, `a tap at four fifths of the slider moves the joint there: ${lift}`);
  await page.keyboard.press('r');
  await settled(page);
  const spheres = spheresAt(truth.robot, rest);
  const [node] = seen((await state(page)).eye, spheres, 2 * kPixel);
  const { x, y } = await placeOf(page, node);
  await page.touchscreen.tap(x, y);
  assert.equal((await state(page)).chosen, node);
  assert.equal((await detailsOf(page)).Link, spheres[node].link);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Spheres that stand in the URDF have no certified error, and the page says so.
async function checkGiven(browser) {
  cairn(program, 'view', file('arm_spheres.urdf'), '-o', file('given.html'));
  const { always } = fitted(file('arm_spheres.urdf'), file('again.urdf'));
  const page = await openPage(browser, file('given.html'), { reducedMotion: 'reduce' });
  assert.equal((await state(page)).instances, 65);
  assert.ok(!(await page.isVisible('#legend')) && !(await page.isVisible('#worst')));
  assert.match(await page.textContent('#plain'), /nothing is certified/);
  assert.ok(!(await page.isVisible('#show-mesh')), 'without a mesh, no switch for it');
  for (const pose of kPoses.slice(0, 3)) {
    await moveTo(page, pose);
    const { overlaps } = await state(page);
    assert.deepEqual(overlaps.map((pair) => pairName(...pair)).sort(), overlapsAt(truth.robot, pose, always).pairs);
  }
  await page.keyboard.press('w');
  assert.equal((await state(page)).chosen, null, 'no sphere is the worst');
  await page.screenshot({ path: file('robot_given.png') });
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

/// Without --spheres there are meshes alone, and the spheres that the URDF has.
async function checkMeshesAlone(browser) {
  cairn(program, 'view', urdf, '-o', file('meshes.html'), ...kMeshes);
  const page = await openPage(browser, file('meshes.html'));
  assert.equal((await state(page)).instances, 1);
  await moveTo(page, kPoses[1]);
  await checkPoses(page, kPoses[1]);
  assert.deepEqual((await state(page)).overlaps, []);
  assert.deepEqual(page.faults, []);
  await page.context().close();
}

const browser = await launch(packages);
try {
  cairn(program, 'view', urdf, '-o', file('robot.html'), ...kFit);
  for (const check of [checkRobot, checkPhone, checkGiven, checkMeshesAlone]) {
    if (wanted.length > 0 && !wanted.includes(check.name)) continue;
    const start = performance.now();
    await check(browser);
    console.log(`${check.name}: passed in ${((performance.now() - start) / 1000).toFixed(1)} s`);
  }
} finally {
  await browser.close();
}
