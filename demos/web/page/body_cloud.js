// SPDX-License-Identifier: GPL-3.0-or-later
//
// All bodies of a scene as three.js draws them: one instanced mesh for each model.
import { BufferAttribute, BufferGeometry, Color, Group, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion, Vector3 } from 'three';
import { kBodyColors } from './colors.js';
import { randomFrom } from './scene_plan.js';

const kHeld = new Color('#f08a24');
const kBright = 0.25; // how far the chosen body goes towards white

function geometryOf({ vertices, indices }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(vertices, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  geometry.computeVertexNormals();
  return geometry;
}

export class BodyCloud {
  object = new Group();
  /// models: meshes; bodies: the index of each one's model.
  constructor(models, bodies) {
    this.material_ = new MeshLambertMaterial();
    this.places_ = bodies.map(() => null);
    this.meshes_ = models.map((model, index) => this.meshOf(model, bodies, index));
    const random = randomFrom(7);
    this.colors_ = bodies.map(() => new Color(kBodyColors[Math.floor(random() * kBodyColors.length)]));
    this.matrix_ = new Matrix4();
    this.colors_.forEach((color, index) => this.paint(index, color));
  }

  meshOf(model, bodies, index) {
    const own = bodies.flatMap((of, body) => (of === index ? [body] : []));
    const mesh = new InstancedMesh(geometryOf(model), this.material_, own.length);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    mesh.userData.bodies = own;
    own.forEach((body, slot) => (this.places_[body] = { mesh, slot }));
    if (own.length > 0) this.object.add(mesh);
    return mesh;
  }

  get count() {
    return this.places_.length;
  }

  paint(body, color) {
    const { mesh, slot } = this.places_[body];
    mesh.setColorAt(slot, color);
    mesh.instanceColor.needsUpdate = true;
  }

  /// Shows which body is chosen and whether a hand holds it; null for none.
  mark(body, isHeld) {
    if (this.marked_ !== undefined && this.marked_ !== null) this.paint(this.marked_, this.colors_[this.marked_]);
    this.marked_ = body;
    if (body !== null) this.paint(body, isHeld ? kHeld : this.colors_[body].clone().lerp(kHeld, 0.55).lerp(new Color('#fff'), kBright));
  }

  /// Seven numbers a body: position and rotation.
  place(poses) {
    const [position, rotation, size] = [new Vector3(), new Quaternion(), new Vector3(1, 1, 1)];
    this.poses_ = poses;
    this.places_.forEach(({ mesh, slot }, body) => {
      position.fromArray(poses, 7 * body);
      rotation.fromArray(poses, 7 * body + 3);
      mesh.setMatrixAt(slot, this.matrix_.compose(position, rotation, size));
    });
    for (const mesh of this.meshes_) {
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null; // of where bodies were, for picking
    }
  }

  get poses() {
    return this.poses_;
  }

  /// The nearest body on a ray, with the place that was hit in the world and in the body; null for none.
  hit(raycaster) {
    const [first] = raycaster.intersectObjects(this.object.children, false);
    if (!first) return null;
    const body = first.object.userData.bodies[first.instanceId];
    return { body, place: first.point, point: this.inBody(body, first.point) };
  }

  inBody(body, place) {
    const rotation = new Quaternion().fromArray(this.poses_, 7 * body + 3).invert();
    return place.clone().sub(this.middleOf(body)).applyQuaternion(rotation);
  }

  inWorld(body, point) {
    return point.clone().applyQuaternion(new Quaternion().fromArray(this.poses_, 7 * body + 3)).add(this.middleOf(body));
  }

  middleOf(body) {
    return new Vector3().fromArray(this.poses_, 7 * body);
  }

  free() {
    this.meshes_.forEach((mesh) => {
      mesh.geometry.dispose();
      mesh.dispose();
    });
    this.material_.dispose();
  }
}
