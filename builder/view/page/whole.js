// SPDX-License-Identifier: GPL-3.0-or-later
//
// The spheres of all links as one list of nodes, which levels, colours and clicks are about.

/// Levels of nodes, and where their children are; parents stand before their children, siblings side by side.
export function linked(parents) {
  const count = parents.length;
  const levels = new Uint8Array(count);
  const firstChild = new Uint32Array(count);
  const childCount = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const parent = parents[i];
    if (parent === i) continue;
    levels[i] = levels[parent] + 1;
    if (childCount[parent]++ === 0) firstChild[parent] = i;
  }
  return { levels, firstChild, childCount };
}

/// Link and number there of every sphere: level by level, and in a level link by link.
function namesOf(links) {
  const next = links.map(() => 0);
  const names = [];
  for (let level = 0; links.some((link, l) => next[l] < link.count); ++level)
    links.forEach((link, l) => {
      for (; next[l] < link.count && link.levels[next[l]] === level; ++next[l]) names.push([l, next[l]]);
    });
  return names;
}

/// Node i is sphere `local[i]` of link `owner[i]`. `centers` change as links move, and so do `alarms`: 1 for a sphere of
/// a link that overlaps another, 2 for one that itself does.
export function wholeOf(links) {
  const names = namesOf(links);
  const nodes = links.map((link) => new Uint32Array(link.count));
  names.forEach(([l, i], node) => (nodes[l][i] = node));
  const pick = (Type, key) => Type.from(names, ([l, i]) => links[l][key][i]);
  const parents = Uint32Array.from(names, ([l, i]) => nodes[l][links[l].parents[i]]);
  const whole = {
    owner: Uint32Array.from(names, ([l]) => l),
    local: Uint32Array.from(names, ([, i]) => i),
    nodes,
    count: names.length,
    centers: new Float64Array(3 * names.length),
    alarms: new Uint8Array(names.length),
    radii: pick(Float32Array, 'radii'),
    errors: pick(Float32Array, 'errors'),
    parents,
    ...linked(parents),
  };
  whole.depth = whole.count === 0 ? 0 : whole.levels[whole.count - 1];
  return whole;
}
