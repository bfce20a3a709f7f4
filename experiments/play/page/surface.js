// What the 3D view draws of a surface: over each patch (base face) a triangular grid of (n+1)(n+2)/2 points, n = 2^level,
// as indices of vertices. Vertices of a coarser level are the first ones of a finer level.
const Surface = (() => {
  function bytesOf(text) {
    const raw = atob(text), bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
    return bytes;
  }

  // The bytes of a script element that holds base64 of gzip.
  async function unpacked(id) {
    const packed = new Blob([bytesOf(byId(id).textContent.trim())]).stream();
    return new Uint8Array(await new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer());
  }

  // Places on the grid of the corners of the faces that a patch is quadrisected into, by the rule of
  // remesh/semiregular.h.
  function corners(level) {
    const n = 1 << level, middle = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    let faces = [[[0, 0], [n, 0], [0, n]]];
    for (let l = 0; l < level; ++l)
      faces = faces.flatMap(([a, b, c]) => {
        const ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
      });
    return faces.flat().map(([i, j]) => j * (2 * n + 3 - j) / 2 + i);
  }

  // The grids of a mesh with `faces` in the order of the subdivision.
  function gridOf(faces, level) {
    const n = 1 << level, inPatch = (n + 1) * (n + 2) / 2, places = corners(level);
    const grid = new Uint32Array(faces.length / places.length * inPatch);
    for (let k = 0; k < faces.length; ++k)
      grid[Math.floor(k / places.length) * inPatch + places[k % places.length]] = faces[k];
    return grid;
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

  // What does not depend on positions: faces, patch coordinates, patch colours.
  function connectivity(grid, level, colours) {
    const n = 1 << level, inPatch = (n + 1) * (n + 2) / 2, patches = grid.length / inPatch;
    const faces = patchFaces(n), index = new Uint32Array(patches * faces.length);
    const weights = new Float32Array(2 * grid.length), colour = new Uint8Array(3 * grid.length);
    for (let p = 0; p < patches; ++p) {
      for (let k = 0; k < faces.length; ++k) index[p * faces.length + k] = p * inPatch + faces[k];
      let v = p * inPatch;
      for (let j = 0; j <= n; ++j)
        for (let i = 0; i + j <= n; ++i, ++v) {
          weights[2 * v] = i / n;
          weights[2 * v + 1] = j / n;
          colour.set(colours[p], 3 * v);
        }
    }
    return { grid, index, weights, colour };
  }

  // Coordinates in the view's box [low, high], moved and scaled such that its longest side is from -1 to 1.
  function fitted(view, positions) {
    const { low, high } = view, result = new Float32Array(positions.length);
    const half = Math.max(...[0, 1, 2].map((k) => high[k] - low[k])) / 2 || 1;
    for (let i = 0; i < positions.length; ++i) {
      const k = i % 3;
      result[i] = (positions[i] - low[k] - (high[k] - low[k]) / 2) / half;
    }
    return result;
  }

  // The same of coordinates that are stored as 16 bits in the box.
  function stored(view, text) {
    const { low, high } = view;
    const raw = new Uint16Array(bytesOf(text).buffer);
    return fitted(view, Float64Array.from(raw, (r, i) => low[i % 3] + r / 65535 * (high[i % 3] - low[i % 3])));
  }

  // Area-weighted, over the surface's vertices and not the grid's, so that no patch edge shows.
  function normals(grid, index, position) {
    const sum = new Float32Array(position.length);
    for (let f = 0; f < index.length; f += 3) {
      const a = 3 * grid[index[f]], b = 3 * grid[index[f + 1]], c = 3 * grid[index[f + 2]];
      const ux = position[b] - position[a], uy = position[b + 1] - position[a + 1], uz = position[b + 2] - position[a + 2];
      const vx = position[c] - position[a], vy = position[c + 1] - position[a + 1], vz = position[c + 2] - position[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      sum[a] += nx; sum[a + 1] += ny; sum[a + 2] += nz;
      sum[b] += nx; sum[b + 1] += ny; sum[b + 2] += nz;
      sum[c] += nx; sum[c + 1] += ny; sum[c + 2] += nz;
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

  const shares = (text) => Float32Array.from(bytesOf(text), (v) => v / 255);

  return { bytesOf, unpacked, gridOf, connectivity, fitted, stored, normals, spread, shares };
})();
