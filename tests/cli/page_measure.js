// SPDX-License-Identifier: BSD-2-Clause
// This script is added to a copy of a study's page. It looks at the page as it is laid out and sends
// lines of text to the page around it: which texts overlap, what leaves the viewport, and where the
// first screen's parts are. With #open it opens all sections first.
(() => {
  const lines = [];

  const isVisible = e => e.checkVisibility({contentVisibilityAuto: true, visibilityProperty: true});

  // Returns the part of a rectangle that the element's ancestors do not cut off.
  function clip(rect, element) {
    const box = {x0: rect.left, y0: rect.top, x1: rect.right, y1: rect.bottom};
    for (let e = element; e && e !== document.body; e = e.parentElement) {
      if (getComputedStyle(e).overflowX === 'visible') continue;
      const r = e.getBoundingClientRect();
      box.x0 = Math.max(box.x0, r.left);
      box.x1 = Math.min(box.x1, r.right);
      box.y0 = Math.max(box.y0, r.top);
      box.y1 = Math.min(box.y1, r.bottom);
    }
    return box.x0 < box.x1 && box.y0 < box.y1 ? box : null;
  }

  // Returns the boxes of all visible texts, a box for each line of text. A box has the height of the
  // font's line, so its upper and lower margins hold no ink.
  function textBoxes() {
    const boxes = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node; (node = walker.nextNode());) {
      const parent = node.parentElement, text = node.textContent.trim();
      if (!text || ['SCRIPT', 'STYLE', 'title'].includes(parent.tagName) || !isVisible(parent))
        continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      const rects = parent.closest('svg') ? [parent.getBoundingClientRect()]
                                          : range.getClientRects();
      for (const rect of rects) {
        const box = clip(rect, parent);
        if (box) boxes.push({...box, node, text: text.slice(0, 40), svg: parent.closest('svg')});
      }
    }
    return boxes;
  }

  function overlap(a, b, margin) {
    return Math.min(a.x1, b.x1) - Math.max(a.x0, b.x0) > 1 &&
           Math.min(a.y1, b.y1) - Math.max(a.y0, b.y0) > margin;
  }

  function reportOverlaps() {
    const texts = textBoxes();
    const margin = 4;  // pixels without ink
    for (let i = 0; i < texts.length; ++i)
      for (let k = i + 1; k < texts.length; ++k)
        if (texts[i].node !== texts[k].node && overlap(texts[i], texts[k], margin))
          lines.push(`overlap: "${texts[i].text}" and "${texts[k].text}"`);
    for (const svg of document.querySelectorAll('svg.chart')) {
      if (!isVisible(svg)) continue;
      for (const mark of svg.querySelectorAll('.point, .whisker, .ring')) {
        const r = mark.getBoundingClientRect();
        const box = {x0: r.left, y0: r.top, x1: r.right, y1: r.bottom};
        // An error bar is a line: its box has no width or no height.
        if (mark.tagName === 'line') {
          box.x0 -= .6, box.x1 += .6, box.y0 -= .6, box.y1 += .6;
        }
        for (const text of texts)
          if (text.svg === svg && overlap(box, {...text, y0: text.y0 + 2, y1: text.y1 - 2}, 1))
            lines.push(`overlap: "${text.text}" and a mark (${mark.getAttribute('class')})`);
      }
    }
    lines.push(`texts: ${texts.length}`);
  }

  function reportOutside() {
    for (const e of document.querySelectorAll('body *')) {
      if (!isVisible(e) || e.closest('svg') !== null && e.tagName !== 'svg') continue;
      const box = clip(e.getBoundingClientRect(), e.parentElement);
      if (box && (box.x1 > innerWidth + 1 || box.x0 < -1))
        lines.push(`outside: ${e.tagName} ${e.className} ${e.textContent.slice(0, 30)}`);
    }
    if (document.scrollingElement.scrollWidth > innerWidth) lines.push('outside: the page scrolls');
  }

  function reportPlaces() {
    lines.push(`viewport: ${innerWidth} ${innerHeight}`);
    for (const selector of ['h1', 'svg.chart', '.poster', '.poster .whole img', '.poster .crop img',
                            '.poster .values', '.poster .crop']) {
      for (const e of document.querySelectorAll(selector)) {
        if (!isVisible(e)) continue;
        const r = e.getBoundingClientRect();
        lines.push(`place: ${selector}: ${Math.round(r.width)} x ${Math.round(r.height)} to ` +
                   `${Math.round(r.right)} ${Math.round(r.bottom)}`);
      }
    }
  }

  addEventListener('load', () => {
    if (location.hash === '#open')
      for (const e of document.querySelectorAll('details')) e.open = true;
    reportPlaces();
    reportOverlaps();
    reportOutside();
    parent.postMessage(lines.join('\n'), '*');
  });
})();
