// SPDX-License-Identifier: GPL-3.0-or-later
//
// The legend: how many spheres have which certified error, in their colours, above a scale in mesh units and per cent.
import { countText, cssColor, errorColor, percentText } from './colors.js';

const kBars = 32;
const kWidth = 256;
const kHeight = 44;
const kSvg = 'http://www.w3.org/2000/svg';

function element(name, attributes) {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function bars(counts) {
  const svg = element('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: 'none', 'aria-hidden': 'true' });
  const most = Math.max(...counts);
  const width = kWidth / kBars;
  counts.forEach((count, k) => {
    // The root of the share: one sphere among thousands is still seen.
    const height = count === 0 ? 0 : Math.max(2, (kHeight - 8) * Math.sqrt(count / most));
    const fill = cssColor(errorColor((k + 0.5) / kBars));
    svg.append(element('rect', { x: k * width + 0.5, width: width - 1, y: kHeight - 7 - height, height, fill, rx: 1 }));
    svg.append(element('rect', { x: k * width, width: width + 0.5, y: kHeight - 4, height: 4, fill }));
  });
  return svg;
}

function scaleText(text, part) {
  const span = document.createElement('span');
  const [length, percent] = [document.createElement('b'), document.createElement('small')];
  length.textContent = text;
  percent.textContent = part;
  span.append(length, percent);
  return span;
}

/// Draws the legend of the spheres `cut` into an element. Per cents are of a single body's diagonal.
export function drawLegend(place, { whole: link, links, isRobot, isMetric, length }, cut, greatest) {
  const [{ diagonal }] = links;
  const percent = (value) => (isRobot ? '' : percentText(value / diagonal));
  const counts = new Array(kBars).fill(0);
  const certified = cut.filter((i) => !Number.isNaN(link.errors[i]));
  for (const i of certified) ++counts[greatest > 0 ? Math.min(kBars - 1, Math.floor((kBars * link.errors[i]) / greatest)) : 0];
  const scale = document.createElement('div');
  scale.className = 'scale';
  const ends = greatest > 0 ? [0, 0.5, 1] : [0];
  for (const share of ends) scale.append(scaleText(length(share * greatest), percent(share * greatest)));
  place.replaceChildren(bars(counts), scale);
  place.setAttribute(
    'aria-label',
    `Colours of ${countText(certified.length)} spheres by certified error, from 0 (${cssColor(errorColor(0))}) to ` +
      `${length(greatest)}${isMetric ? '' : ' mesh units'}${isRobot ? '' : `, ${percent(greatest)} of the diagonal`} (${cssColor(errorColor(1))})`,
  );
}
