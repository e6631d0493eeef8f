// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: reads the data beside it, draws it, and answers to mouse, finger and keyboard.
import { JointSliders } from './joint_sliders.js';
import { Panel } from './panel.js';
import { Robot } from './robot.js';
import { readScene } from './scene.js';
import { Stage } from './stage.js';

const kKeys = {
  ArrowRight: (panel) => panel.stepLevel(1),
  ArrowUp: (panel) => panel.stepLevel(1),
  ArrowLeft: (panel) => panel.stepLevel(-1),
  ArrowDown: (panel) => panel.stepLevel(-1),
  m: (panel) => panel.toggle('mesh'),
  s: (panel) => panel.toggle('spheres'),
  e: (panel) => panel.toggle('edges'),
  f: (panel) => panel.frame(),
  u: (panel) => panel.turnUp(),
  w: (panel) => panel.chooseWorst(),
  p: (panel) => panel.chooseParent(),
  r: (panel, sliders) => sliders?.rest(),
  Escape: (panel) => panel.choose(null),
};

function listenToKeys(panel, sliders) {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // The slider moves itself.
    if (event.target instanceof HTMLInputElement && event.key.startsWith('Arrow')) return;
    const action = kKeys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(panel, sliders);
  });
}

function addSliders(scene, robot, stage, panel) {
  const sliders = new JointSliders(document.getElementById('joints'), robot, scene.isMetric, () => {
    stage.place();
    panel.noteMotion();
  });
  document.getElementById('joints-section').hidden = false;
  document.getElementById('rest').addEventListener('click', () => sliders.rest());
  return sliders;
}

function begin() {
  const scene = readScene(document.getElementById('scene').textContent);
  document.getElementById('title').textContent = scene.title;
  const robot = new Robot(scene);
  const stage = new Stage(document.getElementById('picture'), scene, robot);
  const panel = new Panel(scene, stage, robot);
  const sliders = robot.active.length > 0 ? addSliders(scene, robot, stage, panel) : null;
  listenToKeys(panel, sliders);
  // For tests, and for scripts in the browser's console.
  window.cairnView = {
    state: () => ({ ...panel.state, ...stage.state, ...(scene.isRobot ? robot.state : {}) }),
    placeOf: (node) => stage.placeOf(node),
    drawnAt: (x, y) => stage.drawnAt(x, y),
    orbit: (seconds) => stage.orbit(seconds),
    settled: () => stage.settled(),
  };
}

try {
  begin();
} catch (error) {
  const refusal = document.getElementById('refusal');
  refusal.hidden = false;
  refusal.textContent = `This page cannot be drawn: ${error.message.replace(/\.+$/, '')}. It needs a browser with WebGL 2.`;
}
