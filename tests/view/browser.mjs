// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chromium without a screen, drawing by SwiftShader, and what a test asks of it.
import { execFileSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const kSkipped = 77; // the exit code by which ctest knows a skipped test

export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(kSkipped);
}

function chromiumPath() {
  const paths = [process.env.CAIRN_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
  return paths.find((path) => path && existsSync(path)) ?? skip('Chromium is not installed (Debian: chromium)');
}

/// A browser, from the packages of the viewer.
export async function launch(packages) {
  const { chromium } = createRequire(join(packages, 'package.json'))('playwright-core');
  return chromium.launch({
    executablePath: chromiumPath(),
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
    timeout: 120000,
  });
}

/// Opens a page and waits until its picture is done. `faults` collects whatever must not happen: errors on the console
/// and requests.
export async function openPage(browser, file, options = {}) {
  const context = await browser.newContext({ viewport: { width: 960, height: 600 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(120000);
  page.faults = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) page.faults.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => page.faults.push(`script: ${error.message}`));
  page.on('request', (request) => {
    const url = request.url();
    if (url !== `file://${encodeURI(file)}` && !url.startsWith('data:')) page.faults.push(`request: ${url.slice(0, 200)}`);
  });
  await page.goto(`file://${encodeURI(file)}`);
  await settled(page);
  return page;
}

export const state = (page) => page.evaluate(() => window.cairnView.state());
export const settled = (page) => page.evaluate(() => window.cairnView.settled());
export const placeOf = (page, node) => page.evaluate((n) => window.cairnView.placeOf(n), node);

/// The colours of the page as one sees it: a function from a place in CSS pixels to red, green and blue.
export async function colorsOf(page) {
  await settled(page);
  const png = (await page.screenshot()).toString('base64');
  // Decoded in a page of its own: the one under test forbids what it does not need.
  const blank = await page.context().newPage();
  const { width, data } = await blank.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const drawing = canvas.getContext('2d');
    drawing.drawImage(bitmap, 0, 0);
    const pixels = drawing.getImageData(0, 0, bitmap.width, bitmap.height).data;
    let text = '';
    for (let at = 0; at < pixels.length; at += 0x8000) text += String.fromCharCode(...pixels.subarray(at, at + 0x8000));
    return { width: bitmap.width, data: btoa(text) };
  }, png);
  await blank.close();
  const pixels = Buffer.from(data, 'base64');
  return (x, y) => [...pixels.subarray(4 * (Math.round(y) * width + Math.round(x)), 4 * (Math.round(y) * width + Math.round(x)) + 3)];
}

/// Runs `cairn`; returns what it printed.
export function cairn(program, ...args) {
  return execFileSync(program, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
}
