// SPDX-License-Identifier: GPL-3.0-or-later
//
// The line below the title.
import { countText } from './colors.js';

/// What there is to see, and what the page was told of it.
export function factsText({ facts, links, joints, whole, isRobot, length }) {
  const texts = [];
  if (isRobot) texts.push(`${countText(links.length)} links`, `${countText(joints.length)} joints`);
  if (whole.count > 0) texts.push(`${countText(whole.count)} spheres${whole.depth > 0 ? ` on ${whole.depth + 1} levels` : ''}`);
  const triangles = links.reduce((sum, link) => sum + link.triangles.length / 3, 0);
  if (triangles > 0 || !isRobot) texts.push(`${countText(triangles)} triangles`);
  if (!isRobot) texts.push(`diagonal ${length(links[0].diagonal)}`);
  for (const [name, value] of facts) texts.push(`${name.toLowerCase()} ${value}`);
  return texts.join(' · ');
}
