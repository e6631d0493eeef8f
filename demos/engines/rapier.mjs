// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rapier: moving triangle meshes, its own convex decomposition, or the parts of hulls.mjs.
import { chosenShape, Drags, dragImpulse, hasVectors, hullsOf, kFriction } from './common.mjs';
import { massProperties } from './mass.mjs';
import { add, rotate } from './vectors.mjs';

const kShapes = ['mesh', 'decomposition', 'hulls'];

const vector = ([x, y, z]) => ({ x, y, z });
const quaternion = ([x, y, z, w]) => ({ x, y, z, w });
const list = ({ x, y, z }) => [x, y, z];

/// Returns colliders' descriptions. Meshes are told to be oriented and to mend normals at inner edges, which Rapier's
/// documents advise; without it bodies catch on edges.
function colliders(rapier, kind, model) {
  const { ColliderDesc, TriMeshFlags } = rapier;
  const { vertices, indices } = model;
  if (kind === 'mesh') return [ColliderDesc.trimesh(vertices, indices, TriMeshFlags.FIX_INTERNAL_EDGES)];
  const parts = kind === 'decomposition' ? [ColliderDesc.convexDecomposition(vertices, indices)] : hullsOf('Rapier', model).map((hull) => ColliderDesc.convexHull(hull));
  if (parts.includes(null)) throw new Error(`Rapier: a convex part of ${model.name} is flat; make parts with a volume.`);
  return parts;
}

class RapierWorld {
  drags = new Drags();
  bodies = [];
  poses = new Float32Array(0);
  last = { narrowPhaseMs: 0, stepMs: 0 };

  constructor(rapier, { gravity, timeStep }) {
    this.rapier = rapier;
    this.world = new rapier.World(vector(gravity));
    this.world.timestep = timeStep;
    this.world.profilerEnabled = true;
  }

  addBody({ colliders, properties }, { position, rotation, linearVelocity = [0, 0, 0] }) {
    const { mass, center, moments, axes } = properties;
    const body = this.world.createRigidBody(
      this.rapier.RigidBodyDesc.dynamic()
        .setTranslation(...position)
        .setRotation(quaternion(rotation))
        .setLinvel(...linearVelocity)
        .setAdditionalMassProperties(mass, vector(center), vector(moments), quaternion(axes)),
    );
    for (const collider of colliders) this.world.createCollider(collider.setDensity(0).setFriction(kFriction).setRestitution(0), body);
    this.poses = new Float32Array(7 * (this.bodies.length + 1));
    return this.bodies.push({ body, properties }) - 1;
  }

  addBox(halfExtents, position, rotation) {
    const box = this.rapier.ColliderDesc.cuboid(...halfExtents).setTranslation(...position).setRotation(quaternion(rotation));
    this.world.createCollider(box.setFriction(kFriction).setRestitution(0));
  }

  step() {
    for (const [index, grip] of this.drags) this.pull(this.bodies[index], grip);
    const start = performance.now();
    this.world.step();
    this.last = { stepMs: performance.now() - start, narrowPhaseMs: this.world.timingNarrowPhase() };
  }

  pull({ body, properties }, grip) {
    const { x, y, z, w } = body.rotation();
    const rotation = [x, y, z, w];
    const center = add(list(body.translation()), rotate(rotation, properties.center));
    const state = { center, rotation, velocity: list(body.linvel()), angularVelocity: list(body.angvel()) };
    const { at, impulse } = dragImpulse(state, grip, properties, this.world.timestep);
    body.applyImpulseAtPoint(vector(impulse), vector(at), true);
  }

  transforms() {
    this.bodies.forEach(({ body }, index) => {
      const p = body.translation();
      const q = body.rotation();
      this.poses.set([p.x, p.y, p.z, q.x, q.y, q.z, q.w], 7 * index);
    });
    return this.poses;
  }

  times() {
    return this.last;
  }

  contacts() {
    return null;
  }

  asleep() {
    return this.bodies.filter(({ body }) => body.isSleeping()).length;
  }

  drag(index, point, target) {
    this.drags.set(index, point, target);
  }

  free() {
    this.world.free();
  }
}

/// The build with vectors, whose newest version is older, or the one without.
const packageOf = (simd) => (simd ? import('@dimforge/rapier3d-simd-compat') : import('@dimforge/rapier3d-compat'));

export async function load({ shape, simd = hasVectors() } = {}) {
  const kind = chosenShape('Rapier', kShapes, shape);
  const { default: rapier } = await packageOf(simd);
  await rapier.init();
  return {
    name: 'Rapier',
    version: rapier.version(),
    shape: kind,
    shapes: kShapes,
    prepare: (model) => ({ colliders: colliders(rapier, kind, model), properties: massProperties(model), free() {} }),
    createWorld: (options) => new RapierWorld(rapier, options),
  };
}
