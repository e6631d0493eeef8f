// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a robot's links and spheres are, from the text of its URDF alone: nothing here comes from the page, its writer or
// the builder's kinematics. Matrices of 4 x 4 and quaternions, where those use vectors and Rodrigues's formula.

const attribute = (text, name, usual) => new RegExp(`\\b${name}="([^"]*)"`).exec(text)?.[1] ?? usual;
const numbers = (text, name, usual) => (attribute(text, name) ?? usual).trim().split(/\s+/).map(Number);
const part = (text, name) => new RegExp(`<${name}\\b[^>]*>`).exec(text)?.[0] ?? '';

const multiply = (a, b) => a.map((row) => [0, 1, 2, 3].map((j) => row.reduce((sum, c, k) => sum + c * b[k][j], 0)));
const shift = ([x, y, z]) => [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]];
export const moved = (m, p) => [0, 1, 2].map((k) => m[k][0] * p[0] + m[k][1] * p[1] + m[k][2] * p[2] + m[k][3]);

/// A turn as the matrix of a quaternion.
function turn(axis, angle) {
  const size = Math.hypot(...axis);
  const [x, y, z] = axis.map((c) => (c / size) * Math.sin(angle / 2));
  const w = Math.cos(angle / 2);
  return [
    [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y), 0],
    [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 0],
    [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z, 0],
    [0, 0, 0, 1],
  ];
}

function originOf(text) {
  const origin = part(text, 'origin');
  const [roll, pitch, yaw] = numbers(origin, 'rpy', '0 0 0');
  const turned = multiply(turn([0, 0, 1], yaw), multiply(turn([0, 1, 0], pitch), turn([1, 0, 0], roll)));
  return multiply(shift(numbers(origin, 'xyz', '0 0 0')), turned);
}

function jointOf(text) {
  const type = attribute(text, 'type');
  const mimic = part(text, 'mimic');
  const [lower, upper] = type === 'continuous' ? [-Math.PI, Math.PI] : [Number(attribute(text, 'lower', 0)), Number(attribute(text, 'upper', 0))];
  return {
    name: attribute(text, 'name'),
    type,
    parent: attribute(part(text, 'parent'), 'link'),
    child: attribute(part(text, 'child'), 'link'),
    origin: originOf(text),
    axis: numbers(part(text, 'axis'), 'xyz', '1 0 0'),
    lower,
    upper,
    follows: mimic && { joint: attribute(mimic, 'joint'), multiplier: Number(attribute(mimic, 'multiplier', 1)), offset: Number(attribute(mimic, 'offset', 0)) },
  };
}

/// Links with the spheres of their collisions, and joints, in the order of the text.
export function robotOf(text) {
  const links = [...text.matchAll(/<link name="([^"]*)"\s*(?:\/>|>([\s\S]*?)<\/link>)/g)].map(([, name, inside = '']) => ({
    name,
    spheres: [...inside.matchAll(/<collision\b[\s\S]*?<\/collision>/g)].flatMap(([collision]) => {
      const radius = attribute(part(collision, 'sphere'), 'radius');
      return radius ? [{ center: moved(originOf(collision), [0, 0, 0]), radius: Number(radius) }] : [];
    }),
  }));
  const joints = [...text.matchAll(/<joint\b[\s\S]*?<\/joint>/g)].map(([joint]) => jointOf(joint));
  return { links, joints, active: joints.filter(({ type, follows }) => type !== 'fixed' && !follows) };
}

/// Matrices of all links by name. `positions` are those of active joints by name.
export function posesOf({ links, joints }, positions) {
  const poseOf = (name) => {
    const joint = joints.find(({ child }) => child === name);
    if (!joint) return shift([0, 0, 0]);
    const { follows } = joint;
    const at = follows ? follows.multiplier * positions[follows.joint] + follows.offset : positions[joint.name];
    const motion = { fixed: () => shift([0, 0, 0]), prismatic: () => shift(joint.axis.map((c) => (c / Math.hypot(...joint.axis)) * at)) };
    return multiply(multiply(poseOf(joint.parent), joint.origin), (motion[joint.type] ?? (() => turn(joint.axis, at)))());
  };
  return Object.fromEntries(links.map(({ name }) => [name, poseOf(name)]));
}

/// All spheres where they are, link by link.
export function spheresAt(robot, positions) {
  const poses = posesOf(robot, positions);
  return robot.links.flatMap(({ name, spheres }) => spheres.map(({ center, radius }) => ({ link: name, center: moved(poses[name], center), radius })));
}

/// Names of pairs of links, sorted.
export const pairName = (a, b) => [a, b].sort().join(' & ');

/// Pairs of links of which two spheres meet, but parent and child and `ignored`; and how near the closest call was.
export function overlapsAt(robot, positions, ignored) {
  const adjacent = robot.joints.map(({ parent, child }) => pairName(parent, child));
  const spheres = spheresAt(robot, positions);
  const deepest = new Map();
  spheres.forEach((a, i) => {
    for (const b of spheres.slice(i + 1)) {
      const pair = pairName(a.link, b.link);
      if (a.link === b.link || adjacent.includes(pair) || ignored.includes(pair)) continue;
      const depth = a.radius + b.radius - Math.hypot(...a.center.map((c, k) => c - b.center[k]));
      deepest.set(pair, Math.max(depth, deepest.get(pair) ?? -Infinity));
    }
  });
  return {
    pairs: [...deepest].filter(([, depth]) => depth >= 0).map(([pair]) => pair).sort(),
    closest: Math.min(...[...deepest.values()].map(Math.abs)),
  };
}
