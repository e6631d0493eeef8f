// SPDX-License-Identifier: GPL-3.0-or-later
//
// A chart of the last steps that moves on: one value filled, one as a line, a limit as a dashed line.
import { themeColor } from './colors.js';

const kShown = 240; // steps: four seconds
const kRoom = 1.2; // above the greatest value
const kFitting = 0.97; // the share of the steps that fit on the scale; a few that stand out are cut

/// A round number at or above a value: 1, 2 or 5 times a power of ten.
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((digit) => digit * power >= value * (1 - 1e-12));
}

export function quantile(values, share) {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

export class StripChart {
  /// `least`: the scale never ends below it. `text` writes a value of the scale.
  constructor(canvas, { least, text }) {
    this.canvas_ = canvas;
    this.least_ = least;
    this.text_ = text;
    this.limit = null;
    this.clear();
  }

  clear() {
    this.filled_ = [];
    this.line_ = [];
  }

  /// One step: the filled value and the line's, each null where there is none.
  add(filled, line = null) {
    this.filled_.push(filled);
    this.line_.push(line);
    if (this.filled_.length > kShown) this.filled_.shift();
    if (this.line_.length > kShown) this.line_.shift();
  }

  /// Values of the steps shown, without those that were not told.
  values(name = 'filled') {
    return (name === 'filled' ? this.filled_ : this.line_).filter((value) => value !== null);
  }

  draw() {
    const ratio = Math.min(devicePixelRatio, 2);
    const [width, height] = [this.canvas_.clientWidth, this.canvas_.clientHeight];
    if (width === 0) return;
    if (this.canvas_.width !== width * ratio || this.canvas_.height !== height * ratio) Object.assign(this.canvas_, { width: width * ratio, height: height * ratio });
    const context = this.canvas_.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const most = Math.max(quantile(this.values('filled'), kFitting), quantile(this.values('line'), kFitting));
    const top = roundUp(kRoom * Math.max(most, this.limit ?? 0, this.least_));
    const at = (value) => height - 1 - ((height - 14) * Math.min(value, top)) / top;
    this.drawRules(context, width, top, at);
    this.drawFilled(context, width, at);
    this.drawLine(context, width, at);
    this.drawLimit(context, width, at);
    this.drawScale(context, width, top, at);
  }

  drawRules(context, width, top, at) {
    context.strokeStyle = themeColor('line');
    context.lineWidth = 1;
    for (const value of [top / 2, top]) {
      const y = Math.round(at(value)) + 0.5;
      context.beginPath();
      context.moveTo(0, y);
      context.lineTo(width, y);
      context.stroke();
    }
  }

  /// Words of the scale, with a seam so that they can be read on bars.
  drawScale(context, width, top, at) {
    Object.assign(context, { textAlign: 'right', lineWidth: 4, lineJoin: 'round', strokeStyle: themeColor('seam'), fillStyle: themeColor('soft') });
    context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
    for (const value of [top / 2, top]) {
      const place = [this.text_(value), width - 2, Math.round(at(value)) - 3];
      context.strokeText(...place);
      context.fillText(...place);
    }
  }

  drawFilled(context, width, at) {
    const step = width / kShown;
    const from = width - this.filled_.length * step;
    this.filled_.forEach((value, index) => {
      if (value === null) return;
      context.fillStyle = themeColor(this.limit !== null && value > this.limit ? 'over' : 'accent');
      context.fillRect(from + index * step, at(value), Math.max(step, 1), at(0) - at(value) + 1);
    });
  }

  drawLine(context, width, at) {
    const step = width / kShown;
    const from = width - this.line_.length * step;
    context.strokeStyle = themeColor('ink');
    context.lineWidth = 1.2;
    context.beginPath();
    this.line_.forEach((value, index) => value !== null && context.lineTo(from + (index + 0.5) * step, at(value)));
    context.stroke();
  }

  drawLimit(context, width, at) {
    if (this.limit === null) return;
    context.strokeStyle = themeColor('over');
    context.lineWidth = 1.5;
    context.setLineDash([5, 4]);
    context.beginPath();
    context.moveTo(0, at(this.limit));
    context.lineTo(width, at(this.limit));
    context.stroke();
    context.setLineDash([]);
  }
}
