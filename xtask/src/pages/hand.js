(() => {
  // what a hand does to the figure of chamber and thermometer, and what it sees
  const figure = [...document.querySelectorAll('figure')].find(f => f.querySelector('h3').textContent === 'Chamber and spool temperature');
  const paper = [...figure.querySelectorAll('svg.plot')].find(s => s.getBoundingClientRect().width > 0);
  const plot = paper.querySelector('g[data-x]');
  const [low, high] = plot.dataset.x.split(' ').map(Number), [bottom, top] = plot.dataset.y.split(' ').map(Number);
  const number = text => Number(text.replace('\u2212', '-'));
  const said = () => figure.querySelector('.readout').textContent;
  const values = () => (said().split(': ')[1] || '').split('; ').map(part => number(/(\S+) \S+$/.exec(part)[1]));
  const point = x => {
    const from = plot.getScreenCTM(), [width] = plot.dataset.plot.split(' ').map(Number);
    paper.dispatchEvent(new PointerEvent('pointermove', { clientX: from.e + from.a * (x - low) / (high - low) * width, clientY: from.f, bubbles: true }));
  };
  const lines = () => [...plot.querySelectorAll('path.line')].map(path => path.getAttribute('d')).join();
  const ticks = () => [...plot.children].filter(child => child.tagName === 'text').map(text => text.textContent);
  const button = name => [...figure.querySelectorAll('button')].find(b => b.textContent === name).click();
  const rows = [...figure.nextElementSibling.querySelectorAll('tbody tr')].map(row => [...row.children].map(cell => number(cell.textContent)));
  const before = lines();
  let farthest = 0;
  for (const [x, ...wanted] of rows.slice(1, -1)) {
    point(x);
    const found = values();
    if (found.length !== wanted.length) return { fault: 'reads ' + said() };
    wanted.forEach((value, n) => { farthest = Math.max(farthest, Math.abs(value - found[n]) / (top - bottom)); });
  }
  button('Closer');
  const closer = [lines() !== before, ticks().length];
  const celsius = values()[0];
  const unit = [...figure.querySelectorAll('select')].find(select => [...select.options].some(option => option.text === 'K'));
  unit.value = 'K';
  unit.dispatchEvent(new Event('change'));
  const kelvin = values()[0];
  unit.value = '°C';
  unit.dispatchEvent(new Event('change'));
  const box = figure.querySelector('input[type=checkbox]');
  box.click();
  const one = [values().length, plot.querySelector('[data-name]').style.display];
  box.click();
  button('Whole');
  return { rows: rows.length, farthest, closer, kelvin: kelvin - celsius, one, whole: lines() === before };
})()
