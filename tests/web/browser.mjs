// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built page on a server of its own, in Chromium without a screen.
import { existsSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize, resolve } from 'node:path';

const kSkipped = 77; // the exit code by which ctest knows a skipped test
const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.json': 'application/json' };

export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(kSkipped);
}

/// Serves a folder; `isIsolated` gives the headers by which browsers grant finer clocks. Returns address and `close`.
export async function serve(folder, isIsolated = true) {
  const headers = isIsolated ? { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' } : {};
  const server = createServer(async ({ url, method }, answer) => {
    const path = normalize(decodeURIComponent(new URL(url, 'http://x').pathname));
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    try {
      const bytes = await readFile(file);
      answer.writeHead(200, { ...headers, 'Content-Type': kTypes[extname(file)] ?? 'application/octet-stream' });
      answer.end(method === 'HEAD' ? undefined : bytes);
    } catch {
      answer.writeHead(404, headers);
      answer.end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/// A browser, driven by the packages of the page.
export async function launch(packages) {
  if (!existsSync(join(packages, 'node_modules/playwright-core'))) skip('the packages of the page are not installed: ./cairn.sh web --build');
  const { chromium } = createRequire(join(resolve(packages), 'package.json'))('playwright-core');
  const paths = [process.env.CAIRN_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
  const executablePath = paths.find((path) => path && existsSync(path)) ?? skip('Chromium is not installed (Debian: chromium)');
  const args = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
  return chromium.launch({ executablePath, args, timeout: 120000 });
}

/// Opens a page. `faults` collects whatever must not happen: errors and warnings on the console.
export async function openPage(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 800 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(120000);
  page.faults = [];
  page.on('console', (message) => {
    // How SwiftShader reads pixels back is slow, and it says so; only measurements do it.
    if (message.text().includes('GPU stall due to ReadPixels')) return;
    if (['error', 'warning'].includes(message.type())) page.faults.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => page.faults.push(`script: ${error.message}`));
  page.on('requestfailed', (request) => page.faults.push(`request: ${request.url().slice(0, 200)}`));
  await page.goto(address);
  await page.waitForFunction(() => window.cairnWeb?.state().step > 0 || document.querySelector('#refusal:not([hidden])'));
  return page;
}

export const state = (page) => page.evaluate(() => window.cairnWeb.state());
