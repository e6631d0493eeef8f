// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys: some everywhere but in controls that use them, others in the picture.
import { commandOf, stepOf } from './key_names.js';
import { part } from './panel.js';

const kTurn = 0.12; // radians a key press turns the view
const kNearer = 0.88;

const directionOf = (key) => ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] })[key];

/// Returns whether the key meant something to the picture.
function inPicture(event, stage, hand) {
  const { key } = event;
  const direction = directionOf(key);
  if (hand.holds && direction) hand.nudge(direction[0], 0, direction[1]);
  else if (hand.holds && key === 'PageUp') hand.nudge(0, 1, 0);
  else if (hand.holds && key === 'PageDown') hand.nudge(0, -1, 0);
  else if (direction) stage.move(-kTurn * direction[0], kTurn * direction[1], 1);
  else if (key === '+' || key === '=') stage.move(0, 0, kNearer);
  else if (key === '-') stage.move(0, 0, 1 / kNearer);
  else if (stepOf(event)) hand.next(stepOf(event));
  else if (key === 'Enter') hand.toggle();
  else if (key === 'Escape') (hand.release(), hand.choose(null));
  else return false;
  return true;
}

export function listenToKeys(canvas, stage, hand) {
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (inPicture(event, stage, hand)) event.preventDefault();
  });
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.repeat || event.target instanceof HTMLSelectElement) return;
    const button = part(commandOf(event) ?? '');
    if (button && !button.hidden) button.click();
  });
}
