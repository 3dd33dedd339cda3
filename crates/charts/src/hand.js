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
  const fixed = (value, digits) => sign(value.toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1'));
  const scale = (range, from, to) => value => from + (value - range[0]) / (range[1] - range[0]) * (to - from);
  // the value of a line at a place, as it is drawn; none farther than `slack` beyond its ends
  const on = (points, at, slack) => {
    const place = Math.min(Math.max(at, points[0][0]), points[points.length - 1][0]);
    if (Math.abs(place - at) > slack) return undefined;
    const n = points.findIndex(([x]) => x >= place);
    if (!n) return points[0][1];
    const [[a, v], [b, w]] = [points[n - 1], points[n]];
    return v + (w - v) * (place - a) / (b - a);
  };

  // round numbers between two ends of an axis, some `most` of them, with their labels; logarithms along a logarithmic axis
  const ticks = (axis, range, most) => {
    const [low, high] = range.map(axis.to);
    const power = p => '10' + String(p).replace(/./g, c => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
    const multiples = (step, from, to) => Array.from({ length: Math.floor(to / step + 1e-9) - Math.ceil(from / step - 1e-9) + 1 }, (_, n) => (Math.ceil(from / step - 1e-9) + n) * step);
    if (axis.log && high - low > 0.7) {
      const factors = high - low > 2.5 ? [1] : [1, 2, 5];
      return multiples(Math.ceil((high - low) / most), Math.floor(low), high).flatMap(p => factors.map(f => [p + Math.log10(f), Math.abs(p) > 3 ? (f > 1 ? f + ' · ' : '') + power(p) : String(Number((f * 10 ** p).toPrecision(1)))]))
        .filter(([v]) => v >= low && v <= high);
    }
    const [a, b] = axis.log ? [10 ** low, 10 ** high] : [low, high];
    const raw = (b - a) / most, decade = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find(n => n * decade >= raw * (1 - 1e-9)) * decade;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return multiples(step, a, b).map(v => [axis.back(axis.log ? Math.log10(v) : v), digits > 8 ? sign(v.toExponential(2)) : fixed(v, digits)]);
  };

  // one drawing of a panel
  const drawn = plot => {
    const [width, height] = numbers(plot.dataset.plot), [x, y] = [plot.dataset.x, plot.dataset.y].map(numbers);
    const right = scale([0, width], x[0], x[1]), up = scale([height, 0], y[0], y[1]);
    const lines = [...plot.querySelectorAll('[data-name]')].map(group => {
      const path = group.querySelector('path.line'), own = path ? path.getAttribute('d') : group.dataset.points;
      const pixels = (own.match(/[-.\d]+ [-.\d]+/g) || []).map(numbers), moves = own.match(/[ML]/g) || [];
      const points = pixels.map(([a, b]) => [right(a), up(b)]);
      const marks = [...group.children].filter(mark => mark !== path);
      // a line that turns back has no one value at a place, and a guide none of its own
      const read = path && !path.classList.contains('guide') && points.length > 1 && points.every(([a], n) => !n || a >= points[n - 1][0]);
      return { group, name: group.dataset.name, path, own, moves, pixels, points, marks, read };
    });
    const texts = [...plot.children].filter(child => child.tagName === 'text'), font = parseFloat(plot.ownerSVGElement.getAttribute('font-size'));
    const ticks = texts.filter(t => t.getAttribute('text-anchor') === 'end' || +t.getAttribute('y') < height + 2 * font);
    const labels = { x: texts.find(t => !ticks.includes(t)), y: plot.previousElementSibling };
    // lines stay between the axes, and a hand is felt there
    const window = svg('svg', { width, height, overflow: 'hidden' }), cursor = svg('path', { class: 'cursor' }), touch = svg('rect', { class: 'touch', width, height });
    lines[0].group.before(window);
    window.append(...lines.map(line => line.group));
    plot.append(cursor, touch);
    const [grid, axis] = ['grid', 'axis'].map(name => { const path = plot.querySelector('.' + name); return { path, own: path.getAttribute('d') }; });
    return { plot, width, height, x, y, lines, ticks, shown: ticks, labels, font, cursor, touch, grid, axis };
  };

  // its unit changes with its label alone
  const axis = (label, log, labelled) => {
    const unit = (/\[([^\]]+)\]\s*$/.exec(label) || [])[1];
    // kelvins are differences, which have no zero to shift
    const group = log || !labelled || unit === 'K' ? undefined : UNITS.find(group => group[unit]);
    const made = { log, unit, shown: unit, units: group ? Object.keys(group) : [] };
    const [factor, offset = 0] = group ? group[unit] : [1];
    made.to = v => { const [f, o = 0] = group ? group[made.shown] : [1]; return group ? (v * factor + offset - o) / f : v; };
    made.back = v => { const [f, o = 0] = group ? group[made.shown] : [1]; return group ? (v * f + o - offset) / factor : v; };
    return made;
  };

  // tools for panels that share an abscissa: of each drawing the same
  const tools = (drawings, alone) => {
    const first = drawings[0], along = first[0].plot.dataset.along, labelled = first.some(panel => panel.labels.x);
    const axes = first.map(panel => ({ x: axis(along, panel.x[2], labelled), y: axis(panel.labels.y.textContent, panel.y[2], true) }));
    const bare = label => label.replace(/\s*\[[^\]]+\]\s*$/, '');
    const whole = first[0].x, names = [...new Set(first.flatMap(panel => panel.lines.map(line => line.name)).filter(name => name))];
    const hidden = new Set(), slack = (whole[1] - whole[0]) / first[0].width;
    const visible = panel => panel.lines.filter(line => !hidden.has(line.name));
    // the stretch that is seen if not all is, the place that is read, and where a stretch begins
    let view = null, at = null, held = null;

    const heights = panel => {
      const inside = view ? visible(panel).flatMap(({ points, read }) => points.filter(([a]) => a >= view[0] && a <= view[1]).map(([, b]) => b)
        .concat(read ? view.map(end => on(points, end, 0)).filter(b => b !== undefined) : [])) : [];
      if (!inside.length) return panel.y;
      const low = inside.reduce((a, b) => Math.min(a, b)), high = inside.reduce((a, b) => Math.max(a, b));
      const margin = Math.max((high - low) * 0.05, (panel.y[1] - panel.y[0]) * 1e-3);
      return [low - margin, high + margin];
    };
    const mark = () => drawings.flat().forEach(panel => {
      const range = view || panel.x, places = [at, held].filter(v => v !== null && v >= range[0] && v <= range[1]);
      panel.cursor.setAttribute('d', places.map(v => `M${scale(range, 0, panel.width)(v).toFixed(1)} 0V${panel.height}`).join(''));
    });
    const draw = () => {
      drawings.forEach(panels => panels.forEach((panel, n) => {
        const { x, y } = axes[n], { width, height, font } = panel, across = view || panel.x, high = heights(panel);
        const right = scale(across, 0, width), up = scale(high, height, 0), place = ([a, b]) => [right(a), up(b)];
        panel.lines.forEach(line => {
          line.group.style.display = hidden.has(line.name) ? 'none' : '';
          if (line.path) line.path.setAttribute('d', view ? line.points.map((p, k) => line.moves[k] + place(p).map(v => v.toFixed(1)).join(' ')).join('') : line.own);
          line.marks.forEach((mark, k) => mark.setAttribute('transform', `translate(${place(line.points[k]).map((v, of) => (v - line.pixels[k][of]).toFixed(1)).join(' ')})`));
        });
        panel.shown.forEach(t => t.remove());
        const named = panel.ticks.some(t => t.getAttribute('text-anchor') !== 'end');
        const texts = (axis, range, most, attributes) => ticks(axis, range, Math.max(2, most)).map(([v, text]) => Object.assign(svg('text', attributes(v)), { textContent: text }));
        const own = !view && x.shown === x.unit && y.shown === y.unit, middle = 0.35 * font;
        panel.shown = own ? panel.ticks : [
          ...named ? texts(x, across, width / (6 * font), v => ({ x: right(v).toFixed(1), y: (height + 1.4 * font).toFixed(1), 'text-anchor': 'middle' })) : [],
          ...texts(y, high, height / (3 * font), v => ({ x: (-0.5 * font).toFixed(1), y: (up(v) + middle).toFixed(1), 'text-anchor': 'end' })),
        ];
        panel.plot.append(...panel.shown);
        panel.grid.path.setAttribute('d', own ? panel.grid.own : panel.shown.map(t => (t.getAttribute('text-anchor') === 'end' ? `M0 ${(t.getAttribute('y') - middle).toFixed(1)}H${width}` : `M${t.getAttribute('x')} 0V${height}`)).join(''));
        panel.axis.path.setAttribute('d', own ? panel.axis.own : `M0 0V${height}H${width}` + (high[0] < 0 && high[1] > 0 && !y.log ? `M0 ${up(0).toFixed(1)}H${width}` : ''));
        for (const [of, axis] of [['x', x], ['y', y]]) {
          if (panel.labels[of] && axis.shown) panel.labels[of].textContent = panel.labels[of].textContent.replace(/\[[^\]]+\](\s*)$/, `[${axis.shown}]$1`);
        }
      }));
      mark();
      read();
    };

    const readout = element('output', { className: 'readout' });
    // to a tenth of a pixel, as finely as lines are drawn
    const worded = (axis, v, range, size) => {
      const worth = Math.abs(axis.to(range[1]) - axis.to(range[0])) / size / 10, unit = axis.shown ? ' ' + axis.shown : '';
      return (axis.log ? sign(String(Number((10 ** v).toPrecision(3)))) : fixed(axis.to(v), Math.min(12, Math.max(0, Math.ceil(-Math.log10(worth)))))) + unit;
    };
    const read = () => {
      if (at === null) return;
      const values = first.flatMap((panel, n) => visible(panel).filter(line => line.read).map(line => {
        const value = on(line.points, at, slack), name = line.name || bare(panel.labels.y.textContent);
        return [name + ' ', value === undefined ? '–' : worded(axes[n].y, value, panel.y, panel.height)];
      }));
      readout.replaceChildren(worded(axes[0].x, at, whole, first[0].width) + ': ', ...values.flatMap(([name, text], n) => [n ? '; ' : '', name, element('b', { textContent: text })]));
    };
    const point = v => {
      const range = view || whole;
      at = Math.min(range[1], Math.max(range[0], v));
      slider.value = String(Math.round(scale(range, 0, 1000)(at)));
      mark();
      read();
    };
    const zoom = ([a, b]) => {
      const least = (whole[1] - whole[0]) / 500;
      if (b - a < least) [a, b] = [(a + b - least) / 2, (a + b + least) / 2];
      view = a <= whole[0] && b >= whole[1] ? null : [Math.max(a, whole[0]), Math.min(b, whole[1])];
      draw();
    };
    const about = factor => {
      const range = view || whole, middle = at === null ? (range[0] + range[1]) / 2 : at;
      zoom(range.map(end => middle + (end - middle) * factor));
    };

    const bar = element('div', { className: 'hand' }, ...alone ? [] : [bare(along) + ':']);
    const button = (text, act) => {
      const made = element('button', { type: 'button', textContent: text });
      made.addEventListener('click', act);
      return made;
    };
    names.length > 1 && names.forEach(name => {
      const box = element('input', { type: 'checkbox', checked: true });
      box.addEventListener('change', () => { hidden[box.checked ? 'delete' : 'add'](name); draw(); });
      bar.append(element('label', {}, box, ' ' + name));
    });
    const alike = new Map();
    axes.flatMap(({ x, y }) => [x, y]).filter(axis => axis.units.length > 1).forEach(axis => alike.set(axis.unit, [...(alike.get(axis.unit) || []), axis]));
    alike.forEach((all, unit) => {
      const select = element('select', { title: 'Unit in place of ' + unit }, ...all[0].units.map(name => element('option', { textContent: name, selected: name === unit })));
      select.addEventListener('change', () => { all.forEach(axis => { axis.shown = select.value; }); draw(); });
      bar.append(element('label', {}, 'unit ', select));
    });
    const slider = element('input', { type: 'range', min: '0', max: '1000', value: '0' });
    slider.setAttribute('aria-label', 'Place along: ' + bare(along));
    slider.addEventListener('input', () => point(scale([0, 1000], ...(view || whole))(+slider.value)));
    bar.append(element('span', {}, slider, button('Closer', () => about(0.5)), button('Wider', () => about(2)), button('Whole', () => zoom(whole))), readout);
    drawings.flat().forEach(({ plot, touch, width, x }) => {
      const place = event => { const from = plot.getScreenCTM(); return scale([0, width], ...(view || x).slice(0, 2))((event.clientX - from.e) / from.a); };
      touch.addEventListener('pointermove', event => point(place(event)));
      // a finger reads; a mouse that is held marks a stretch
      touch.addEventListener('pointerdown', event => { held = event.pointerType === 'touch' ? null : place(event); });
      touch.addEventListener('pointerleave', () => { held = null; mark(); });
      touch.addEventListener('pointerup', event => {
        const ends = [held, place(event)].sort((a, b) => a - b), [from, to] = view || whole, marked = held !== null && ends[1] - ends[0] > (to - from) / 50;
        held = null;
        if (marked) zoom(ends);
        else mark();
      });
      touch.addEventListener('dblclick', () => zoom(whole));
    });
    return bar;
  };

  root.querySelectorAll('figure').forEach(frame => {
    const plots = [...frame.querySelectorAll('svg.plot')].map(s => [...s.querySelectorAll('g[data-x]')].filter(plot => plot.querySelector('[data-name]')));
    const ranges = (plots[0] || []).map(plot => plot.dataset.x + plot.dataset.along), kinds = new Set(ranges);
    // many small panels with an abscissa each would drown in tools
    if (!kinds.size || kinds.size > 3) return;
    const drawings = plots.map(panels => panels.map(drawn));
    kinds.forEach(range => {
      const of = list => list.filter((_, n) => ranges[n] === range);
      frame.querySelector('figcaption').before(tools(drawings.map(of), kinds.size === 1));
    });
  });
};
hand(document);
