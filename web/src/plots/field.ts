// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** A number in the messages of a topic, what is made of it, and how one is dragged and written. */

/** Its change per second; without its noise, of first order; less another number. */
export type Step = { by: 'd' } | { by: 'lowpass'; seconds: number } | { by: 'minus'; other: Field };

export interface Field {
  topic: string;
  path: string; // as in `twist.twist.linear.x` or `ranges[3]`
  steps?: readonly Step[]; // what is made of it, one after the other
}

const MIME = 'application/x-amr-field';

/** Its name: "/odom:twist.twist.linear.x", "/imu:angular_velocity.z~lowpass=0.5~d". */
export function nameOf(field: Field): string {
  return `${field.topic}:${field.path}${stepsText(field)}`;
}

/** What is made of it, as it is written behind it. */
export function stepsText({ steps = [] }: Field): string {
  return steps
    .map((step) => {
      switch (step.by) {
        case 'd':
          return '~d';
        case 'lowpass':
          return `~lowpass=${step.seconds}`;
        case 'minus':
          return `~minus=${nameOf(step.other)}`;
      }
    })
    .join('');
}

/** The vector, array or message that a number is of: `twist.twist.linear` of x, y and z there. */
export function parentOf(field: Field): Field {
  return { ...field, path: field.path.replace(/(?:^|\.)[^.[\]]*$|\[\d+\]$/, '') };
}

/**
 * The field that somebody wrote: topic and path with a space, a colon or a slash between; behind it
 * what is made of it: "~ d", "~ lowpass 0.5" (s), "~ minus /truth x". Null: it is none.
 */
export function parseField(text: string): Field | null {
  const [first = '', ...rest] = text.split('~');
  const [, topic, path] = /^\s*(\/[^\s:]+)(?:\s*:\s*|\s+)([^\s:]+)\s*$/.exec(first) ?? [];
  const steps = rest.map(parseStep);
  if (topic === undefined || path === undefined || steps.includes(null)) {
    return null;
  }
  return { topic, path, ...(steps.length > 0 && { steps: steps as Step[] }) };
}

function parseStep(text: string): Step | null {
  const [, by, of = ''] = /^\s*(\w+)\s*[=\s]?(.*)$/.exec(text) ?? [];
  const other = by === 'minus' ? parseField(of) : null;
  if (other !== null) {
    return { by: 'minus', other };
  }
  if (by === 'lowpass' && Number(of) > 0 && Number.isFinite(Number(of))) {
    return { by, seconds: Number(of) };
  }
  return by === 'd' && of.trim() === '' ? { by } : null;
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
  return fields.map((field) => {
    const others = fields.filter(({ topic, path }) => topic !== field.topic || path !== field.path);
    const parts = field.path.split('.');
    for (let count = Math.min(2, parts.length); count <= parts.length; count += 1) {
      const end = parts.slice(-count).join('.');
      if (!others.some(({ path }) => path === end || path.endsWith(`.${end}`))) {
        return end + stepsText(field);
      }
    }
    return nameOf(field);
  });
}
