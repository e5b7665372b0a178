// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The colours of the scene, for a light and a dark page; sRGB. */

export type Theme = 'light' | 'dark';

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
  truth: string; // of one robot, as in the plots (style/tokens.css)
  odometry: string;
  robots: readonly string[]; // of several robots: 3 : 1 or more against the ground
  robotText: string; // on these
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
  path: string; // and goals
  pose: string; // where a robot believes it is
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
    truth: '#066570',
    odometry: '#c64a06',
    robots: ['#1c56c4', '#b0246f', '#1a7340', '#8f4a00', '#6a3fc0', '#0a6d7a', '#5f6200', '#4b5a69'],
    robotText: '#ffffff',
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
    path: '#0f7f3f',
    pose: '#1c56c4',
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
    truth: '#35d0de',
    odometry: '#ee7f22',
    robots: ['#6b9dff', '#ff6aa8', '#46cf82', '#f0a83c', '#b295ff', '#3fc5d3', '#d0cc4a', '#a9b7c6'],
    robotText: '#10151b',
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
    path: '#4be08a',
    pose: '#6b9dff',
    highlight: '#ffb02e',
    collision: '#f59e0b',
    sun: 2.0,
    sky: 1.5,
    shadow: 0.5,
  },
};
