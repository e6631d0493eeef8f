// SPDX-License-Identifier: GPL-3.0-or-later
//
// What keys mean, whether caps lock is on or not.

const kCommands = new Map(Object.entries({ d: 'drop', p: 'pause', c: 'show-contacts', f: 'frame' }));

const letterOf = ({ key }) => key?.toLowerCase();

/// The control that a key stands for; null for none.
export const commandOf = (event) => kCommands.get(letterOf(event)) ?? null;

/// N chooses the next body, with Shift the one before: 1 or -1, and 0 for other keys.
export const stepOf = (event) => (letterOf(event) !== 'n' ? 0 : event.shiftKey ? -1 : 1);
