// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which links overlap, in words beside the picture: nobody has to see the colour.

const kNamed = 3; // pairs, as far as they fit; the rest are counted
const kRoom = 90; // characters of names: more would hide the picture of a phone

/// Pairs of links in words.
export function overlapText(links, pairs) {
  if (pairs.length === 0) return 'No links overlap';
  const named = pairs.slice(0, kNamed).map(([a, b]) => `${links[a].name} and ${links[b].name}`);
  while (named.length > 1 && named.join(', ').length > kRoom) named.pop();
  const more = pairs.length - named.length;
  return `${named.join(', ')}${more > 0 ? `, ${more} more pairs` : ''} overlap`.replace(/\b1 more pairs/, '1 more pair');
}

export function tellOverlaps(place, links, pairs) {
  const text = overlapText(links, pairs);
  place.classList.toggle('alarm', pairs.length > 0);
  if (place.textContent !== text) place.textContent = text; // or it would be read out at every step
}
