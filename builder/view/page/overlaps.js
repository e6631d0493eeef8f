// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which links overlap by their spheres, as these stand now.

// Coordinates come as float32: each is off by at most this part of its link's size. The check errs towards overlapping.
const kRounding = 1.2e-7;

function boxOf(whole, nodes) {
  const box = { lower: [Infinity, Infinity, Infinity], upper: [-Infinity, -Infinity, -Infinity] };
  for (const node of nodes)
    for (let k = 0; k < 3; ++k) {
      box.lower[k] = Math.min(box.lower[k], whole.centers[3 * node + k] - whole.radii[node]);
      box.upper[k] = Math.max(box.upper[k], whole.centers[3 * node + k] + whole.radii[node]);
    }
  return box;
}

const near = (whole, nodes, { lower, upper }, slack) =>
  nodes.filter((node) =>
    [0, 1, 2].every((k) => {
      const [c, reach] = [whole.centers[3 * node + k], whole.radii[node] + slack];
      return c + reach >= lower[k] && c - reach <= upper[k];
    }),
  );

function touch({ centers, radii }, a, b, slack) {
  const reach = radii[a] + radii[b] + slack;
  return (centers[3 * a] - centers[3 * b]) ** 2 + (centers[3 * a + 1] - centers[3 * b + 1]) ** 2 + (centers[3 * a + 2] - centers[3 * b + 2]) ** 2 <= reach * reach;
}

export class Overlaps {
  /// Pairs of links in `ignored` may overlap.
  constructor(whole, links, ignored) {
    this.whole_ = whole;
    this.sizes_ = links.map(({ origin, diagonal }) => Math.hypot(...origin) + diagonal);
    this.leaves_ = whole.nodes.map((nodes) => [...nodes].filter((node) => whole.childCount[node] === 0));
    const isIgnored = new Set(ignored.map(([a, b]) => `${Math.min(a, b)} ${Math.max(a, b)}`));
    this.asked_ = [];
    for (let a = 0; a < links.length; ++a)
      for (let b = a + 1; b < links.length; ++b)
        if (this.leaves_[a].length > 0 && this.leaves_[b].length > 0 && !isIgnored.has(`${a} ${b}`)) this.asked_.push([a, b]);
  }

  /// Pairs of links that overlap; sets the alarms of their spheres.
  find() {
    const { whole_: whole, leaves_: leaves } = this;
    const boxes = leaves.map((nodes) => boxOf(whole, nodes));
    whole.alarms.fill(0);
    const pairs = this.asked_.filter(([a, b]) => this.meet(a, b, boxes));
    for (const node of pairs.flat().flatMap((link) => [...whole.nodes[link]])) whole.alarms[node] = Math.max(1, whole.alarms[node]);
    return pairs;
  }

  meet(a, b, boxes) {
    const slack = kRounding * (this.sizes_[a] + this.sizes_[b]);
    const ofA = near(this.whole_, this.leaves_[a], boxes[b], slack);
    const ofB = ofA.length === 0 ? [] : near(this.whole_, this.leaves_[b], boxes[a], slack);
    let found = false;
    for (const i of ofA)
      for (const k of ofB)
        if (touch(this.whole_, i, k, slack)) {
          found = true;
          this.whole_.alarms[i] = this.whole_.alarms[k] = 2;
        }
    return found;
  }
}
