// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What drags in the view do to the robots of a simulator. */
import { ask, type App } from './app';
import type { Hands } from './scene/grip';

/** Null where nothing simulates. */
export function handsOf(app: App): Hands | null {
  const { store, connection } = app;
  if (store.simulator === null) {
    return null;
  }
  return {
    push: (robot, link, force, torque) => {
      const entity = store.entityOf(robot);
      if (entity !== null) {
        connection.send({ type: 'push', simulator: entity.simulator, entity: entity.name, link, force, torque });
      }
    },
    place: async (robot, position, yaw) => {
      const entity = store.entityOf(robot);
      if (entity !== null) {
        await ask(app, { type: 'place', ...entity, position, yaw });
      }
    },
  };
}
