(() => {
  // a hand on figures of the simulation's page: its actions, and what it sees
  const figure = title => {
    const frame = [...document.querySelectorAll('figure')].find(f => f.querySelector('h3').textContent === title);
    const paper = [...frame.querySelectorAll('svg.plot')].find(s => s.getBoundingClientRect().width > 0);
    const plot = paper.querySelector('g[data-x]'), [width] = plot.dataset.plot.split(' ').map(Number);
    const touch = (type, share) => {
      const from = plot.getScreenCTM();
      plot.querySelector('.touch').dispatchEvent(new PointerEvent(type, { clientX: from.e + from.a * width * share, clientY: from.f, pointerType: 'mouse', bubbles: true }));
    };
    const select = unit => {
      const list = [...frame.querySelectorAll('select')].find(select => [...select.options].some(option => option.text === unit));
      list.value = unit;
      list.dispatchEvent(new Event('change'));
    };
    return {
      frame, plot, touch, select,
      ends: plot.dataset.x.split(' ').map(Number),
      values: () => [...frame.querySelectorAll('.readout b')].map(b => Number(b.textContent.split(' ')[0].replace('\u2212', '-'))),
      lines: () => [...plot.querySelectorAll('path.line')].map(path => path.getAttribute('d')),
      ticks: () => [...plot.children].filter(child => child.tagName === 'text').map(text => text.textContent).sort(),
      button: name => [...frame.querySelectorAll('button')].find(b => b.textContent === name).click(),
    };
  };
  const pairs = path => path.match(/[-.\d]+ [-.\d]+/g).map(pair => pair.split(' ').map(Number));

  const course = figure('Chamber and spool temperature'), { plot, touch, values, lines, ticks, button } = course;
  const number = text => Number(text.replace('\u2212', '-'));
  const rows = [...course.frame.nextElementSibling.querySelectorAll('tbody tr')].map(row => [...row.children].map(cell => number(cell.textContent)));
  const before = lines().join(), marked = ticks().join();
  const [bottom, top] = plot.dataset.y.split(' ').map(Number), [low, high] = course.ends;
  let farthest = 0;
  for (const [x, ...wanted] of rows.slice(1, -1)) {
    touch('pointermove', (x - low) / (high - low));
    const found = values();
    if (found.length !== wanted.length) return { fault: 'reads ' + course.frame.querySelector('.readout').textContent };
    wanted.forEach((value, n) => { farthest = Math.max(farthest, Math.abs(value - found[n]) / (top - bottom)); });
  }
  button('Closer');
  const closer = [lines().join() !== before, ticks().length];
  button('Whole');
  touch('pointerdown', 0.2);
  touch('pointermove', 0.5);
  touch('pointerup', 0.5);
  touch('pointermove', 0);
  const stretch = [0, 1].map(share => { touch('pointermove', share); return number(course.frame.querySelector('.readout').textContent.split(' ')[0]); })
    .map(x => (x - low) / (high - low));
  const celsius = values()[0];
  course.select('K');
  const kelvin = values()[0] - celsius;
  course.select('°C');
  const box = course.frame.querySelector('input[type=checkbox]');
  box.click();
  const one = [values().length, plot.querySelector('[data-name]').style.display];
  box.click();
  button('Whole');
  const whole = lines().join() === before && ticks().join() === marked;

  // a straight line is read between its two points
  const straight = figure("Bias against the spool's temperature rate");
  const [from, middle, to] = [0, 0.3, 1].map(share => { straight.touch('pointermove', share); return straight.values()[0]; });
  // marks stay on their line, on both papers
  const convergence = figure('Convergence of the steady sensitivity');
  convergence.button('Closer');
  const off = Math.max(...[...convergence.frame.querySelectorAll('[data-name]')].flatMap(group => {
    const own = [...group.querySelectorAll('circle')], points = pairs(group.querySelector('path.line').getAttribute('d'));
    return own.flatMap((mark, n) => {
      const moved = pairs(mark.getAttribute('transform'))[0];
      return ['cx', 'cy'].map((of, k) => Math.abs(Number(mark.getAttribute(of)) + moved[k] - points[n][k]));
    });
  }));
  const differences = [...figure('Temperature along the fibre').frame.querySelectorAll('option')].some(option => option.text === 'K' && option.parentElement.value === 'K');
  return { rows: rows.length, farthest, closer, stretch, kelvin, one, whole, bent: Math.abs(middle - 0.7 * from - 0.3 * to) / Math.abs(to - from), off, differences };
})()
