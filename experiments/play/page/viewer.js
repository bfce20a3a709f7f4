// The 3D view: one mesh, a shader for all the ways of colouring it, a camera that turns around it.
const Viewer = (() => {
  const vertexShader = `
    attribute vec2 weights; attribute vec3 tint; attribute float value;
    varying vec3 vNormal; varying vec2 vWeights; varying vec3 vPatch; varying float vValue;
    void main() {
      vNormal = normalMatrix * normal; vWeights = weights; vPatch = tint; vValue = value;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    }`;
  const fragmentShader = `
    uniform int kind; uniform float density; uniform float edges; uniform float facing;
    varying vec3 vNormal; varying vec2 vWeights; varying vec3 vPatch; varying float vValue;
    float ink(float value, float width) {
      float perPixel = fwidth(value);
      float away = abs(value - floor(value + 0.5)) / max(perPixel, 1e-9);
      float line = clamp(0.5 * width + 0.5 - away, 0.0, 1.0);
      return mix(line, min(1.0, width * perPixel), clamp(perPixel * 4.0 - 0.6, 0.0, 1.0));
    }
    float lines(float count, float width) {
      vec3 w = count * vec3(vWeights, 1.0 - vWeights.x - vWeights.y);
      return max(ink(w.x, width), max(ink(w.y, width), ink(w.z, width)));
    }
    void main() {
      vec3 colour = vec3(0.86, 0.85, 0.83);
      if (kind == 0) colour = vPatch;
      if (kind == 1) colour = mix(colour, vec3(0.20, 0.32, 0.48), lines(density, 1.0));
      if (kind == 2) colour = mix(vec3(0.745), vec3(0.784, 0.063, 0.063), clamp(vValue, 0.0, 1.0));
      colour = mix(colour, vec3(0.10, 0.10, 0.14), edges * lines(1.0, 2.0));
      bool inside = !gl_FrontFacing;
      if (facing < 0.0) inside = gl_FrontFacing;
      vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
      vec3 key = normalize(vec3(-0.45, 0.6, 0.75)), fill = normalize(vec3(0.8, -0.1, 0.6));
      float light = 0.36 + 0.56 * max(0.0, dot(n, key)) + 0.16 * max(0.0, dot(n, fill));
      float gloss = 0.10 * pow(max(0.0, dot(n, normalize(key + vec3(0.0, 0.0, 1.0)))), 40.0);
      gl_FragColor = vec4(inside ? 0.55 * light * colour : light * colour + gloss, 1.0);
    }`;

  let renderer = null, scene, camera, mesh, material, shown = null, reach = 3.4, turn, wanted = false;

  async function start(canvas) {
    // A classic script, which makes the global THREE.
    (0, eval)(new TextDecoder().decode(await Surface.unpacked('three')));
    renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    scene = new THREE.Scene();
    camera = new THREE.PerspectiveCamera(30, 1, 0.05, 50);
    material = new THREE.ShaderMaterial({
      vertexShader, fragmentShader, side: THREE.DoubleSide, extensions: { derivatives: true },
      uniforms: { kind: { value: 0 }, density: { value: 8 }, edges: { value: 1 }, facing: { value: 1 } },
    });
    mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    mesh.frustumCulled = false;
    scene.add(mesh);
    turn = new THREE.Quaternion();
    steer(canvas);
    new ResizeObserver(draw).observe(canvas.parentElement);
  }

  function steer(canvas) {
    let from = null;
    canvas.addEventListener('pointerdown', (e) => { from = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener('pointerup', () => { from = null; });
    canvas.addEventListener('pointermove', (e) => {
      if (!from) return;
      const dx = e.clientX - from[0], dy = e.clientY - from[1];
      from = [e.clientX, e.clientY];
      const step = new THREE.Quaternion().setFromEuler(new THREE.Euler(dy * 0.008, dx * 0.008, 0));
      turn.premultiply(step).normalize();
      draw();
    });
    canvas.addEventListener('wheel', (e) => {
      e.preventDefault();
      reach = Math.min(12, Math.max(0.6, reach * Math.exp(0.001 * e.deltaY)));
      draw();
    }, { passive: false });
    canvas.addEventListener('dblclick', () => { if (shown) { home(shown.view); draw(); } });
  }

  function home(view) {
    const m = new THREE.Matrix4();
    const [r, u, t] = view.camera;
    m.set(r[0], r[1], r[2], 0, u[0], u[1], u[2], 0, t[0], t[1], t[2], 0, 0, 0, 0, 1);
    turn.setFromRotationMatrix(m);
    reach = 4.4;
  }

  function draw() {
    if (!renderer || wanted) return;
    wanted = true;
    requestAnimationFrame(() => {
      wanted = false;
      const frame = renderer.domElement.parentElement;
      renderer.setSize(frame.clientWidth, frame.clientHeight, false);
      camera.aspect = frame.clientWidth / frame.clientHeight;
      camera.position.set(0, 0, reach);
      camera.updateProjectionMatrix();
      mesh.quaternion.copy(turn);
      renderer.render(scene, camera);
    });
  }

  function load(view, level, grid) {
    if (shown && shown.view === view && shown.level === level) return;
    const connectivity = Surface.connectivity(grid, level, view.patch_colours);
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(connectivity.index, 1));
    geometry.setAttribute('weights', new THREE.BufferAttribute(connectivity.weights, 2));
    geometry.setAttribute('tint', new THREE.BufferAttribute(connectivity.colour, 3, true));
    mesh.geometry.dispose();
    mesh.geometry = geometry;
    const another = !shown || shown.view.model !== view.model;
    shown = { view, level, connectivity, position: null, values: null };
    material.uniforms.facing.value = view.outward;
    if (another) home(view);
  }

  function setPosition(position) {
    if (shown.position === position) return;
    shown.position = position;
    const { grid, index: faces } = shown.connectivity;
    const normal = Surface.normals(grid, faces, position);
    mesh.geometry.setAttribute('position', new THREE.BufferAttribute(Surface.spread(grid, position, 3), 3));
    mesh.geometry.setAttribute('normal', new THREE.BufferAttribute(Surface.spread(grid, normal, 3), 3));
  }

  // `values`: text of one byte a vertex, or null where the colour does not depend on a value.
  function setValues(values) {
    if (shown.values === values && mesh.geometry.getAttribute('value')) return;
    shown.values = values;
    const grid = shown.connectivity.grid;
    const shares = values === null ? new Float32Array(grid.length) : Surface.spread(grid, Surface.shares(values), 1);
    mesh.geometry.setAttribute('value', new THREE.BufferAttribute(shares, 1));
  }

  // `shape`: level, grid (surface.js) and fitted positions. Its positions are an array of their own for each surface.
  let started = null;
  async function show(view, shape, { kind, values, density, edges }) {
    await (started ||= start(byId('view')));
    load(view, shape.level, shape.grid);
    setPosition(shape.position);
    setValues(values);
    material.uniforms.kind.value = kind;
    material.uniforms.density.value = density;
    material.uniforms.edges.value = edges ? 1 : 0;
    draw();
  }

  return { show };
})();
