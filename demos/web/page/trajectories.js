// SPDX-License-Identifier: GPL-3.0-or-later
//
// Trajectories of rocks, as `rockfall merge` writes them: trajectories.vtk, or trajectories.geojson, which has only durations.

import { greatest, kFarthest, kLongest, least } from './bounds.js';

const kMaxPoints = 2e6;
const kDefaultSize = 0.5; // m, where the file does not tell how large a rock is
const kDefaultStep = 0.1; // s between places, where a GeoJSON has no durations

const refuse = (what) => {
  throw new Error(`These are no trajectories that can be shown: ${what}.`);
};

const isPlace = (place) => Array.isArray(place) && place.length >= 2 && place.slice(0, 3).every(Number.isFinite);

function linesOf(feature) {
  const { type, coordinates } = feature?.geometry ?? {};
  if (type === 'LineString') return [coordinates];
  if (type === 'MultiLineString') return coordinates;
  return [];
}

/// The time between two places. rockfall samples all rocks at equal steps until they lie still, and tells how long each took
/// until it slept; the rock that moved longest of its time tells the step best.
function stepOf(found) {
  const steps = found.flatMap(({ places, duration }) => (duration > 0 ? [duration / (places.length - 1)] : []));
  return steps.length > 0 ? least(steps) : kDefaultStep;
}

export function tracksOfGeoJson(text) {
  let data;
  try {
    data = JSON.parse(text);
  } catch {
    refuse('the file is not JSON');
  }
  const features = Array.isArray(data?.features) ? data.features : refuse('the file has no list of features');
  const found = [];
  for (const feature of features) {
    for (const line of linesOf(feature)) {
      if (!Array.isArray(line) || !line.every(isPlace)) refuse('a line has a place that is no number');
      if (line.length < 2) continue;
      const places = line.map(([x, y, z = 0]) => [x, y, z]);
      const { time_s: duration, sieve_m: size } = feature.properties ?? {};
      found.push({ places, duration, size: size > 0 ? size : kDefaultSize });
    }
  }
  const step = stepOf(found);
  return checked(found.map(({ places, size }) => ({ places, size, times: places.map((_, k) => k * step) })));
}

/// The numbers after a heading of legacy VTK, up to the next letter.
function numbersAfter(text, heading) {
  const found = text.match(heading);
  if (!found) refuse(`the VTK file has no ${heading.source.split('\\')[0].replace('^', '')}`);
  const rest = text.slice(found.index + found[0].length);
  const end = rest.search(/[A-DF-Za-df-z]/); // E and e belong to numbers
  const numbers = (end < 0 ? rest : rest.slice(0, end)).trim().split(/\s+/).map(Number);
  if (!numbers.every(Number.isFinite)) refuse('the VTK file has a word where a number belongs');
  return numbers;
}

export function tracksOfVtk(text) {
  if (!/^# vtk DataFile/.test(text) || !/\nASCII\s/.test(text)) refuse('the file is no legacy VTK in ASCII');
  const points = numbersAfter(text, /^POINTS\s+\d+\s+\w+/m);
  const lines = numbersAfter(text, /^LINES\s+\d+\s+\d+/m);
  const times = numbersAfter(text, /^SCALARS time_s \w+ 1\s+LOOKUP_TABLE default/m);
  const tracks = [];
  for (let at = 0; at < lines.length; at += 1 + lines[at]) {
    const own = lines.slice(at + 1, at + 1 + lines[at]);
    if (!(lines[at] >= 1) || own.length !== lines[at] || own.some((k) => !(k >= 0 && 3 * k + 2 < points.length && k < times.length))) refuse('a line of the VTK file leads nowhere');
    if (own.length < 2) continue;
    const start = times[own[0]];
    tracks.push({ places: own.map((k) => points.slice(3 * k, 3 * k + 3)), times: own.map((k) => times[k] - start), size: kDefaultSize });
  }
  return checked(tracks);
}

function checked(tracks) {
  if (tracks.length === 0) refuse('the file has no line of two places or more');
  if (tracks.reduce((sum, { places }) => sum + places.length, 0) > kMaxPoints) refuse(`there are more than ${kMaxPoints} places`);
  for (const { times } of tracks) times.forEach((time, k) => (k === 0 || time >= times[k - 1]) || refuse('times of a line do not rise'));
  // Maps lie far from zero; the picture is drawn around the first place, with z of the map as its height.
  const [ox, oy, oz] = tracks[0].places[0];
  for (const track of tracks) track.places = track.places.map(([x, y, z]) => [x - ox, z - oz, oy - y]);
  const isFar = (place) => place.some((c) => !(Math.abs(c) <= kFarthest));
  if (tracks.some(({ places }) => places.some(isFar))) refuse('a place is farther than 1000 km from the first');
  const duration = greatest(tracks, ({ times }) => times.at(-1));
  if (!(duration <= kLongest)) refuse('a line takes longer than a day');
  return { kind: 'tracks', tracks, duration };
}

/// Where a rock is at a time: before the start at the start, after the end at the end.
export function placeAt({ places, times }, time) {
  if (time >= times.at(-1)) return places.at(-1);
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  const share = times[high] > times[low] ? Math.max(0, time - times[low]) / (times[high] - times[low]) : 0;
  return places[low].map((c, k) => c + share * (places[high][k] - c));
}
