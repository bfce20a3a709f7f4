// The page of `gsp play`: one stream, a slider over its bytes.
(() => {
  const view = JSON.parse(byId('played').textContent);
  const steps = Number(byId('budget').max), low = view.header_bytes, high = view.bytes;
  const kinds = [['shape', 'shape'], ['patches', 'patches'], ['isolines', 'iso-lines']];
  const numbers = { patches: 0, isolines: 1, shape: 3 };

  State.declare('bytes', high);
  State.declare('colours', 'shape');
  State.declare('lines', 3);
  State.declare('edges', 0);

  const message = (text) => {
    byId('view-message').textContent = text;
    byId('view-message').hidden = !text;
  };

  const wanted = () => Math.min(high, Math.max(low, Math.round(Number(State.get('bytes'))) || high));

  let shape = null, shown = null;
  const draw = latest(async () => {
    try {
      const bytes = wanted();
      if (shown !== bytes) shape = await decodedShape(view, bytes);
      shown = bytes;
      const kind = State.get('colours');
      await Viewer.show(view, shape, { kind: numbers[kind] ?? 3, values: null, density: 2 ** Number(State.get('lines')), edges: State.flag('edges') });
      byId('decoded').textContent = `${bytes.toLocaleString('en')} of ${high.toLocaleString('en')} bytes, ` +
        `${shape.vertices.toLocaleString('en')} vertices, level ${shape.level}` +
        (view.level < view.stream_level ? `, of ${view.stream_level}: finer ones are not shown` : '');
      message('');
    } catch (error) {
      message(error.message);
    }
  });

  function controls() {
    const kind = State.get('colours');
    setSlider(byId('budget'), wanted(), steps, low, high);
    byId('lines').value = State.get('lines');
    byId('lines-value').textContent = 2 ** Number(State.get('lines'));
    byId('lines-control').style.visibility = kind === 'isolines' ? 'visible' : 'hidden';
    byId('edges').checked = State.flag('edges');
    choice(byId('view-kinds'), 'colours', kinds, kind);
  }

  // Moves the slider from its beginning to its end in some ten seconds, as a slow line would.
  let playing = null;
  function play() {
    clearInterval(playing);
    let place = 0;
    playing = setInterval(() => {
      State.set('bytes', bytesAt(place, steps, low, high));
      if ((place += 5) > steps) clearInterval(playing);
    }, 50);
  }

  document.title = byId('title').textContent = view.name;
  message('loading');
  byId('budget').addEventListener('input', (e) => {
    clearInterval(playing);
    State.set('bytes', bytesAt(Number(e.target.value), steps, low, high));
  });
  byId('lines').addEventListener('input', (e) => State.set('lines', e.target.value));
  byId('edges').addEventListener('change', (e) => State.set('edges', e.target.checked ? 1 : 0));
  byId('load').addEventListener('click', play);
  State.on(controls);
  State.on(draw);
  State.start();
})();
