// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page's end of the engine's worker.

export class EngineLink {
  /// `onScene(engine, hasBudget)` when a scene stands, `onFrame(frame)` at most once for each `shown()`, `onFault(message)`.
  constructor({ onScene, onFrame, onFault }) {
    this.worker_ = new Worker(new URL('./engine_worker.js', import.meta.url), { type: 'module' });
    this.scene_ = 0; // number of the scene asked for last
    this.standing_ = 0; // and of the one that stands
    this.worker_.onmessage = ({ data }) => {
      if (data.did === 'fault') return onFault(data.message);
      if (data.number !== this.scene_) return undefined; // of a scene that nobody wants any more
      if (data.did === 'frame') return onFrame(data);
      this.standing_ = data.number;
      return onScene(data);
    };
    this.worker_.onerror = (event) => onFault(event.message || 'The engine could not be started; reload the page.');
  }

  /// Whether the scene asked for last stands.
  get isCurrent() {
    return this.standing_ === this.scene_;
  }

  start(id, scene) {
    this.scene_ += 1;
    this.worker_.postMessage({ do: 'scene', id, number: this.scene_, scene });
  }

  tell(action, what = {}) {
    this.worker_.postMessage({ do: action, ...what });
  }
}
