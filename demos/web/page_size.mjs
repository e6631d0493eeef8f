// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints what of a built page a browser loads, and when.
//   node page_size.mjs FOLDER
import { readdirSync, statSync } from 'node:fs';
import { join, relative } from 'node:path';

const [folder] = process.argv.slice(2);
// Chunks that two engines share are small and belong to the page.
const kParts = [
  ['Rapier, when chosen', /^assets\/rapier/],
  ['Jolt, when chosen', /^assets\/jolt/],
  ['Havok, when chosen', /^assets\/havok/i],
  ['Cairn', /^assets\/cairn/],
  ['models', /^models\//],
  ['page, with three.js', /./],
];

const sizes = new Map(kParts.map(([name]) => [name, 0]));
for (const entry of readdirSync(folder, { recursive: true, withFileTypes: true })) {
  if (!entry.isFile()) continue;
  const file = join(entry.parentPath ?? entry.path, entry.name);
  const [name] = kParts.find(([, pattern]) => pattern.test(relative(folder, file)));
  sizes.set(name, sizes.get(name) + statSync(file).size);
}
for (const [name, bytes] of sizes) console.log(`  ${name.padEnd(24)} ${(bytes / 1e6).toFixed(2).padStart(6)} MB`);
const whole = sizes.get('page, with three.js') + sizes.get('Cairn');
console.log(`  page without models and rivals: ${(whole / 1e6).toFixed(2)} MB`);
