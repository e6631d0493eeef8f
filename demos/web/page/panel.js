// SPDX-License-Identifier: GPL-3.0-or-later
//
// Controls beside the picture: what they are set to, and what they say.
import { kEngines } from './engines.js';

export const part = (id) => document.getElementById(id);

const kUsual = 4000; // microseconds of the budget the page begins with
const kNoLimit = 24; // the slider's last place

/// Budgets at the places of a slider: about ten to each power of ten.
const kMicroseconds = [0, 50, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1200, 1500, 2000, 2500, 3000, 3500, 4000, 5000, 6000, 7000, 8000, 10000, 12000];
const kOperations = [0, 250, 500, 1000, 1500, 2000, 3000, 4000, 5000, 7000, 10000, 15000, 20000, 25000, 30000, 40000, 50000, 60000, 80000, 100000, 120000, 150000, 200000, 300000];

export const millisecondsText = (value) => (value === null ? '–' : `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`);
export const countText = (value) => (value === null ? '–' : Math.round(value).toLocaleString('en-GB'));

/// Whole thousands written short, for the scale of a chart.
export const shortText = (value) => (value >= 1000 ? `${value / 1000} k` : String(value));

const setShare = (slider) => slider.style.setProperty('--share', (slider.value - slider.min) / (slider.max - slider.min));

/// The budget's limits as the sliders stand: undefined where there is none. The engine takes 0 for none, so 0 is 1 here.
export function budgetOf() {
  const at = (id, values) => (Number(part(id).value) === kNoLimit ? undefined : Math.max(values[part(id).value], 1));
  return { microseconds: at('microseconds', kMicroseconds), operations: at('operations', kOperations) };
}

function showBudget() {
  const { microseconds, operations } = budgetOf();
  const texts = {
    microseconds: microseconds === undefined ? 'no limit' : microseconds === 1 ? '0 ms' : `${Number((microseconds / 1000).toFixed(2))} ms`,
    operations: operations === undefined ? 'no limit' : operations === 1 ? '0 operations' : `${countText(operations)} operations`,
  };
  for (const [id, text] of Object.entries(texts)) {
    part(`${id}-text`).value = text;
    part(id).setAttribute('aria-valuetext', text);
    setShare(part(id));
  }
}

/// The nearest place of a budget's slider.
function placeOf(values, wanted) {
  if (!(wanted > 0)) return kNoLimit;
  const distances = values.map((value) => Math.abs(value - wanted));
  return distances.indexOf(Math.min(...distances));
}

/// Sets controls from the address: ?engine=jolt&body=ring&bodies=300&microseconds=5000&operations=20000
function readAddress(models) {
  const wanted = new URLSearchParams(location.search);
  if (kEngines.some(({ id }) => id === wanted.get('engine'))) part('engine').value = wanted.get('engine');
  if (models.some(({ name }) => name === wanted.get('body'))) part('body').value = wanted.get('body');
  const count = Number(wanted.get('bodies'));
  if (count >= 1) part('count').value = count;
  part('microseconds').value = placeOf(kMicroseconds, Number(wanted.get('microseconds') ?? kUsual));
  part('operations').value = placeOf(kOperations, Number(wanted.get('operations')));
}

export class Panel {
  /// Calls `onScene` when another scene is wanted, and `onBudget` when another budget is.
  constructor(models, { onScene, onBudget }) {
    for (const { id, label } of kEngines) part('engine').add(new Option(label, id));
    part('body').add(new Option('Mixed', 'mixed'));
    for (const { name, label } of models) part('body').add(new Option(label, name));
    readAddress(models);
    for (const id of ['microseconds', 'operations']) {
      part(id).addEventListener('input', () => {
        showBudget();
        onBudget(budgetOf());
      });
    }
    part('count').addEventListener('input', () => this.showCount());
    for (const id of ['count', 'engine', 'body']) part(id).addEventListener('change', onScene);
    part('drop').addEventListener('click', onScene);
    showBudget();
    this.showCount();
  }

  showCount() {
    part('count-text').value = part('count').value;
    setShare(part('count'));
  }

  /// What scene is asked for.
  get wish() {
    return { engine: part('engine').value, body: part('body').value, count: Number(part('count').value) };
  }

  /// Engines without a budget have their sliders put aside.
  setHasBudget(hasBudget) {
    part('budget-section').hidden = !hasBudget;
    part('work-section').hidden = !hasBudget;
    part('legend').hidden = !hasBudget || part('show-contacts').getAttribute('aria-pressed') === 'false';
    part('show-contacts').hidden = !hasBudget;
  }
}

/// A button that is pressed or not.
export function makeSwitch(id, onChange) {
  const button = part(id);
  const set = (isOn) => {
    button.setAttribute('aria-pressed', String(isOn));
    onChange(isOn);
  };
  button.addEventListener('click', () => set(button.getAttribute('aria-pressed') !== 'true'));
  return { set, get isOn() { return button.getAttribute('aria-pressed') === 'true'; } };
}

export function refuse(message) {
  part('refusal').textContent = message;
  part('refusal').hidden = !message;
}
