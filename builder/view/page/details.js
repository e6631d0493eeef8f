// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is said of a chosen sphere.
import { countText, percentText } from './colors.js';
import { trianglesOf } from './scene.js';

function rowOf(name, ...values) {
  const row = document.createElement('div');
  const [term, description] = [document.createElement('dt'), document.createElement('dd')];
  term.textContent = name;
  description.append(...values);
  row.append(term, description);
  return row;
}

function jump(node, title, choose) {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'jump';
  button.textContent = node;
  button.setAttribute('aria-label', `${title} ${node}`);
  button.addEventListener('click', () => choose(node));
  return button;
}

function lengthRow(scene, name, value) {
  if (scene.isRobot) return rowOf(name, scene.length(value));
  const part = document.createElement('small');
  part.textContent = ` ${percentText(value / scene.links[0].diagonal)}`;
  return rowOf(name, scene.length(value), part);
}

function errorRow(scene, error) {
  if (Number.isNaN(error)) return rowOf('Certified error', 'none: the file gives this sphere');
  return lengthRow(scene, 'Certified error', error);
}

function relativeRows(whole, triangles, node, choose) {
  const parent = whole.parents[node];
  const children = Array.from({ length: whole.childCount[node] }, (_, k) => jump(whole.firstChild[node] + k, 'Child, node', choose));
  return [
    rowOf('Level', String(whole.levels[node])),
    rowOf('Parent', parent === node ? 'none, it is the root' : jump(parent, 'Parent, node', choose)),
    rowOf('Children', ...(children.length > 0 ? children : ['none, it is a leaf'])),
    rowOf('Triangles held', countText(triangles.size)),
  ];
}

/// Lists what is known of sphere `node`; its relatives are buttons that call `choose`.
export function listDetails(place, scene, node, choose) {
  const { whole, links, isRobot } = scene;
  const link = links[whole.owner[node]];
  const i = whole.local[node];
  const rows = isRobot ? [rowOf('Link', link.name)] : [];
  if (whole.depth > 0) rows.push(...relativeRows(whole, trianglesOf(link, i), node, choose));
  rows.push(errorRow(scene, link.errors[i]), lengthRow(scene, 'Radius', link.radii[i]));
  if (link.innerRadii[i] > 0) rows.push(lengthRow(scene, 'Radius in the solid', link.innerRadii[i]));
  const centre = [0, 1, 2].map((k) => link.origin[k] + link.centers[3 * i + k]);
  rows.push(rowOf(isRobot ? 'Centre in the link' : 'Centre', scene.length(...centre)));
  place.replaceChildren(...rows);
}
