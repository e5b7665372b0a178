// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** `window.amr`: the page in numbers, for tests in a real browser and for the curious. */
import type { App } from './app';
import type { SensorsPanel } from './panels/sensors';
import type { Recorder } from './plots/recorder';
import type { MarkNumbers } from './scene/marks';
import type { NavigationNumbers } from './scene/navigation';
import type { Scene } from './scene/scene';
import type { SensorNumbers } from './scene/sensors';
import type { StateStream } from './stream';
import type { View } from './view';

interface Parts {
  app: App;
  stream: StateStream;
  recorder: Recorder;
  view: View;
  sensors: SensorsPanel;
}

export interface SceneNumbers {
  frames: number; // drawn
  triangles: number; // of the last one
  pose: { x: number; y: number; yaw: number } | null; // of the shown robot in `world`, m and rad
  extent: number[]; // of the robots near the first one, m: least x, y, z, then greatest
  trails: Record<string, [truth: number, odometry: number]>; // points, by robot
  sensors: Record<string, SensorNumbers>; // by topic
  navigation: NavigationNumbers;
  marks: Record<string, MarkNumbers>;
}

export interface Inspection {
  link: string; // connecting, open, waiting
  client: string | null;
  robot: string | null;
  driver: string | null;
  driving: boolean; // a hand on this page drives
  states: number; // that came
  skipped: number; // left out by the node
  stale: number; // of another layout
  bad: number;
  sensed: number; // samples of sensors that came
  pictures: Record<string, number>; // drawn, by topic
  time: number | null; // s, of the latest state
  age: number | null; // ms since it came
  samples: number; // kept for the plots
  notices: number;
  recording: string | null; // the name of the bag that is shown
  place: number | null; // s since its begin
  writing: string | null; // the folder of the bag that the node writes
  scene: SceneNumbers | null; // null without WebGL
}

declare global {
  interface Window {
    amr: { readonly now: Inspection };
  }
}

export function inspect({ app, stream, recorder, view, sensors }: Parts): void {
  const { store, pilot } = app;
  window.amr = {
    get now(): Inspection {
      return {
        link: store.link.state,
        client: store.client,
        robot: store.robot?.id ?? null,
        driver: store.driver?.name ?? null,
        driving: pilot.driving,
        ...stream.counts,
        time: stream.latest?.time ?? null,
        age: stream.latest === null ? null : performance.now() - stream.arrivedAt,
        samples: recorder.length,
        pictures: sensors.drawn,
        notices: store.notices.length,
        recording: store.recording?.name ?? null,
        place: store.playhead?.place ?? null,
        writing: store.writing?.active === true ? store.writing.path : null,
        scene: numbersOf(view.scene, store.robot?.id ?? ''),
      };
    },
  };
}

function numbersOf(scene: Scene | null, robot: string): SceneNumbers | null {
  return scene === null
    ? null
    : {
        ...scene.stats(),
        pose: scene.placeIn('world', robot),
        extent: scene.extent(),
        trails: scene.trailSizes(),
        sensors: scene.sensorNumbers(),
        navigation: scene.navigationNumbers(),
        marks: scene.markNumbers(),
      };
}
