// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page's end of the engine's worker.

export class EngineLink {
  /// `onScene(engine, hasBudget)` when a scene stands, `onFrame(frame)` at most once for each `shown()`, `onFault(message)`.
  constructor({ onScene, onFrame, onFault }) {
    this.worker_ = new Worker(new URL('./engine_worker.js', import.meta.url), { type: 'module' });
    this.scene_ = 0;
    this.ready_ = 0;
    this.worker_.onmessage = ({ data }) => {
      if (data.did === 'fault') return onFault(data.message);
      if (data.did === 'scene') {
        this.ready_ += 1;
        return this.isCurrent && onScene(data);
      }
      return this.isCurrent && onFrame(data);
    };
    this.worker_.onerror = (event) => onFault(event.message || 'The engine could not be started; reload the page.');
  }

  /// Whether what arrives belongs to the scene asked for last.
  get isCurrent() {
    return this.ready_ === this.scene_;
  }

  start(id, scene) {
    this.scene_ += 1;
    this.worker_.postMessage({ do: 'scene', id, scene });
  }

  tell(action, what = {}) {
    this.worker_.postMessage({ do: action, ...what });
  }

  end() {
    this.worker_.terminate();
  }
}
