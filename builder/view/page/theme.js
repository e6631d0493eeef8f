// SPDX-License-Identifier: GPL-3.0-or-later
//
// The colours of the picture, as the style sheet has them for light and dark.

function rgbOf(style, name) {
  const digits = style.getPropertyValue(name).trim().slice(1);
  return [0, 2, 4].map((at) => parseInt(digits.slice(at, at + 2), 16) / 255);
}

export function themeColors() {
  const style = getComputedStyle(document.documentElement);
  const names = ['above', 'below', 'stone', 'mark', 'wire', 'ring', 'parent'];
  return Object.fromEntries(names.map((name) => [name, rgbOf(style, `--${name}`)]));
}

/// Calls back when the system changes between light and dark.
export function onThemeChange(callback) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', callback);
}

export function wantsLittleMotion() {
  return matchMedia('(prefers-reduced-motion: reduce)').matches;
}
