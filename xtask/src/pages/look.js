(async () => {
  const page = document.documentElement;
  const name = e => e.tagName.toLowerCase() + (e.id ? '#' + e.id : '') + (e.className && e.className.baseVal === undefined ? '.' + e.className : '');
  const scrolls = e => { for (; e && e !== document.body; e = e.parentElement) if (getComputedStyle(e).overflowX !== 'visible') return true; return false; };
  const wide = () => [...document.body.querySelectorAll('*')]
    .filter(e => !(e instanceof SVGElement && e.tagName !== 'svg') && e.getBoundingClientRect().right > page.clientWidth + 0.5 && !scrolls(e.parentElement)).map(name);
  const folded = [...document.querySelectorAll('details')];
  const overflow = () => page.scrollWidth > page.clientWidth ? wide().slice(0, 5).concat('scrollWidth ' + page.scrollWidth) : [];
  const closed = overflow();
  folded.forEach(d => { d.open = true; });
  const opened = overflow();
  const clipped = [...document.querySelectorAll('svg')].filter(s => s.getBoundingClientRect().width > 0).flatMap(svg => {
    const box = svg.getBoundingClientRect();
    return [...svg.querySelectorAll('text')].filter(t => {
      const b = t.getBoundingClientRect();
      return b.left < box.left - 1 || b.right > box.right + 1 || b.top < box.top - 1 || b.bottom > box.bottom + 1;
    }).map(t => (svg.querySelector('title') || {}).textContent + ': ' + t.textContent);
  });
  const overlapping = [...document.querySelectorAll('svg')].filter(s => s.getBoundingClientRect().width > 0).flatMap(svg => {
    const all = [...svg.querySelectorAll('text')].map(t => [t, t.getBoundingClientRect()]).filter(([, b]) => b.width > 0);
    const meet = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 4;
    return all.flatMap(([t, a], i) => all.slice(i + 1).filter(([, b]) => meet(a, b))
      .map(([u]) => (svg.querySelector('title') || {}).textContent + ': ' + t.textContent + ' | ' + u.textContent));
  });
  const small = [...document.querySelectorAll('svg text')].filter(t => t.getBoundingClientRect().width > 0)
    .map(t => parseFloat(getComputedStyle(t).fontSize) * (t.ownerSVGElement.getBoundingClientRect().width / t.ownerSVGElement.viewBox.baseVal.width));
  const found = await axe.run(document, { resultTypes: ['violations'] });
  folded.forEach(d => { d.open = false; });
  return {
    inner: innerWidth,
    height: page.scrollHeight,
    overflow: closed.concat(opened),
    clipped,
    overlapping,
    smallest: small.length ? Math.min(...small) : 0,
    axe: found.testEngine.version,
    findings: found.violations.map(v => ({ id: v.id, impact: v.impact, nodes: v.nodes.length, help: v.help, first: v.nodes[0].target.join(' ') }))
  };
})()
