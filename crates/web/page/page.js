(() => {
  // runs beside the page, which stays at hand: the program, one question after the other
  const beside = () => {
    let ready;
    const asked = (program, question) => {
      const bytes = new TextEncoder().encode(JSON.stringify(question));
      const at = program.room(bytes.length);
      new Uint8Array(program.memory.buffer, at, bytes.length).set(bytes);
      const from = program.ask();
      return JSON.parse(new TextDecoder().decode(new Uint8Array(program.memory.buffer, from, program.length())));
    };
    onmessage = async ({ data: { module, id, question } }) => {
      if (module) ready = WebAssembly.instantiate(module, {}).then(instance => instance.exports);
      if (!question) return;
      try {
        postMessage({ id, ...asked(await ready, question) });
      } catch (error) {
        postMessage({ id, broken: String(error) });
      }
    };
  };
  const source = URL.createObjectURL(new Blob(['(' + beside + ')()'], { type: 'text/javascript' }));
  const at = id => document.getElementById(id);
  const all = selector => [...document.querySelectorAll(selector)];
  let module, worker, waiting = new Map(), count = 0;

  const start = () => {
    if (worker) worker.terminate();
    waiting = new Map();
    worker = new Worker(source);
    worker.postMessage({ module });
    worker.onmessage = ({ data }) => {
      const [done, failed] = waiting.get(data.id);
      waiting.delete(data.id);
      if (data.broken) start();
      if ('answer' in data) done(data.answer);
      else failed(new Error(data.error || 'The program stopped (' + data.broken + '). This is its fault; please report it.'));
    };
  };
  const ask = question => new Promise((done, failed) => {
    waiting.set(++count, [done, failed]);
    worker.postMessage({ id: count, question });
  });

  // the file that the fields alter, the cell of the fibre, the values of the file's fields, and what was computed last
  let file, cell, values = {}, turn = 0, computed = {};

  const state = (text, done) => {
    at('state').textContent = text;
    document.documentElement.dataset.state = done ? 'done' : 'working';
  };
  const wrong = error => {
    at('wrong').textContent = error ? error.message : '';
    at('wrong').hidden = !error;
  };
  const picture = (place, svg, words) => {
    const image = new Image();
    image.alt = words;
    image.src = 'data:image/svg+xml,' + encodeURIComponent(svg);
    at(place).replaceChildren(image);
  };
  const offer = (link, text) => {
    URL.revokeObjectURL(at(link).href);
    at(link).href = URL.createObjectURL(new Blob([text]));
    at(link).hidden = false;
  };
  const fill = () => all('[data-key]').forEach(field => {
    const value = values[field.dataset.key];
    field.disabled = value === undefined;
    field.value = field.tagName === 'SELECT' && ![...field.options].some(option => option.value === value) ? '' : value ?? '';
  });
  const changed = selector => all(selector).filter(field => field.value !== '').map(field => [Object.values(field.dataset)[0], field.value]);
  const question = () => {
    const altered = changed('[data-key]').filter(([key, value]) => value !== values[key]);
    const number = key => Number((altered.find(([other]) => other === key) || [key, values[key]])[1]);
    const [hub, bore] = ['spool.hub_thickness_mm', 'sensor.radius_mm'];
    const inner = Number(values['winding.inner_radius_mm']);
    const there = Math.abs(inner - Number(values[hub]) - Number(values[bore])) < 1e-6;
    if (there && !altered.some(([key]) => key === bore) && number(hub) !== Number(values[hub])) {
      altered.push([bore, String(Number((inner - number(hub)).toFixed(6)))]);
    }
    const design = { coil: file, values: altered };
    return at('constants').value === 'file' ? design : { ...design, cell, of_cell: changed('[data-cell]') };
  };

  const compute = async (from) => {
    const mine = ++turn;
    if (waiting.size > 0) start();
    if (from < 1 || !computed.design) [from, computed] = [0, {}];
    const show = async (text, asked, shown) => {
      state(text);
      const answer = await ask(asked);
      if (mine === turn) shown(answer);
      else throw null;
    };
    wrong();
    try {
      if (from < 1) {
        await show('The winding is laid.', { design: question() }, answer => {
          computed.design = answer;
          at('winding').textContent = answer.text;
          at('warnings').textContent = answer.warnings.join('\n');
          at('coil').value = answer.coil;
          picture('section', answer.picture, 'Section of the winding: every turn a disc, coloured by its half of the fibre.');
          offer('coil-file', answer.coil);
        });
        await show('The coil is modelled.', { sensitivity: { coil: computed.design.coil } }, answer => {
          computed.sensitivity = answer.json;
          at('sensitivity').textContent = answer.text;
        });
      }
      const run = { coil: computed.design.coil, profile: at('profile').value };
      if (at('step').value) run.step = Number(at('step').value);
      await show('The profile is run.', { simulate: run }, answer => {
        computed.bias = answer;
        at('bias').textContent = answer.text;
        at('notes').textContent = answer.notes.join('\n');
        at('figures').innerHTML = answer.figures;
        hand(at('figures'));
        offer('bias-file', answer.csv);
      });
      const { total, error_estimate: error, tolerance_sd: sd } = computed.sensitivity, { peak, numerical_error: of } = computed.bias.json;
      state(`S = ${total.toPrecision(5)} ± ${error.toPrecision(2)} (numerical) ± ${sd.toPrecision(2)} (tolerances) (°/h)/(°C/min); \
largest bias ${peak.rate_deg_per_h.toPrecision(4)} ± ${of.rate_deg_per_h.toPrecision(2)} °/h`.replace(/-/g, '\u2212'), true);
    } catch (error) {
      if (mine !== turn) return;
      wrong(error);
      state('Not computed: the message says why.', true);
    }
  };
  const replace = async text => {
    file = text;
    at('constants').value = 'file';
    if (waiting.size > 0) start();
    try {
      values = (await ask({ design: { coil: file } })).values;
      fill();
    } catch {
      // `compute` says why
    }
    compute(0);
  };

  const check = async (name, text) => {
    wrong();
    state('The recording is judged.');
    try {
      const answer = await ask({ check: { name, text } });
      computed.check = answer;
      at('check').textContent = answer.text;
      at('check').hidden = false;
      at('allan').replaceChildren();
      if (answer.picture) picture('allan', answer.picture, 'Allan deviation of the rate and of the fitted noise model.');
      if (answer.wrong) throw new Error(answer.wrong);
      state('The recording is judged, see below.', true);
      at('check').scrollIntoView();
    } catch (error) {
      wrong(error);
      state('The message says what is wrong.', true);
    }
  };
  const opened = async given => {
    if (!given) return;
    const text = await given.text();
    if (given.name.endsWith('.ron')) return replace(text);
    if (given.name.endsWith('.json')) return wrong(new Error(given.name + ': this page reads a coil as RON; the program reads JSON, too.'));
    if (/rate|gyro|omega/i.test(text.split('\n', 1)[0]) || !/chamber_c/.test(text.split('\n', 1)[0])) return check(given.name, text);
    at('profile').value = text;
    compute(1);
  };

  let later;
  const soon = from => {
    clearTimeout(later);
    state('Waiting for the end of the input.');
    later = setTimeout(() => compute(from), 250);
  };
  at('design').addEventListener('submit', event => event.preventDefault());
  at('design').addEventListener('input', () => soon(0));
  ['profile', 'step'].forEach(id => at(id).addEventListener('input', () => soon(1)));
  at('coil').addEventListener('change', () => replace(at('coil').value));
  at('file').addEventListener('change', () => opened(at('file').files[0]));
  document.addEventListener('dragover', event => {
    event.preventDefault();
    document.body.classList.add('over');
  });
  document.addEventListener('dragleave', () => document.body.classList.remove('over'));
  document.addEventListener('drop', event => {
    event.preventDefault();
    document.body.classList.remove('over');
    opened(event.dataTransfer.files[0]);
  });
  // all numbers that are shown, whole: for scripts, and for the test of this page
  window.fogcoil = () => computed;

  (async () => {
    try {
      const packed = Uint8Array.from(atob(at('program').content.textContent), c => c.charCodeAt(0));
      const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
      module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
      start();
      const files = await ask({ start: {} });
      cell = files.cell;
      at('profile').value = files.profile;
      all('[data-cell]').forEach(field => { field.value = files.adhesive[field.dataset.cell]; });
      await replace(files.coil);
    } catch (error) {
      wrong(new Error('This browser cannot run the program (' + error + '). A current one can.'));
      state('Not started.', true);
    }
  })();
})();
