// SPDX-License-Identifier: GPL-3.0-or-later
//
// A slider for each joint that has a position of its own: degrees, or millimetres of those that slide.

const kSteps = 100; // of a sliding joint's range, at least; a turning one goes by degrees
const kLeap = 10; // steps of Page Up and Page Down

/// What a joint is shown in: how many there are in a radian or a unit of length, the sign behind, and what is said.
function unitOf(joint, isMetric) {
  if (joint.type !== 'prismatic') return { scale: 180 / Math.PI, sign: '°', word: 'degrees', step: 1 };
  const scale = isMetric ? 1000 : 1;
  const range = scale * (joint.upper - joint.lower);
  const step = range > 0 ? 10 ** Math.floor(Math.log10(range / kSteps)) : 1;
  return { scale, sign: isMetric ? ' mm' : '', word: isMetric ? 'millimetres' : 'units', step };
}

const digitsOf = ({ step }) => Math.max(0, 1 - Math.floor(Math.log10(step) + 1e-9));

/// A number with as many digits as a tenth of a step has, without those that say nothing.
function numberText(unit, position) {
  const text = String(Number((unit.scale * position).toFixed(Math.min(12, digitsOf(unit)))));
  return (text === '-0' ? '0' : text).replace('-', '−');
}

function element(name, className, text = '') {
  const made = document.createElement(name);
  made.className = className;
  made.textContent = text;
  return made;
}

export class JointSliders {
  /// Fills `place`; calls `onMove` after every motion.
  constructor(place, robot, isMetric, onMove) {
    this.robot_ = robot;
    this.onMove_ = onMove;
    this.rows_ = robot.active.map((j, k) => this.rowOf(j, k, unitOf(robot.joints[j], isMetric)));
    place.replaceChildren(...this.rows_.map(({ box }) => box));
    this.show();
  }

  rowOf(j, k, unit) {
    const joint = this.robot_.joints[j];
    const box = element('div', 'joint');
    const row = element('div', 'row');
    const name = element('label', 'name');
    name.append(...joint.name.match(/[^_.-]*[_.-]*/g).flatMap((piece) => [piece, document.createElement('wbr')])); // lines break there
    const value = element('output', 'value');
    const slider = Object.assign(element('input', ''), { type: 'range', id: `joint-${k}`, min: joint.lower, max: joint.upper, step: 'any' });
    name.htmlFor = slider.id;
    slider.dataset.joint = joint.name;
    slider.addEventListener('input', () => this.move(j, Number(slider.value)));
    slider.addEventListener('keydown', (event) => this.step(event, j, unit));
    row.append(name, value);
    const [lower, upper] = [joint.lower, joint.upper].map((end) => numberText(unit, end));
    box.append(row, element('small', 'lower', lower), slider, element('small', 'upper', upper));
    const followers = this.robot_.joints.filter(({ mimic }) => mimic?.joint === j).map((follower) => follower.name);
    if (followers.length > 0) box.append(element('small', 'followers', `moves ${followers.join(', ')} too`));
    return { j, unit, box, slider, value };
  }

  move(j, position) {
    this.robot_.move(j, position);
    this.show();
    this.onMove_();
  }

  rest() {
    this.robot_.rest();
    this.show();
    this.onMove_();
  }

  /// Keys go to the next whole step, so that 0 is met.
  step(event, j, { scale, step }) {
    const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: kLeap, PageDown: -kLeap }[event.key];
    if (steps === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const at = (this.robot_.positionOf(j) * scale) / step;
    const next = steps > 0 ? Math.floor(at + 1e-6) + steps : Math.ceil(at - 1e-6) + steps;
    this.move(j, (next * step) / scale);
  }

  show() {
    for (const { j, unit, slider, value } of this.rows_) {
      const { lower, upper } = this.robot_.joints[j];
      const position = this.robot_.positionOf(j);
      const share = (at) => (upper > lower ? (Math.min(Math.max(at, lower), upper) - lower) / (upper - lower) : 0);
      const ends = [share(0), share(position)].sort((a, b) => a - b);
      slider.value = position;
      slider.style.setProperty('--from', ends[0]);
      slider.style.setProperty('--share', ends[1]);
      slider.setAttribute('aria-valuetext', `${numberText(unit, position)} ${unit.word}`);
      value.textContent = `${numberText(unit, position)}${unit.sign}`;
    }
  }
}
