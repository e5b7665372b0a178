// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** The worker that holds the WebSocket, so that drawing does not hold it up. */
import { WaitingFrames } from './frames';
import type { FromWorker, ToWorker } from './messages';
import { Repeater } from './repeater';

const tell = (message: FromWorker, transfer: Transferable[] = []): void => {
  self.postMessage(message, { transfer });
};
let socket: WebSocket | null = null;
const repeater = new Repeater({
  send: (text) => socket?.readyState === WebSocket.OPEN && socket.send(text),
  left: (seconds) => tell({ kind: 'left', seconds }),
  now: () => performance.now(),
  after: (milliseconds, call) => {
    const timer = setTimeout(call, milliseconds);
    return () => clearTimeout(timer);
  },
});
const waiting = new WaitingFrames((frames) => tell({ kind: 'frames', frames }, frames));

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  switch (data.kind) {
    case 'open':
      socket = open(data.url, data.protocol);
      return;
    case 'send':
      return repeater.send(data.text);
    case 'rest':
      return repeater.rest();
    case 'here':
      return repeater.hear();
    case 'taken':
      repeater.hear();
      return waiting.taken();
  }
};

function open(url: string, protocol: string): WebSocket {
  const opened = new WebSocket(url, protocol);
  opened.binaryType = 'arraybuffer';
  opened.onopen = () => tell({ kind: 'opened' });
  opened.onclose = ({ reason }) => {
    repeater.rest();
    tell({ kind: 'closed', reason });
    self.close(); // a new connection has a worker of its own
  };
  opened.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
    if (typeof data === 'string') {
      tell({ kind: 'text', text: data });
    } else {
      waiting.add(data);
    }
  };
  return opened;
}
