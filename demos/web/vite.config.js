// SPDX-License-Identifier: GPL-3.0-or-later
//
// Builds page/ into a folder that any web server serves.
//   CAIRN_PACKAGE: the folder of the package cairn-collision; CAIRN_WEB: where `public/models` is, and `page` is written.
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

const root = fileURLToPath(new URL('../..', import.meta.url));
const web = resolve(root, process.env.CAIRN_WEB ?? 'out/web');
const cairn = resolve(root, process.env.CAIRN_PACKAGE ?? 'out/wasm/cairn-collision');

// Isolated pages get clocks of 5 microseconds instead of 100; budgets of time are kept better. Other servers do without.
const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

const checks = { pluginTimings: false }; // says nothing about the page

export default defineConfig({
  root: fileURLToPath(new URL('page', import.meta.url)),
  base: './',
  publicDir: join(web, 'public'),
  resolve: { alias: { 'cairn-collision': join(cairn, 'cairn.mjs') } },
  worker: { format: 'es', rolldownOptions: { checks } },
  build: { rolldownOptions: { checks }, outDir: join(web, 'page'), emptyOutDir: true, target: 'es2022', chunkSizeWarningLimit: 10000, reportCompressedSize: false },
  preview: { headers, host: '127.0.0.1' },
});
