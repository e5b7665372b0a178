// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The drawings on buttons: paths in a square of 16 by 16. */
export const ICONS = {
  play: 'M5 3.5v9l7.5-4.5z',
  pause: 'M4.5 3.5h2.5v9H4.5zM9 3.5h2.5v9H9z',
  record: 'M8 3.5a4.5 4.5 0 1 1 0 9 4.5 4.5 0 0 1 0-9z',
  stop: 'M4 4h8v8H4z',
  step: 'M3.5 3.5v9L9.5 8zM10.5 3.5h2v9h-2z',
  reset: 'M8 2.5V0L4 3.5 8 7V4.3a3.9 3.9 0 1 1-3.9 3.9H2.3A5.7 5.7 0 1 0 8 2.5z',
  theme: 'M8 1.5a6.5 6.5 0 1 0 0 13zM8 1.5v1.3a5.2 5.2 0 0 1 0 10.4v1.3a6.5 6.5 0 0 0 0-13z',
  panels: 'M2 3h12v2H2zM2 7h12v2H2zM2 11h12v2H2z',
  close: 'M3 4.4 4.4 3 8 6.6 11.6 3 13 4.4 9.4 8l3.6 3.6-1.4 1.4L8 9.4 4.4 13 3 11.6 6.6 8z',
  down: 'M3 5.5 8 10.5l5-5z',
  up: 'M3 10.5 8 5.5l5 5z',
  copy: 'M5 1h8a1 1 0 0 1 1 1v9h-1.5V2.5H5zM3 4h7a1 1 0 0 1 1 1v9a1 1 0 0 1-1 1H3a1 1 0 0 1-1-1V5a1 1 0 0 1 1-1zm.5 1.5v8h6v-8z',
  done: 'M6.3 13 1.5 8.2l1.4-1.4 3.4 3.4 7-7 1.4 1.4z',
  // Where a tool stands: in the window, the part that it takes.
  beside: 'M1 2h14v12H1zm1.3 1.3v9.4h11.4V3.3zM7.5 4.5h5v7h-5z',
  below: 'M1 2h14v12H1zm1.3 1.3v9.4h11.4V3.3zM3.5 8.5h9v3h-9z',
  column: 'M1 2h14v12H1zm1.3 1.3v9.4h11.4V3.3zM10.5 4.5h2v7h-2z',
  layout: 'M1 2h14v12H1zm1.3 1.3v9.4h11.4V3.3zM7.4 3h1.2v10H7.4zM8 7.4h6v1.2H8z',
  // Of tabs, by the names of their panels.
  model: 'M8 1 14 4.3v7.4L8 15 2 11.7V4.3zm0 1.7L4.7 4.5 8 6.3l3.3-1.8zM3.5 5.7v5.1l3.8 2.1V7.8zm9 0L8.8 7.8v5.1l3.7-2.1z',
  joints: 'M2 3.2h6.2a2 2 0 0 1 3.6 0H14v1.6h-2.2a2 2 0 0 1-3.6 0H2zm0 4h1.2a2 2 0 0 1 3.6 0H14v1.6H6.8a2 2 0 0 1-3.6 0H2zm0 4h7.2a2 2 0 0 1 3.6 0H14v1.6h-1.2a2 2 0 0 1-3.6 0H2z',
  sensors: 'M8 6.5a1.5 1.5 0 1 1 0 3 1.5 1.5 0 0 1 0-3zM4.8 4.8l1 1a3.1 3.1 0 0 0 0 4.4l-1 1a4.5 4.5 0 0 1 0-6.4zm6.4 0a4.5 4.5 0 0 1 0 6.4l-1-1a3.1 3.1 0 0 0 0-4.4zM2.7 2.7l1 1a6.1 6.1 0 0 0 0 8.6l-1 1a7.5 7.5 0 0 1 0-10.6zm10.6 0a7.5 7.5 0 0 1 0 10.6l-1-1a6.1 6.1 0 0 0 0-8.6z',
  frames: 'M7.2 1.5 9.5 4H8v5l4.4 2.2.6-1.3 1.6 3-3.3.7.6-1.3L7.4 10.2 3 12.9l.7 1.2-3.4-.4 1.4-3.1.7 1.1 4.1-2.5V4H5z',
  simulation: 'M8 1.2a6.8 6.8 0 1 1 0 13.6A6.8 6.8 0 0 1 8 1.2zm0 1.5a5.3 5.3 0 1 0 0 10.6A5.3 5.3 0 0 0 8 2.7zM6.4 5l5 3-5 3z',
  control: 'M6.9 1h2.2l.4 1.9 1.3.6 1.7-1 1.5 1.5-1 1.7.6 1.3 1.9.4v2.2l-1.9.4-.6 1.3 1 1.7-1.5 1.5-1.7-1-1.3.6L9.1 15H6.9l-.4-1.9-1.3-.6-1.7 1L2 12l1-1.7L2.4 9 .5 8.6V7.4L2.4 7 3 5.7 2 4l1.5-1.5 1.7 1 1.3-.6zM8 5.3a2.7 2.7 0 1 0 0 5.4 2.7 2.7 0 0 0 0-5.4z',
  health: 'M1 7.2h3.2l1.9-4.7h1.5l2.3 7.6 1.2-2.9H15v1.6h-2.8l-1.8 4.6H8.9L6.7 6 5.3 8.8H1z',
  plots: 'M2 2h1.5v10.5H14V14H2zm9.9 2.3 1.2 1-3.5 4.3-2.5-2.2-1.8 2.3-1.2-1L6.9 5.3l2.5 2.2z',
  topics: 'M2 3h12v1.5H2zm0 4.2h7v1.5H2zm0 4.3h12V13H2zM11.5 5.7 14 8l-2.5 2.3z',
  services: 'M1.5 3.5h8V1.2L14.5 4.3 9.5 7.4V5h-8zM14.5 11h-8V8.6L1.5 11.7l5 3.1v-2.3h8z',
  log: 'M3 1.5h7L13.5 5v9.5H3zm1.5 1.5v10H12V6H9V3zM6 7.5h4.5V9H6zm0 2.7h4.5v1.5H6z',
  parameters: 'M2 4h7.2a2 2 0 0 1 3.9 0H14v1.5h-.9a2 2 0 0 1-3.9 0H2zm0 6.5h.9a2 2 0 0 1 3.9 0H14V12H6.8a2 2 0 0 1-3.9 0H2z',
  graph: 'M3.5 1.5a2 2 0 0 1 1.9 2.6l3.4 2.6a2 2 0 1 1 0 2.6l-3.4 2.6a2 2 0 1 1-.9-1.2l3.3-2.5a2 2 0 0 1 0-.4L4.5 5.3A2 2 0 1 1 3.5 1.5z',
  plus: 'M7 2.5h2V7h4.5v2H9v4.5H7V9H2.5V7H7z',
  range: 'M8 0.5 11.5 4H9v8h2.5L8 15.5 4.5 12H7V4H4.5z',
} as const;

export type IconName = keyof typeof ICONS;
