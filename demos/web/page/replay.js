// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shows a run again: bodies as they lay, or rocks along their trajectories.
import { BufferAttribute, BufferGeometry, Group, IcosahedronGeometry, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, MeshLambertMaterial, Vector3 } from 'three';
import { BodyCloud } from './body_cloud.js';
import { pitFor } from './scene_plan.js';
import { placeAt } from './trajectories.js';

/// The last frame at or before a time.
function frameAt(times, time) {
  let [low, high] = [0, times.length];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

class BodyReplay {
  constructor(stage, run, models) {
    this.run_ = run;
    this.duration = run.times.at(-1);
    this.cloud_ = new BodyCloud(run.models.map((name) => models.find((model) => model.name === name)), run.bodies);
    this.object = this.cloud_.object;
    this.about = `${run.bodies.length} bodies, ${run.engine}`;
    stage.showPit(pitFor(run.bodies.length));
  }

  show(time) {
    this.cloud_.place(this.run_.frames[frameAt(this.run_.times, time)]);
  }

  free() {
    this.cloud_.free();
  }
}

function linesOf(tracks) {
  const points = tracks.flatMap(({ places }) => places.slice(1).flatMap((place, k) => [...places[k], ...place]));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(points), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: '#b0713c', transparent: true, opacity: 0.45 }));
}

class TrackReplay {
  constructor(stage, { tracks, duration }) {
    this.tracks_ = tracks;
    this.duration = duration;
    this.about = `${tracks.length} rocks, trajectories`;
    this.lines_ = linesOf(tracks);
    this.rocks_ = new InstancedMesh(new IcosahedronGeometry(0.5, 1), new MeshLambertMaterial({ color: '#a39684', flatShading: true }), tracks.length);
    this.rocks_.castShadow = true;
    this.rocks_.frustumCulled = false;
    this.object = new Group().add(this.lines_, this.rocks_);
    this.lines_.geometry.computeBoundingBox();
    const { min, max } = this.lines_.geometry.boundingBox;
    // Rocks are drawn at least so large that they can be seen beside the slope.
    this.least_ = min.distanceTo(max) / 120;
    stage.showBox(min, max);
  }

  show(time) {
    const [matrix, place] = [new Matrix4(), new Vector3()];
    this.tracks_.forEach((track, index) => {
      const size = Math.max(track.size, this.least_);
      place.fromArray(placeAt(track, time));
      this.rocks_.setMatrixAt(index, matrix.makeScale(size, size, size).setPosition(place));
    });
    this.rocks_.instanceMatrix.needsUpdate = true;
  }

  free() {
    for (const object of [this.lines_, this.rocks_]) {
      object.geometry.dispose();
      object.material.dispose();
    }
  }
}

export const makeReplay = (stage, run, models) => (run.kind === 'tracks' ? new TrackReplay(stage, run) : new BodyReplay(stage, run, models));
