// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a scene costs in headless Chromium, physics and drawing told apart, as a table in Markdown.
//   node measure.mjs PAGE PACKAGES [BODIES] [SECONDS] [ROW...]
// Times are of a clock: whatever else the machine does, and the threads that draw, take from them.
import { loadavg } from 'node:os';
import { launch, openPage, serve } from './browser.mjs';

const [built, packages, bodies = '300', seconds = '10', ...wanted] = process.argv.slice(2);
const kRows = [
  ['Cairn, 5 ms', 'engine=cairn&microseconds=5000', true],
  ['Cairn, 5 ms, not drawn', 'engine=cairn&microseconds=5000', false],
  ['Cairn, 60,000 operations, not drawn', 'engine=cairn&microseconds=0&operations=60000', false],
  ['Cairn, no budget, not drawn', 'engine=cairn&microseconds=0', false],
  ['Rapier, meshes, not drawn', 'engine=rapier', false],
  ['Rapier, convex parts, not drawn', 'engine=rapier-parts', false],
  ['Jolt, convex parts, not drawn', 'engine=jolt', false],
  ['Havok, meshes, not drawn', 'engine=havok', false],
];

const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(share * values.length))];
const cell = (values) => (values.length === 0 ? '–' : `${quantile(values, 0.5).toFixed(1)} / ${quantile(values, 0.99).toFixed(1)}`);

/// Drops the bodies and looks on for some seconds; an engine that is slower than time gets through fewer steps.
async function measured(browser, address, query, isDrawn) {
  const page = await openPage(browser, `${address}?bodies=${bodies}&${query}`);
  const found = await page.evaluate(async ([time, drawn]) => {
    const { cairnWeb: web } = window;
    web.isDrawing = drawn;
    await web.drop();
    while (!web.link_.isCurrent) await new Promise((done) => setTimeout(done, 5)); // until the world stands
    return web.measure(time);
  }, [Number(seconds), isDrawn]);
  await page.context().close();
  return found;
}

const server = await serve(built);
const browser = await launch(packages);
try {
  console.log(`${bodies} concave bodies dropped, ${seconds} s; milliseconds: median / 99 %; load of the machine before: ${loadavg()[0].toFixed(1)}\n`);
  console.log('| engine | steps | whole step | after a second | narrow phase | drawing a picture | between pictures |\n| --- | --: | --: | --: | --: | --: | --: |');
  for (const [row, [name, query, isDrawn]] of kRows.entries()) {
    if (wanted.length > 0 && !wanted.includes(String(row))) continue;
    const { steps, drawings, frames } = await measured(browser, server.address, query, isDrawn);
    const narrow = steps.flatMap(({ narrowPhaseMs }) => (narrowPhaseMs === null ? [] : [narrowPhaseMs]));
    // Browsers compile WebAssembly anew while its first second runs.
    const later = steps.filter(({ step }) => step > 60);
    const cells = [steps.length, cell(steps.map(({ stepMs }) => stepMs)), cell(later.map(({ stepMs }) => stepMs)), cell(narrow), cell(drawings), isDrawn ? cell(frames) : '–'];
    console.log(`| ${[name, ...cells].join(' | ')} |`);
  }
} finally {
  await browser.close();
  server.close();
}
