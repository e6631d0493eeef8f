// SPDX-License-Identifier: GPL-3.0-or-later

/// Colours of certified errors at equal steps from 0 to the greatest: those of the plugin's debug drawing. Lightness
/// rises steadily, so that everyone can read the scale.
export const kErrorColors = [
  [0.29, 0.36, 0.72],
  [0.2, 0.52, 0.74],
  [0.2, 0.66, 0.63],
  [0.47, 0.77, 0.47],
  [0.82, 0.84, 0.34],
  [0.99, 0.8, 0.26],
];

/// Spheres that touch another link's; the other spheres of such links; spheres without a certified error. None is near
/// the scale's.
export const kAlarmColor = [0.86, 0.16, 0.13];
export const kAlarmLinkColor = [0.93, 0.5, 0.45];
export const kPlainColor = [0.62, 0.63, 0.68];

/// The colour at a share of the scale, as sRGB from 0 to 1.
export function errorColor(share) {
  const at = Math.min(Math.max(share, 0), 1) * (kErrorColors.length - 1);
  const i = Math.min(Math.floor(at), kErrorColors.length - 2);
  return kErrorColors[i].map((c, k) => c + (at - i) * (kErrorColors[i + 1][k] - c));
}

export function cssColor(rgb) {
  return `rgb(${rgb.map((c) => Math.round(255 * c)).join(' ')})`;
}

/// A length in few digits: three that count, without an exponent where one can do without.
export function lengthText(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e6) return value.toExponential(2);
  return String(Number(value.toPrecision(3)));
}

export function percentText(share) {
  const percent = 100 * share;
  if (percent === 0) return '0 %';
  return `${percent >= 100 ? Math.round(percent) : Number(percent.toPrecision(2))} %`;
}

export function countText(count) {
  return count.toLocaleString('en-GB');
}
