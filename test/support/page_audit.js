// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * What a look at the page finds, for tests in a browser; evaluated in the page.
 *
 * auditPage.faults(): sentences about what nobody wants: overflow, texts over one another or cut
 * off, a STOP that cannot be pressed.
 * auditPage.styles(): of each kind of element that is seen, how the style sheet has it look, with
 * colours by the names of their tokens, so that they are the same in both themes.
 */
window.auditPage = (() => {
  /** What is looked at, and what it is where nothing is said of it. */
  const PROPERTIES = {
    display: 'block', listStyleType: 'disc', cursor: 'auto', borderLeftWidth: '0px',
    borderBottomWidth: '0px', borderLeftColor: '--text', backgroundColor: 'rgba(0, 0, 0, 0)',
    color: '--text', fontWeight: '400', textAlign: 'start', overflowX: 'visible',
    overflowY: 'visible', whiteSpace: 'normal', textOverflow: 'clip', position: 'static',
    flexDirection: 'row',
  };
  const LEAST = 2; // px that two texts may share
  const seen = (element) => element.checkVisibility({ opacityProperty: true, visibilityProperty: true });

  function intersection(a, b) {
    const box = {
      left: Math.max(a.left, b.left), right: Math.min(a.right, b.right),
      top: Math.max(a.top, b.top), bottom: Math.min(a.bottom, b.bottom),
    };
    return box.right - box.left > 0 && box.bottom - box.top > 0 ? box : null;
  }

  /** What is seen of a box inside an element, within all that clips it. */
  function clipped(box, element) {
    let found = intersection(box, { left: 0, top: 0, right: innerWidth, bottom: innerHeight });
    for (let each = element; each !== null && found !== null; each = each.parentElement) {
      const { overflowX, overflowY, clipPath } = getComputedStyle(each);
      if (clipPath !== 'none') {
        return null; // for screen readers
      }
      if (overflowX !== 'visible' || overflowY !== 'visible') {
        found = intersection(found, each.getBoundingClientRect());
      }
    }
    return found;
  }

  function textsOf(root) {
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    const texts = [];
    for (let node = walker.nextNode(); node !== null; node = walker.nextNode()) {
      const element = node.parentElement;
      if (node.data.trim() === '' || element.closest('script, option, noscript') || !seen(element)) {
        continue;
      }
      const range = document.createRange();
      range.selectNodeContents(node);
      for (const rect of range.getClientRects()) {
        const box = clipped(rect, element);
        if (box !== null) {
          texts.push({ words: node.data.trim().slice(0, 40), element, box });
        }
      }
    }
    return texts;
  }

  function overlaps() {
    const texts = textsOf(document.body);
    const found = new Set();
    texts.forEach((one, index) => {
      for (const other of texts.slice(index + 1)) {
        const box = one.element === other.element ? null : intersection(one.box, other.box);
        if (box !== null && box.right - box.left > LEAST && box.bottom - box.top > LEAST) {
          found.add(`"${one.words}" is over "${other.words}"`);
        }
        const [left, right] = one.box.left < other.box.left ? [one, other] : [other, one];
        const gap = right.box.left - left.box.right;
        const beside = Math.abs(one.box.top - other.box.top) < 4 && gap > -LEAST && gap < 3;
        if (beside && /\d$/.test(left.words) && /^[-−]?\d/.test(right.words)) {
          found.add(`the numbers ${left.words} and ${right.words} touch`);
        }
      }
    });
    return [...found];
  }

  function cutOff() {
    const found = [];
    for (const element of document.querySelectorAll('body *')) {
      const { overflowX, textOverflow, clipPath } = getComputedStyle(element);
      const hides = overflowX === 'hidden' || overflowX === 'clip';
      const over = element.scrollWidth - element.clientWidth;
      const ownText = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
      if (hides && over > 1 && textOverflow !== 'ellipsis' && ownText && clipPath === 'none' && seen(element)) {
        found.push(`"${element.textContent.trim().slice(0, 40)}" is cut off by ${over} px`);
      }
    }
    return found;
  }

  function outside() {
    const found = [];
    const scrolls = (element) => {
      for (let each = element.parentElement; each !== null; each = each.parentElement) {
        const { overflowX, overflowY } = getComputedStyle(each);
        if (/auto|scroll/.test(overflowX + overflowY)) {
          return true;
        }
      }
      return false;
    };
    for (const element of document.querySelectorAll('button, input, select, a')) {
      const { left, right, top, bottom } = element.getBoundingClientRect();
      const out = left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1;
      if (out && seen(element) && !element.matches('.skip') && !scrolls(element)) {
        found.push(`"${element.innerText || element.title}" is out of the window`);
      }
    }
    return found;
  }

  function stop() {
    const element = document.querySelector('.stop');
    const { left, top, width, height } = element.getBoundingClientRect();
    const hit = document.elementFromPoint(left + width / 2, top + height / 2);
    const size = width >= 100 && height >= 40 ? [] : [`STOP is ${width} by ${height} px`];
    return element.contains(hit) ? size : ['STOP cannot be pressed', ...size];
  }

  function faults() {
    const { scrollWidth } = document.documentElement;
    const over = scrollWidth > innerWidth ? [`the page is ${scrollWidth} px wide, not ${innerWidth}`] : [];
    return [...over, ...stop(), ...overlaps(), ...cutOff(), ...outside()];
  }

  /** Colour as computed -> the token of the style sheet. */
  function tokens() {
    const probe = document.createElement('i');
    document.body.append(probe);
    const names = [...document.styleSheets]
      .flatMap((sheet) => [...sheet.cssRules])
      .filter(({ selectorText }) => selectorText === ':root')
      .flatMap(({ style }) => [...style].filter((name) => name.startsWith('--')));
    const found = new Map();
    for (const name of names) {
      const sheet = new CSSStyleSheet();
      sheet.replaceSync(`i.probe { color: var(${name}) }`);
      document.adoptedStyleSheets.push(sheet);
      probe.className = 'probe';
      const { color } = getComputedStyle(probe);
      document.adoptedStyleSheets.pop();
      if (!found.has(color)) {
        found.set(color, name);
      }
    }
    probe.remove();
    return found;
  }

  function styles() {
    const names = tokens();
    const kinds = {};
    for (const element of document.querySelectorAll('body, body *')) {
      const isDrawn = element.closest('svg, .uplot, .announce, [data-volatile]') !== null;
      if (isDrawn || element.matches('script, option') || !seen(element) || element.matches(':hover')) {
        continue;
      }
      const classes = [...element.classList].sort().map((name) => `.${name}`);
      const { tone } = element.dataset;
      const parent = element.parentElement?.classList[0];
      const own = `${element.localName}${classes.join('')}${tone ? `[${tone}]` : ''}`;
      const kind = parent === undefined || classes.length > 0 ? own : `.${parent} > ${own}`;
      const computed = getComputedStyle(element);
      const look = Object.entries(PROPERTIES)
        .map(([name, usual]) => [name, names.get(computed[name]) ?? computed[name], usual])
        .filter(([, value, usual]) => value !== usual)
        // What a menu does with what is too long for it is the browser's: it differs by version.
        .filter(([name]) => element.localName !== 'select' || !name.startsWith('overflow'))
        .map(([name, value]) => `${name} ${value}`)
        .join('; ');
      (kinds[kind] ??= new Set()).add(look);
    }
    return Object.fromEntries(Object.entries(kinds).map(([kind, looks]) => [kind, [...looks].sort()]));
  }

  return { faults, styles };
})();
