// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What the page and its worker, which holds the WebSocket, say to each other. */

export type ToWorker =
  | { kind: 'open'; url: string; protocol: string } // the first of each worker
  | { kind: 'send'; text: string } // a text frame
  | { kind: 'rest' } // what is repeated is repeated no more
  | { kind: 'here' } // the page is there
  | { kind: 'taken' }; // the last `frames` have been dealt with

export type FromWorker =
  | { kind: 'opened' }
  | { kind: 'closed'; reason: string }
  | { kind: 'text'; text: string }
  | { kind: 'left'; seconds: number } // a `drive` is repeated no more: of the page nothing was heard for so long
  | { kind: 'frames'; frames: ArrayBuffer[] };
