// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is said of a chosen sphere.
import { countText, lengthText, percentText } from './colors.js';
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

function lengthRow(link, name, value) {
  const part = document.createElement('small');
  part.textContent = ` ${percentText(value / link.diagonal)}`;
  return rowOf(name, lengthText(value), part);
}

function childrenOf(link, node) {
  return Array.from({ length: link.childCount[node] }, (_, k) => link.firstChild[node] + k);
}

/// Lists what is known of sphere `node` of a link; its relatives are buttons that call `choose`.
export function listDetails(place, link, node, choose) {
  const isTree = link.depth > 0;
  const rows = [];
  if (isTree) {
    const parent = link.parents[node];
    rows.push(rowOf('Level', String(link.levels[node])));
    rows.push(rowOf('Parent', parent === node ? 'none, it is the root' : jump(parent, 'Parent, node', choose)));
    const children = childrenOf(link, node).map((child) => jump(child, 'Child, node', choose));
    rows.push(rowOf('Children', ...(children.length > 0 ? children : ['none, it is a leaf'])));
    rows.push(rowOf('Triangles held', countText(trianglesOf(link, node).size)));
  }
  rows.push(lengthRow(link, 'Certified error', link.errors[node]));
  rows.push(lengthRow(link, 'Radius', link.radii[node]));
  if (link.innerRadii[node] > 0) rows.push(lengthRow(link, 'Radius in the solid', link.innerRadii[node]));
  const centre = [0, 1, 2].map((k) => lengthText(link.origin[k] + link.centers[3 * node + k]));
  rows.push(rowOf('Centre', centre.join(', ')));
  place.replaceChildren(...rows);
}
