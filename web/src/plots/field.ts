// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A number in the messages of a topic, and how one is dragged and written. */

export interface Field {
  topic: string;
  path: string; // as in `twist.twist.linear.x` or `ranges[3]`
}

const MIME = 'application/x-amr-field';

/** Its name: "/odom:twist.twist.linear.x". */
export function nameOf({ topic, path }: Field): string {
  return `${topic}:${path}`;
}

/** The vector, array or message that a number is of: `twist.twist.linear` of x, y and z there. */
export function parentOf({ topic, path }: Field): Field {
  return { topic, path: path.replace(/(?:^|\.)[^.[\]]*$|\[\d+\]$/, '') };
}

/** The field that somebody wrote: topic and path with a space, a colon or a slash between; or null. */
export function parseField(text: string): Field | null {
  const [, topic, path] = /^\s*(\/[^\s:]+)(?:\s*:\s*|\s+)([^\s:]+)\s*$/.exec(text) ?? [];
  return topic === undefined || path === undefined ? null : { topic, path };
}

/** Let what is dragged be this field: for whoever shows fields. */
export function dragField(transfer: DataTransfer | null, field: Field): void {
  transfer?.setData(MIME, nameOf(field));
  transfer?.setData('text/plain', nameOf(field));
  if (transfer !== null) {
    transfer.effectAllowed = 'copy';
  }
}

/** Whether what is dragged may be a field; what it is can be read only when it is let go. */
export function isField(transfer: DataTransfer | null): boolean {
  return transfer?.types.includes(MIME) ?? false;
}

export function droppedField(transfer: DataTransfer | null): Field | null {
  return parseField(transfer?.getData(MIME) ?? '');
}

/** The shortest ends of the paths that tell fields apart, beginning at a dot; with the topic if need be. */
export function shortNames(fields: readonly Field[]): string[] {
  return fields.map((field, index) => {
    const others = fields.filter((_, other) => other !== index);
    const parts = field.path.split('.');
    for (let count = Math.min(2, parts.length); count <= parts.length; count += 1) {
      const end = parts.slice(-count).join('.');
      if (!others.some(({ path }) => path === end || path.endsWith(`.${end}`))) {
        return end;
      }
    }
    return nameOf(field);
  });
}
