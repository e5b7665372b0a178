// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The colours of the scene, for a light and a dark page; sRGB. */

export type Theme = 'light' | 'dark';

/** What the page's plots and legends share with the scene: one colour a thing, in both themes. */
export const TRUTH_COLOUR = '#0fa3b1';
export const ODOMETRY_COLOUR = '#f2811d';

export interface Palette {
  horizon: string; // what far things fade to
  zenith: string;
  ground: string; // an endless plane
  gridMinor: string;
  gridMajor: string;
  edge: string; // outlines of the world's shapes
  edgeOpacity: number;
  partEdge: string; // outlines of a robot's primitives
  partEdgeOpacity: number;
  axes: [string, string, string]; // x, y, z
  tree: string; // from a frame to its parent
  label: string;
  labelFixed: string; // the fixed frame's
  labelBack: string;
  contact: string; // load under a wheel
  slip: string;
  scans: [string, string, string]; // of one lidar after the other
  distance: string; // what a range finder sees
  touch: string; // where shapes touch
  highlight: string;
  collision: string;
  sun: number; // candela-free units of three.js: pi lights a white surface to white
  sky: number;
  shadow: number; // how dark the ground is where the sun does not shine, 0..1
}

export const PALETTES: Readonly<Record<Theme, Palette>> = {
  light: {
    horizon: '#e9edf1',
    zenith: '#c9d6e3',
    ground: '#dfe4e9',
    gridMinor: '#bcc6d1',
    gridMajor: '#8896a6',
    edge: '#26323f',
    edgeOpacity: 0.28,
    partEdge: '#ffffff',
    partEdgeOpacity: 0.35,
    axes: ['#e03a3a', '#22a047', '#2f6fed'],
    tree: '#8a6d1f',
    label: '#1d2733',
    labelFixed: '#0b5cad',
    labelBack: 'rgba(255, 255, 255, 0.78)',
    contact: '#1f9d55',
    slip: '#d6246e',
    scans: ['#e11d2e', '#7a3ff2', '#0b7a3b'],
    distance: '#7a3ff2',
    touch: '#e11d2e',
    highlight: '#ff9d00',
    collision: '#d97706',
    sun: 2.3,
    sky: 1.7,
    shadow: 0.26,
  },
  dark: {
    horizon: '#161b21',
    zenith: '#0d1116',
    ground: '#20262e',
    gridMinor: '#3a4450',
    gridMajor: '#5a6878',
    edge: '#dbe6f2',
    edgeOpacity: 0.22,
    partEdge: '#ffffff',
    partEdgeOpacity: 0.4,
    axes: ['#ff5c5c', '#46cf6f', '#6b9dff'],
    tree: '#d9b650',
    label: '#e8eef5',
    labelFixed: '#7cc0ff',
    labelBack: 'rgba(16, 21, 27, 0.74)',
    contact: '#3ddc84',
    slip: '#ff5fa2',
    scans: ['#ff4d5e', '#b48cff', '#4be08a'],
    distance: '#b48cff',
    touch: '#ff4d5e',
    highlight: '#ffb02e',
    collision: '#f59e0b',
    sun: 2.0,
    sky: 1.5,
    shadow: 0.5,
  },
};
