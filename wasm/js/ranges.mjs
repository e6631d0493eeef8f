// SPDX-License-Identifier: Zlib
//
// What is taken of the numbers, lists and objects that JavaScript gives. Beyond these ranges floats lose what a step needs:
// inverse masses become infinite, planes lose their place, time stands still. index.d.ts states them.
import { CairnError } from './module.mjs';

const range = (least, most, give) => ({ least, most, give });
const both = (most, unit) => range(-most, most, `${unit} from -${most} to ${most}`);

export const kRanges = {
  place: both(1e6, 'metres'),
  rotation: range(-1.001, 1.001, 'x, y, z and w of length 1'),
  gravity: both(1e4, 'm/s^2'),
  velocity: both(1e4, 'm/s'),
  turning: both(1e4, 'rad/s'),
  timeStep: range(1e-5, 1, 'seconds from 0.00001 to 1'),
  iterations: range(1, 1000, 'a whole number from 1 to 1000'),
  operations: range(0, 9e15, 'a number from 0 to 9e15, or leave it out for no limit'),
  microseconds: range(0, 1e9, 'a number from 0 to 1e9, or leave it out for no limit'),
  normal: both(1000, 'numbers'),
  normalLength: range(1e-3, 1000, 'a normal of length 0.001 to 1000'),
  halfExtent: range(1e-4, 1e6, 'metres from 0.0001 to 1000000'),
  mass: range(1e-6, 1e9, 'kilograms from 0.000001 to 1e9, or 0 for a body that does not move'),
  friction: range(0, 100, 'a number from 0 to 100'),
  restitution: range(0, 1, 'a number from 0 to 1'),
  scale: range(1e-6, 1e6, 'a number from 0.000001 to 1000000'),
  size: range(1e-4, 1e5, 'a scale that makes it 0.0001 to 100000 metres'),
  maxContactError: range(0, 1, 'a fraction from 0 to 1'),
  level: range(0, 255, 'a whole number from 0 to 255'),
  cut: range(1, 255, 'a whole number from 1 to 255'),
};

const shown = (value) => (typeof value === 'string' ? `'${value.slice(0, 40)}'` : String(value).slice(0, 40));

/** The number, if it is one of its range. `what` says where it was given, and of what. */
export function numberIn({ least, most, give }, number, what) {
  if (typeof number !== 'number') throw new TypeError(`${what} is ${shown(number)}; give ${give}`);
  if (!(number >= least && number <= most)) throw new CairnError(`${what} is ${number}; give ${give}`);
  return number;
}

/** The number, if it is a whole one: WebAssembly would make whole numbers of everything, 0 of NaN and of a name. */
export function whole(number, what) {
  if (number !== (number | 0)) throw new TypeError(`${what} is ${shown(number)}; give a whole number`);
  return number;
}

export const wholeIn = (limits, number, what) => numberIn(limits, whole(number, what), what);

/** A list of so many numbers: more would be written beyond the place for arguments, fewer would leave an older call's. */
export function numbersIn(limits, list, count, what) {
  const length = list?.length;
  if (typeof list !== 'object' || length === undefined) throw new TypeError(`${what} is ${shown(list)}; give a list of ${count} numbers`);
  if (length !== count) throw new TypeError(`${what} has ${shown(length)} numbers; give ${count}`);
  return Array.from({ length: count }, (_, i) => numberIn(limits, list[i], what));
}

export const vectorIn = (limits, list, what) => numbersIn(limits, list, 3, what);

/** An object with names; a number or a list in its place would be passed over. */
export function objectIn(value, what, example) {
  if (typeof value === 'object' && value !== null && !(Symbol.iterator in value)) return value;
  throw new TypeError(`${what} is ${shown(value)}; give an object such as { ${example} }`);
}

export const optionsOf = (options, where, example) => (options === undefined ? {} : objectIn(options, `${where}: the last argument`, example));

/** One of some names, by its place. */
export function placeIn(names, name, what) {
  const place = names.indexOf(name);
  if (place < 0) throw new TypeError(`there is no ${what} ${shown(name)}; give one of ${names.join(', ')}`);
  return place;
}
