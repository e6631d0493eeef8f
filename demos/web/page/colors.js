// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours of certified errors, and those of the style sheet.

// The scale of Cairn's debug drawing: lightness rises steadily, so that everyone can read it.
const kErrorColors = [
  [0.29, 0.36, 0.72],
  [0.2, 0.52, 0.74],
  [0.2, 0.66, 0.63],
  [0.47, 0.77, 0.47],
  [0.82, 0.84, 0.34],
  [0.99, 0.8, 0.26],
];

/// Errors of this share of a body's size, and greater ones, have the last colour.
export const kGreatestShown = 0.05;

/// The colour at a share of the scale, as sRGB from 0 to 1.
export function errorColor(share) {
  const at = Math.min(Math.max(share, 0), 1) * (kErrorColors.length - 1);
  const i = Math.min(Math.floor(at), kErrorColors.length - 2);
  return kErrorColors[i].map((c, k) => c + (at - i) * (kErrorColors[i + 1][k] - c));
}

export const cssColor = (rgb) => `rgb(${rgb.map((c) => Math.round(255 * c)).join(' ')})`;

export const errorGradient = () => `linear-gradient(to right, ${kErrorColors.map(cssColor).join(', ')})`;

export const themeColor = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

export function onThemeChange(callback) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', callback);
}

/// Muted colours that bodies take in turn.
export const kBodyColors = ['#c9b79c', '#a9b8c4', '#b7a5b4', '#b3bda0', '#cfa893', '#9fb3ae'];
