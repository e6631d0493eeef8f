// SPDX-License-Identifier: GPL-3.0-or-later
//
// Jolt: convex parts of hulls.mjs in a compound. Jolt's moving meshes do not collide with each other (its documents).
import { chosenShape, Drags, dragImpulse, hullsOf, kFriction } from './common.mjs';
import { massProperties } from './mass.mjs';

const kShapes = ['hulls'];
const kVersion = '1.1.0'; // the module does not tell it; package.json pins it

// Jolt's defaults of 2 cm for slop and speculative distance, and 5 cm for the rounding of hulls, are for things of the size of
// a person. Bodies are a metre here and their walls thin: these were the most accurate that stayed quiet.
const kSlop = 0.005; // m
const kSpeculativeDistance = 0.005; // m
const kConvexRadius = 0.01; // m

const kMoving = 0; // object layers
const kStill = 1;

function layers(jolt, settings) {
  const pairs = new jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(kMoving, kMoving);
  pairs.EnableCollision(kMoving, kStill);
  const broad = new jolt.BroadPhaseLayerInterfaceTable(2, 2);
  for (const layer of [kMoving, kStill]) {
    const made = new jolt.BroadPhaseLayer(layer);
    broad.MapObjectToBroadPhaseLayer(layer, made);
    jolt.destroy(made);
  }
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 2);
}

function start(jolt, { gravity, timeStep }) {
  const settings = new jolt.JoltSettings();
  settings.mMaxBodies = 4096;
  settings.mMaxBodyPairs = 65536;
  settings.mMaxContactConstraints = 16384; // more does not fit the 10 MB of scratch memory that the package fixes
  layers(jolt, settings);
  const machine = new jolt.JoltInterface(settings); // owns the filters
  jolt.destroy(settings);
  const system = machine.GetPhysicsSystem();
  const physics = system.GetPhysicsSettings();
  physics.mPenetrationSlop = kSlop;
  physics.mSpeculativeContactDistance = kSpeculativeDistance;
  system.SetPhysicsSettings(physics);
  const down = new jolt.Vec3(...gravity);
  system.SetGravity(down);
  jolt.destroy(down);
  return { machine, timeStep, bodies: system.GetBodyInterface() };
}

function hullSettings(jolt, hull) {
  const settings = new jolt.ConvexHullShapeSettings();
  const point = new jolt.Vec3();
  for (let at = 0; at < hull.length; at += 3) {
    point.Set(hull[at], hull[at + 1], hull[at + 2]);
    settings.mPoints.push_back(point);
  }
  settings.mMaxConvexRadius = kConvexRadius;
  jolt.destroy(point);
  return settings;
}

/// A compound whose centre of mass is the mesh's: Jolt would take that of the overlapping parts.
function compoundOf(jolt, model, center) {
  const zero = new jolt.Vec3(0, 0, 0);
  const upright = new jolt.Quat(0, 0, 0, 1);
  const compound = new jolt.StaticCompoundShapeSettings();
  for (const hull of hullsOf('Jolt', model)) compound.AddShape(zero, upright, hullSettings(jolt, hull), 0);
  const made = compound.Create();
  if (made.HasError()) throw new Error(`Jolt: ${model.name}: ${made.GetError().c_str()}`);
  const parts = made.Get();
  const own = parts.GetCenterOfMass();
  const shift = new jolt.Vec3(center[0] - own.GetX(), center[1] - own.GetY(), center[2] - own.GetZ());
  const shape = new jolt.OffsetCenterOfMassShape(parts, shift);
  shape.AddRef();
  for (const used of [zero, upright, shift, compound]) jolt.destroy(used);
  return shape;
}

class JoltWorld {
  drags = new Drags();
  placed = [];
  boxes = [];
  poses = new Float32Array(0);
  stepMs = 0;

  constructor(jolt, options) {
    this.jolt = jolt;
    Object.assign(this, start(jolt, options));
    this.impulse = new jolt.Vec3();
    this.place = new jolt.RVec3();
  }

  settings(shape, position, rotation, motion, layer) {
    const { jolt } = this;
    const at = new jolt.RVec3(...position);
    const turn = new jolt.Quat(...rotation);
    const settings = new jolt.BodyCreationSettings(shape, at, turn, motion, layer);
    settings.mFriction = kFriction;
    settings.mRestitution = 0;
    jolt.destroy(at);
    jolt.destroy(turn);
    return settings;
  }

  add(settings) {
    const body = this.bodies.CreateBody(settings);
    this.jolt.destroy(settings);
    this.bodies.AddBody(body.GetID(), this.jolt.EActivation_Activate);
    return body;
  }

  addBody({ shape, properties }, { position, rotation, linearVelocity = [0, 0, 0] }) {
    const { jolt } = this;
    const settings = this.settings(shape, position, rotation, jolt.EMotionType_Dynamic, kMoving);
    settings.mLinearVelocity.Set(...linearVelocity);
    settings.mOverrideMassProperties = jolt.EOverrideMassProperties_MassAndInertiaProvided;
    settings.mMassPropertiesOverride.mMass = properties.mass;
    const { inertia } = properties;
    for (let k = 0; k < 3; ++k) {
      const column = new jolt.Vec4(inertia[0][k], inertia[1][k], inertia[2][k], 0);
      settings.mMassPropertiesOverride.mInertia.SetColumn4(k, column);
      jolt.destroy(column);
    }
    this.poses = new Float32Array(7 * (this.placed.length + 1));
    return this.placed.push({ body: this.add(settings), properties }) - 1;
  }

  addBox(halfExtents, position, rotation) {
    const { jolt } = this;
    const half = new jolt.Vec3(...halfExtents);
    const shape = new jolt.BoxShape(half, Math.min(kConvexRadius, ...halfExtents));
    jolt.destroy(half);
    this.boxes.push(this.add(this.settings(shape, position, rotation, jolt.EMotionType_Static, kStill)));
  }

  step() {
    for (const [index, grip] of this.drags) this.pull(this.placed[index], grip);
    const start = performance.now();
    this.machine.Step(this.timeStep, 1);
    this.stepMs = performance.now() - start;
  }

  pull({ body, properties }, grip) {
    const q = body.GetRotation();
    const rotation = [q.GetX(), q.GetY(), q.GetZ(), q.GetW()];
    const of = (v) => [v.GetX(), v.GetY(), v.GetZ()]; // read at once: the module may use one place for several answers
    const center = of(body.GetCenterOfMassPosition());
    const velocity = of(body.GetLinearVelocity());
    const state = { center, rotation, velocity, angularVelocity: of(body.GetAngularVelocity()) };
    const { at, impulse } = dragImpulse(state, grip, properties, this.timeStep);
    this.impulse.Set(...impulse);
    this.place.Set(...at);
    this.bodies.ActivateBody(body.GetID());
    this.bodies.AddImpulse(body.GetID(), this.impulse, this.place);
  }

  transforms() {
    this.placed.forEach(({ body }, index) => {
      const p = body.GetPosition();
      this.poses.set([p.GetX(), p.GetY(), p.GetZ()], 7 * index);
      const q = body.GetRotation();
      this.poses.set([q.GetX(), q.GetY(), q.GetZ(), q.GetW()], 7 * index + 3);
    });
    return this.poses;
  }

  times() {
    return { narrowPhaseMs: null, stepMs: this.stepMs };
  }

  contacts() {
    return null;
  }

  asleep() {
    return this.placed.filter(({ body }) => !body.IsActive()).length;
  }

  drag(index, point, target) {
    this.drags.set(index, point, target);
  }

  free() {
    for (const body of [...this.placed.map(({ body }) => body), ...this.boxes]) {
      this.bodies.RemoveBody(body.GetID());
      this.bodies.DestroyBody(body.GetID());
    }
    for (const used of [this.impulse, this.place, this.machine]) this.jolt.destroy(used);
  }
}

export async function load({ shape } = {}) {
  const kind = chosenShape('Jolt', kShapes, shape);
  const { default: create } = await import('jolt-physics/wasm-compat');
  const jolt = await create();
  return {
    name: 'Jolt',
    version: kVersion,
    shape: kind,
    shapes: kShapes,
    prepare(model) {
      const properties = massProperties(model);
      const shape = compoundOf(jolt, model, properties.center);
      return { shape, properties, free: () => shape.Release() };
    },
    createWorld: (options) => new JoltWorld(jolt, options),
  };
}
