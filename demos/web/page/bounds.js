// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far and how long a replay may go. Farther places are no picture, and cameras and lights that frame them hang.

export const kFarthest = 1e6; // m, 1000 km in each coordinate
export const kLongest = 86400; // s, a day

/// The greatest of a list of any length: arguments of a call lie on the stack, which a large file overflows.
export const greatest = (list, of) => list.reduce((most, one) => Math.max(most, of(one)), -Infinity);
export const least = (list) => list.reduce((lowest, one) => Math.min(lowest, one), Infinity);
