'use strict';
// Figures that answer to a hand: values under the pointer, a stretch of the abscissa alone, lines taken away, other units. A page without it shows the same figures.
const hand = root => {
  // units that are known, each group with value = other · factor + offset of its first
  const UNITS = [
    { s: [1], min: [60], h: [3600], d: [86400] },
    { '°/h': [1], '°/s': [3600], 'µrad/s': [0.20626480624709636] },
    { '°C': [1], K: [1, -273.15], '°F': [1 / 1.8, -32 / 1.8] },
    { m: [1], km: [1000] },
    { mm: [1], µm: [1e-3], m: [1e3] },
  ];
  const svg = (tag, attributes) => {
    const made = document.createElementNS(root.querySelector('svg').namespaceURI, tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    return made;
  };
  const element = (tag, properties, ...inside) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...inside);
    return made;
  };
  const numbers = text => text.split(' ').map(Number);
  const sign = text => text.replace(/-/g, '\u2212');
  // along an axis, logarithms where it is logarithmic
  const scale = (range, from, to) => value => from + (value - range[0]) / (range[1] - range[0]) * (to - from);

  // round numbers between two, at most so many, with their labels
  const ticks = (axis, range, most) => {
    const to = v => axis.to(v), back = v => axis.back(v);
    const [low, high] = range.map(to);
    if (axis.log && high - low > 1.5) {
      const step = Math.ceil((high - low) / most), first = Math.ceil(low / step) * step;
      return Array.from({ length: Math.floor((high - first) / step) + 1 }, (_, n) => first + n * step).map(p => [back(p), sign(Number(10 ** p).toPrecision(1).replace(/e\+?/, ' E'))]);
    }
    const [a, b] = axis.log ? [10 ** low, 10 ** high] : [low, high];
    const raw = (b - a) / most, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find(n => n * power >= raw * (1 - 1e-9)) * power;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const first = Math.ceil(a / step - 1e-9);
    return Array.from({ length: Math.max(0, Math.floor(b / step - first + 1e-9) + 1) }, (_, n) => (first + n) * step)
      .map(v => [back(axis.log ? Math.log10(v) : v), sign(digits > 8 ? v.toExponential(2) : v.toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1'))]);
  };

  // one drawing of a panel
  const drawn = plot => {
    const [width, height] = numbers(plot.dataset.plot);
    const lines = [...plot.querySelectorAll('[data-name]')].map(group => {
      const path = group.querySelector('path.line');
      const marks = [...group.children].filter(mark => mark !== path).map(mark => ({ mark }));
      const points = path ? (path.getAttribute('d').match(/[-.\d]+ [-.\d]+/g) || []).map(numbers) : [];
      // a line that turns back has no one value at a place
      const rises = points.length > 1 && points.every(([x], n) => !n || x >= points[n - 1][0]);
      return { group, path, marks, points, rises };
    });
    const texts = [...plot.children].filter(child => child.tagName === 'text');
    const font = parseFloat(plot.ownerSVGElement.getAttribute('font-size'));
    const is = { y: t => t.getAttribute('text-anchor') === 'end', x: t => t.getAttribute('text-anchor') === 'middle' && +t.getAttribute('y') < height + 2 * font };
    const label = { x: texts.find(t => !is.x(t) && !is.y(t)), y: plot.previousElementSibling };
    // what is drawn stays between the axes
    const window = svg('svg', { width, height, overflow: 'hidden' });
    lines[0].group.before(window);
    window.append(...lines.map(line => line.group));
    const cursor = svg('path', { class: 'cursor', d: '' });
    plot.append(cursor);
    return { plot, width, height, lines, texts, is, label, font, cursor, grid: plot.querySelector('.grid'), axis: plot.querySelector('.axis') };
  };

  const figure = (frame, number) => {
    const drawings = [...frame.querySelectorAll('svg.plot')].map(s => [...s.querySelectorAll('g[data-x]')].map(drawn));
    const first = drawings[0];
    if (!first || !first.length) return;
    const axis = (text, label) => {
      const [low, high, log] = numbers(text), unit = (/\[([^\]]+)\]\s*$/.exec(label || '') || [])[1];
      const group = log ? undefined : UNITS.find(group => group[unit]);
      const [factor, offset = 0] = group ? group[unit] : [1];
      const made = { whole: [low, high], log, unit, units: group ? Object.keys(group) : [], shown: unit };
      // between the figure's own unit and the one that is shown
      const conversion = () => (group ? group[made.shown] : [1]);
      made.to = v => { const [f, o = 0] = conversion(); return group ? (v * factor + offset - o) / f : v; };
      made.back = v => { const [f, o = 0] = conversion(); return group ? (v * f + o - offset) / factor : v; };
      return made;
    };
    const said = (panel, of) => (panel.label[of] ? panel.label[of].textContent : '');
    // of panels under one another the last alone names their axis
    const below = n => first.slice(n).map(panel => said(panel, 'x')).find(text => text) || '';
    const panels = first.map((panel, n) => ({ x: axis(panel.plot.dataset.x, below(n)), y: axis(panel.plot.dataset.y, said(panel, 'y')) }));
    const names = [...new Set(first.flatMap(panel => panel.lines.map(line => line.group.dataset.name)).filter(name => name))];
    const hidden = new Set();
    const whole = panels[0].x.whole, together = panels.every(panel => panel.x.whole.join() === whole.join());
    let view = whole, at = null;

    const value = (range, of, size, pixel) => (of === 'x' ? scale([0, size], range[0], range[1])(pixel) : scale([size, 0], range[0], range[1])(pixel));
    // the height of what is seen
    const seen = (n, panel) => {
      const y = panels[n].y;
      if (view === whole) return y.whole;
      const inside = panel.lines.filter(line => !hidden.has(line.group.dataset.name)).flatMap(line => line.points)
        .filter(([px]) => { const v = value(whole, 'x', panel.width, px); return v >= view[0] && v <= view[1]; })
        .map(([, py]) => value(y.whole, 'y', panel.height, py));
      if (!inside.length) return y.whole;
      const low = inside.reduce((a, b) => Math.min(a, b)), high = inside.reduce((a, b) => Math.max(a, b));
      const margin = Math.max((high - low) * 0.05, (y.whole[1] - y.whole[0]) * 1e-3);
      return [low - margin, high + margin];
    };
    const relabel = (panel, of, axis, range, pixel) => {
      panel.texts.filter(panel.is[of]).forEach(t => t.remove());
      const most = of === 'x' ? panel.width / (6 * panel.font) : panel.height / (3 * panel.font);
      const made = ticks(axis, range, Math.max(2, most)).map(([v, text]) => {
        const p = pixel(v);
        const place = of === 'x' ? { x: p.toFixed(1), y: (panel.height + 1.4 * panel.font).toFixed(1), 'text-anchor': 'middle' }
          : { x: (-0.5 * panel.font).toFixed(1), y: (p + 0.35 * panel.font).toFixed(1), 'text-anchor': 'end' };
        const t = svg('text', place);
        t.textContent = text;
        panel.plot.append(t);
        return [t, p];
      });
      panel.texts = panel.texts.filter(t => !panel.is[of](t)).concat(made.map(([t]) => t));
      return made.map(([, p]) => (of === 'x' ? `M${p.toFixed(1)} 0V${panel.height}` : `M0 ${p.toFixed(1)}H${panel.width}`)).join('');
    };
    const draw = () => drawings.forEach(drawing => drawing.forEach((panel, n) => {
      const { x, y } = panels[n], high = seen(n, first[n]);
      const across = scale(view, 0, panel.width), up = scale(high, panel.height, 0);
      const moved = ([px, py]) => [across(value(whole, 'x', panel.width, px)), up(value(y.whole, 'y', panel.height, py))];
      panel.lines.forEach(line => {
        line.group.style.display = hidden.has(line.group.dataset.name) ? 'none' : '';
        if (line.path) line.path.setAttribute('d', line.points.map((p, k) => (k ? 'L' : 'M') + moved(p).map(v => v.toFixed(1)).join(' ')).join(''));
        line.marks.forEach(mark => {
          if (!mark.at) { const box = mark.mark.getBBox(); mark.at = [box.x + box.width / 2, box.y + box.height / 2]; }
          const [a, b] = moved(mark.at);
          mark.mark.setAttribute('transform', `translate(${(a - mark.at[0]).toFixed(1)} ${(b - mark.at[1]).toFixed(1)})`);
        });
      });
      const named = panel.texts.some(panel.is.x);
      const grid = (named ? relabel(panel, 'x', x, view, across) : '') + relabel(panel, 'y', y, high, up);
      if (panel.grid) panel.grid.setAttribute('d', grid);
      if (panel.axis) panel.axis.setAttribute('d', `M0 0V${panel.height}H${panel.width}` + (high[0] < 0 && high[1] > 0 && !y.log ? `M0 ${up(0).toFixed(1)}H${panel.width}` : ''));
      for (const [of, axis] of [['x', x], ['y', y]]) {
        if (panel.label[of] && axis.shown) panel.label[of].textContent = panel.label[of].textContent.replace(/\[[^\]]+\](\s*)$/, `[${axis.shown}]$1`);
      }
      panel.cursor.setAttribute('d', at === null || at < view[0] || at > view[1] ? '' : `M${across(at).toFixed(1)} 0V${panel.height}`);
    }));

    const readout = element('output', { className: 'readout' });
    // to what a tenth of a pixel is worth, as finely as the lines are drawn
    const worded = (axis, v, size) => {
      if (axis.log) return sign(String(Number((10 ** v).toPrecision(3))));
      const worth = Math.abs(axis.to(axis.whole[1]) - axis.to(axis.whole[0])) / size / 10;
      return sign(axis.to(v).toFixed(Math.min(12, Math.max(0, Math.ceil(-Math.log10(worth))))).replace(/^-(0(\.0*)?)$/, '$1'));
    };
    const read = () => {
      if (at === null) return;
      const { x } = panels[0];
      const parts = first.flatMap((panel, n) => panel.lines.filter(line => line.rises && !hidden.has(line.group.dataset.name)).map(line => {
        const pixel = scale(whole, 0, panel.width)(at);
        const near = line.points.reduce((best, p) => (Math.abs(p[0] - pixel) < Math.abs(best[0] - pixel) ? p : best));
        const { y } = panels[n], called = line.group.dataset.name || said(panel, 'y').replace(/\s*\[[^\]]+\]\s*$/, '');
        return `${called} ${worded(y, value(y.whole, 'y', panel.height, near[1]), panel.height)}${y.shown ? ' ' + y.shown : ''}`;
      }));
      readout.textContent = `${worded(x, at, first[0].width)}${x.shown ? ' ' + x.shown : ''}: ${parts.join('; ')}`;
    };
    const point = v => {
      at = Math.min(view[1], Math.max(view[0], v));
      slider.value = String(Math.round(scale(view, 0, 1000)(at)));
      draw();
      read();
    };
    const zoom = range => {
      const least = (whole[1] - whole[0]) / 500;
      let [a, b] = range;
      if (b - a < least) [a, b] = [(a + b - least) / 2, (a + b + least) / 2];
      a = Math.max(a, whole[0]);
      b = Math.min(b, whole[1]);
      view = a <= whole[0] && b >= whole[1] ? whole : [a, b];
      draw();
      read();
    };
    const about = factor => {
      const middle = at === null ? (view[0] + view[1]) / 2 : at;
      zoom([middle - (middle - view[0]) * factor, middle + (view[1] - middle) * factor]);
    };

    const slider = element('input', { type: 'range', min: '0', max: '1000', value: '0' });
    slider.setAttribute('aria-label', 'Place along the abscissa');
    slider.addEventListener('input', () => point(scale([0, 1000], view[0], view[1])(+slider.value)));
    const button = (text, act) => {
      const made = element('button', { type: 'button', textContent: text });
      made.addEventListener('click', act);
      return made;
    };
    const tools = element('div', { className: 'hand' });
    names.length > 1 && names.forEach(name => {
      const box = element('input', { type: 'checkbox', checked: true });
      box.addEventListener('change', () => { hidden[box.checked ? 'delete' : 'add'](name); draw(); read(); });
      tools.append(element('label', {}, box, ' ' + name));
    });
    const chosen = new Map();
    panels.flatMap(panel => [panel.x, panel.y]).filter(axis => axis.units.length > 1).forEach(axis => chosen.set(axis.unit, [...(chosen.get(axis.unit) || []), axis]));
    chosen.forEach((axes, unit) => {
      const select = element('select', {}, ...axes[0].units.map(name => element('option', { textContent: name, selected: name === unit })));
      select.setAttribute('aria-label', 'Unit in place of ' + unit);
      select.addEventListener('change', () => { axes.forEach(axis => { axis.shown = select.value; }); draw(); read(); });
      tools.append(select);
    });
    if (together) {
      tools.append(slider, button('Closer', () => about(0.5)), button('Wider', () => about(2)), button('Whole', () => zoom(whole)));
      const place = event => {
        const drawing = drawings.find(drawing => drawing[0].plot.ownerSVGElement === event.currentTarget);
        const panel = drawing && drawing[0], from = panel.plot.getScreenCTM();
        return value(view, 'x', panel.width, (event.clientX - from.e) / from.a);
      };
      let held = null;
      drawings.forEach(([panel]) => {
        const paper = panel.plot.ownerSVGElement;
        paper.classList.add('touched');
        paper.addEventListener('pointerdown', event => { held = place(event); });
        paper.addEventListener('pointermove', event => point(place(event)));
        paper.addEventListener('pointerup', event => {
          const end = place(event), start = held;
          held = null;
          if (start !== null && Math.abs(end - start) > (view[1] - view[0]) / 50) zoom([Math.min(start, end), Math.max(start, end)]);
        });
        paper.addEventListener('dblclick', () => zoom(whole));
      });
    }
    tools.append(readout);
    frame.querySelector('figcaption').before(tools);
  };
  root.querySelectorAll('figure').forEach(figure);
};
hand(document);
