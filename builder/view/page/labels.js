// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names in the picture, above the chosen sphere and its parent.

const byId = (id) => document.getElementById(id);

function placeLabel(label, stage, node, text) {
  label.hidden = node === null;
  if (node === null) return;
  const { x, y, rise } = stage.placeOf(node);
  const box = label.parentElement.getBoundingClientRect();
  label.textContent = text;
  label.style.transform = `translate(${Math.round(x - box.left)}px, ${Math.round(Math.max(18, y - rise - box.top))}px)`;
}

/// Puts them where they belong; `chosen` is null for none.
export function placeLabels({ whole, links, isRobot }, stage, chosen) {
  const parent = chosen === null || whole.parents[chosen] === chosen ? null : whole.parents[chosen];
  const name = (node) => (isRobot ? links[whole.owner[node]].name : String(node));
  placeLabel(byId('chosen-label'), stage, chosen, chosen === null ? '' : name(chosen));
  placeLabel(byId('parent-label'), stage, parent, `parent ${parent}`);
}
