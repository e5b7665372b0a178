// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Rows that scroll sideways show it: `data-more` says at which ends there is more. */

const SLACK = 2; // px that rounding may leave

/** Which ends of a scrolled row hide something. */
export function hiddenEnds(scrolled: number, shown: number, whole: number): string {
  const ends = [scrolled > SLACK ? 'left' : '', scrolled + shown < whole - SLACK ? 'right' : ''];
  return ends.filter((end) => end !== '').join(' ');
}

/** Have a row tell where there is more of it, and let a mouse wheel scroll it. */
export function showOverflow(row: HTMLElement): void {
  const mark = (): void => {
    row.dataset.more = hiddenEnds(row.scrollLeft, row.clientWidth, row.scrollWidth);
  };
  row.addEventListener('scroll', mark, { passive: true });
  row.addEventListener('wheel', (event) => {
    if (event.deltaX === 0 && row.scrollWidth > row.clientWidth + SLACK) {
      row.scrollLeft += event.deltaY;
      event.preventDefault();
    }
  });
  const sizes = new ResizeObserver(mark);
  const watch = (): void => {
    sizes.observe(row);
    for (const child of row.children) {
      sizes.observe(child);
    }
    mark();
  };
  new MutationObserver(watch).observe(row, { childList: true });
  watch();
}
