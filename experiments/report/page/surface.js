// Geometry of a decoded surface from the compact form in views/*.js: for each patch a triangular grid of
// (n+1)(n+2)/2 points, as indices of vertices whose coordinates are 16-bit numbers in the model's box.
const Surface = (() => {
  function bytesOf(text) {
    const raw = atob(text), bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
    return bytes.buffer;
  }

  // Faces of one patch over its grid: row j has n - j + 1 points.
  function patchFaces(n) {
    const faces = [], at = (i, j) => j * (2 * n + 3 - j) / 2 + i;
    for (let j = 0; j < n; ++j)
      for (let i = 0; i + j < n; ++i) {
        faces.push(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j < n - 1) faces.push(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    return faces;
  }

  // What is the same at every size: connectivity, patch coordinates, patch colours.
  function connectivity(view) {
    const n = 1 << view.level, inPatch = (n + 1) * (n + 2) / 2;
    const grid = new Uint32Array(bytesOf(view.grid)), patches = grid.length / inPatch;
    const faces = patchFaces(n), index = new Uint32Array(patches * faces.length);
    const weights = new Float32Array(2 * grid.length), colour = new Uint8Array(3 * grid.length);
    for (let p = 0; p < patches; ++p) {
      for (let k = 0; k < faces.length; ++k) index[p * faces.length + k] = p * inPatch + faces[k];
      let v = p * inPatch;
      for (let j = 0; j <= n; ++j)
        for (let i = 0; i + j <= n; ++i, ++v) {
          weights[2 * v] = i / n;
          weights[2 * v + 1] = j / n;
          colour.set(view.patch_colours[p], 3 * v);
        }
    }
    return { grid, index, weights, colour };
  }

  function positions(view, text) {
    const raw = new Uint16Array(bytesOf(text)), result = new Float32Array(raw.length);
    const { low, high } = view;
    const half = Math.max(...[0, 1, 2].map((k) => high[k] - low[k])) / 2;
    for (let i = 0; i < raw.length; ++i) {
      const k = i % 3;
      result[i] = (raw[i] / 65535 - 0.5) * (high[k] - low[k]) / half;
    }
    return result;
  }

  // Area-weighted, over the surface's vertices and not the grid's, so that no patch edge shows.
  function normals(grid, index, position) {
    const sum = new Float32Array(position.length);
    for (let f = 0; f < index.length; f += 3) {
      const [a, b, c] = [3 * grid[index[f]], 3 * grid[index[f + 1]], 3 * grid[index[f + 2]]];
      const ux = position[b] - position[a], uy = position[b + 1] - position[a + 1], uz = position[b + 2] - position[a + 2];
      const vx = position[c] - position[a], vy = position[c + 1] - position[a + 1], vz = position[c + 2] - position[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (const v of [a, b, c]) { sum[v] += nx; sum[v + 1] += ny; sum[v + 2] += nz; }
    }
    return sum;
  }

  // Values of the surface's vertices at the grid's points.
  function spread(grid, values, size) {
    const result = new Float32Array(size * grid.length);
    for (let v = 0; v < grid.length; ++v)
      for (let k = 0; k < size; ++k) result[size * v + k] = values[size * grid[v] + k];
    return result;
  }

  const shares = (text) => Float32Array.from(new Uint8Array(bytesOf(text)), (v) => v / 255);

  return { connectivity, positions, normals, spread, shares };
})();
