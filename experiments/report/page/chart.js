// The rate-distortion chart of one model, drawn as SVG.
const Chart = (() => {
  const margin = { left: 48, right: 12, top: 10, bottom: 40 };
  const known = { gsp: '#c8102e', 'maps-smoothed': '#1f5fa8', maps: '#7fb2e5', 'decimate-draco': '#2b2b2b', 'lindstrom-turk-draco': '#8a6d3b',
    draco: '#9a9a9a' };
  const further = ['#6a3d9a', '#1b7f5c', '#c77a00', '#00829b', '#a6408c', '#5d7a00', '#7a5230', '#3b4cc0', '#d1495b', '#66a182'];

  // As method_colors (plot.cpp) does it, so that the page and its figures agree.
  function colours(labels) {
    const result = {};
    let next = 0;
    for (const label of labels) {
      const own = known[label.split(' ')[0]];
      result[label] = own && !Object.values(result).includes(own) ? own : further[next++ % further.length];
    }
    return result;
  }

  function ticks(low, high, count) {
    const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
    const result = [];
    for (let t = Math.ceil(low / step) * step; t <= high + 1e-9 * step; t += step) result.push(t);
    return result;
  }

  function byteTicks(low, high, log) {
    if (!log) return ticks(low / 1024, high / 1024, 6).map((kilobytes) => 1024 * kilobytes);
    const result = [];
    for (let t = 2 ** Math.ceil(Math.log2(low)); t <= high; t *= 4) result.push(t);
    return result;
  }

  // The anchors' tails far beyond the progressive curves would only shrink the rest.
  function range(curves) {
    const coded = curves.filter((c) => c.ceiling_db !== null);
    const shown = coded.length ? coded : curves;
    const bytes = shown.flatMap((c) => c.points.map((p) => p.bytes));
    const heights = curves.flatMap((c) => c.points.filter((p) => p.bytes <= Math.max(...bytes) && p.psnr_db < Infinity))
      .map((p) => p.psnr_db);
    const tops = coded.map((c) => c.ceiling_db).filter((db) => db < Infinity);
    // Where all points are exact there are no heights, and any will do.
    const top = tops.length ? Math.max(...tops) + 2 : heights.length ? Math.max(...heights) + 2 : 100;
    const low = heights.length ? Math.min(...heights) - 1 : top - 100;
    // One size alone has no extent.
    const first = Math.min(...bytes), last = Math.max(...bytes);
    return { x: [first, last > first ? last : 2 * first], y: [low, top] };
  }

  function scales(curves, width, height, log) {
    const { x, y } = range(curves);
    const along = log ? Math.log2 : (v) => v;
    const from = along(log ? x[0] : 0), to = along(x[1] * (log ? 1.05 : 1.02));
    return {
      domain: { x: [log ? x[0] : 0, x[1]], y },
      x: (v) => margin.left + (along(v) - from) / (to - from) * (width - margin.left - margin.right),
      // What is exact stands at the upper edge.
      y: (v) => height - margin.bottom - (Math.min(v, y[1]) - y[0]) / (y[1] - y[0]) * (height - margin.top - margin.bottom),
    };
  }

  function axes(svg, scale, width, height, log) {
    for (const t of byteTicks(scale.domain.x[0], scale.domain.x[1], log)) {
      const x = scale.x(t);
      svg.append(element('line', { class: 'grid', x1: x, x2: x, y1: margin.top, y2: height - margin.bottom }),
        element('text', { x, y: height - margin.bottom + 16, 'text-anchor': 'middle' }, bytesText(t)));
    }
    for (const t of ticks(scale.domain.y[0], scale.domain.y[1], 8)) {
      const y = scale.y(t);
      svg.append(element('line', { class: 'grid', x1: margin.left, x2: width - margin.right, y1: y, y2: y }),
        element('text', { x: margin.left - 7, y: y + 4, 'text-anchor': 'end' }, String(+t.toFixed(6))));
    }
    svg.append(
      element('line', { class: 'axis', x1: margin.left, x2: width - margin.right, y1: height - margin.bottom, y2: height - margin.bottom }),
      element('line', { class: 'axis', x1: margin.left, x2: margin.left, y1: margin.top, y2: height - margin.bottom }),
      element('text', { x: width - margin.right, y: height - 6, 'text-anchor': 'end' }, 'bytes'),
      element('text', { x: 4, y: margin.top + 2, 'dominant-baseline': 'hanging' }, 'dB'));
  }

  const exact = (point) => point.psnr_db === Infinity;

  // The points that a curve is drawn by: of several replicates their means.
  const drawn = (curve) => curve.spread || curve.points;

  // From the lowest to the highest of the replicates.
  function band(points, scale) {
    const at = (p, y) => `${scale.x(p.bytes).toFixed(1)},${scale.y(y).toFixed(1)}`;
    return `M${points.map((p) => at(p, p.high_db)).join('L')}L${[...points].reverse().map((p) => at(p, p.low_db)).join('L')}Z`;
  }

  // Only points that no smaller size reaches are on the curve; the others are shown as points.
  function envelope(points) {
    let best = -Infinity;
    return [...points].sort((a, b) => a.bytes - b.bytes || b.psnr_db - a.psnr_db)
      .filter((p) => p.psnr_db > best && ((best = p.psnr_db), true));
  }

  function tip(frame, curve, point, x, y) {
    const box = byId('tip');
    box.innerHTML = '';
    const lines = curve.spread ? [`${Math.round(point.bytes).toLocaleString('en')} bytes`,
      exact(point) ? 'exact' : `${point.psnr_db.toFixed(2)} dB, the mean of ${curve.replicates} replicates`,
      ...exact(point) ? [] : [`${point.low_db.toFixed(2)} to ${point.high_db.toFixed(2)} dB`]]
      : [`${point.bytes.toLocaleString('en')} bytes · ${point.bits_per_vertex.toPrecision(3)} bits/vertex`,
        exact(point) ? 'exact' : `${point.psnr_db.toFixed(2)} dB ± ${point.standard_error_db.toPrecision(1)}`,
        `RMS ${point.rms.toExponential(2)} (→ ${point.rms_forward.toExponential(2)}, ← ${point.rms_backward.toExponential(2)})`,
        `Hausdorff ≥ ${point.hausdorff.toExponential(2)} · ${point.faces.toLocaleString('en')} faces`];
    box.append(element('b', {}, curve.label), element('br'), ...lines.flatMap((line) => [line, element('br')]));
    box.hidden = false;
    const left = x + 16 + box.offsetWidth > frame.clientWidth ? x - 16 - box.offsetWidth : x + 16;
    box.style.left = `${Math.max(0, left)}px`;
    box.style.top = `${Math.max(0, y - box.offsetHeight - 8)}px`;
  }

  function follow(svg, curves, scale) {
    const frame = byId('chart-frame');
    const mark = element('circle', { r: 5, fill: 'none', 'stroke-width': 2, visibility: 'hidden' });
    svg.append(mark);
    svg.onpointermove = (event) => {
      const box = svg.getBoundingClientRect();
      const px = event.clientX - box.left, py = event.clientY - box.top;
      let best = null;
      for (const curve of curves)
        for (const point of curve.points) {
          const d = Math.hypot(scale.x(point.bytes) - px, scale.y(point.psnr_db) - py);
          if (!best || d < best.d) best = { d, curve, point };
        }
      const near = best && best.d < 40;
      mark.setAttribute('visibility', near ? 'visible' : 'hidden');
      byId('tip').hidden = !near;
      if (!near) return;
      const x = scale.x(best.point.bytes), y = scale.y(best.point.psnr_db);
      mark.setAttribute('cx', x);
      mark.setAttribute('cy', y);
      mark.setAttribute('stroke', best.curve.colour);
      tip(frame, best.curve, best.point, x, y);
    };
    svg.onpointerleave = () => { byId('tip').hidden = true; mark.setAttribute('visibility', 'hidden'); };
  }

  function draw(svg, all, hidden, reference, log, ceilings) {
    svg.replaceChildren();
    const curves = all.filter((c) => c.points.length && !hidden.includes(c.label));
    if (!curves.length) return;
    const width = svg.clientWidth || 800, height = svg.clientHeight || 430;
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const scale = scales(curves, width, height, log);
    axes(svg, scale, width, height, log);
    const clip = (p) => p.bytes >= scale.domain.x[0] && p.bytes <= scale.domain.x[1] * 1.05 && (exact(p) || p.psnr_db <= scale.domain.y[1]);
    for (const curve of [...curves].reverse()) {
      if (ceilings && curve.ceiling_db !== null && curve.ceiling_db < Infinity) {
        const y = scale.y(curve.ceiling_db);
        svg.append(element('path', { class: 'ceiling', stroke: curve.colour, d: `M${margin.left},${y}H${width - margin.right}`, 'data-label': curve.label }));
      }
      const shown = drawn(curve).filter(clip), high = shown.filter((p) => !exact(p));
      if (curve.spread && high.length > 1)
        svg.append(element('path', { class: 'band', fill: curve.colour, d: band(high, scale), 'data-label': curve.label }));
      const line = curve.spread ? high : envelope(high);
      svg.append(element('path', {
        class: curve.label === reference ? 'curve first' : 'curve', stroke: curve.colour, 'data-label': curve.label,
        d: line.map((p, i) => `${i ? 'L' : 'M'}${scale.x(p.bytes).toFixed(1)},${scale.y(p.psnr_db).toFixed(1)}`).join(''),
      }));
      for (const p of shown)
        svg.append(element('circle', { cx: scale.x(p.bytes), cy: scale.y(p.psnr_db), r: exact(p) ? 4 : 2.2, fill: curve.colour, class: exact(p) ? 'exact' : '' }));
    }
    follow(svg, curves.map((c) => ({ ...c, points: drawn(c).filter(clip) })), scale);
  }

  return { draw, colours };
})();
