// Ties the data to the page. Views are loaded one at a time, as classic scripts, since fetch does not read files.
(() => {
  const run = JSON.parse(byId('run').textContent);
  const views = {};
  window.gspView = (file, view) => { views[file] = view; };

  // JSON has no infinity: null with a reason beside it stands for the decibels of a surface that is met exactly.
  const restore = (object, name) => { if (object[name] === null && object[`${name}_reason`]) object[name] = Infinity; };
  for (const curve of run.models.flatMap((m) => m.curves)) {
    restore(curve, 'ceiling_db');
    for (const point of [...curve.points, ...curve.spread || []]) restore(point, 'psnr_db');
  }

  const labels = [...new Set(run.models.flatMap((m) => m.curves.map((c) => c.label)))];
  const colour = Chart.colours(labels);
  for (const model of run.models) for (const curve of model.curves) curve.colour = colour[curve.label];
  const modelOf = (name) => run.models.find((m) => m.name === name) || run.models[0];
  const viewed = run.models.filter((m) => m.curves.some((c) => c.view));
  const kinds = [['patches', 'patches'], ['isolines', 'iso-lines'], ['anisotropy', 'anisotropy'], ['area', 'area'],
    ['smoothness', 'smoothness'], ['distance', 'distance'], ['shape', 'shape']];

  State.declare('model', run.models.length ? run.models[0].name : '');
  State.declare('log', 1);
  State.declare('ceilings', 1);
  State.declare('hide', '');
  State.declare('label', run.reference);
  State.declare('colours', 'patches');
  State.declare('lines', 3);
  State.declare('edges', 1);
  State.declare('size', -1);

  function drawChart() {
    const model = modelOf(State.get('model'));
    choice(byId('curve-models'), 'model', run.models.map((m) => [m.name, m.name]), model.name);
    byId('log').checked = State.flag('log');
    byId('ceilings').checked = State.flag('ceilings');
    const hidden = State.list('hide');
    Chart.draw(byId('chart'), model.curves, hidden, run.reference, State.flag('log'), State.flag('ceilings'));
    byId('legend').replaceChildren(...model.curves.filter((c) => c.points.length).map((curve) => {
      const box = element('input', { type: 'checkbox', 'data-label': curve.label });
      box.checked = !hidden.includes(curve.label);
      box.addEventListener('change', () => {
        const rest = State.list('hide').filter((label) => label !== curve.label);
        State.set('hide', (box.checked ? rest : [...rest, curve.label]).join('|'));
      });
      return element('label', {}, box, element('span', { class: 'swatch', style: `background:${curve.colour}` }),
        element('span', { class: 'name' }, curve.label));
    }));
  }

  function csv() {
    const model = modelOf(State.get('model')), hidden = State.list('hide');
    const columns = ['replicate', 'bytes', 'bits_per_vertex', 'faces', 'rms_forward', 'rms_backward', 'rms', 'hausdorff', 'psnr_db', 'standard_error_db', 'samples'];
    const csvNumber = (value) => (value === Infinity ? 'inf' : value);
    const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
    const rows = model.curves.filter((c) => !hidden.includes(c.label)).flatMap((c) =>
      c.points.map((p) => [quoted(model.name), quoted(c.label), ...columns.map((name) => csvNumber(p[name]))].join(',')));
    const text = [['model', 'label', ...columns].join(','), ...rows, ''].join('\n');
    const link = element('a', { href: URL.createObjectURL(new Blob([text], { type: 'text/csv' })), download: `${model.name}.csv` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  function message(text) {
    byId('view-message').textContent = text;
    byId('view-message').hidden = !text;
  }

  function ramp(low, high, sentence) {
    return [`${low} `, element('span', { class: 'ramp' }), ` ${high}. ${sentence}`];
  }

  function legendOf(view, kind, size) {
    const hint = 'Drag to turn, scroll to come nearer, double-click to reset.';
    if (kind === 'distance') {
      const scale = size.distance_scale;
      return ramp('0', `${scale.toExponential(2)} of the diagonal`, `Distance of the decoded surface to the input; red from the worst 5% of the vertices on. ${hint}`);
    }
    const measure = view.measures[kind];
    if (measure) return ramp(measure.gray.toPrecision(3), measure.red.toPrecision(3), `${measure.text} ${hint}`);
    if (kind === 'isolines') return [`Lines of constant barycentric coordinate. Where they bend at a patch edge, the map does. ${hint}`];
    return [hint];
  }

  const kindOf = () => (kinds.some(([name]) => name === State.get('colours')) ? State.get('colours') : 'patches');

  // Whether the slider stops at any byte: where there is one stream, and no distances, which are known of a few sizes.
  const anySize = (view, kind) => view.streams && view.streams.length === 1 && kind !== 'distance';
  const kSteps = 1000;

  // Of the sizes that were measured the nearest one.
  function measuredSize(view, bytes) {
    const away = (s) => Math.abs(Math.log(s.bytes / bytes));
    return view.sizes.reduce((best, s) => (away(s) < away(best) ? s : best));
  }

  function shownBytes(view, kind) {
    const given = Number(State.get('size')), low = view.sizes[0].bytes, high = view.sizes[view.sizes.length - 1].bytes;
    const bytes = given > 0 ? Math.min(high, Math.max(low, Math.round(given))) : high;
    return anySize(view, kind) ? bytes : measuredSize(view, bytes).bytes;
  }

  function bytesOfPlace(view, place) {
    const { sizes } = view;
    return anySize(view, kindOf()) ? bytesAt(place, kSteps, sizes[0].bytes, sizes[sizes.length - 1].bytes) : sizes[place].bytes;
  }

  function setBudget(view, bytes) {
    const { sizes } = view, budget = byId('budget'), any = anySize(view, kindOf());
    budget.max = any ? kSteps : sizes.length - 1;
    if (any) setSlider(budget, bytes, kSteps, sizes[0].bytes, sizes[sizes.length - 1].bytes);
    else budget.value = sizes.findIndex((s) => s.bytes === bytes);
  }

  // What is drawn of a view at so many bytes: decoded, or as it is stored.
  let drawn = null;
  async function shapeAt(view, bytes) {
    if (drawn && drawn.view === view && drawn.bytes === bytes) return drawn.shape;
    const size = measuredSize(view, bytes);
    let shape = null;
    if (view.streams) shape = await decodedShape(view, bytes, size.stream);
    else {
      view.stored ||= new Uint32Array(Surface.bytesOf(view.grid).buffer);
      const position = Surface.stored(view, size.positions);
      shape = { level: view.level, grid: view.stored, vertices: position.length / 3, position };
    }
    drawn = { view, bytes, shape };
    return shape;
  }

  const showShape = latest(async ({ view, bytes, look }) => {
    try {
      const shape = await shapeAt(view, bytes), size = measuredSize(view, bytes);
      const db = size.bytes !== bytes ? '' : size.psnr_db === null ? ', exact' : `, ${dbText(size.psnr_db, 1)} dB`;
      byId('budget-value').textContent = `${bytesText(bytes)}, ${shape.vertices.toLocaleString('en')} vertices${db}`;
      await Viewer.show(view, shape, look);
      message('');
    } catch (error) {
      message(`The surface cannot be shown: ${error.message}`);
    }
  });

  function showView(view) {
    const kind = kindOf(), bytes = shownBytes(view, kind), size = measuredSize(view, bytes);
    const density = 2 ** Math.min(5, Math.max(0, Number(State.get('lines')) || 0));
    setBudget(view, bytes);
    byId('lines').value = Math.log2(density);
    byId('lines-value').textContent = density;
    byId('lines-control').style.visibility = kind === 'isolines' ? 'visible' : 'hidden';
    byId('edges').checked = State.flag('edges');
    choice(byId('view-kinds'), 'colours', kinds, kind);
    byId('view-legend').replaceChildren(...legendOf(view, kind, size));
    const values = kind === 'distance' ? size.distance : view.measures[kind] ? view.measures[kind].values : null;
    const number = kind === 'patches' ? 0 : kind === 'isolines' ? 1 : values ? 2 : 3;
    showShape({ view, bytes, look: { kind: number, values, density, edges: State.flag('edges') } });
  }

  function drawView() {
    byId('surfaces-section').hidden = !viewed.length;
    if (!viewed.length) return;
    const model = viewed.find((m) => m.name === State.get('model')) || viewed[0];
    const curves = model.curves.filter((c) => c.view);
    const curve = curves.find((c) => c.label === State.get('label')) || curves[0];
    choice(byId('view-models'), 'model', viewed.map((m) => [m.name, m.name]), model.name);
    choice(byId('view-labels'), 'label', curves.map((c) => [c.label, c.label]), curve.label);
    if (views[curve.view]) return showView(views[curve.view]);
    message('loading');
    const script = element('script', { src: curve.view });
    script.onload = drawView;
    script.onerror = () => message(`${curve.view} is missing from this folder`);
    document.head.append(script);
  }

  function fillTable() {
    const head = ['', 'base', 'level', 'positions', 'ceiling', 'error', 'paper', ...run.levels_db.map((l) => `${l} dB`), 'BD-rate'];
    const some = (value, format) => (value === null || value === undefined ? '–' : format(value));
    const percent = (v) => `${v > 0 ? '+' : ''}${v.toFixed(1)} %`;
    const rows = [element('tr', {}, ...head.map((text) => element('th', {}, text)))];
    for (const model of run.models) {
      const size = model.vertices ? `  ${model.vertices.toLocaleString('en')} vertices, ${model.faces.toLocaleString('en')} faces` : '';
      const name = element('td', { colspan: head.length }, model.name, element('span', { class: 'note' }, size));
      rows.push(element('tr', { class: 'model' }, name));
      for (const c of model.curves.filter((one) => one.points.length)) {
        const cells = [c.label, some(c.base_vertices, String), some(c.level, String), some(c.positions, String), some(c.ceiling_db, (v) => dbText(v, 1)),
          some(c.remesh_error, (v) => (1e5 * v).toFixed(2)), some(c.paper_error, (v) => (1e5 * v).toFixed(2)),
          ...c.bytes_at.map((b) => some(b, (v) => Math.round(v).toLocaleString('en'))),
          c.label === run.reference ? '0' : some(c.bd_rate, (v) => percent(v) + (c.bd_interval ? ` (${percent(c.bd_interval[0])} to ${percent(c.bd_interval[1])})` : ''))];
        const row = element('tr', {}, ...cells.map((text) => element('td', {}, text)));
        if (c.bd_note) row.lastChild.title = c.bd_note;
        rows.push(row);
      }
    }
    byId('table').replaceChildren(...rows);
    byId('table-note').textContent = `Base: vertices of the base complex. Error: RMS distance of the uncoded remesh over the ` +
      `diagonal, in units of 1e-5, beside that of the paper's Table 1, ` +
      `which is of sampled positions, so only rows of those compare with it. ` +
      `dB columns: bytes at which the curve reaches it. Exact: no distance to the input is left, its PSNR is infinite. ` +
      (run.models.some((m) => m.curves.some((c) => c.mode === 'fixed')) ? `mode=fixed: a stream for each size alone; the other curves are prefixes of one. ` : '') +
      `BD-rate: mean bytes against ${run.reference} at equal PSNR, below the ceilings less 10 dB; more than 0 is worse. ` +
      (run.models.some((m) => m.curves.some((c) => c.spread)) ? `Rows of several replicates are means: of ceilings in dB, of bytes and ` +
        `BD-rates geometric, with what chance does to these, 95%. Curves are means too, with a band from the lowest to the highest.` : '');
  }

  function fillFailures() {
    byId('failures-section').hidden = !run.failures.length;
    byId('failures').replaceChildren(...run.failures.map((f) =>
      element('tr', {}, ...[f.model, f.label, f.cause].map((text) => element('td', { class: 'text' }, text)),
        element('td', { class: 'text wrap' }, f.failure))));
  }

  function fillFigures() {
    byId('figures-section').hidden = !run.figures.length;
    byId('figures').replaceChildren(...run.figures.map((f) => {
      const link = element('a', { href: f.svg || f.png }, element('img', { src: f.png, alt: f.caption, loading: 'lazy' }));
      return element('figure', {}, link, element('figcaption', {}, f.caption));
    }));
  }

  document.title = `gsp report: ${run.name}`;
  byId('title').textContent = run.name;
  byId('about').textContent = run.about;
  byId('findings').replaceChildren(...run.sentences.map((text) => element('li', {}, text)));
  fillTable();
  fillFailures();
  fillFigures();

  byId('log').addEventListener('change', (e) => State.set('log', e.target.checked ? 1 : 0));
  byId('ceilings').addEventListener('change', (e) => State.set('ceilings', e.target.checked ? 1 : 0));
  byId('edges').addEventListener('change', (e) => State.set('edges', e.target.checked ? 1 : 0));
  byId('lines').addEventListener('input', (e) => State.set('lines', e.target.value));
  byId('budget').addEventListener('input', (e) => {
    const model = viewed.find((m) => m.name === State.get('model')) || viewed[0];
    const curves = model.curves.filter((c) => c.view);
    const view = views[(curves.find((c) => c.label === State.get('label')) || curves[0]).view];
    if (view) State.set('size', bytesOfPlace(view, Number(e.target.value)));
  });
  byId('csv').addEventListener('click', csv);
  State.on(drawChart);
  State.on(drawView);
  new ResizeObserver(drawChart).observe(byId('chart-frame'));
  State.start();
})();
